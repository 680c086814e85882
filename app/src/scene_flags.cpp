#include "scene_flags.h"

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <optional>
#include <tuple>

#include "fur/builtin.h"
#include "fur/coat_file.h"
#include "fur/gltf.h"
#include "groom_flags.h"

namespace app {
namespace {

using fur::Done;
using fur::Error;
using fur::ErrorCode;
using fur::Result;

constexpr uint32_t kMaxAnimals = 10000;
const glm::dvec3 kStudioGrey{0.30, 0.32, 0.34};  // linear; an outline of fur shows on it, light and dark

Result<Done> ParseSize(const std::string& text, fur::RenderSettings* s) {
  uint32_t w = 0, h = 0;
  const char* const end = text.data() + text.size();
  const auto [x, wError] = std::from_chars(text.data(), end, w);
  const bool hasX = wError == std::errc() && x != end && *x == 'x';
  const auto [rest, hError] = std::from_chars(hasX ? x + 1 : end, end, h);
  if (hError != std::errc() || rest != end || w < 1 || h < 1 || w > kMaxSide || h > kMaxSide)
    return Error{ErrorCode::Usage, fmt::format("--size takes WxH with sides of 1..{}, not '{}'", kMaxSide, text)};
  s->width = w;
  s->height = h;
  return Done{};
}

// World positions of every vertex of every animal, with its fur: what a framing camera must show. A large field is
// represented by each hundredth vertex.
std::vector<glm::dvec3> FurredPoints(const fur::Model& model, const std::vector<glm::dmat4>& placements) {
  std::vector<glm::dvec3> points;
  const size_t step = placements.size() > 4 ? 100 : 1;
  for (const glm::dmat4& placement : placements)
    for (const fur::Part& part : model.parts) {
      const fur::Primitive& primitive = model.primitives[part.primitive];
      const fur::Material& m = model.materials[primitive.material];
      const double length = m.fur ? m.fur->params.length : 0;
      const glm::dmat4 toWorld = placement * part.transform;
      for (size_t i = 0; i < primitive.vertices.size(); i += step) {
        const fur::Vertex& v = primitive.vertices[i];
        points.push_back(toWorld * glm::dvec4(glm::dvec3(v.position) + glm::dvec3(v.normal) * length, 1));
      }
    }
  return points;
}

Result<fur::Camera> MakeCamera(const SceneFlags& f, const fur::Model& model, double scale, double aspect,
                               const std::vector<glm::dmat4>& placements) {
  const bool placed = !f.eye.empty() || !f.target.empty();
  fur::Camera camera;
  if (placed) {
    camera.fovY = f.fov > 0 ? f.fov : 65;
    camera.eye *= scale;
    camera.zNear *= scale;
    camera.zFar *= scale;
  } else {
    camera = fur::FramePoints(FurredPoints(model, placements), f.fov > 0 ? f.fov : 40, aspect, scale);
  }
  for (const auto& [flag, text, value] :
       {std::tuple{"--eye", &f.eye, &camera.eye}, {"--target", &f.target, &camera.target}}) {
    if (text->empty()) continue;
    Result<glm::dvec3> parsed = ParseVector(*text, flag);
    if (!parsed) return parsed.error();
    *value = *parsed;
  }
  if (f.zNear > 0) camera.zNear = f.zNear;
  if (f.zFar > 0) camera.zFar = f.zFar;
  if (camera.zFar <= camera.zNear) return Error{ErrorCode::Usage, "--far must be larger than --near"};
  const glm::dvec3 view = camera.target - camera.eye;
  if (glm::length(glm::cross(view, camera.up)) <= 1e-9 * glm::length(view))
    return Error{ErrorCode::Usage,
                 "--eye and --target must differ, and not be above one another: the view needs an up direction"};
  return camera;
}

}  // namespace

fur::Look LookOf(const SceneFlags& f) { return f.look == "seed" ? fur::Look::Seed : fur::Look::Correct; }

Result<Done> SetScene(const SceneFlags& f, fur::RenderSettings* s) {
  if (Result<Done> size = ParseSize(f.size, s); !size) return size.error();
  // As published: a sheet, whatever the angle.
  const bool published = s->technique == fur::Technique::Seed || s->look == fur::Look::Seed;
  const bool volume = f.semantics.empty() ? !published : f.semantics == "volume";
  s->semantics = volume ? fur::Semantics::Volume : fur::Semantics::Sheet;
  s->time = f.time;
  if (s->look == fur::Look::Seed) s->light = fur::PresetLight(s->preset);
  s->background = s->look == fur::Look::Correct ? kStudioGrey : glm::dvec3(0);
  if (f.background.empty()) return Done{};
  Result<glm::dvec3> background = ParseVector(f.background, "--background");
  if (!background) return background.error();
  if (glm::any(glm::lessThan(*background, glm::dvec3(0))) || glm::any(glm::greaterThan(*background, glm::dvec3(1))))
    return Error{ErrorCode::Usage, "--background takes values of 0..1, not '" + f.background + "'"};
  s->background = *background;
  return Done{};
}

Result<fur::Model> LoadModel(const SceneFlags& f) {
  Result<std::string> overrides = GroomOverrides(f.fur);
  if (!overrides) return overrides.error();
  std::optional<fur::Coat> coat;
  if (!f.coat.empty()) {
    Result<fur::Coat> loaded = fur::LoadCoat(f.coat);
    if (!loaded) return loaded.error();
    coat = std::move(*loaded);
  }
  const fur::LoadOptions options{.coat = coat ? &*coat : nullptr, .furFile = f.furFile, .furOverrides = *overrides,
                                 .furMaterial = f.furMaterial};
  if (!f.model.empty()) return fur::LoadGltf(f.model, options);
  fur::Model model = fur::MakeBuiltinAnimal();
  if (Result<Done> groomed = fur::GroomModel(options, &model); !groomed) return groomed.error();
  return model;
}

Result<SceneView> MakeView(const SceneFlags& f, const fur::Model& model, double aspect) {
  const double scale = fur::SceneScale(fur::ComputeBounds(model));
  SceneView view;
  view.placements = fur::PlaceAnimals(f.count, scale);
  Result<fur::Camera> camera = MakeCamera(f, model, scale, aspect, view.placements);
  if (!camera) return camera.error();
  view.camera = *camera;
  return view;
}

void PrintMessages(const std::vector<std::string>& messages) {
  for (const std::string& m : messages) fmt::print(stderr, "fur: {}\n", m);
}

void AddSceneFlags(CLI::App* c, SceneFlags* f) {
  c->add_option("MODEL", f->model, "A .gltf or .glb file; without it, the built-in animal");
  c->add_option("--size", f->size, "Width x height in pixels")->capture_default_str();
  c->add_option("--look", f->look,
                "Lighting and colour: seed (as published, raw values) or correct (sRGB, linear light)")
      ->check(CLI::IsMember({"seed", "correct"}))
      ->capture_default_str();
  c->add_option("--semantics", f->semantics,
                "A shell is a sheet (default as published: technique or look seed), or a slab of a volume")
      ->check(CLI::IsMember({"sheet", "volume"}));
  c->add_option("--eye", f->eye, "Eye, X,Y,Z; without --eye and --target the camera frames the animals");
  c->add_option("--target", f->target, "Point looked at, X,Y,Z");
  c->add_option("--fov", f->fov, "Vertical field of view in degrees; default 65, or 40 when framing")
      ->check(kFinite)
      ->check(CLI::Range(0.1, 179.0));
  c->add_option("--near", f->zNear, "Near plane")->check(kFinite)->check(CLI::PositiveNumber);
  c->add_option("--far", f->zFar, "Far plane")->check(kFinite)->check(CLI::PositiveNumber);
  c->add_option("--count", f->count, "Number of animals")->check(CLI::Range(1u, kMaxAnimals))->capture_default_str();
  c->add_option("--coat", f->coat, "A whole coat: a name (fur info --coats) or a JSON file (docs/coats.md)");
  c->add_option("--groom,--fur", f->furFile, "JSON file of fur parameters (docs/fur.md, docs/groom.schema.json)");
  c->add_option("--fur-material", f->furMaterial, "Grow fur on the material of this name only");
  c->add_option("--time", f->time, "Seconds that the wind has blown")->check(kFinite)->check(CLI::Range(0.0, 1e9));
  AddGroomFlags(c, &f->fur);
  c->add_option(
      "--background", f->background,
      "Background, R,G,B in 0..1: linear, default a grey, for look correct; raw, default black, for look seed");
}

}  // namespace app

// fur render: a model, a camera and a technique become a picture on one backend, or on each with their difference.
#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <map>
#include <optional>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>

#include "commands.h"
#include "flag_checks.h"
#include "fur/builtin.h"
#include "fur/coat_file.h"
#include "fur/file.h"
#include "fur/gltf.h"
#include "fur/image_io.h"
#include "groom_flags.h"
#include "picture_file.h"
#include "preset_flags.h"
#include "render_job.h"
#include "stats.h"

namespace app {
namespace {

using fur::Done;
using fur::Error;
using fur::ErrorCode;
using fur::Result;

constexpr uint32_t kMaxSide = 16384;
constexpr uint32_t kMaxShells = 512;
constexpr uint32_t kMaxAnimals = 10000;
const glm::dvec3 kStudioGrey{0.30, 0.32, 0.34};  // linear; an outline of fur shows on it, light and dark

struct RenderFlags {
  std::string model, output = "fur.png", backend = "vulkan", size = "1280x720", technique = "shells", look = "correct", semantics,
              preset, coat, stats, shellMode = "instanced", finMode = "auto", eye, target, adapter, furFile, furMaterial,
              background;
  std::map<std::string, std::string> fur;  // FurParams keys that flags set, as they were spelled
  uint32_t samples = 1, shells = 0, shellsAtOnce = 1, count = 1, repeat = 1;
  double fov = 0, zNear = 0, zFar = 0, time = 0;
  double finThreshold = 0.25, deadZone = 0.25, spacing = 0;
  std::optional<double> finOpacity;
  bool noFins = false, noShells = false, noBackFaces = false, noSort = false, validate = false;
  std::set<std::string> given;  // the flags on the command line
};

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

// What belongs to technique shells alone, or to a preset too.
void SetShellOptions(const RenderFlags& f, fur::RenderSettings* s) {
  s->shellMode = Choose<fur::ShellMode>(f.shellMode, {{"instanced", fur::ShellMode::Instanced},
                                                      {"draws", fur::ShellMode::Draws},
                                                      {"amplified", fur::ShellMode::Amplified}});
  s->shellsAtOnce = f.shellsAtOnce;
  s->finMode = Choose<fur::FinMode>(f.finMode, {{"auto", fur::FinMode::Auto},
                                                {"geometry", fur::FinMode::Geometry},
                                                {"pulled", fur::FinMode::Pulled},
                                                {"compacted", fur::FinMode::Compacted}});
  s->finThreshold = f.finThreshold;
  s->finOpacity = f.finOpacity;
  s->backFaces = !f.noBackFaces;
  s->sortAnimals = !f.noSort;
  s->finDeadZone = f.deadZone;
  s->spacing = f.spacing;
  s->time = f.time;
}

Result<fur::RenderSettings> MakeSettings(const RenderFlags& f) {
  fur::RenderSettings s;
  if (Result<Done> size = ParseSize(f.size, &s); !size) return size.error();
  s.samples = f.samples;
  s.look = f.look == "seed" ? fur::Look::Seed : fur::Look::Correct;
  s.technique = f.technique == "seed" ? fur::Technique::Seed : fur::Technique::Shells;
  if (Result<Done> preset = SetPreset(f.preset, f.coat, f.given, &s); !preset) return preset.error();
  // As published: a sheet, whatever the angle.
  const bool published = s.technique == fur::Technique::Seed || s.look == fur::Look::Seed;
  const bool volume = f.semantics.empty() ? !published : f.semantics == "volume";
  s.semantics = volume ? fur::Semantics::Volume : fur::Semantics::Sheet;
  s.shells = f.shells;
  s.drawFins = !f.noFins;
  s.drawShells = !f.noShells;
  SetShellOptions(f, &s);
  if (s.look == fur::Look::Seed) s.light = fur::PresetLight(s.preset);
  s.background = s.look == fur::Look::Correct ? kStudioGrey : glm::dvec3(0);
  if (f.background.empty()) return s;
  Result<glm::dvec3> background = ParseVector(f.background, "--background");
  if (!background) return background.error();
  if (glm::any(glm::lessThan(*background, glm::dvec3(0))) || glm::any(glm::greaterThan(*background, glm::dvec3(1))))
    return Error{ErrorCode::Usage, "--background takes values of 0..1, not '" + f.background + "'"};
  s.background = *background;
  return s;
}

Result<fur::Model> LoadModel(const RenderFlags& f) {
  Result<std::string> overrides = GroomOverrides(f.fur);
  if (!overrides) return overrides.error();
  std::optional<fur::Coat> coat;
  if (!f.coat.empty() && f.preset.empty()) {
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

Result<fur::Camera> MakeCamera(const RenderFlags& f, const fur::Model& model, double scale, const RenderJob& job) {
  const double aspect = double(job.settings.width) / job.settings.height;
  const bool placed = !f.eye.empty() || !f.target.empty();
  fur::Camera camera;
  if (placed) {
    camera.fovY = f.fov > 0 ? f.fov : 65;
    camera.eye *= scale;
    camera.zNear *= scale;
    camera.zFar *= scale;
  } else {
    camera = fur::FramePoints(FurredPoints(model, job.placements), f.fov > 0 ? f.fov : 40, aspect, scale);
  }
  for (const auto& [flag, text, value] : {std::tuple{"--eye", &f.eye, &camera.eye}, {"--target", &f.target, &camera.target}}) {
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
    return Error{ErrorCode::Usage, "--eye and --target must differ, and not be above one another: the view needs an up direction"};
  return camera;
}

// out.png -> out.vulkan.png
std::filesystem::path WithBackend(const std::filesystem::path& file, const std::string& backend) {
  std::filesystem::path named = file;
  return named.replace_extension(backend + file.extension().string());
}

std::filesystem::path PictureFile(const RenderFlags& f, const std::string& backend) {
  return f.backend == "both" ? WithBackend(f.output, backend) : std::filesystem::path(f.output);
}

std::vector<std::filesystem::path> OutputFiles(const RenderFlags& f) {
  std::vector<std::filesystem::path> files;
  for (const BackendEntry* b : SelectBackends(f.backend)) files.push_back(PictureFile(f, b->name));
  if (!f.stats.empty()) files.push_back(f.stats);
  return files;
}

std::string Throughput(const RenderOutcome& out) {
  return fmt::format("{:.1f} ms a frame (median of {}; the first took {:.0f} ms), {} draws, {} fragments", Median(out.frameMs),
                     out.frameMs.size(), out.firstFrameMs, out.counts.draws,
                     out.counts.baseFragments + out.counts.finFragments + out.counts.shellFragments);
}

nlohmann::ordered_json AllStats(const std::vector<RenderOutcome>& outcomes, const RenderJob& job) {
  if (outcomes.size() == 1) return StatsJson(outcomes[0], job);
  nlohmann::ordered_json j;
  for (const RenderOutcome& out : outcomes) j["runs"].push_back(StatsJson(out, job));
  j["difference"] = DifferenceJson(CompareImages(outcomes[0].image, outcomes[1].image));
  return j;
}

Result<Done> WriteOutputs(const RenderFlags& f, const RenderJob& job, const std::vector<RenderOutcome>& outcomes) {
  for (const RenderOutcome& out : outcomes) {
    const std::filesystem::path file = PictureFile(f, out.backend);
    Result<Done> written = WritePicture(file, out, job.settings);
    if (!written) return written.error();
    fmt::print("{}: {} ({})\n  {}\n", out.backend, file.string(), out.caps.driver.data(), Throughput(out));
  }
  if (f.stats.empty()) return Done{};
  return fur::WriteFile(f.stats, AllStats(outcomes, job).dump(2) + "\n");
}

void PrintDifference(const RenderOutcome& a, const RenderOutcome& b) {
  const ImageDifference d = CompareImages(a.image, b.image);
  fmt::print("difference {} - {}: {:.4f} % of pixels bit-equal ({} of {} differ), largest {}/255, mean {:.6f}/255\n", a.backend,
             b.backend, 100 * d.EqualShare(), d.differing, d.pixels, d.largest, d.mean);
}

void PrintMessages(const std::vector<std::string>& messages) {
  for (const std::string& m : messages) fmt::print(stderr, "fur: {}\n", m);
}

Result<RenderJob> PrepareJob(const RenderFlags& f, const fur::Model& model) {
  RenderJob job;
  Result<fur::RenderSettings> settings = MakeSettings(f);
  if (!settings) return settings.error();
  job.settings = *settings;
  const double scale = fur::SceneScale(fur::ComputeBounds(model));
  job.placements = fur::PlaceAnimals(f.count, scale);
  Result<fur::Camera> camera = MakeCamera(f, model, scale, job);
  if (!camera) return camera.error();
  job.camera = *camera;
  job.repeat = f.repeat;
  job.validate = f.validate;
  job.adapter = f.adapter;
  job.floatFrame = IsExrName(f.output);
  return job;
}

Result<Done> Render(const RenderFlags& f) {
  if (!f.stats.empty() && f.stats == f.output)
    return Error{ErrorCode::Usage, "-o and --stats name the same file: " + f.output};
  for (const std::filesystem::path& file : OutputFiles(f))
    if (Result<Done> ok = fur::CheckWritable(file); !ok) return ok.error();
  Result<fur::RenderSettings> settings = MakeSettings(f);
  if (!settings) return settings.error();
  if (Result<Done> ok = CheckPictureFile(f.output, *settings); !ok) return ok.error();
  Result<fur::Model> model = LoadModel(f);
  if (!model) return model.error();
  PrintMessages(model->warnings);
  Result<RenderJob> job = PrepareJob(f, *model);
  if (!job) return job.error();

  std::vector<RenderOutcome> outcomes;  // all are rendered before the first file is written
  for (const BackendEntry* backend : SelectBackends(f.backend)) {
    Result<RenderOutcome> out = RunRenderJob(*backend, *model, *job);
    if (!out) return out.error();
    PrintMessages(out->messages);
    outcomes.push_back(std::move(*out));
  }
  if (Result<Done> written = WriteOutputs(f, *job, outcomes); !written) return written.error();
  if (outcomes.size() > 1) PrintDifference(outcomes[0], outcomes[1]);
  return Done{};
}

void AddPresetFlags(CLI::App* c, RenderFlags* f) {
  c->add_option("--preset", f->preset, "A published system's shells and fins, and its look (docs/presets.md); technique seed, look seed")
      ->check(CLI::IsMember({"demo-fur", "nvidia-d3d10", "gs-shells", "four-coats"}));
  c->add_option("--dead-zone", f->deadZone, "Presets gs-shells, four-coats: an edge whose mean normal is this near to perpendicular to the view grows a fin, 0..1")
      ->check(kFinite)->check(CLI::Range(0.0, 1.0))->capture_default_str();
}

void AddShellFlags(CLI::App* c, RenderFlags* f) {
  c->add_option("--shell-mode", f->shellMode, "Shells by instances, by a draw each, or amplified by a geometry shader")
      ->check(CLI::IsMember({"instanced", "draws", "amplified"}))->capture_default_str();
  c->add_option("--shells-at-once", f->shellsAtOnce,
                "Amplified: shells of a triangle in one go, 1..14; above 1 overlapping limbs look different")
      ->check(CLI::Range(1u, 14u))->capture_default_str();
  c->add_option("--fins", f->finMode, "Fins by a geometry shader, pulled by the vertex shader, or compacted first; auto: the best there is")
      ->check(CLI::IsMember({"auto", "geometry", "pulled", "compacted"}))->capture_default_str();
  c->add_option("--fin-threshold", f->finThreshold, "Edges this near to the silhouette grow a fading fin, 0..1")
      ->check(kFinite)->check(CLI::Range(0.0, 1.0))->capture_default_str();
  c->add_option("--fin-opacity", f->finOpacity, "Opacity of a fin on the silhouette, 0..1 (.9; in a volume 1, of its fur's)")->check(kFinite)->check(CLI::Range(0.0, 1.0));
  c->add_option("--spacing", f->spacing, "Distance of two shells in the model's units; the length is N times it")->check(kFinite)->check(CLI::PositiveNumber);
  c->add_flag("--no-back-faces", f->noBackFaces, "Leave out the fur that is seen from behind");
  c->add_flag("--no-sort", f->noSort, "Draw the animals in the order given instead of back to front");
}

void AddFlags(CLI::App* c, RenderFlags* f) {
  c->add_option("MODEL", f->model, "A .gltf or .glb file; without it, the built-in animal");
  c->add_option("-o,--output", f->output, "PNG to write, or EXR: the frame in linear floats, alpha its opacity; with --backend both, FILE.vulkan.png and FILE.gl.png")->capture_default_str();
  c->add_option("--backend", f->backend, "vulkan, gl, or both (renders with each and prints the difference)")
      ->check(CLI::IsMember({"vulkan", "gl", "both"}))->capture_default_str();
  c->add_option("--adapter", f->adapter, "Part of an adapter's name (fur info lists them); default: the first");
  c->add_option("--size", f->size, "Width x height in pixels")->capture_default_str();
  c->add_option("--samples", f->samples, "Samples a pixel, 1 or 4")->check(CLI::IsMember({1, 4}))->capture_default_str();
  c->add_option("--technique", f->technique, "shells, or seed: shells and fins as published")->check(CLI::IsMember({"shells", "seed"}))->capture_default_str();
  c->add_option("--look", f->look, "Lighting and colour: seed (as published, raw values) or correct (sRGB, linear light)")
      ->check(CLI::IsMember({"seed", "correct"}))->capture_default_str();
  c->add_option("--semantics", f->semantics, "A shell is a sheet (default as published: technique or look seed), or a slab of a volume")
      ->check(CLI::IsMember({"sheet", "volume"}));
  c->add_option("--shells", f->shells, "Number of shells, 1..512; default: as the coat says")->check(CLI::Range(1u, kMaxShells));
  c->add_option("--eye", f->eye, "Eye, X,Y,Z; without --eye and --target the camera frames the animals");
  c->add_option("--target", f->target, "Point looked at, X,Y,Z");
  c->add_option("--fov", f->fov, "Vertical field of view in degrees; default 65, or 40 when framing")->check(kFinite)->check(CLI::Range(0.1, 179.0));
  c->add_option("--near", f->zNear, "Near plane")->check(kFinite)->check(CLI::PositiveNumber);
  c->add_option("--far", f->zFar, "Far plane")->check(kFinite)->check(CLI::PositiveNumber);
  c->add_option("--count", f->count, "Number of animals")->check(CLI::Range(1u, kMaxAnimals))->capture_default_str();
  c->add_option("--repeat", f->repeat, "Timed frames after the first")->check(CLI::Range(0u, 100000u))->capture_default_str();
  c->add_option("--stats", f->stats, "JSON file for times and counts");
  c->add_option("--groom,--fur", f->furFile, "JSON file of fur parameters (docs/fur.md, docs/groom.schema.json)");
  c->add_option("--coat", f->coat, "A whole coat: a name (fur info --coats) or a JSON file (docs/coats.md). With --preset four-coats whose colours it wears: bear, panther, snow, tiger; default bear");
  c->add_option("--fur-material", f->furMaterial, "Grow fur on the material of this name only");
  c->add_option("--time", f->time, "Seconds that the wind has blown")->check(kFinite)->check(CLI::Range(0.0, 1e9));
  AddGroomFlags(c, &f->fur);
  c->add_option("--background", f->background, "Background, R,G,B in 0..1: linear, default a grey, for look correct; raw, default black, for look seed");
  c->add_flag("--no-fins", f->noFins, "Draw no fins");
  c->add_flag("--no-shells", f->noShells, "Draw no shells");
  AddPresetFlags(c, f);
  AddShellFlags(c, f);
  c->add_flag("--validate", f->validate, "Run with the drivers' validation; messages go to stderr and into the stats");
}

}  // namespace

void AddRenderCommand(CLI::App& app, Command* run) {
  auto flags = std::make_shared<RenderFlags>();
  CLI::App* c = app.add_subcommand("render", "Render a model, or the built-in animal, to a PNG or an EXR");
  AddFlags(c, flags.get());
  c->callback([c, flags, run] {
    for (const CLI::Option* option : c->get_options())
      if (option->count() > 0) flags->given.insert(option->get_name());
    *run = [flags] {
      Result<Done> done = Render(*flags);
      return done ? 0 : Fail(done.error());
    };
  });
}

}  // namespace app

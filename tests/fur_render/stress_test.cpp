// Scenes made to break arithmetic: zero vectors, slivers, no length and too much, light and eye where they should not be.
// Nothing in a frame of floats, nor in the reference, may be other than a number, and each scene has a bound of its own.
#include <cmath>
#include <functional>
#include <glm/gtc/matrix_transform.hpp>
#include <limits>

#include "fur/builtin.h"
#include "fur/reference.h"
#include "models.h"
#include "support.h"

namespace fur::test {
namespace {

constexpr uint32_t kWidth = 64, kHeight = 48;
constexpr float kNan = std::numeric_limits<float>::quiet_NaN(), kInfinity = std::numeric_limits<float>::infinity();

struct Scene {
  std::string name;
  Model model;
  Camera camera = CameraAt(5, 20, 25);
  glm::dvec3 light{1, -1, 1};
  uint32_t shells = 0;
};

Coat Rough() {
  Coat coat = UniformCoat(8, 120, {150, 110, 230});
  coat.length = 0.4;
  coat.selfShadow = 0.2;
  return coat;
}

Scene Changed(const char* name, const std::function<void(Primitive*)>& change) {
  Scene scene{name, Cube(Rough())};
  change(&scene.model.primitives[0]);
  return scene;
}

Scene WithCoat(const char* name, const std::function<void(Coat*)>& change) {
  Coat coat = Rough();
  change(&coat);
  return {name, Cube(coat)};
}

void ForEachVertex(Primitive* p, const std::function<void(Vertex*)>& change) {
  for (Vertex& v : p->vertices) change(&v);
}

std::vector<Scene> Vectors() {
  const auto light = glm::vec3(glm::normalize(glm::dvec3(1, -1, 1)));
  return {
      Changed("zero tangents", [](Primitive* p) { ForEachVertex(p, [](Vertex* v) { v->tangent = glm::vec4(0); }); }),
      Changed("zero normals", [](Primitive* p) { ForEachVertex(p, [](Vertex* v) { v->normal = glm::vec3(0); }); }),
      Changed("normals of 1e-30", [](Primitive* p) { ForEachVertex(p, [](Vertex* v) { v->normal *= 1e-30f; }); }),
      Changed("tangent along the normal",
              [](Primitive* p) { ForEachVertex(p, [](Vertex* v) { v->tangent = glm::vec4(v->normal, 1); }); }),
      Changed("fur along the light",
              [=](Primitive* p) { ForEachVertex(p, [=](Vertex* v) { v->normal = -light; }); }),
      Changed("fur against the light", [=](Primitive* p) { ForEachVertex(p, [=](Vertex* v) { v->normal = light; }); }),
      Changed("opposite normals in one place", [](Primitive* p) {
        for (size_t i = 0; i < 4; ++i) {
          Vertex back = p->vertices[i];
          back.normal = -back.normal;
          p->vertices.push_back(back);
        }
        p->indices.insert(p->indices.end(), {8, 9, 10, 9, 11, 10});
      }),
  };
}

std::vector<Scene> Shapes() {
  return {
      Changed("degenerate triangles",
              [](Primitive* p) { p->indices.insert(p->indices.end(), {0, 0, 0, 1, 1, 2, 3, 4, 3}); }),
      Changed("slivers",
              [](Primitive* p) {
                ForEachVertex(p, [](Vertex* v) { v->position.x *= 1e-7f; });
              }),
      Changed("all in one point", [](Primitive* p) { ForEachVertex(p, [](Vertex* v) { v->position = {0, 0, 0}; }); }),
      Changed("edges of 1e-30", [](Primitive* p) { ForEachVertex(p, [](Vertex* v) { v->position *= 1e-30f; }); }),
      Changed("texture coordinates of 1e30", [](Primitive* p) { ForEachVertex(p, [](Vertex* v) { v->uv *= 1e30f; }); }),
      Changed("no texture area", [](Primitive* p) { ForEachVertex(p, [](Vertex* v) { v->uv = {0.5f, 0.5f}; }); }),
  };
}

std::vector<Scene> Coats() {
  std::vector<Scene> scenes{
      WithCoat("no length", [](Coat* c) { c->length = 0; }),
      WithCoat("length of 1e-30", [](Coat* c) { c->length = 1e-30; }),
      WithCoat("ten times the model", [](Coat* c) { c->length = 35; }),
      WithCoat("coverage 0", [](Coat* c) { *c = UniformCoat(8, 0); }),
      WithCoat("coverage 255", [](Coat* c) { *c = UniformCoat(8, 255); }),
      WithCoat("strands of no direction", [](Coat* c) { *c = UniformCoat(8, 120, {127, 128, 128}); }),
      WithCoat("black roots, sharp highlight", [](Coat* c) { c->selfShadow = 0, c->specularPower = 1e5; }),
  };
  for (const uint32_t shells : {1u, 512u}) {
    scenes.push_back(WithCoat(shells == 1 ? "1 shell" : "512 shells", [](Coat*) {}));
    scenes.back().shells = shells;
  }
  return scenes;
}

std::vector<Scene> Views() {
  std::vector<Scene> scenes;
  const auto add = [&](const char* name, Model model) -> Scene& {
    scenes.push_back({name, std::move(model)});
    return scenes.back();
  };
  Scene& atEye = add("light from the eye", Cube(Rough()));
  atEye.light = atEye.camera.target - atEye.camera.eye;
  Scene& against = add("light towards the eye", Cube(Rough()));
  against.light = against.camera.eye - against.camera.target;
  add("no light direction", Cube(Rough())).light = glm::dvec3(0);
  add("a triangle seen edge-on", FurredSquare(1, {200, 100, 50, 255}, Rough())).camera = CameraAt(4, 90, 0);
  Scene& corner = add("a vertex in the eye", Cube(Rough()));
  corner.camera.eye = glm::dvec3(1, 1, 1);
  corner.camera.zNear = 1e-3;
  add("the built-in animal", MakeBuiltinAnimal()).camera = CameraAt(4.5, 200, 20);
  Scene& inside = add("the eye within the fur", Cube(Rough()));
  inside.camera = CameraAt(1.2, 0, 0);
  inside.camera.zNear = 1e-3;
  return scenes;
}

std::vector<Scene> Scenes() {
  std::vector<Scene> all;
  for (const auto& group : {Vectors(), Shapes(), Coats(), Views()}) all.insert(all.end(), group.begin(), group.end());
  return all;
}

const Scene& SceneAt(size_t i) {
  static const std::vector<Scene> scenes = Scenes();
  return scenes[i];
}

// What light can make of a surface: more is not energy but a fault. The strands' highlight and the skin's add to it.
bool WithinLight(const FloatImage& image, const Light& light) {
  const double most = light.ambient.r + light.diffuse.r + 2 * light.specular.r + 0.01;
  for (const glm::vec4& p : image.pixels)
    for (int c = 0; c < 4; ++c)
      if (p[c] < 0 || double(p[c]) > std::max(most, 1.0001)) return false;
  return true;
}

RenderSettings SettingsOf(const Scene& scene, Look look) {
  RenderSettings s{.width = kWidth, .height = kHeight, .look = look, .shells = scene.shells};
  s.target = TargetFormat::Float32;
  s.light.direction = scene.light;
  return s;
}

std::string SceneName(const testing::TestParamInfo<size_t>& info) {
  std::string name;
  for (const char c : SceneAt(info.param).name) name += std::isalnum(static_cast<unsigned char>(c)) ? c : '_';
  return name;
}

class Stress : public testing::TestWithParam<size_t> {};
INSTANTIATE_TEST_SUITE_P(Scenes, Stress, testing::Range(size_t{0}, Scenes().size()), SceneName);

TEST_P(Stress, EveryPixelIsANumber) {
  const Scene& scene = SceneAt(GetParam());
  for (const BackendCase& backend : Backends()) {
    TestDevice device(backend);
    for (const auto& [look, samples] : {std::pair{Look::Correct, 1u}, {Look::Correct, 4u}, {Look::Seed, 1u}}) {
      RenderSettings s = SettingsOf(scene, look);
      s.samples = samples;
      const FloatImage image = Pixels(device, scene.model, s, scene.camera);
      const std::string what = std::string(backend.name) + (look == Look::Seed ? ", seed" : ", correct") + ", samples " +
                               std::to_string(samples);
      EXPECT_TRUE(AllFinite(image)) << what;
      EXPECT_TRUE(look == Look::Seed || WithinLight(image, s.light)) << what;
    }
  }
}

TEST_P(Stress, TheReferenceGivesNumbers) {
  const Scene& scene = SceneAt(GetParam());
  ReferenceSettings s;
  s.width = kWidth / 2;
  s.height = kHeight / 2;
  s.light.direction = scene.light;
  s.samplesPerPixel = 1;
  const std::vector<glm::dmat4> one{glm::dmat4(1)};
  const Result<ReferenceImage> image = RenderReference(scene.model, scene.camera, one, s);
  ASSERT_TRUE(image) << image.error().message;
  EXPECT_TRUE(AllFinite(image->color));
  EXPECT_TRUE(WithinLight(image->color, s.light));
}

// ---------------------------------------------------------------------------------------------- bounds of their own
class StressBound : public OnEachBackend {
 protected:
  FloatImage Draw(const std::string& name, Look look = Look::Correct) {
    for (size_t i = 0; i < Scenes().size(); ++i)
      if (SceneAt(i).name == name)
        return Pixels(*device_, SceneAt(i).model, SettingsOf(SceneAt(i), look), SceneAt(i).camera);
    ADD_FAILURE() << "no scene " << name;
    return {};
  }
};
INSTANTIATE_TEST_SUITE_P(Backends, StressBound, testing::ValuesIn(Backends()), BackendName);

// Fur that is not there leaves the skin: the picture of no coverage, to the bit.
TEST_P(StressBound, NoFurIsTheSkin) {
  const Scene& plain = SceneAt(0);
  RenderSettings skin = SettingsOf(plain, Look::Correct);
  skin.drawShells = skin.drawFins = false;
  const FloatImage bald = Pixels(*device_, Cube(Rough()), skin, plain.camera);
  for (const char* name : {"coverage 0"}) EXPECT_TRUE(Draw(name).pixels == bald.pixels) << name;
}

// Fur of full coverage lets no skin through: all that is covered is opaque.
TEST_P(StressBound, FullCoverageIsOpaque) {
  const FloatImage image = Draw("coverage 255");
  size_t opaque = 0;
  for (const glm::vec4& p : image.pixels) opaque += p.a > 0.999f ? 1 : 0;
  EXPECT_GT(opaque, image.pixels.size() / 8);
}

// Degenerate triangles add nothing.
TEST_P(StressBound, DegenerateTrianglesAreInvisible) {
  const FloatImage with = Draw("degenerate triangles");
  const FloatImage without = Pixels(*device_, Cube(Rough()), SettingsOf(SceneAt(0), Look::Correct), SceneAt(0).camera);
  EXPECT_TRUE(with.pixels == without.pixels);
}

// --------------------------------------------------------------------------------------------- what is not a number
class NotANumber : public OnEachBackend {};
INSTANTIATE_TEST_SUITE_P(Backends, NotANumber, testing::ValuesIn(Backends()), BackendName);

TEST_P(NotANumber, InAModelIsRefusedByName) {
  const std::vector<std::pair<const char*, std::function<void(Model*)>>> faults{
      {"the position", [](Model* m) { m->primitives[0].vertices[3].position.y = kNan; }},
      {"the normal", [](Model* m) { m->primitives[0].vertices[3].normal.x = kInfinity; }},
      {"the tangent", [](Model* m) { m->primitives[0].vertices[3].tangent.z = -kInfinity; }},
      {"the texture coordinate", [](Model* m) { m->primitives[0].vertices[3].uv.x = kNan; }},
      {"index 4", [](Model* m) { m->primitives[0].indices[4] = 8; }},
      {"the transform", [](Model* m) { m->parts[0].transform[3][0] = double(kNan); }},
      {"a number", [](Model* m) { m->materials[0].roughness = kNan; }},
      {"length_scale", [](Model* m) { m->materials[0].fur->params.length = double(kNan); }},
      {"comb", [](Model* m) { m->materials[0].fur->params.comb.y = double(kInfinity); }},
      {"the bytes of its size", [](Model* m) { m->volumes[0].pixels.pop_back(); }},
  };
  for (const auto& [word, fault] : faults) {
    Model model = Cube(Rough());
    fault(&model);
    const auto renderer = MakeRenderer(**device_, model, {.width = 8, .height = 8});
    ASSERT_FALSE(renderer) << word;
    EXPECT_EQ(renderer.error().code, ErrorCode::InputMalformed) << word;
    EXPECT_NE(renderer.error().message.find(word), std::string::npos) << renderer.error().message;
    const std::vector<glm::dmat4> one{glm::dmat4(1)};
    EXPECT_FALSE(RenderReference(model, Camera{}, one, {})) << word;
  }
}

TEST_P(NotANumber, AnAnimalThatIsNowhereIsNotDrawn) {
  const Model model = Cube(Rough());
  const Camera camera = CameraAt(8, 20, 25);
  const RenderSettings s = SettingsOf(SceneAt(0), Look::Correct);
  const glm::dmat4 left = glm::translate(glm::dmat4(1), glm::dvec3(-1.5, 0, 0));
  glm::dmat4 nowhere(1);
  nowhere[3][1] = double(kNan);
  const FloatImage one = Pixels(*device_, model, s, camera, {left});
  EXPECT_TRUE(Pixels(*device_, model, s, camera, {nowhere, left}).pixels == one.pixels);

  auto renderer = MakeRenderer(**device_, model, s);
  ASSERT_TRUE(renderer) << renderer.error().message;
  const std::vector<glm::dmat4> two{left, glm::dmat4(1)};
  const std::vector<glm::dvec3> offsets{glm::dvec3(0), glm::dvec3(double(kNan), 0, 0)};
  (*renderer)->Draw(camera, two, Motion{.offsets = offsets});
  EXPECT_TRUE((*renderer)->Finish());
  EXPECT_TRUE((*renderer)->ReadPixels()->pixels == one.pixels) << "an offset";
}

TEST_P(NotANumber, ACameraThatIsNowhereSeesTheBackground) {
  RenderSettings s = SettingsOf(SceneAt(0), Look::Correct);
  s.background = {0.25, 0.5, 0.75};
  Camera lost = CameraAt(5, 0, 0);
  lost.eye.x = double(kNan);
  Camera blind = CameraAt(5, 0, 0);
  blind.target = blind.eye;
  for (const Camera& camera : {lost, blind})
    for (const glm::vec4& p : Pixels(*device_, Cube(Rough()), s, camera).pixels)
      ASSERT_EQ(p, glm::vec4(0.25f, 0.5f, 0.75f, 0));
}

}  // namespace
}  // namespace fur::test

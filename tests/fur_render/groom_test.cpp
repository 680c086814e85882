// Groomed fur as it is drawn: against closed forms.
#include <cmath>
#include <functional>
#include <glm/gtc/matrix_transform.hpp>

#include "fur/builtin.h"
#include "fur/fur_mesh.h"
#include "fur/groom.h"
#include "oracle.h"
#include "support.h"

namespace fur::test {
namespace {

class Groomed : public OnEachBackend {};
INSTANTIATE_TEST_SUITE_P(Backends, Groomed, testing::ValuesIn(Backends()), BackendName);

constexpr uint32_t kWidth = 33, kHeight = 25;
const Light kSide{.direction = {0.7, -0.4, -0.5}, .diffuse = {0.9, 0.8, 0.7}, .ambient = {0.1, 0.12, 0.14},
                  .specular = glm::dvec3(0.5)};

// Strands of one coverage and direction a slice, on a square that a few tiles cover.
SquareScene Scene() {
  SquareScene scene{.semantics = Semantics::Volume, .light = kSide, .color = {255, 0, 255, 255}};
  for (uint32_t i = 0; i < 16; ++i)
    scene.coat.slices.push_back({uint8_t(128 + 9 * (i % 4)), uint8_t(150 - 11 * (i % 3)), 225, uint8_t(90 - 3 * i)});
  return scene;
}

// The picture of a scene, whose frame is filled in from the mesh that is drawn, in four pixels against the oracle.
void ExpectOracle(TestDevice& device, SquareScene scene, const Camera& camera, const std::string& what) {
  const Model model = GroomedSquare(&scene);
  scene.eye = camera.eye;
  const RenderSettings settings{.width = kWidth, .height = kHeight, .semantics = scene.semantics,
                                .target = TargetFormat::Float32, .shells = scene.shells, .light = scene.light};
  const FloatImage pixels = Pixels(device, model, settings, camera);
  for (const auto& [x, y] : {std::pair{16u, 12u}, {2u, 3u}, {29u, 5u}, {8u, 21u}, {24u, 17u}}) {
    const glm::dvec3 expected = CompositeMidpoints(scene, RayThrough(camera, kWidth, kHeight, x, y));
    const glm::vec4 got = pixels.pixels[size_t{y} * kWidth + x];
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(got[c], expected[c], 2e-4) << what << ", pixel " << x << ", " << y;
  }
}

struct Change {
  const char* name;
  std::function<void(FurParams*)> apply;
};
const Change kShading[] = {
    {"nothing", [](FurParams*) {}},
    {"thin", [](FurParams* p) { p->density = 0.4; }},
    {"dense", [](FurParams* p) { p->density = 3; }},
    {"bald", [](FurParams* p) { p->density = 0; }},
    {"gradient", [](FurParams* p) { p->rootColor = {0.2, 0.5, 1.5}, p->tipColor = {1, 2, 0.3}; }},
    {"white", [](FurParams* p) { p->colorFromBase = 0; }},
    {"half white", [](FurParams* p) { p->colorFromBase = 0.5; }},
    {"clumped", [](FurParams* p) { p->clumping = 0.6; }},
    {"wholly clumped", [](FurParams* p) { p->clumping = 1; }},
    {"damp", [](FurParams* p) { p->wetness = 0.3; }},
    {"wet", [](FurParams* p) { p->wetness = 1; }},
    {"wet and clumped", [](FurParams* p) { p->wetness = 0.4, p->clumping = 0.9, p->density = 1.7; }},
};

TEST_P(Groomed, IsShadedByItsFormulas) {
  for (const Change& change : kShading)
    for (const uint32_t shells : {16u, 40u})
      for (const auto& [yaw, pitch] : {std::pair{0.0, 0.0}, {-25.0, 35.0}}) {
        SquareScene scene = Scene();
        scene.shells = shells;
        change.apply(&scene.groom);
        ExpectOracle(*device_, scene, CameraAt(3, yaw, pitch), change.name + (" " + std::to_string(shells)));
      }
}

// The rightmost and the lowest lit pixel of the middle row and column.
glm::dvec2 LastLit(const Image& image) {
  int x = int(image.width) - 1, y = int(image.height) - 1;
  while (x > 0 && PixelAt(image, uint32_t(x), image.height / 2) == Rgb{0, 0, 0}) --x;
  while (y > 0 && PixelAt(image, image.width / 2, uint32_t(y)) == Rgb{0, 0, 0}) --y;
  return {x, y};
}

// The largest coordinate `axis` at which the outline crosses the picture's middle across it.
double LastCrossing(const std::vector<glm::dvec2>& outline, int axis, double middle) {
  double last = 0;
  for (size_t i = 0; i < outline.size(); ++i) {
    const glm::dvec2 a = outline[i], b = outline[(i + 1) % outline.size()];
    const double t = (middle - a[1 - axis]) / (b[1 - axis] - a[1 - axis]);
    if (t >= 0 && t <= 1) last = std::max(last, glm::mix(a[axis], b[axis], t));
  }
  return last;
}

// Shell 1 of 2, at height 0.75, is all there is over the skin; corners by fur/groom.h in double.
glm::dvec2 ExpectedLast(const FurParams& p, const glm::dmat4& placement, double time, const glm::dvec3& offset,
                        const Camera& camera, uint32_t width, uint32_t height) {
  const FurSway sway = MakeFurSway(p, placement, glm::dmat4(1), time, offset);
  const glm::dmat4 toClip = ProjectionMatrix(camera, double(width) / height) * ViewMatrix(camera) * placement;
  glm::dvec2 last(0);
  for (const double at : {0.0, 0.75}) {
    std::vector<glm::dvec2> outline;
    for (const glm::dvec3& corner : {glm::dvec3(0.5, 0.5, 0), {0.5, -0.5, 0}, {-0.5, -0.5, 0}, {-0.5, 0.5, 0}}) {
      const glm::dvec4 clip = toClip * glm::dvec4(FurPoint(sway, corner, {0, 0, 1}, p.length, at), 1);
      outline.emplace_back((clip.x / clip.w * 0.5 + 0.5) * width - 0.5, (0.5 - clip.y / clip.w * 0.5) * height - 0.5);
    }
    last = glm::max(last, glm::dvec2(LastCrossing(outline, 0, height / 2), LastCrossing(outline, 1, width / 2)));
  }
  return last;
}

TEST_P(Groomed, StandsWhereItsFormulasSay) {
  constexpr uint32_t kSide2 = 401;
  Coat coat = UniformCoat(2, 255);
  coat.length = 0.5;
  coat.slices[0][3] = 0;  // the top slice is emptied, so look seed
  Model model = FurredSquare(0.5, {255, 255, 255, 255}, coat);
  FurParams& p = model.materials[0].fur->params;
  const FurParams plain = p;
  const Change kMoves[] = {
      {"comb", [](FurParams* q) { q->comb = {2, -1, 0}, q->combStrength = 0.6, q->bend = 1.5; }},
      {"gravity", [](FurParams* q) { q->gravity = 0.9; }},
      {"wind", [](FurParams* q) { q->windStrength = 1, q->windLength = 1.7, q->windFrequency = 1; }},
      {"all", [](FurParams* q) { q->comb = {0, 1, 0}, q->combStrength = 0.3, q->gravity = 0.5, q->wind = {1, 0, 0.5},
                                 q->windStrength = 0.7, q->windLength = 1.1; }}};
  const Camera camera = CameraAt(6, 0, 0, 30);
  for (const Change& move : kMoves)
    for (const double time : {0.0, 0.3, 0.6, 500.9})
      for (const double quarters : {0, 1, 2, 3}) {
        p = plain;
        move.apply(&p);
        const glm::dmat4 placement = glm::rotate(glm::dmat4(1), glm::radians(90 * quarters), glm::dvec3(0, 0, 1));
        const glm::dvec3 offset = time == 0.3 ? glm::dvec3(0.2, -0.1, 0) : glm::dvec3(0);
        for (const ShellMode mode : {ShellMode::Instanced, ShellMode::Amplified}) {
          const RenderSettings settings{.width = kSide2, .height = kSide2, .look = Look::Seed,
                                        .semantics = Semantics::Sheet, .shells = 2, .drawFins = false,
                                        .shellMode = mode, .backFaces = false, .time = time - 0.1};
          Result<std::unique_ptr<Renderer>> renderer = MakeRenderer(**device_, model, settings);
          ASSERT_TRUE(renderer) << renderer.error().message;
          (*renderer)->Draw(camera, {&placement, 1}, {.time = 0.1, .offsets = {&offset, 1}});
          const Result<Image> image = (*renderer)->ReadImage();
          ASSERT_TRUE(image);
          const glm::dvec2 got = LastLit(*image);
          const glm::dvec2 expected = ExpectedLast(p, placement, time, offset, camera, kSide2, kSide2);
          EXPECT_NEAR(got.x, expected.x, 1.01) << move.name << ", time " << time << ", quarters " << quarters;
          EXPECT_NEAR(got.y, expected.y, 1.01) << move.name << ", time " << time << ", quarters " << quarters;
        }
      }
}

const Model& Animal() {
  static const Model animal = MakeBuiltinAnimal();
  return animal;
}

Model AnimalWith(const std::function<void(FurParams*)>& change) {
  Model model = Animal();
  change(&model.materials[0].fur->params);
  return model;
}

const RenderSettings kSmall{.width = 160, .height = 120};
Camera Close() { return FrameBounds(ComputeBounds(Animal()), PlaceAnimals(1, 1), 40, 160 / 120.0); }

double Brightness(const Image& image) {
  double sum = 0;
  for (size_t i = 0; i < image.pixels.size(); ++i) sum += i % 4 < 3 ? image.pixels[i] : 0;
  return sum / double(image.pixels.size());
}

// Values that mean nothing change no bit, whatever stands beside them.
TEST_P(Groomed, NeutralValuesChangeNothing) {
  const Frame plain = Render(*device_, Animal(), kSmall, Close());
  const Change kNeutral[] = {
      {"comb of no strength", [](FurParams* p) { p->comb = {1, 2, 3}, p->combStrength = 0; }},
      {"comb of no direction", [](FurParams* p) { p->combStrength = 5, p->bend = 4; }},
      {"wind of no strength", [](FurParams* p) { p->wind = {0, 1, 0}, p->windFrequency = 9, p->windLength = 2; }},
      {"wind of no direction", [](FurParams* p) { p->wind = {0, 0, 0}, p->windStrength = 3; }},
      {"inertia at rest", [](FurParams* p) { p->inertiaStiffness = 10, p->inertiaDamping = 1; }}};
  for (const Change& change : kNeutral)
    EXPECT_EQ(DifferingPixels(Render(*device_, AnimalWith(change.apply), kSmall, Close()).image, plain.image), 0u)
        << change.name;
}

// Which way a parameter changes the animal's picture, on black.
TEST_P(Groomed, ParametersActInTheirDirection) {
  const Image plain = Render(*device_, Animal(), kSmall, Close()).image;
  struct Row {
    Change change;
    int brighter;  // -1, 1; 0: the picture changes
  };
  const Row kRows[] = {
      {{"wetness", [](FurParams* p) { p->wetness = 0.8, p->specularScale = 0; }}, -1},
      {{"root", [](FurParams* p) { p->rootColor = glm::dvec3(0.2); }}, -1},
      {{"tip", [](FurParams* p) { p->tipColor = glm::dvec3(2); }}, 1},
      {{"white", [](FurParams* p) { p->colorFromBase = 0; }}, 1},
      {{"clumping", [](FurParams* p) { p->clumping = 0.9; }}, 0},
      {{"density", [](FurParams* p) { p->density = 0.3; }}, 0},
      {{"thickness", [](FurParams* p) { p->thickness = 2; }}, 0},
      {{"gravity", [](FurParams* p) { p->gravity = 1; }}, 0},
      {{"wind", [](FurParams* p) { p->windStrength = 1; }}, 0}};
  for (const Row& row : kRows) {
    const Image image = Render(*device_, AnimalWith(row.change.apply), kSmall, Close()).image;
    EXPECT_GT(DifferingPixels(image, plain), 800u) << row.change.name;
    const double brighter = Brightness(image) - Brightness(plain);
    EXPECT_GT(row.brighter * brighter, row.brighter == 0 ? -1 : 0.5) << row.change.name;
  }
}

// How much of what is over black is fur, by the opacity in look correct's alpha.
TEST_P(Groomed, DensityAndThicknessGrowOpacity) {
  const auto opacity = [&](const std::function<void(FurParams*)>& change) {
    RenderSettings settings = kSmall;
    settings.target = TargetFormat::Float32;
    double sum = 0;
    for (const glm::vec4& p : Pixels(*device_, AnimalWith(change), settings, Close()).pixels) sum += double(p.a);
    return sum;
  };
  double before = 0;
  for (const double density : {0.0, 0.3, 1.0, 2.5, 4.0}) {
    const double now = opacity([&](FurParams* p) { p->density = density; });
    EXPECT_GT(now, before) << density;
    before = now;
  }
  before = 0;
  for (const double thickness : {0.25, 0.6, 1.0, 2.0, 4.0}) {
    const double now = opacity([&](FurParams* p) { p->thickness = thickness; });
    EXPECT_GT(now, before) << thickness;
    before = now;
  }
}

// Offsets belong to their animals, in whatever order they are given and drawn.
TEST_P(Groomed, InertiaBelongsToItsAnimal) {
  const std::vector<glm::dmat4> placements = PlaceAnimals(4, 0.25);
  const std::vector<glm::dvec3> offsets{{0.9, 0, 0}, {0, 0, 0}, {0, 0, -0.9}, {0, 0.5, 0.5}};
  const Camera camera{.eye = {-2, 1.2, -3}};
  const auto draw = [&](std::span<const glm::dmat4> p, std::span<const glm::dvec3> o) {
    Result<std::unique_ptr<Renderer>> renderer = MakeRenderer(**device_, Animal(), kSmall);
    (*renderer)->Draw(camera, p, {.offsets = o});
    return *(*renderer)->ReadImage();
  };
  const Image moved = draw(placements, offsets), still = draw(placements, {});
  EXPECT_GT(DifferingPixels(moved, still), 300u);
  const std::vector<glm::dmat4> reversed(placements.rbegin(), placements.rend());
  const std::vector<glm::dvec3> reversedOffsets(offsets.rbegin(), offsets.rend());
  EXPECT_EQ(DifferingPixels(draw(reversed, reversedOffsets), moved), 0u);
  EXPECT_GT(DifferingPixels(draw(reversed, offsets), moved), 100u);
  EXPECT_EQ(DifferingPixels(draw(placements, std::span(offsets).first(0)), still), 0u);
}

}  // namespace
}  // namespace fur::test

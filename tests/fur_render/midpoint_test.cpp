// The technique shells over a square, against closed forms: midpoint layers, the opacity law for any number of shells
// and any angle, the length map at the fragment, and the order of animals.
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>

#include "fur/fur_mesh.h"
#include "oracle.h"
#include "support.h"

namespace fur::test {
namespace {

class Midpoint : public OnEachBackend {};
INSTANTIATE_TEST_SUITE_P(Backends, Midpoint, testing::ValuesIn(Backends()), BackendName);

constexpr uint32_t kWidth = 33, kHeight = 25;
// Whole and no colour: what these drivers make of sRGB in between is off by up to 0.5 %.
constexpr Texel kColor{255, 0, 255, 255};
const Light kSide{.direction = {0.7, -0.4, -0.5},
                  .diffuse = {0.9, 0.8, 0.7},
                  .ambient = {0.1, 0.12, 0.14},
                  .specular = glm::dvec3(0.5)};

Coat VariedCoat(uint32_t slices) {
  Coat coat;
  for (uint32_t i = 0; i < slices; ++i) {
    const uint32_t k = i % 4;
    coat.slices.push_back(
        {uint8_t(128 + 30 * k), uint8_t(148 - 40 * (i % 3)), uint8_t(220 - 25 * k), uint8_t(90 + 9 * i)});
  }
  return coat;
}

RenderSettings Settings(const SquareScene& scene, TargetFormat target) {
  return {.width = kWidth,
          .height = kHeight,
          .look = scene.look,
          .semantics = scene.semantics,
          .target = target,
          .shells = scene.shells,
          .light = scene.light};
}

// The fur's own texture coordinates turn the square's frame.
glm::dvec3 FurTangent(const Model& square) {
  return glm::dvec3(MakeFurMeshes(square, FurTiling::Isometric)[0].vertices[0].tangent);
}

void ExpectMidpoints(TestDevice& device, SquareScene scene, const Camera& camera, const std::string& what) {
  Model model = FurredSquare(40, scene.color, scene.coat);
  model.materials[0].fur->params.tint = scene.groom.tint;
  if (scene.look == Look::Correct) scene.tangent = FurTangent(model);
  const FloatImage pixels = Pixels(device, model, Settings(scene, TargetFormat::Float32), camera);
  const Frame frame = Render(device, model, Settings(scene, TargetFormat::Auto), camera);
  for (const auto& [x, y] : {std::pair{16u, 12u}, {1u, 1u}, {31u, 4u}, {8u, 23u}}) {
    const glm::dvec3 expected = CompositeMidpoints(scene, RayThrough(camera, kWidth, kHeight, x, y));
    const glm::vec4 got = pixels.pixels[size_t{y} * kWidth + x];
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(got[c], expected[c], 2e-5) << what << ", channel " << c;
    EXPECT_NEAR(got.a, 1, 1e-6) << what;
    ExpectColor(PixelAt(frame.image, x, y), Stored(scene.look, glm::clamp(expected, 0.0, 1.0)), 1, what);
  }
}

std::string Describe(const SquareScene& s) {
  return std::string(s.look == Look::Seed ? "seed" : "correct") +
         (s.semantics == Semantics::Sheet ? " sheet " : " volume ") + std::to_string(s.shells) + " shells";
}

std::vector<SquareScene> Scenes() {
  std::vector<SquareScene> scenes;
  for (const Look look : {Look::Seed, Look::Correct})
    for (const Semantics semantics : {Semantics::Sheet, Semantics::Volume})
      for (const uint32_t shells : {1u, 4u, 5u, 16u, 17u, 64u, 512u})
        scenes.push_back({.look = look, .semantics = semantics, .light = kSide, .color = kColor,
                          .coat = VariedCoat(16), .shells = shells});
  return scenes;
}

TEST_P(Midpoint, VariedCoatFromManySides) {
  for (const SquareScene& scene : Scenes())
    for (const auto& [yaw, pitch] : {std::pair{0.0, 0.0}, {50.0, 0.0}, {-20.0, 55.0}})
      ExpectMidpoints(*device_, scene, CameraAt(3, yaw, pitch), Describe(scene) + " yaw " + std::to_string(yaw));
}

// Strands of their own colours, brighter and darker than the coat's; look seed does not know them.
TEST_P(Midpoint, StrandsHaveTheirOwnColors) {
  for (SquareScene scene : Scenes()) {
    for (uint32_t i = 0; i < 16; ++i)
      scene.coat.tints.push_back({uint8_t(60 + 9 * i), uint8_t(200 - 5 * i), uint8_t(90 + 30 * (i % 3)), uint8_t(16 * i)});
    scene.color = {255, 255, 0, 255};
    for (const double strength : {1.0, 0.4, 0.0}) {
      scene.groom.tint = strength;
      ExpectMidpoints(*device_, scene, CameraAt(3, 20, 25), Describe(scene) + " tint " + std::to_string(strength));
    }
  }
}

// Published: alpha per shell whatever their number, so the fur grows denser with N. The law keeps it: below N0 the
// slices are undersampled, from N0 on the picture stays.
TEST_P(Midpoint, OpacityDoesNotGrowWithTheNumberOfShells) {
  SquareScene scene{.look = Look::Correct, .light = kSide, .color = kColor};
  for (uint32_t i = 0; i < 16; ++i) scene.coat.slices.push_back({140, 120, 240, uint8_t(120 - 8 * i)});  // as hair thins
  const Camera camera = CameraAt(3, 20, 10);
  const glm::dvec3 ray = RayThrough(camera, kWidth, kHeight, 16, 12);
  scene.tangent = FurTangent(FurredSquare(40, scene.color, scene.coat));
  scene.shells = 512;
  const double limit = CompositeMidpoints(scene, ray).x;
  double published = 0;
  for (const uint32_t n : {16u, 32u, 64u, 256u}) {
    scene.shells = n;
    const Model model = FurredSquare(40, scene.color, scene.coat);
    const FloatImage image = Pixels(*device_, model, Settings(scene, TargetFormat::Float32), camera);
    EXPECT_NEAR(image.pixels[12 * kWidth + 16].x, limit, n == 16 ? 0.004 : 0.001) << n;
    published = std::abs(Composite(scene, ray).x - Stored(Look::Correct, glm::dvec3(limit)).x);
  }
  EXPECT_GT(published, 0.02) << "the published law, 256 shells: this test must tell the two apart";
}

// The map is 0.5 at the corners, where the vertices are, and 0.25 in the middle: there fur ends at half of its height.
TEST_P(Midpoint, LengthMapEndsTheFurAtTheFragment) {
  SquareScene scene{.light = kSide, .color = kColor, .coat = VariedCoat(16)};
  Model model = FurredSquare(40, scene.color, scene.coat);
  Image lengths{"length", 8, 8, {}};
  for (uint32_t i = 0; i < 64; ++i) {
    const uint32_t x = i % 8, y = i / 8;
    const bool corner = (x == 0 || x == 7) && (y == 0 || y == 7);
    lengths.pixels.insert(lengths.pixels.end(), {uint8_t(corner ? 128 : 64), 0, 0, 255});
  }
  model.images.push_back(lengths);
  model.materials[0].fur->lengthMap = int32_t(model.images.size()) - 1;
  scene.tangent = FurTangent(model);
  const Camera camera = CameraAt(3, 10, 0);
  const FloatImage image = Pixels(*device_, model, Settings(scene, TargetFormat::Float32), camera);
  const glm::dvec3 expected = CompositeMidpoints(scene, RayThrough(camera, kWidth, kHeight, 16, 12), 64.0 / 128);
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(image.pixels[12 * kWidth + 16][c], expected[c], 2e-5) << c;
}

// Spacing: the length is N times it.
TEST_P(Midpoint, SpacingMakesTheLength) {
  const Coat coat = UniformCoat(4, 255);
  RenderSettings settings{.width = 65, .height = 65, .shells = 4, .drawFins = false};
  const Camera camera = CameraAt(6, 0, 45, 30);
  const auto bottom = [&](const Model& model, double spacing) {  // the last row with fur in the middle column
    settings.spacing = spacing;
    const Frame frame = Render(*device_, model, settings, camera);
    uint32_t y = 64;
    while (y > 0 && PixelAt(frame.image, 32, y) == Rgb{0, 0, 0}) --y;
    return y;
  };
  Coat longCoat = coat;
  longCoat.length = 1;
  const uint32_t expected = bottom(FurredSquare(0.5, {255, 255, 255, 255}, longCoat), 0);
  EXPECT_EQ(bottom(FurredSquare(0.5, {255, 255, 255, 255}, coat), 0.25), expected);
  EXPECT_NE(bottom(FurredSquare(0.5, {255, 255, 255, 255}, coat), 0), expected) << "the coat's own length is another";
}

// The tip of combed fur moves by the comb times the length; the root stays.
TEST_P(Midpoint, CombMovesTheShells) {
  Coat coat = UniformCoat(2, 255);
  coat.length = 0.5;
  coat.slices[0][3] = 0;  // only the upper half: shell 1 of 2, at height 0.75; the top slice is emptied, so look seed
  RenderSettings settings{.width = 129, .height = 65, .look = Look::Seed, .semantics = Semantics::Sheet, .shells = 2,
                          .drawFins = false, .backFaces = false};
  const Camera camera = CameraAt(8, 0, 0, 30);
  const auto right = [&](const glm::dvec3& comb, double bend) {  // the last lit column in the middle row
    settings.comb = comb;
    settings.bend = bend;
    const Frame frame = Render(*device_, FurredSquare(0.5, {255, 255, 255, 255}, coat), settings, camera);
    uint32_t x = 128;
    while (x > 0 && PixelAt(frame.image, x, 32) == Rgb{0, 0, 0}) --x;
    return int(x);
  };
  const double pixel = 2 * std::tan(glm::radians(15.0)) * (8 - 0.375) / 65;  // at the shell's distance
  for (const double bend : {1.0, 2.0, 3.0}) {
    const double moved = std::pow(0.75, bend) * 0.5 * 0.8;  // h^k length comb
    EXPECT_NEAR(right({0.8, 0, 0}, bend) - right({0, 0, 0}, bend), moved / pixel, 1.01) << bend;
  }
}

// Two squares, the nearer one given first.
TEST_P(Midpoint, AnimalsAreSortedBackToFront) {
  Coat coat = UniformCoat(8, 100);
  coat.length = 0.5;
  coat.selfShadow = 0.1;  // roots and tips differ, so that the order can be seen
  const Model model = FurredSquare(0.5, {220, 120, 40, 255}, coat);
  const Camera camera = CameraAt(4, 0, 0);
  const glm::dmat4 nearer = glm::translate(glm::dmat4(1), glm::dvec3(0.45, 0, 0.6));
  const glm::dmat4 farther = glm::translate(glm::dmat4(1), glm::dvec3(0, 0, 0));
  RenderSettings settings{.width = 65, .height = 49, .light = {.direction = {-1, 0, -1}}};
  const Frame given = Render(*device_, model, settings, camera, {nearer, farther});
  const Frame ordered = Render(*device_, model, settings, camera, {farther, nearer});
  EXPECT_EQ(DifferingPixels(given.image, ordered.image), 0u);
  settings.sortAnimals = false;
  EXPECT_GT(DifferingPixels(Render(*device_, model, settings, camera, {nearer, farther}).image, ordered.image), 0u);
  EXPECT_EQ(DifferingPixels(Render(*device_, model, settings, camera, {farther, nearer}).image, ordered.image), 0u);
}

}  // namespace
}  // namespace fur::test

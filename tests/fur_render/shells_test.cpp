// Shells over a square, against closed forms.
#include <cmath>
#include <numbers>

#include "oracle.h"
#include "support.h"

namespace fur::test {
namespace {

class Shells : public OnEachBackend {};
INSTANTIATE_TEST_SUITE_P(Backends, Shells, testing::ValuesIn(Backends()), BackendName);

constexpr uint32_t kWidth = 33, kHeight = 25;
constexpr double kDrift = 2;  // of 255: what rounding the target at each of the shells may add up to

const Light kSide{.direction = {0.7, -0.4, -0.5},
                  .diffuse = {0.9, 0.8, 0.7},
                  .ambient = {0.3, 0.25, 0.2},
                  .specular = glm::dvec3(0.5)};
const Light kBehind{
    .direction = {0.3, 0.4, 1}, .diffuse = glm::dvec3(1), .ambient = glm::dvec3(0.3), .specular = glm::dvec3(0.5)};

// Slices that differ in everything, so that a swapped or shifted slice shows.
Coat VariedCoat(uint32_t slices) {
  Coat coat;
  for (uint32_t i = 0; i < slices; ++i) {
    const uint32_t k = i % 4;
    coat.slices.push_back(
        {uint8_t(128 + 30 * k), uint8_t(148 - 40 * (i % 3)), uint8_t(220 - 25 * k), uint8_t(90 + 11 * i)});
  }
  coat.slices[slices / 3][3] = 2;  // below the published threshold of 0.01
  return coat;
}

void ExpectComposite(TestDevice& device, const SquareScene& scene, const Camera& camera, const std::string& what) {
  const RenderSettings settings{.width = kWidth,
                                .height = kHeight,
                                .technique = Technique::Seed,
                                .look = scene.look,
                                .semantics = scene.semantics,
                                .shells = scene.shells,
                                .light = scene.light};
  const Frame frame = Render(device, FurredSquare(40, scene.color, scene.coat), settings, camera);
  for (const auto& [x, y] : {std::pair{16u, 12u}, {1u, 1u}, {31u, 4u}, {8u, 23u}}) {
    const glm::dvec3 ray = RayThrough(camera, kWidth, kHeight, x, y);
    ExpectColor(PixelAt(frame.image, x, y), Composite(scene, ray), kDrift,
                what + " at " + std::to_string(x) + "," + std::to_string(y));
  }
}

std::vector<SquareScene> Scenes() {
  std::vector<SquareScene> scenes;
  for (const Look look : {Look::Seed, Look::Correct})
    for (const Semantics semantics : {Semantics::Sheet, Semantics::Volume})
      for (const Light& light : {kSide, kBehind})
        scenes.push_back({.look = look, .semantics = semantics, .light = light, .color = {180, 120, 60, 255}});
  return scenes;
}

std::string Describe(const SquareScene& s) {
  return std::string(s.look == Look::Seed ? "seed" : "correct") +
         (s.semantics == Semantics::Sheet ? " sheet" : " volume") +
         (s.light.direction.z > 0 ? " lit from behind" : " lit from the front");
}

// Face-on, alpha a (1 - i/16) in every shell over the skin.
TEST_P(Shells, UniformCoatFaceOn) {
  for (SquareScene scene : Scenes()) {
    scene.coat = UniformCoat(16, 128);
    ExpectComposite(*device_, scene, CameraAt(3, 0, 0), Describe(scene));
  }
}

TEST_P(Shells, VariedCoatFromManySides) {
  for (SquareScene scene : Scenes()) {
    scene.coat = VariedCoat(16);
    for (const auto& [yaw, pitch] : {std::pair{0.0, 0.0}, {50.0, 0.0}, {-20.0, 55.0}})
      ExpectComposite(*device_, scene, CameraAt(3, yaw, pitch), Describe(scene) + " yaw " + std::to_string(yaw));
  }
}

// The coat's own numbers reach the shader.
TEST_P(Shells, SelfShadowAndSpecular) {
  for (SquareScene scene : Scenes()) {
    scene.coat = UniformCoat(16, 160, {220, 128, 180});
    scene.coat.selfShadow = 0.3;
    scene.coat.specularPower = 4;
    scene.coat.specularScale = 1.2;
    ExpectComposite(*device_, scene, CameraAt(3, 30, 20), Describe(scene));
  }
}

// Shell i of N reads slice i N0 / N: here every second slice, and each slice twice in a row.
TEST_P(Shells, FewerShellsThanSlices) {
  for (SquareScene scene : Scenes()) {
    scene.coat = VariedCoat(16);
    scene.shells = 8;
    ExpectComposite(*device_, scene, CameraAt(3, 20, 0), Describe(scene));
  }
}

// 0.5 is "no direction" only in look correct; the seed normalises what it finds.
TEST_P(Shells, NoDirectionMeansStraightUp) {
  SquareScene scene{.look = Look::Correct, .light = kSide, .color = {180, 120, 60, 255}};
  scene.coat = UniformCoat(16, 128, {128, 127, 128});
  ExpectComposite(*device_, scene, CameraAt(3, 30, 0), "no direction");
  const RenderSettings settings{.width = kWidth,
                                .height = kHeight,
                                .technique = Technique::Seed,
                                .semantics = Semantics::Sheet,
                                .light = kSide};
  const Frame none = Render(*device_, FurredSquare(40, scene.color, scene.coat), settings, CameraAt(3, 30, 0));
  const Frame up = Render(*device_, FurredSquare(40, scene.color, UniformCoat(16, 128, {128, 128, 255})), settings,
                          CameraAt(3, 30, 0));
  for (size_t c = 0; c < 3; ++c) EXPECT_NEAR(Center(none.image)[c], Center(up.image)[c], 1);
}

// One shell at a time: opacity 1 - (1 - a)^(1/|cos|) on a square that leans away, a face-on.
TEST_P(Shells, VolumeOpacityGrowsWithThePath) {
  Coat coat = UniformCoat(2, 128);
  coat.selfShadow = 1;
  // Black skin and white fur, so that the picture is the opacity: only the coat's light differs from the skin's.
  const Light fur{
      .direction = {1, 0, 0}, .diffuse = glm::dvec3(1.5), .ambient = glm::dvec3(0), .specular = glm::dvec3(0)};
  RenderSettings settings{.width = kWidth,
                          .height = kHeight,
                          .technique = Technique::Seed,
                          .look = Look::Correct,
                          .semantics = Semantics::Volume,
                          .shells = 2,
                          .light = fur};
  // Light along the surface, wrapped by a half; sin(T,l) is 1, and half of the light has the mean sine instead.
  const double wrapped = 0.5 / 1.5 * 1.5 * (0.5 + std::numbers::pi / 8);
  for (const double yaw : {0.0, 60.0, 75.0, 85.0}) {
    const Camera camera = CameraAt(3, yaw, 0);
    const Frame frame = Render(*device_, FurredSquare(100, {255, 255, 255, 255}, coat), settings, camera);
    const double cosine = std::max(std::cos(glm::radians(yaw)), 0.25 / std::sqrt(2.0));
    const double opacity = 1 - std::pow(1 - 128 / 255.0, 1 / cosine);
    // Strands stand up (almost: 128 is not 127.5), the light runs along the skin.
    ExpectColor(Center(frame.image), glm::dvec3(Encode(wrapped * opacity)), 1.5, "yaw " + std::to_string(yaw));
  }
}

TEST_P(Shells, NoShellsShowTheSkin) {
  SquareScene scene{.look = Look::Correct, .light = kSide, .color = {180, 120, 60, 255}};
  RenderSettings settings{.width = kWidth, .height = kHeight, .drawFins = false, .drawShells = false, .light = kSide};
  const Camera camera = CameraAt(3, 0, 0);
  const Frame frame = Render(*device_, FurredSquare(40, scene.color, UniformCoat(16, 200)), settings, camera);
  const glm::dvec3 ray = RayThrough(camera, kWidth, kHeight, 16, 12);
  ExpectColor(Center(frame.image), Stored(scene.look, SkinColor(scene, ray)), 1, "skin");
}

// The displacement itself: seen from the side, the highest shell with coverage ends at its published height.
TEST_P(Shells, HeightIsTheLengthTimesTheShell) {
  Coat coat = UniformCoat(4, 255);
  coat.length = 1;
  const RenderSettings settings{.width = 65,
                                .height = 65,
                                .technique = Technique::Seed,
                                .look = Look::Seed,
                                .semantics = Semantics::Sheet,
                                .shells = 4,
                                .drawFins = false};
  // From above at 45 degrees: shell i of 4 of the unit square rises by (i + 1) / 4 along +Z.
  const Camera camera = CameraAt(6, 0, 45, 30);
  const Frame frame = Render(*device_, FurredSquare(0.5, {255, 255, 255, 255}, coat), settings, camera);
  const glm::dmat4 toClip = ProjectionMatrix(camera, 1) * ViewMatrix(camera);
  const auto row = [&](const glm::dvec3& p) {
    const glm::dvec4 clip = toClip * glm::dvec4(p, 1);
    return (1 - clip.y / clip.w) / 2 * settings.height;
  };
  uint32_t last = 0;
  for (uint32_t y = 0; y < settings.height; ++y)
    if (PixelAt(frame.image, 32, y) != Rgb{0, 0, 0}) last = y;
  // The lowest edge on the screen is the front edge (y = -0.5) of the shell or skin that projects lowest.
  double lowest = 0;
  for (int i = 0; i <= 4; ++i) lowest = std::max(lowest, row({0, -0.5, i / 4.0}));
  EXPECT_NEAR(last + 0.5, lowest, 1.0);
  EXPECT_GT(lowest - row({0, -0.5, 0}), 4) << "the test cannot tell the shells from the skin";
}

}  // namespace
}  // namespace fur::test

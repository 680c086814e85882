// Fur over fur: shells sorted by triangle (fur/src/triangle_order.h), the default.
#include <cmath>
#include <cstdio>
#include <glm/gtc/matrix_transform.hpp>

#include "../fur/reference_support.h"
#include "fur/builtin.h"
#include "models.h"
#include "oracle.h"
#include "support.h"

namespace fur::test {
namespace {

class Sorted : public OnEachBackend {};
INSTANTIATE_TEST_SUITE_P(Backends, Sorted, testing::ValuesIn(Backends()), BackendName);

// The square, and one behind it, half hidden; in one primitive, whose list says the nearer one first.
const glm::dvec3 kBehind{0.7, 0.4, -0.6};
Model TwoSquares(const Model& square) {
  Model model = square;
  Primitive& p = model.primitives[0];
  const auto count = uint32_t(p.vertices.size());
  const std::vector<uint32_t> indices = p.indices;
  for (uint32_t i = 0; i < count; ++i) {
    p.vertices.push_back(p.vertices[i]);
    p.vertices.back().position += glm::vec3(kBehind);
  }
  for (const uint32_t i : indices) p.indices.push_back(i + count);
  return model;
}

// Limb by limb as animal by animal: the nearer one's fur over the farther one's.
TEST_P(Sorted, TheNearerLimbLiesOverTheOtherOne) {
  Coat coat = UniformCoat(16, 60, {190, 128, 220});
  coat.length = 0.6;  // so that the tips stand before what is behind
  const Model square = FurredSquare(1, {200, 150, 100, 255}, coat), both = TwoSquares(square);
  RenderSettings settings{.width = 160, .height = 120, .semantics = Semantics::Sheet, .drawFins = false};
  for (const double yaw : {-25.0, -40.0}) {
    const Camera camera = CameraAt(6, yaw, -25);
    settings.shellMode = ShellMode::Sorted;
    const Image sorted = Render(*device_, both, settings, camera).image;
    settings.shellMode = ShellMode::Instanced;
    const std::vector<glm::dmat4> animals{glm::dmat4(1), glm::translate(glm::dmat4(1), kBehind)};
    EXPECT_EQ(DifferingPixels(sorted, Render(*device_, square, settings, camera, animals).image), 0u) << yaw;
    EXPECT_GT(DifferingPixels(sorted, Render(*device_, both, settings, camera).image), 200u) << yaw << ": hardly anything overlaps";
  }
}

double Rmse(const FloatImage& image, const std::vector<glm::dvec3>& truth) {
  double sum = 0;
  for (size_t i = 0; i < truth.size(); ++i) {
    const glm::dvec3 d = glm::dvec3(image.pixels[i]) - truth[i];
    sum += glm::dot(d, d) / 3;
  }
  return std::sqrt(sum / double(truth.size()));
}

// The animal's cheek before its shoulder, and its flank before its thigh.
TEST_P(Sorted, IsNearerToTheIntegral) {
  constexpr uint32_t kWidth = 96, kHeight = 72;
  const Model animal = MakeBuiltinAnimal();
  const Camera camera{.eye = {-1.8, 1.0, -1.2}, .target = {-0.25, 0.62, 0.0}, .fovY = 14};
  const ReferenceScene scene(animal, Precise(Look::Correct, Semantics::Volume));
  std::vector<glm::dvec3> truth;
  for (uint32_t y = 0; y < kHeight; ++y)
    for (uint32_t x = 0; x < kWidth; ++x)
      truth.push_back(scene.Trace(RayFrom(camera.eye, camera.eye + RayThrough(camera, kWidth, kHeight, x, y))).color);
  const auto error = [&](ShellMode mode) {
    return Rmse(Pixels(*device_, animal,
                       {.width = kWidth, .height = kHeight, .target = TargetFormat::Float32, .shells = 32,
                        .floatTextures = true, .shellMode = mode},
                       camera),
                truth);
  };
  const double sorted = error(ShellMode::Sorted), instanced = error(ShellMode::Instanced);
  std::printf("  RMSE of single rays: sorted %.4f, shell by shell %.4f\n", sorted, instanced);
  EXPECT_LT(sorted, instanced);
}

}  // namespace
}  // namespace fur::test

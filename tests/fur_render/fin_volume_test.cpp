// Fins in a volume: as opaque as the fur that shells leave to them (docs/shells.md), against closed forms.
#include <algorithm>
#include <cmath>

#include "models.h"
#include "oracle.h"
#include "support.h"

namespace fur::test {
namespace {

class FinVolume : public OnEachBackend {};
INSTANTIATE_TEST_SUITE_P(Backends, FinVolume, testing::ValuesIn(Backends()), BackendName);

constexpr double kLength = 0.4;
constexpr uint32_t kSlices = 16;

Coat ThinCoat(uint8_t coverage) {
  Coat coat = UniformCoat(kSlices, coverage);
  coat.length = kLength;
  return coat;
}

RenderSettings FinsAlone(uint32_t shells) {
  return {.width = 96, .height = 64, .target = TargetFormat::Float32, .shells = shells, .drawShells = false};
}

// The share of a way at this cosine that shells do not carry.
double Left(double cosine, uint32_t shells) {
  const double least = 0.5 / std::sqrt(double(shells));
  return 1 - std::abs(cosine) / std::max(std::abs(cosine), least);
}

double Opacity(uint8_t coverage, double heights) { return 1 - std::pow(1 - coverage / 255.0, kSlices * heights); }

// Two slopes that meet in the edge y = 0; the farther one is seen nearly edge on, the nearer one is left to the shells. The
// strands stand up +Z, so the slope at a height is the slope itself, moved. The wall at its foot carries the other half.
double RoofFin(const Camera& camera, const glm::dvec3& ray, uint8_t coverage, uint32_t shells, double* height,
               double* foot) {
  const glm::dvec3 at = camera.eye - ray * (camera.eye.y / ray.y), m = glm::normalize(glm::dvec3(0, -1, 1));
  *height = at.z / kLength;
  const double cosine = -glm::dot(ray, m);
  const glm::dvec3 along = ray + m * cosine;
  // The slope is |x| <= 1 + y from above.
  double way = 1e9;
  for (const double side : {-1.0, 1.0}) {
    const double reach = (1 - side * at.x) / (side * along.x - along.y);
    if (reach > 0) way = std::min(way, reach);
  }
  const double heights = way / (kLength * m.z), end = *height - cosine * heights;
  *foot = end;
  const auto half = [&](double from, bool rises) {
    return std::min(heights / 2, (rises ? 1 - from : from) / std::abs(cosine));
  };
  const double rest = end > 0 && end < 1 ? half(end, cosine > 0) : 0;
  return Opacity(coverage, (half(*height, cosine < 0) + rest) * Left(cosine, shells));
}

TEST_P(FinVolume, CarriesTheWayOverASlopeSeenEdgeOn) {
  constexpr uint8_t kCoverage = 12;
  for (const uint32_t shells : {8u, 16u, 40u})
    for (const double pitch : {44.9, 44.2, 43.0, 45.8, 47.0}) {
      const Camera camera = CameraAt(40, 4, pitch, 3);
      const RenderSettings settings = FinsAlone(shells);
      const FloatImage image = Pixels(*device_, Roof(ThinCoat(kCoverage)), settings, camera);
      int checked = 0;
      for (uint32_t y = 0; y < settings.height; ++y)
        for (uint32_t x = 0; x < settings.width; x += 3) {
          double height = 0, foot = 0;
          const glm::dvec3 ray = RayThrough(camera, settings.width, settings.height, x, y);
          const double expected = RoofFin(camera, ray, kCoverage, shells, &height, &foot);
          const glm::vec4 got = image.pixels[y * settings.width + x];
          const double across = camera.eye.x - ray.x * camera.eye.y / ray.y;
          // The coverage is even up to the middle of the slice below the emptied one.
          if ((foot > -0.02 && foot < 0.02) || (foot > 0.88 && foot < 1.02)) continue;
          if (height < 0.08 || height > 0.88 || std::abs(across) > 0.95 || got.a > 0.999f) continue;
          ASSERT_NEAR(got.a, expected, 0.004) << shells << " shells, pitch " << pitch << ", height " << height;
          ++checked;
        }
      EXPECT_GE(checked, 60) << "pitch " << pitch;
    }
}

// A square of two triangles, seen over its plane: the walls at both ends and the one between the triangles share the way
// through the whole slab between them.
TEST_P(FinVolume, WallsShareTheWholeWay) {
  constexpr uint8_t kCoverage = 2;
  constexpr uint32_t kShells = 16;
  const Camera camera = CameraAt(40, 88.4, 9, 5);
  const RenderSettings settings = FinsAlone(kShells);
  const FloatImage image = Pixels(*device_, FurredSquare(1, {200, 150, 100, 255}, ThinCoat(kCoverage)), settings, camera);
  int checked = 0;
  for (uint32_t y = 0; y < settings.height; ++y)
    for (uint32_t x = 0; x < settings.width; ++x) {
      const glm::dvec3 ray = RayThrough(camera, settings.width, settings.height, x, y);
      double from = 0, to = 1e9;
      for (int axis = 0; axis < 2; ++axis) {
        const double a = (-1 - camera.eye[axis]) / ray[axis], b = (1 - camera.eye[axis]) / ray[axis];
        from = std::max(from, std::min(a, b)), to = std::min(to, std::max(a, b));
      }
      const double in = (camera.eye.z + ray.z * from) / kLength, out = (camera.eye.z + ray.z * to) / kLength;
      if (from >= to || std::min(in, out) < 0.1 || std::max(in, out) > 0.85) continue;
      const double heights = (to - from) / kLength;
      const double expected = Opacity(kCoverage, heights * Left(ray.z, kShells));
      ASSERT_NEAR(image.pixels[y * settings.width + x].a, expected, 0.006) << x << ", " << y;
      ++checked;
    }
  EXPECT_GE(checked, 200);
}

// It fades in with the angle and out again: nothing pops while the slope behind turns away.
TEST_P(FinVolume, FadeIsContinuous) {
  double largest = 0, before = -1, most = 0;
  for (double pitch = 30; pitch <= 60; pitch += 0.25) {
    double sum = 0;
    for (const glm::vec4& p : Pixels(*device_, Roof(ThinCoat(12)), FinsAlone(16), CameraAt(6, 0, pitch, 20)).pixels)
      sum += p.a < 0.999f ? double(p.a) : 0;
    if (before >= 0) largest = std::max(largest, std::abs(sum - before));
    before = sum;
    most = std::max(most, sum);
  }
  EXPECT_GT(most, 20) << "the fin is hardly seen";
  EXPECT_LT(largest, 0.2 * most);
  EXPECT_LT(before, 0.02 * most) << "away from edge on there is nothing left to it";
}

// Of fur so thin that what two fins hide of each other does not count.
TEST_P(FinVolume, OpacityScalesIt) {
  RenderSettings settings = FinsAlone(16);
  const Camera camera = CameraAt(40, 4, 44.9, 3);
  const auto sum = [&](std::optional<double> opacity) {
    settings.finOpacity = opacity;
    double all = 0;
    for (const glm::vec4& p : Pixels(*device_, Roof(ThinCoat(1)), settings, camera).pixels) all += p.a < 0.999f ? double(p.a) : 0;
    return all;
  };
  const double whole = sum({});
  EXPECT_GT(whole, 20);
  EXPECT_NEAR(sum(0.5) / whole, 0.5, 0.02);
  EXPECT_EQ(sum(0), 0);
}

}  // namespace
}  // namespace fur::test

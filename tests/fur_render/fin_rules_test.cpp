// Fins of the technique shells: which edges grow one, how it fades, how it is lit, how long it is at each end.
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>

#include "emitted.h"
#include "fur/fur_mesh.h"
#include "models.h"
#include "oracle.h"

namespace fur::test {
namespace {

class FinRules : public OnEachBackend {};
INSTANTIATE_TEST_SUITE_P(Backends, FinRules, testing::ValuesIn(Backends()), BackendName);

Coat LongCoat() {
  Coat coat = UniformCoat(16, 200, {128, 128, 255});
  coat.length = 0.4;
  return coat;
}

RenderSettings Settings(double threshold) {
  return {.width = 96,
          .height = 64,
          .semantics = Semantics::Sheet,  // fins as published; those of a volume: fin_volume_test.cpp
          .target = TargetFormat::Float32,
          .drawShells = false,
          .finMode = FinMode::Geometry,
          .finThreshold = threshold};
}

// The rule of docs/shells.md in double: 1 on a silhouette, 1 - |e.N| / t beside it, e at the middle of the edge.
double Fade(const FurMesh& mesh, size_t edge, const glm::dvec3& eye, double threshold) {
  const auto at = [&](size_t k) { return glm::dvec3(mesh.vertices[mesh.edges[edge + k]].position); };
  const glm::dvec3 e = glm::normalize(eye - (at(1) + at(2)) * 0.5);
  const double n1 = glm::dot(e, glm::normalize(glm::cross(at(2) - at(1), at(3) - at(1))));
  const double n2 = glm::dot(e, glm::normalize(glm::cross(at(1) - at(2), at(0) - at(2))));
  if (n1 * n2 < 0) return 1;
  return threshold > 0 ? std::clamp(1 - std::min(std::abs(n1), std::abs(n2)) / threshold, 0.0, 1.0) : 0;
}

uint64_t ExpectedFins(const Model& model, const glm::dvec3& eye, double threshold) {
  const FurMesh mesh = MakeFurMeshes(model, FurTiling::Isometric)[0];
  uint64_t fins = 0;
  for (size_t e = 0; e < mesh.edges.size(); e += 4) fins += Fade(mesh, e, eye, threshold) > 0;
  return fins;
}

// Closed bodies, a boundary, and a body that is turned and moved: the eye is brought to it.
TEST_P(FinRules, EdgesThatGrowAFin) {
  if (!(*device_)->GetCaps().pipelineStatistics) GTEST_SKIP() << GetParam().name << " has no pipeline statistics";
  const glm::dmat4 moved = glm::rotate(glm::translate(glm::dmat4(1), {0.4, -0.2, 1}), 2.0, glm::dvec3(0.3, 1, 0.1));
  for (const Model& model : {Tetrahedron(LongCoat()), Cube(LongCoat()), Roof(LongCoat())})
    for (const double threshold : {0.0, 0.1, 0.25, 0.9})
      for (const glm::dmat4& placement : {glm::dmat4(1), moved})
        for (const auto& [yaw, pitch] : {std::pair{3.0, 4.0}, {21.0, 12.0}, {101.0, -48.0}, {200.0, 7.0}}) {
          const Camera camera = CameraAt(7.3, yaw, pitch);
          const glm::dvec3 eye(glm::inverse(placement) * glm::dvec4(camera.eye, 1));
          EXPECT_EQ(EmittedTriangles(*device_, model, Settings(threshold), camera, placement),
                    2 * ExpectedFins(model, eye, threshold))
              << "threshold " << threshold << ", yaw " << yaw;
        }
}

// Seen from above along the slopes' planes the ridge fades in before one slope turns away, and never jumps.
TEST_P(FinRules, FadeIsContinuous) {
  const Model roof = Roof(LongCoat());
  const FurMesh mesh = MakeFurMeshes(roof, FurTiling::Isometric)[0];
  float largest = 0, before = -1, most = 0;
  for (double pitch = 20; pitch <= 60; pitch += 0.25) {
    const Camera camera = CameraAt(6, 0, pitch, 20);
    float sum = 0;
    for (const glm::vec4& p : Pixels(*device_, roof, Settings(0.25), camera).pixels) sum += p.a < 1 ? p.a : 0;
    if (before >= 0) largest = std::max(largest, std::abs(sum - before));
    before = sum;
    most = std::max(most, sum);
  }
  EXPECT_GT(most, 20) << "the fin is hardly seen";
  EXPECT_LT(largest, 0.08f * most) << "a quarter of a degree changes the fin by more than its slope";
}

// The fin stands in the plane y = 0 from the ridge up +Z: its colour is the shells' (docs/accuracy.md), its opacity the
// coverage at that height times the whole fin's.
TEST_P(FinRules, FinIsLitLikeShells) {
  Coat coat = LongCoat();
  coat.slices.assign(16, Texel{150, 110, 230, 200});
  const Model roof = Roof(coat);
  const Light light{.direction = {0.3, 0.8, -0.4}, .diffuse = {0.9, 0.8, 0.7}, .ambient = {0.1, 0.2, 0.3}};
  const FurMesh mesh = MakeFurMeshes(roof, FurTiling::Isometric)[0];
  SquareScene scene{.light = light, .color = {200, 150, 100, 255}, .coat = coat, .shells = 4096};
  scene.tangent = glm::dvec3(mesh.vertices[mesh.edges[1]].tangent);
  RenderSettings settings = Settings(0.25);
  settings.light = light;
  const Camera camera = CameraAt(6, 0, 89.5, 20);  // the fin stands up in the picture; +Z points down
  const FloatImage image = Pixels(*device_, roof, settings, camera);
  int checked = 0;
  for (uint32_t y = 0; y < settings.height; ++y) {
    const glm::dvec3 ray = RayThrough(camera, settings.width, settings.height, 48, y);
    const double z = camera.eye.z - ray.z * camera.eye.y / ray.y;  // where the ray meets the plane y = 0
    const double h = z / coat.length;
    if (h < 0.05 || h > 0.9) continue;
    const glm::dvec4 shell = MidpointShell(scene, ray, uint32_t(h * 4096));
    const double alpha = 200 / 255.0 * 0.9;  // the published opacity
    const glm::vec4 got = image.pixels[y * settings.width + 48];
    EXPECT_NEAR(got.a, alpha, 2e-3) << "height " << h;
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(got[c] / got.a, shell[c], 0.01) << "height " << h << ", channel " << c;
    ++checked;
  }
  EXPECT_GE(checked, 10);
}

// Each end is as long as the fur is there: bald on the left, whole on the right, a fin is a triangle. The slopes' feet are
// bald, so that every fin's area is in proportion to the sum of the lengths at the ridge's two ends.
TEST_P(FinRules, EachEndHasItsOwnLength) {
  const Camera camera = CameraAt(6, 0, 89.5, 25);
  const auto area = [&](uint8_t left, uint8_t right) {
    Model roof = Roof(LongCoat());
    Image lengths = Plain("length", {left, left, left, 255});
    for (size_t i = 0; i < 16; ++i)
      if (i % 4 >= 2 || i < 4) lengths.pixels[i * 4] = i < 4 ? 0 : right;
    for (size_t foot : {2u, 3u}) roof.primitives[0].vertices[foot].uv.y = 0.125f;
    roof.images.push_back(lengths);
    roof.materials[0].fur->lengthMap = 1;
    return Render(*device_, roof, Settings(0), camera).counts.finFragments;
  };
  const double whole = double(area(255, 255));
  EXPECT_GT(whole, 500);
  EXPECT_NEAR(double(area(0, 255)) / whole, 0.5, 0.03);
  EXPECT_NEAR(double(area(255, 0)) / whole, 0.5, 0.03);
  EXPECT_NEAR(double(area(128, 255)) / whole, 0.75, 0.03);
  EXPECT_EQ(area(0, 0), 0u);
}

TEST_P(FinRules, OpacityScalesTheFin) {
  RenderSettings settings = Settings(0);
  const Camera camera = CameraAt(6, 0, 89.5, 25);
  const auto middle = [&](double opacity) {
    settings.finOpacity = opacity;
    return Pixels(*device_, Roof(LongCoat()), settings, camera).pixels[36 * 96 + 48].a;
  };
  const float whole = middle(1);
  EXPECT_GT(whole, 0.5f);
  EXPECT_NEAR(middle(0.5), whole / 2, 1e-3f);
  EXPECT_EQ(middle(0), 0);
}

}  // namespace
}  // namespace fur::test

// Numbers far from 1: the same scene in other units, far from the origin, with planes far apart, mirrored and sheared. Each
// picture is compared with that of the plain scene, which the other tests hold to closed forms.
#include <cmath>
#include <cstdio>
#include <glm/gtc/matrix_transform.hpp>

#include "fur/builtin.h"
#include "models.h"
#include "support.h"

namespace fur::test {
namespace {

constexpr uint32_t kWidth = 160, kHeight = 120;

RenderSettings Settings(Look look = Look::Correct) {
  RenderSettings s{.width = kWidth, .height = kHeight, .look = look, .background = {0.3, 0.32, 0.34}};
  s.target = TargetFormat::Float32;
  if (look == Look::Seed) s.semantics = Semantics::Sheet;
  return s;
}

const Model& Animal() {
  static const Model model = MakeBuiltinAnimal();
  return model;
}

Camera Near(const Model& model) {
  Camera c = FrameBounds(ComputeBounds(model), {glm::dmat4(1)}, 30, double(kWidth) / kHeight);
  c.zNear = 0.25;
  c.zFar = 64;
  return c;
}

// The scene in a unit that is 1 / `scale` of the old one.
Model Scaled(const Model& model, double scale) {
  Model m = model;
  for (Primitive& p : m.primitives)
    for (Vertex& v : p.vertices) v.position *= float(scale);
  for (Material& material : m.materials)
    if (material.fur) material.fur->params.length *= scale;
  return m;
}

Camera Scaled(Camera c, double scale) {
  c.eye *= scale;
  c.target *= scale;
  c.zNear *= scale;
  c.zFar *= scale;
  return c;
}

// Share of pixels of which a channel differs by more than 1/255.
double Beyond(const FloatImage& a, const FloatImage& b) {
  size_t count = 0;
  for (size_t i = 0; i < a.pixels.size(); ++i) {
    const glm::vec4 d = glm::abs(a.pixels[i] - b.pixels[i]);
    count += std::max(std::max(d.r, d.g), std::max(d.b, d.a)) > 1 / 255.0f ? 1 : 0;
  }
  return double(count) / double(a.pixels.size());
}

void ExpectAlike(const FloatImage& got, const FloatImage& plain, const char* what) {
  ASSERT_TRUE(AllFinite(got)) << what;
  ASSERT_EQ(got.pixels.size(), plain.pixels.size());
  const double beyond = Beyond(got, plain);
  std::printf("  %s: %.3f %% of pixels beyond 1/255\n", what, beyond * 100);
  EXPECT_LE(beyond, 0.001) << what;
}

class StressScale : public OnEachBackend {
 protected:
  FloatImage Draw(const Model& m, const RenderSettings& s, const Camera& c,
                  const std::vector<glm::dmat4>& placements = {glm::dmat4(1)}) {
    return Pixels(*device_, m, s, c, placements);
  }
  // With what it was made for: an animal in the middle of the picture.
  FloatImage Plain(const RenderSettings& s) {
    FloatImage plain = Draw(Animal(), s, Near(Animal()));
    size_t covered = 0;
    for (const glm::vec4& p : plain.pixels) covered += p.a > 0.5f ? 1 : 0;
    EXPECT_GT(covered, plain.pixels.size() / 10);
    return plain;
  }
};
INSTANTIATE_TEST_SUITE_P(Backends, StressScale, testing::ValuesIn(Backends()), BackendName);

// A power of two changes no digit, so no bit of the picture may change. Look seed has the demo's skin, whose light depends on
// the length of normals that a node scales.
TEST_P(StressScale, PowersOfTwoAreTheSameBits) {
  for (const Look look : {Look::Correct, Look::Seed}) {
    const FloatImage plain = Plain(Settings(look));
    for (const int power : {-17, -6, 6, 17}) {
      const double scale = std::ldexp(1.0, power);
      const std::string what = std::string(look == Look::Correct ? "correct" : "seed") + ", 2^" + std::to_string(power);
      const FloatImage mesh = Draw(Scaled(Animal(), scale), Settings(look), Scaled(Near(Animal()), scale));
      EXPECT_TRUE(mesh.pixels == plain.pixels) << what << " in the mesh: " << Beyond(mesh, plain);
      if (look == Look::Seed) continue;
      const FloatImage node = Draw(Animal(), Settings(look), Scaled(Near(Animal()), scale),
                                   {glm::scale(glm::dmat4(1), glm::dvec3(scale))});
      EXPECT_TRUE(node.pixels == plain.pixels) << what << " in the node: " << Beyond(node, plain);
    }
  }
}

TEST_P(StressScale, OtherScalesDifferByRounding) {
  const FloatImage plain = Plain(Settings());
  for (const double scale : {1e-5, 0.3, 7.0, 1e5}) {
    const std::string what = "scale " + std::to_string(scale);
    ExpectAlike(Draw(Scaled(Animal(), scale), Settings(), Scaled(Near(Animal()), scale)), plain, what.c_str());
  }
}

TEST_P(StressScale, NodesFarFromTheOrigin) {
  const FloatImage plain = Plain(Settings());
  for (const glm::dvec3& far : {glm::dvec3(1e6, 0, 0), glm::dvec3(-1e6, 3e5, 1e6)}) {
    Camera c = Near(Animal());
    c.eye += far;
    c.target += far;
    ExpectAlike(Draw(Animal(), Settings(), c, {glm::translate(glm::dmat4(1), far)}), plain, "translated by 1e6");
  }
}

// 1e6 in the vertices themselves leaves them a grid of 1/16: the shape is lost, the numbers are not.
TEST_P(StressScale, VerticesFarFromTheOriginGiveNoNan) {
  Model far = Animal();
  for (Primitive& p : far.primitives)
    for (Vertex& v : p.vertices) v.position += glm::vec3(1e6f, 0, 0);
  Camera c = Near(Animal());
  c.eye.x += 1e6;
  c.target.x += 1e6;
  EXPECT_TRUE(AllFinite(Draw(far, Settings(), c)));
}

TEST_P(StressScale, PlanesFarApart) {
  const FloatImage plain = Plain(Settings());
  Camera c = Near(Animal());
  c.zNear = 1e-3;
  c.zFar = 1e6;
  ExpectAlike(Draw(Animal(), Settings(), c), plain, "planes at 1e-3 and 1e6");
}

// Two walls a hundredth apart, 400 away: with depth 0 at the near plane of 1e-3 floats could not tell them apart.
TEST_P(StressScale, FarSurfacesStayInOrder) {
  Model walls = BaldSquare(40, {255, 0, 0, 255});
  const Model behind = BaldSquare(40, {0, 255, 0, 255});
  walls.images.push_back(behind.images[0]);
  walls.materials.push_back(behind.materials[0]);
  walls.materials[1].baseColorTexture.image = 1;
  walls.primitives.push_back(behind.primitives[0]);
  walls.primitives[1].material = 1;
  walls.parts.push_back({.primitive = 1, .transform = glm::translate(glm::dmat4(1), glm::dvec3(0, 0, -0.01))});
  Camera c = CameraAt(400, 10, 5, 8);
  c.zNear = 1e-3;
  c.zFar = 1e6;
  for (const bool swapped : {false, true}) {
    if (swapped) std::swap(walls.parts[0], walls.parts[1]);
    const FloatImage picture = Draw(walls, Settings(), c);
    size_t red = 0, green = 0;
    for (const glm::vec4& p : picture.pixels) {
      red += p.r > 2 * p.g ? 1 : 0;
      green += p.g > 2 * p.r ? 1 : 0;
    }
    EXPECT_GT(red, picture.pixels.size() / 2);
    // The nearer wall hides the farther one but for a line at two edges.
    EXPECT_LE(green, size_t(kWidth + kHeight)) << (swapped ? "farther wall drawn first" : "nearer wall drawn first");
  }
}

// A mirrored node, seen by a mirrored camera under a mirrored light, is the picture mirrored.
TEST_P(StressScale, MirroredNodes) {
  RenderSettings s = Settings();
  s.light.direction = {0.4, -1, 0.7};
  const Camera c = Near(Animal());
  const FloatImage plain = Draw(Animal(), s, c);
  const glm::dvec3 mirror(-1, 1, 1);
  s.light.direction *= mirror;
  Camera other = c;
  other.eye *= mirror;
  other.target *= mirror;
  FloatImage mirrored = Draw(Animal(), s, other, {glm::scale(glm::dmat4(1), mirror)});
  ASSERT_TRUE(AllFinite(mirrored));
  for (uint32_t y = 0; y < kHeight; ++y)
    std::reverse(mirrored.pixels.begin() + y * kWidth, mirrored.pixels.begin() + (y + 1) * kWidth);
  ExpectAlike(mirrored, plain, "mirrored");
}

TEST_P(StressScale, ShearedAndFlattenedNodes) {
  glm::dmat4 sheared(1);
  sheared[1][0] = 3;  // x += 3 y
  const Camera c = Near(Animal());
  const FloatImage plain = Plain(Settings());
  for (const double flat : {1.0, 1e-6, 0.0}) {
    const glm::dmat4 node = sheared * glm::scale(glm::dmat4(1), glm::dvec3(1, 1, flat));
    const FloatImage picture = Draw(Animal(), Settings(), c, {node});
    EXPECT_TRUE(AllFinite(picture)) << flat;
    EXPECT_GT(Beyond(picture, plain), 0.05) << "it is another shape";
  }
}

}  // namespace
}  // namespace fur::test

// The reference on curved fur and on whole animals: the sphere, the furnace, Embree against all prisms, odd triangles.
#include <gtest/gtest.h>

#include <cmath>

#include "fur/builtin.h"
#include "fur/gltf.h"
#include "random.h"
#include "reference_support.h"

namespace fur::test {
namespace {

using reference::Radiance;
using reference::Ray;

// Rays between points of a ball around the model, most of which meet it.
std::vector<Ray> RandomRays(const Bounds& b, size_t count) {
  Pcg32 random(7);
  const auto point = [&](double size) {
    const glm::dvec3 v(random.Uniform() - 0.5, random.Uniform() - 0.5, random.Uniform() - 0.5);
    return b.Center() + v * (b.Diameter() * size);
  };
  std::vector<Ray> rays;
  while (rays.size() < count) {
    const glm::dvec3 from = b.Center() + glm::normalize(point(1) - b.Center()) * (b.Diameter() * 1.5);
    rays.push_back(RayFrom(from, point(0.5)));
  }
  return rays;
}

void ExpectCullingLosesNothing(const Model& model, ReferenceSettings settings) {
  settings.tolerance = 1e-3;
  const ReferenceScene scene(model, settings);
  size_t furry = 0;
  double largest = 0;
  for (const Ray& ray : RandomRays(ComputeBounds(model), 1000)) {
    const Radiance fast = scene.Trace(ray, glm::dvec3(0.3)), all = scene.TraceBrute(ray, glm::dvec3(0.3));
    const glm::dvec3 apart = glm::abs(fast.color - all.color);
    largest = std::max({largest, apart.x, apart.y, apart.z, std::abs(fast.furOpacity - all.furOpacity)});
    EXPECT_EQ(fast.skin, all.skin);
    furry += all.furOpacity > 0.01;
  }
  EXPECT_LE(largest, 1e-12);
  EXPECT_GT(furry, 300u);
  std::printf("  1000 rays, %zu through fur: largest difference %g\n", furry, largest);
}

TEST(ReferenceRays, EmbreeLosesNothing) {
  ExpectCullingLosesNothing(MakeBuiltinAnimal(), Precise(Look::Correct, Semantics::Volume));
}

TEST(ReferenceRays, EmbreeLosesNothingOfCombedFur) {
  ReferenceSettings settings = Precise(Look::Seed, Semantics::Sheet);
  settings.comb = {0.5, -0.8, 1};
  settings.bend = 2.5;
  ExpectCullingLosesNothing(MakeBuiltinAnimal(), settings);
}

TEST(ReferenceRays, EmbreeLosesNothingOfTheCat) {
  const Result<Model> cat = LoadGltf(std::string(FUR_ASSETS_DIR) + "/cat/cat.gltf");
  if (!cat) GTEST_SKIP() << "the cat is absent from " << FUR_ASSETS_DIR;
  ExpectCullingLosesNothing(*cat, Precise(Look::Correct, Semantics::Volume));
}

// Fur and skin of one colour before a background of that colour cannot be seen.
TEST(ReferenceRays, TheFurnaceIsEven) {
  const Model model = MakeBuiltinAnimal();
  const glm::dvec3 c(0.7, 0.4, 0.1);
  for (const Semantics semantics : {Semantics::Sheet, Semantics::Volume}) {
    ReferenceSettings settings = Precise(Look::Correct, semantics);
    settings.furnace = c;
    settings.tolerance = 1e-3;
    const ReferenceScene scene(model, settings);
    for (const Ray& ray : RandomRays(ComputeBounds(model), 500)) {
      const glm::dvec3 got = scene.Trace(ray, c).color;
      for (int i = 0; i < 3; ++i) EXPECT_NEAR(got[i], c[i], 1e-12);
    }
  }
}

// tau through fur of length `length` on the unit sphere at impact parameter b: the height is r - 1 over the length.
double SphereTau(double b, double length, double coverage, uint32_t slices, Semantics semantics) {
  const double outer = 1 + length, nearest = std::max(b, 1.0);
  const double sides = b < 1 ? 1 : 2;
  if (b >= outer) return 0;
  if (semantics == Semantics::Sheet) return sides * ConstantCoatAbove((nearest - 1) / length, coverage, slices);
  // |grad h| is 1 / length: midpoints along the ray.
  const double from = std::sqrt(nearest * nearest - b * b), to = std::sqrt(outer * outer - b * b);
  constexpr int kSteps = 20000;
  double sum = 0;
  for (int i = 0; i < kSteps; ++i) {
    const double s = from + (to - from) * (i + 0.5) / kSteps, h = (std::sqrt(b * b + s * s) - 1) / length;
    const double z = std::clamp(h * slices - 0.5, 0.0, slices - 1.0);
    sum -= slices * std::log(1 - coverage * std::clamp(slices - 1 - z, 0.0, 1.0));
  }
  return sides * sum * (to - from) / kSteps / length;
}

TEST(ReferenceRays, SphereOfConstantFur) {
  Coat coat = UniformCoat(8, 60);
  coat.length = 0.3;
  double coarse = 0, fine = 0;
  for (const int levels : {3, 5}) {
    const Model model = Sphere(levels, coat);
    double largest = 0;
    for (const Semantics semantics : {Semantics::Sheet, Semantics::Volume}) {
      ReferenceSettings settings = Precise(Look::Correct, semantics);
      settings.tolerance = 1e-5;
      const ReferenceScene scene(model, settings);
      for (const double b : {0.0, 0.3, 0.6, 0.9, 0.97, 1.03, 1.1, 1.15, 1.2, 1.31}) {
        const double expected = -std::expm1(-SphereTau(b, coat.length, 60 / 255.0, 8, semantics));
        const double got = scene.Trace(RayFrom({0.8 * b, 0.6 * b, 9}, {0.8 * b, 0.6 * b, 0})).furOpacity;
        largest = std::max(largest, std::abs(got - expected));
        EXPECT_NEAR(got, expected, levels == 5 ? 4e-3 : 0.06) << "impact parameter " << b << ", semantics " << int(semantics);
      }
    }
    (levels == 3 ? coarse : fine) = largest;
  }
  std::printf("  largest error of opacity: %.5f with 1280 triangles, %.5f with 20480\n", coarse, fine);
  EXPECT_LT(fine, coarse / 4);
}

TEST(ReferenceRays, NoNumberIsLostOnOddTriangles) {
  const std::vector<glm::vec3> p{{1, 1, 1}, {1, -1, -1}, {-1, 1, -1}, {-1, -1, 1}, {1, 1, 1}, {0.2f, 0.2f, 0.2f}, {0.6f, 0.6f, 0.6f}};
  // The tetrahedron, then triangles without an area, of one point, and of three on a line.
  const std::vector<uint32_t> indices{0, 1, 2, 0, 3, 1, 0, 2, 3, 1, 3, 2, 0, 0, 1, 0, 4, 0, 1, 1, 1, 0, 5, 6, 2, 3, 3};
  Coat coat = UniformCoat(4, 255);
  coat.length = 3;  // the faces' fur is longer than the body
  Model model = FurredMesh(p, indices, coat);
  for (Vertex& v : model.primitives[0].vertices) v.tangent = {0, 0, 0, 1};
  for (const Look look : {Look::Seed, Look::Correct})
    for (const double bend : {1.0, 1.5, 3.0}) {
      ReferenceSettings settings = Precise(look, Semantics::Volume);
      settings.tolerance = 1e-3;
      settings.comb = {0, bend - 1, 10 * (bend - 1)};
      settings.bend = bend;
      const ReferenceScene scene(model, settings);
      std::vector<Ray> rays = RandomRays(ComputeBounds(model), 300);
      for (const double x : {0.0, 1.0, -1.0}) rays.push_back(RayFrom({x, x, 9}, {x, x, 0}));
      for (const Ray& ray : rays) {
        const Radiance r = scene.Trace(ray);
        EXPECT_TRUE(std::isfinite(r.color.x + r.color.y + r.color.z + r.furOpacity));
        EXPECT_GE(r.furOpacity, 0);
        EXPECT_LE(r.furOpacity, 1);
      }
    }
}

}  // namespace
}  // namespace fur::test

#include "reference_support.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <utility>

namespace fur::test {
namespace {

std::unique_ptr<reference::Culler> Embree(const reference::FurScene& scene) {
  Result<std::unique_ptr<reference::Culler>> culler = reference::MakeEmbreeCuller(scene);
  if (culler) return std::move(*culler);
  ADD_FAILURE() << culler.error().message;
  return reference::MakeBruteCuller(scene);
}

}  // namespace

ReferenceScene::ReferenceScene(const Model& model, const ReferenceSettings& settings,
                               const std::vector<glm::dmat4>& placements)
    : model_(model),
      scene_(model_, placements, settings),
      culler_(Embree(scene_)),
      brute_(reference::MakeBruteCuller(scene_)),
      tolerance_(settings.tolerance) {}

reference::Radiance ReferenceScene::Trace(const reference::Ray& ray, const glm::dvec3& background) const {
  return reference::Integrator(scene_, *culler_, tolerance_).Trace(ray, background);
}

reference::Radiance ReferenceScene::TraceBrute(const reference::Ray& ray, const glm::dvec3& background) const {
  return reference::Integrator(scene_, *brute_, tolerance_).Trace(ray, background);
}

reference::Ray RayFrom(const glm::dvec3& origin, const glm::dvec3& towards) {
  reference::Ray ray;
  ray.origin = origin;
  ray.SetDirection(glm::normalize(towards - origin));
  return ray;
}

ReferenceSettings Precise(Look look, Semantics semantics) {
  ReferenceSettings s;
  s.look = look;
  s.semantics = semantics;
  s.light = look == Look::Seed ? kDemoLight : Light{};
  s.tolerance = 1e-9;
  return s;
}

double ConstantCoatAbove(double h, double coverage, uint32_t slices) {
  const double n = slices, full = (n - 1.5) / n, empty = (n - 0.5) / n;
  // From coverage a x at a share x of the way down from `empty`, per unit of x.
  const auto wedge = [&](double x) {
    const double a = coverage;
    return x <= 0 ? 0 : x + (1 - a * x) * std::log(1 - a * x) / a;
  };
  const double below = std::max(0.0, full - h) * -n * std::log(1 - coverage);
  return below + wedge(std::min(1.0, (empty - h) * n));
}

Model Sphere(int levels, const Coat& coat) {
  const auto g = float((1 + std::sqrt(5.0)) / 2);
  std::vector<glm::vec3> p{{-1, g, 0}, {1, g, 0},  {-1, -g, 0}, {1, -g, 0}, {0, -1, g}, {0, 1, g},
                           {0, -1, -g}, {0, 1, -g}, {g, 0, -1},  {g, 0, 1},  {-g, 0, -1}, {-g, 0, 1}};
  for (glm::vec3& v : p) v = glm::normalize(v);
  std::vector<uint32_t> indices{0, 11, 5, 0, 5,  1, 0, 1, 7, 0, 7,  10, 0, 10, 11, 1, 5, 9, 5, 11, 4, 11, 10, 2, 10, 7, 6, 7, 1, 8,
                                3, 9,  4, 3, 4,  2, 3, 2, 6, 3, 6,  8,  3, 8,  9,  4, 9, 5, 2, 4,  11, 6, 2,  10, 8, 6, 7, 9, 8, 1};
  for (int level = 0; level < levels; ++level) {
    std::map<std::pair<uint32_t, uint32_t>, uint32_t> middles;
    const auto middle = [&](uint32_t a, uint32_t b) {
      const auto [it, made] = middles.insert({{std::min(a, b), std::max(a, b)}, uint32_t(p.size())});
      if (made) p.push_back(glm::normalize(p[a] + p[b]));
      return it->second;
    };
    std::vector<uint32_t> finer;
    for (size_t i = 0; i < indices.size(); i += 3) {
      const uint32_t a = indices[i], b = indices[i + 1], c = indices[i + 2];
      const uint32_t ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
      finer.insert(finer.end(), {a, ab, ca, ab, b, bc, ca, bc, c, ab, bc, ca});
    }
    indices = finer;
  }
  return FurredMesh(p, indices, coat);
}

}  // namespace fur::test

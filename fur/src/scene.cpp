#include "fur/scene.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>

namespace fur {
namespace {

constexpr double kDemoCatDiameter = 3.31;
constexpr double kDemoFieldHalf = 8;

// SplitMix64 (Steele, Lea, Flood 2014): 53 bits to [0, 1).
double NextUnit(uint64_t* state) {
  uint64_t z = (*state += 0x9E3779B97F4A7C15u);
  z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9u;
  z = (z ^ (z >> 27)) * 0x94D049BB133111EBu;
  return double((z ^ (z >> 31)) >> 11) * 0x1p-53;
}

glm::dmat4 Place(const glm::dvec3& position, double degrees) {
  const glm::dmat4 moved = glm::translate(glm::dmat4(1), position);
  return glm::rotate(moved, glm::radians(degrees), glm::dvec3(0, 1, 0));
}

// The distance along -forward from `center` at which `point` is just inside the view.
double DistanceToShow(const glm::dvec3& point, const glm::dvec3& center, const glm::dmat3& axes, double tanX, double tanY) {
  const glm::dvec3 v = glm::transpose(axes) * (point - center);  // right, up, forward
  return std::max(std::abs(v.x) / tanX, std::abs(v.y) / tanY) - v.z;
}

glm::dvec3 Corner(const Bounds& b, int i) {
  return {i & 1 ? b.max.x : b.min.x, i & 2 ? b.max.y : b.min.y, i & 4 ? b.max.z : b.min.z};
}

Bounds BoundsOf(const std::vector<glm::dvec3>& points) {
  Bounds b{points.front(), points.front()};
  for (const glm::dvec3& p : points) {
    b.min = glm::min(b.min, p);
    b.max = glm::max(b.max, p);
  }
  return b;
}

}  // namespace

glm::dmat4 ViewMatrix(const Camera& c) { return glm::lookAtRH(c.eye, c.target, c.up); }

glm::dmat4 ProjectionMatrix(const Camera& c, double aspect) {
  return glm::perspectiveRH_ZO(glm::radians(c.fovY), aspect, c.zNear, c.zFar);
}

double SceneScale(const Bounds& b) {
  const double ratio = b.Diameter() / kDemoCatDiameter;
  return ratio > 0 && std::isfinite(ratio) ? std::exp2(std::round(std::log2(ratio))) : 1;
}

std::vector<glm::dmat4> PlaceAnimals(uint32_t count, double scale) {
  if (count <= 1) return {Place(glm::dvec3(0), -180)};
  const auto rows = uint32_t(std::ceil(std::sqrt(double(count))));
  const double half = std::min(rows, 10u) / 2.0;  // above 10 rows the spacing stays and the field grows
  std::vector<glm::dmat4> placements;
  uint64_t state = 1;
  for (uint32_t i = 0; i < rows; ++i)
    for (uint32_t j = 0; j < rows && placements.size() < count; ++j) {
      const double x = (i - (rows > 10 ? rows / 2.0 : half)) / half, z = (j - half) / half;
      const glm::dvec3 position = glm::dvec3(x, 0, z) * (kDemoFieldHalf * scale);
      placements.push_back(Place(position, -180 + 60 * NextUnit(&state)));
    }
  return placements;
}

Camera FrameBounds(const Bounds& bounds, const std::vector<glm::dmat4>& placements, double fovY, double aspect) {
  std::vector<glm::dvec3> points;
  for (const glm::dmat4& m : placements)
    for (int i = 0; i < 8; ++i) points.push_back(m * glm::dvec4(Corner(bounds, i), 1));
  const glm::dvec3 center = BoundsOf(points).Center();
  const glm::dvec3 forward = glm::normalize(glm::dvec3(0.62, -0.38, 0.80));
  const glm::dvec3 right = glm::normalize(glm::cross(forward, glm::dvec3(0, 1, 0)));
  const glm::dmat3 axes(right, glm::cross(right, forward), forward);
  const double tanY = std::tan(glm::radians(fovY) / 2), tanX = tanY * aspect;
  double distance = 0;
  for (const glm::dvec3& p : points) distance = std::max(distance, DistanceToShow(p, center, axes, tanX, tanY));
  distance = distance > 0 ? distance * 1.03 : 1;
  Camera camera;
  camera.eye = center - forward * distance;
  camera.target = center;
  camera.fovY = fovY;
  const double scale = SceneScale(bounds);
  camera.zNear = 0.1 * scale;
  camera.zFar = 1000 * scale;
  return camera;
}

Camera TurnCamera(const Camera& camera, double degrees) {
  Camera turned = camera;
  const glm::dmat4 turn = glm::rotate(glm::dmat4(1), glm::radians(degrees), camera.up);
  turned.eye = camera.target + glm::dvec3(turn * glm::dvec4(camera.eye - camera.target, 0));
  return turned;
}

}  // namespace fur

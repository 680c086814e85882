#include "fur/scene.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <limits>
#include <numeric>

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

// What a view direction sees: axes and the tangents of the half angles.
struct Frustum {
  glm::dmat3 axes;  // right, up, forward
  double tanX, tanY;
};

struct Range {
  double min = std::numeric_limits<double>::infinity(), max = -min;
  void Add(double v) {
    min = std::min(min, v);
    max = std::max(max, v);
  }
  double Middle() const { return (min + max) / 2; }
};

// The distance behind `center` at which every point is inside.
double DistanceToShow(const std::vector<glm::dvec3>& points, const glm::dvec3& center, const Frustum& f) {
  double distance = 0;
  for (const glm::dvec3& p : points) {
    const glm::dvec3 v = glm::transpose(f.axes) * (p - center);
    distance = std::max(distance, std::max(std::abs(v.x) / f.tanX, std::abs(v.y) / f.tanY) - v.z);
  }
  return distance;
}

// Moves `center` so that the points' picture lies in the middle of the view.
glm::dvec3 Recenter(const std::vector<glm::dvec3>& points, const glm::dvec3& center, double distance, const Frustum& f) {
  Range x, y;
  for (const glm::dvec3& p : points) {
    const glm::dvec3 v = glm::transpose(f.axes) * (p - center);
    x.Add(v.x / (v.z + distance));
    y.Add(v.y / (v.z + distance));
  }
  return center + (f.axes[0] * x.Middle() + f.axes[1] * y.Middle()) * distance;
}

}  // namespace

glm::dmat4 ViewMatrix(const Camera& c) { return glm::lookAtRH(c.eye, c.target, c.up); }

glm::dmat4 ProjectionMatrix(const Camera& c, double aspect) {
  return glm::perspectiveRH_ZO(glm::radians(c.fovY), aspect, c.zFar, c.zNear);
}

glm::dmat3 NormalMatrix(const glm::dmat3& m) {
  const glm::dmat3 n = glm::transpose(glm::inverse(m));
  if (std::isfinite(glm::dot(n[0], n[1]) + glm::dot(n[2], n[2]))) return n;
  return {glm::cross(m[1], m[2]), glm::cross(m[2], m[0]), glm::cross(m[0], m[1])};
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

Camera FramePoints(const std::vector<glm::dvec3>& points, double fovY, double aspect, double scale) {
  const glm::dvec3 forward = glm::normalize(glm::dvec3(0.62, -0.38, 0.80));
  const glm::dvec3 right = glm::normalize(glm::cross(forward, glm::dvec3(0, 1, 0)));
  const double tanY = std::tan(glm::radians(fovY) / 2) * 0.94;  // some air around
  const Frustum frustum{{right, glm::cross(right, forward), forward}, tanY * aspect, tanY};
  glm::dvec3 center = std::accumulate(points.begin(), points.end(), glm::dvec3(0)) / double(points.size());
  double distance = DistanceToShow(points, center, frustum);
  for (int i = 0; i < 8 && distance > 0; ++i) {
    center = Recenter(points, center, distance, frustum);
    distance = DistanceToShow(points, center, frustum);
  }
  if (distance <= 0) distance = scale;  // a single point
  Camera camera;
  camera.eye = center - forward * distance;
  camera.target = center;
  camera.fovY = fovY;
  camera.zNear = std::min(0.1 * scale, distance * 0.05);
  camera.zFar = 1000 * scale;
  return camera;
}

Camera FrameBounds(const Bounds& b, const std::vector<glm::dmat4>& placements, double fovY, double aspect) {
  std::vector<glm::dvec3> corners;
  for (const glm::dmat4& m : placements)
    for (int i = 0; i < 8; ++i) {
      const glm::dvec4 corner(i & 1 ? b.max.x : b.min.x, i & 2 ? b.max.y : b.min.y, i & 4 ? b.max.z : b.min.z, 1);
      corners.push_back(m * corner);
    }
  return FramePoints(corners, fovY, aspect, SceneScale(b));
}

Camera TurnCamera(const Camera& camera, double degrees) {
  Camera turned = camera;
  const glm::dmat4 turn = glm::rotate(glm::dmat4(1), glm::radians(degrees), camera.up);
  turned.eye = camera.target + glm::dvec3(turn * glm::dvec4(camera.eye - camera.target, 0));
  return turned;
}

}  // namespace fur

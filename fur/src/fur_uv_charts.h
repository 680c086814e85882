// The charts of a primitive, each as a small mesh of its own.
#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "fur/model.h"

namespace fur::furuv {

constexpr uint32_t kNone = ~0u;

using Triangle = std::array<uint32_t, 3>;

struct Chart {
  std::vector<glm::dvec3> positions;
  std::vector<glm::dvec2> modelUv;
  std::vector<Triangle> triangles;  // counter-clockwise seen from where most of the normals point
  std::vector<glm::dvec3> normals;  // sum over the primitive's vertices that are welded here, not unit
  double area = 0;                  // on the skin
};

struct Charts {
  std::vector<Chart> charts;
  // For each vertex of the primitive: its chart and its vertex in there; kNone where no triangle uses it.
  std::vector<uint32_t> chartOf, vertexOf;
};

Charts FindCharts(const Primitive&);

double AreaOf(const Chart&, const Triangle&);

// Twice the signed area.
inline double Cross(const glm::dvec2& a, const glm::dvec2& b) { return a.x * b.y - a.y * b.x; }
inline double SignedArea(const std::vector<glm::dvec2>& uv, const Triangle& t) {
  return Cross(uv[t[1]] - uv[t[0]], uv[t[2]] - uv[t[0]]) / 2;
}

}  // namespace fur::furuv

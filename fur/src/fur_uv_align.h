// Turns charts so that tangents agree across the seams.
#pragma once

#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "fur_uv_charts.h"

namespace fur::furuv {

// d(position)/du and /dv at a chart's vertex, averaged over the skin around it (where that folds, over the
// larger side); zero where it has no area.
struct Frame {
  glm::dvec3 du{0}, dv{0};
};
std::vector<Frame> FramesOf(const Chart&, const std::vector<glm::dvec2>& uv);

// Turns each chart's uv about the origin; `weld` is by position over the primitive's vertices.
void AlignCharts(const Primitive&, const Charts&, std::span<const uint32_t> weld,
                 std::vector<std::vector<glm::dvec2>>* uvs);

}  // namespace fur::furuv

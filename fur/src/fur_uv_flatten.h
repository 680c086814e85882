// Lays one chart flat, as rigidly as it goes.
#pragma once

#include <glm/glm.hpp>
#include <optional>
#include <vector>

#include "fur_uv_charts.h"

namespace fur::furuv {

struct Flat {
  std::vector<glm::dvec2> uv;  // for each vertex of the chart, in units of length
  uint32_t flipped = 0;        // triangles turned over
  double energy = 0;           // ARAP: the integral over the skin of |J - rotation|^2
  bool kept = false;           // the model's coordinates, only scaled (and mirrored)
};

Flat FlattenChart(const Chart&);

// Its first step alone, the local/global iterations from the model's UVs; empty where these have no area. What follows
// it repairs so much that only the step itself shows whether it is right.
std::optional<Flat> RelaxModelUv(const Chart&);

}  // namespace fur::furuv

// Texture coordinates for the fur alone. The model's own serve its pictures: they stretch, shear and mirror as the
// pictures need it, and a tile of strands mapped by them grows hair of uneven density. These lie on the same charts and
// keep lengths on the skin as well as a flat chart can.
#pragma once

#include <cmath>
#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "fur/model.h"

namespace fur {

// One entry for each vertex of the primitive; everything is finite.
struct FurUv {
  // In the primitive's units of length. Each chart starts at (0, 0), so charts overlap: for tiles, not for an atlas.
  std::vector<glm::dvec2> uv;
  std::vector<glm::dvec3> tangent;  // unit d(position)/du, perpendicular to the vertex's normal
  std::vector<float> handedness;    // +-1: bitangent = w cross(normal, tangent)
  uint32_t charts = 0;
  uint32_t keptCharts = 0;  // of these, how many have the model's coordinates, only scaled: closed ones always fold
};

// Corners at equal positions with equal model UVs are one; what hangs together then is a chart. Every chart has the
// area it has on the skin, handedness +1 but where it folds, and is turned so that tangents agree across seams as well
// as turning whole charts can make them; all together, u follows -z (an animal's tail in glTF) where the box is longest
// in z, -y (down) where in y, else +x. The same bytes on each run; positions times 2^k give uv times 2^k exactly.
// Method: Liu, Zhang, Xu, Gotsman, Gortler 2008, "A Local/Global Approach to Mesh Parameterization" (ARAP), then a
// descent that evens out the density and opens or avoids folds (fur/src/fur_uv_even.h).
FurUv MakeFurUv(const Primitive&);

// How evenly a map spreads hairs: area-weighted percentiles over the skin of the scale sqrt(|det J|), uv over skin.
struct UvSpread {
  double p5 = 0, median = 0, p95 = 0;
  uint32_t flipped = 0;  // triangles mirrored against most of the skin
  double Ratio() const { return p5 > 0 ? p95 / p5 : p95 > 0 ? HUGE_VAL : 1; }
};
// uv: one for each vertex. Triangles without area on the skin do not count.
UvSpread MeasureSpread(const Primitive&, std::span<const glm::dvec2> uv);

}  // namespace fur

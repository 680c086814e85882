// Strands drawn together in clumps: docs/fur.md, "Clumps", in double.
#pragma once

#include <glm/glm.hpp>

namespace fur::reference {

// What a point of the fur sees of the clump it lies in.
struct Clump {
  glm::dvec2 root{0};    // tiles: where the strand that came here has its root
  glm::dvec2 lean{0};    // of the strands in tangent space, for one unit along their axis
  double spread = 1;     // 1 / (1 - q): so much closer the strands stand, in u and in v
  double inside = 1;     // 0: that root belongs to another clump
};

// `clumping` 0..1. No clump is too small for a picture here.
Clump ClumpAt(const glm::dvec2& tiles, double height, double clumping);

}  // namespace fur::reference

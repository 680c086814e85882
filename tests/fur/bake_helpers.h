// What the tests of baking share.
#pragma once

#include <cmath>

#include "fur/bake.h"

namespace fur::test {

inline const uint8_t* Texel(const FurVolume& v, uint32_t x, uint32_t y, uint32_t layer) {
  return v.pixels.data() + ((size_t{layer} * v.height + y) * v.width + x) * 4;
}

inline double MeanCoverage(const FurVolume& v, uint32_t layer) {
  double sum = 0;
  for (uint32_t y = 0; y < v.height; ++y)
    for (uint32_t x = 0; x < v.width; ++x) sum += Texel(v, x, y, layer)[3] / 255.0;
  return sum / v.width / v.height;
}

inline glm::dvec3 Unpack(const uint8_t* rgba) { return glm::dvec3(rgba[0], rgba[1], rgba[2]) / 127.5 - 1.0; }

inline double OnGrid(double x) { return std::floor(x * 0x1p20) * 0x1p-20; }

// From the skin to `tip`, with one radius.
inline Strand Straight(glm::dvec2 root, glm::dvec3 tip, double radius) {
  return {
      StrandKind::Over, {OnGrid(root.x), OnGrid(root.y)}, {{glm::dvec3(0), radius, 0}, {tip, radius, 1}}, {1, 1, 1}};
}

// A coat of few strands, quick to bake.
inline CoatParams SmallCoat() {
  CoatParams p;
  p.size = 64, p.layers = 8, p.tile = 2;
  return p;
}

}  // namespace fur::test

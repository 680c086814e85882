// Noise for what is painted on bodies: the same bits on every machine.
#pragma once

#include <algorithm>
#include <glm/glm.hpp>

namespace fur {

// 0 at from and before, 1 at to and beyond, smooth; from > to runs the other way.
inline double Smooth(double t) {
  t = std::clamp(t, 0.0, 1.0);
  return t * t * (3 - 2 * t);
}
inline double Step(double from, double to, double x) { return Smooth((x - from) / (to - from)); }

inline double Hash(int x, int y, int z) {
  uint32_t h = uint32_t(x) * 0x9e3779b1u ^ uint32_t(y) * 0x85ebca77u ^ uint32_t(z) * 0xc2b2ae3du;
  h = (h ^ (h >> 15)) * 0x2c1b3c6du;
  h = (h ^ (h >> 12)) * 0x297a2d39u;
  return (h ^ (h >> 15)) * 0x1p-32;
}

// Value noise on a lattice, smooth, in -1..1; |p| below 2^30.
inline double Noise(const glm::dvec3& p) {
  const glm::dvec3 cell = glm::floor(p), f = p - cell, s = f * f * (3.0 - 2.0 * f);
  const int x = int(cell.x), y = int(cell.y), z = int(cell.z);
  const auto row = [&](int dy, int dz) { return glm::mix(Hash(x, y + dy, z + dz), Hash(x + 1, y + dy, z + dz), s.x); };
  return glm::mix(glm::mix(row(0, 0), row(1, 0), s.y), glm::mix(row(0, 1), row(1, 1), s.y), s.z) * 2 - 1;
}
inline double Turbulence(const glm::dvec3& p) { return (Noise(p) + 0.5 * Noise(p * 2.1)) / 1.5; }

}  // namespace fur

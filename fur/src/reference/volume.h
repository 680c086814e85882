// The fur's volume as a sampler reads it at mip 0: coverage, strands and tint, linear between texels and between slices.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "fur/model.h"

namespace fur::reference {

// Where a point lies among the texels and slices. All that is read at the point shares it.
struct VolumeCell {
  uint32_t texels[4] = {};   // (u0, v0), (u1, v0), (u0, v1), (u1, v1)
  double u = 0, v = 0;       // how far from the first
  uint32_t below = 0, above = 0;
  double part = 0;           // how far from `below`
};

class Volume {
 public:
  Volume(FurVolume, bool emptyTop);

  // `tiles` repeat; slice j is centred at (j + 1/2) / slices, clamped at the ends.
  VolumeCell CellOf(const glm::dvec2& tiles, double height) const {
    const TileCell u = TileAt(tiles.x, width_), v = TileAt(tiles.y, height_);
    const double z = std::clamp(height * slices_ - 0.5, 0.0, double(slices_ - 1));
    const auto below = uint32_t(z);
    const uint32_t low = v.first * width_, high = v.second * width_;
    return {{low + u.first, low + u.second, high + u.first, high + u.second}, u.fraction, v.fraction,
            below, std::min(below + 1, slices_ - 1), z - below};
  }
  // 0..1: rgb the packed strand, a the coverage.
  glm::dvec4 Strands(const VolumeCell& cell) const { return Read(columns_, cell); }
  glm::dvec3 Tint(const VolumeCell& cell) const { return glm::dvec3(Read(tint_, cell)); }
  bool HasTint() const { return !tint_.empty(); }
  uint32_t Slices() const { return slices_; }
  // Of a way through the volume, along its longer axis.
  double Texels(const glm::dvec2& tiles) const;

 private:
  struct TileCell {
    uint32_t first, second;
    double fraction;
  };
  static TileCell TileAt(double tiles, uint32_t size) {
    constexpr double kMost = 1e15;  // beyond, no texel can be told from the next
    const double x = std::clamp(tiles * size - 0.5, -kMost, kMost);
    auto cell = int64_t(x);
    cell -= double(cell) > x;
    const int64_t n = size, first = (size & (size - 1)) == 0 ? cell & (n - 1) : ((cell % n) + n) % n;
    return {uint32_t(first), first + 1 < n ? uint32_t(first + 1) : 0, x - double(cell)};
  }

  // A table: conversions cost twice as much, floats or doubles in memory its cache.
  static constexpr std::array<double, 256> kShares = [] {
    std::array<double, 256> shares{};
    for (size_t i = 0; i < 256; ++i) shares[i] = double(i) / 255;
    return shares;
  }();
  static glm::dvec4 Decoded(const uint8_t* p) { return {kShares[p[0]], kShares[p[1]], kShares[p[2]], kShares[p[3]]}; }
  glm::dvec4 Read(const std::vector<uint8_t>& columns, const VolumeCell& c) const {
    const double weights[4] = {(1 - c.u) * (1 - c.v), c.u * (1 - c.v), (1 - c.u) * c.v, c.u * c.v};
    glm::dvec4 low(0), high(0);
    for (int i = 0; i < 4; ++i) {
      const uint8_t* column = &columns[size_t{c.texels[i]} * slices_ * 4];
      low += Decoded(column + 4 * c.below) * weights[i];
      high += Decoded(column + 4 * c.above) * weights[i];
    }
    return low * (1 - c.part) + high * c.part;
  }

  uint32_t width_, height_, slices_;
  std::vector<uint8_t> columns_, tint_;  // rgba, the slices of a texel side by side
};

}  // namespace fur::reference

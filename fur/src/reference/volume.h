// The fur's volume as a sampler reads it at mip 0: coverage, strands and tint, linear between texels and between slices.
#pragma once

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
  VolumeCell CellOf(const glm::dvec2& tiles, double height) const;
  // 0..1: rgb the packed strand, a the coverage.
  glm::dvec4 Strands(const VolumeCell& cell) const { return Read(columns_, cell); }
  glm::dvec3 Tint(const VolumeCell& cell) const { return glm::dvec3(Read(tint_, cell)); }
  bool HasTint() const { return !tint_.empty(); }
  uint32_t Slices() const { return slices_; }
  // Of a way through the volume, along its longer axis.
  double Texels(const glm::dvec2& tiles) const;

 private:
  glm::dvec4 Read(const std::vector<uint8_t>& columns, const VolumeCell&) const;

  uint32_t width_, height_, slices_;
  std::vector<uint8_t> columns_, tint_;  // rgba, the slices of a texel side by side
};

}  // namespace fur::reference

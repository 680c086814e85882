#include "volume.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "texture.h"

namespace fur::reference {
namespace {

std::vector<uint8_t> Columns(const std::vector<uint8_t>& slices, uint32_t layers) {
  std::vector<uint8_t> columns(slices.size());
  const size_t texels = slices.size() / 4 / layers;
  for (size_t layer = 0; layer < layers; ++layer)
    for (size_t i = 0; i < texels; ++i)
      for (size_t c = 0; c < 4; ++c) columns[(i * layers + layer) * 4 + c] = slices[(layer * texels + i) * 4 + c];
  return columns;
}

constexpr auto kShares = [] {
  std::array<double, 256> shares{};
  for (size_t i = 0; i < 256; ++i) shares[i] = double(i) / 255;
  return shares;
}();

// A table: half of all reading happens here, and it costs half of what conversions do.
glm::dvec4 Decoded(const uint8_t* texel) {
  return {kShares[texel[0]], kShares[texel[1]], kShares[texel[2]], kShares[texel[3]]};
}

// Tiles repeat.
Cell TileAt(double tiles, uint32_t size) {
  const double x = tiles * size - 0.5;
  auto first = int64_t(x);
  first -= double(first) > x;
  const double fraction = x - double(first);
  const bool power = (size & (size - 1)) == 0;
  const int64_t n = size, x0 = power ? first & (n - 1) : ((first % n) + n) % n;
  return {uint32_t(x0), x0 + 1 < n ? uint32_t(x0 + 1) : 0, fraction};
}

}  // namespace

Volume::Volume(FurVolume volume, bool emptyTop) : width_(volume.width), height_(volume.height), slices_(volume.layers) {
  const size_t slice = size_t{4} * width_ * height_, top = slice * (slices_ - 1);
  if (emptyTop)
    for (size_t i = top + 3; i < volume.pixels.size(); i += 4) volume.pixels[i] = 0;
  // The emptied slice has no colours of its own.
  for (size_t i = top; top > 0 && i < volume.tint.size(); ++i) volume.tint[i] = volume.tint[i - slice];
  columns_ = Columns(volume.pixels, slices_);
  tint_ = Columns(volume.tint, slices_);
}

VolumeCell Volume::CellOf(const glm::dvec2& tiles, double h) const {
  const Cell u = TileAt(tiles.x, width_), v = TileAt(tiles.y, height_);
  const double z = std::clamp(h * slices_ - 0.5, 0.0, double(slices_ - 1));
  const auto below = uint32_t(z);
  const uint32_t low = v.x0 * width_, high = v.x1 * width_;
  return {{low + u.x0, low + u.x1, high + u.x0, high + u.x1}, u.fraction, v.fraction,
          below, std::min(below + 1, slices_ - 1), z - below};
}

glm::dvec4 Volume::Read(const std::vector<uint8_t>& columns, const VolumeCell& cell) const {
  const std::array<double, 4> weights{(1 - cell.u) * (1 - cell.v), cell.u * (1 - cell.v), (1 - cell.u) * cell.v,
                                      cell.u * cell.v};
  glm::dvec4 low(0), high(0);
  for (size_t i = 0; i < 4; ++i) {
    const uint8_t* p = &columns[size_t{cell.texels[i]} * slices_ * 4];
    low += Decoded(p + 4 * cell.below) * weights[i];
    high += Decoded(p + 4 * cell.above) * weights[i];
  }
  return low * (1 - cell.part) + high * cell.part;
}

double Volume::Texels(const glm::dvec2& tiles) const {
  return std::max(std::abs(tiles.x) * width_, std::abs(tiles.y) * height_);
}

}  // namespace fur::reference

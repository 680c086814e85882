#include "volume.h"

#include <cmath>

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

double Volume::Texels(const glm::dvec2& tiles) const {
  return std::max(std::abs(tiles.x) * width_, std::abs(tiles.y) * height_);
}

}  // namespace fur::reference

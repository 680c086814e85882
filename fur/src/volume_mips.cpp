#include "volume_mips.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace fur {
namespace {

// The rays that ask what is visible, beside the one straight down: texels of mip 0 that a ray moves sideways from one
// slice to the next. Straight down a hair hides its own lower part, aslant it does not, and one coverage has to serve
// both. Chosen by the error over shears 0, 2 and 8 (docs/measured.md).
constexpr std::array<int, 3> kSlantedShears = {1, 2, 8};

// What is left of one bundle of parallel rays when it comes down to a slice, for each texel of the slice.
struct Bundle {
  uint32_t shiftX = 0, shiftY = 0;  // towards the top, wrapped into the tile
  float weight = 1;
  std::vector<float> open;
};

uint32_t WrapShift(int shift, uint32_t size) {
  const int n = int(size);
  return uint32_t((shift % n + n) % n);
}

// Straight down, and each slanted shear along +-u and +-v; every shear counts alike.
std::vector<Bundle> MakeBundles(uint32_t width, uint32_t height) {
  const std::vector<float> all(size_t(width) * height, 1.0f);
  std::vector<Bundle> bundles{{0, 0, 1, all}};
  for (const int s : kSlantedShears)
    for (const auto& [x, y] : {std::pair{s, 0}, {-s, 0}, {0, s}, {0, -s}})
      bundles.push_back({WrapShift(x, width), WrapShift(y, height), 0.25f, all});
  return bundles;
}

// Takes the bundle through the slice to the texels of the slice below.
void Descend(Bundle* bundle, const uint8_t* rgba, float kept, uint32_t width, uint32_t height) {
  std::vector<float> below(bundle->open.size());
  for (uint32_t y = 0; y < height; ++y) {
    const size_t row = size_t(y + bundle->shiftY < height ? y + bundle->shiftY : y + bundle->shiftY - height) * width;
    for (uint32_t x = 0; x < width; ++x) {
      const size_t from = row + (x + bundle->shiftX < width ? x + bundle->shiftX : x + bundle->shiftX - width);
      below[size_t(y) * width + x] = bundle->open[from] * (1 - kept * float(rgba[from * 4 + 3]) / 255);
    }
  }
  bundle->open = std::move(below);
}

// Sums over the texels of mip 0 below one texel of a level. Levels come from sums: nothing is rounded twice.
struct Sums {
  double count = 0, visibility = 0, visibleCoverage = 0, coverage = 0;
  std::array<double, 3> color{}, coveredColor{};

  Sums& operator+=(const Sums& s) {
    count += s.count, visibility += s.visibility, visibleCoverage += s.visibleCoverage, coverage += s.coverage;
    for (size_t c = 0; c < 3; ++c) color[c] += s.color[c], coveredColor[c] += s.coveredColor[c];
    return *this;
  }
};

Sums TexelSums(const uint8_t* rgba, double visibility) {
  Sums s{1, visibility, visibility * rgba[3], double(rgba[3])};
  for (size_t c = 0; c < 3; ++c) s.color[c] = rgba[c], s.coveredColor[c] = double(rgba[c]) * rgba[3];
  return s;
}

void WriteTexel(const Sums& s, uint8_t* rgba) {
  for (size_t c = 0; c < 3; ++c)
    rgba[c] = uint8_t((s.coverage > 0 ? s.coveredColor[c] / s.coverage : s.color[c] / s.count) + 0.5);
  // Where nothing is visible from anywhere there is nothing to weigh with.
  const bool seen = s.visibility > 1e-6 * s.count;
  rgba[3] = uint8_t(std::min(255.0, (seen ? s.visibleCoverage / s.visibility : s.coverage / s.count) + 0.5));
}

// Halves with every texel counted: at an odd size the last box is three wide.
template <class Source>
std::vector<Sums> Halve(uint32_t width, uint32_t height, Source source) {
  const uint32_t w2 = std::max(1u, width / 2), h2 = std::max(1u, height / 2);
  std::vector<Sums> out(size_t(w2) * h2);
  for (uint32_t y = 0; y < height; ++y)
    for (uint32_t x = 0; x < width; ++x)
      out[size_t(std::min(y / 2, h2 - 1)) * w2 + std::min(x / 2, w2 - 1)] += source(size_t(y) * width + x);
  return out;
}

MipChain SliceMips(const uint8_t* rgba, const std::vector<float>& visibility, uint32_t width, uint32_t height) {
  MipChain levels{{rgba, rgba + size_t(width) * height * 4}};
  std::vector<Sums> sums;
  while (width > 1 || height > 1) {
    sums = levels.size() == 1 ? Halve(width, height, [&](size_t i) { return TexelSums(rgba + i * 4, visibility[i]); })
                              : Halve(width, height, [&](size_t i) -> const Sums& { return sums[i]; });
    std::vector<uint8_t>& level = levels.emplace_back(sums.size() * 4);
    for (size_t i = 0; i < sums.size(); ++i) WriteTexel(sums[i], &level[i * 4]);
    width = std::max(1u, width / 2);
    height = std::max(1u, height / 2);
  }
  return levels;
}

}  // namespace

std::vector<MipChain> MakeVolumeMips(const FurVolume& volume, double heightFalloff) {
  const size_t texels = size_t(volume.width) * volume.height;
  std::vector<MipChain> slices(volume.layers);
  std::vector<Bundle> bundles = MakeBundles(volume.width, volume.height);
  for (uint32_t j = volume.layers; j-- > 0;) {
    const uint8_t* rgba = &volume.pixels[j * texels * 4];
    std::vector<float> visibility(texels);
    for (const Bundle& b : bundles)
      for (size_t i = 0; i < texels; ++i) visibility[i] += b.weight * b.open[i];
    slices[j] = SliceMips(rgba, visibility, volume.width, volume.height);
    const float kept = float(1 - heightFalloff * j / volume.layers);
    for (Bundle& b : bundles) Descend(&b, rgba, kept, volume.width, volume.height);
  }
  return slices;
}

}  // namespace fur

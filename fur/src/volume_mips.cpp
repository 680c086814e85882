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
  std::array<double, 4> color{}, coveredColor{};

  Sums& operator+=(const Sums& s) {
    count += s.count, visibility += s.visibility, visibleCoverage += s.visibleCoverage, coverage += s.coverage;
    for (size_t c = 0; c < 4; ++c) color[c] += s.color[c], coveredColor[c] += s.coveredColor[c];
    return *this;
  }
  // Weighted by coverage; the plain mean where nothing is covered.
  uint8_t MeanOf(size_t channel) const {
    return uint8_t((coverage > 0 ? coveredColor[channel] / coverage : color[channel] / count) + 0.5);
  }
};

Sums TexelSums(const uint8_t* rgba, double coverage, double visibility) {
  Sums s{1, visibility, visibility * coverage, coverage};
  for (size_t c = 0; c < 4; ++c) s.color[c] = rgba[c], s.coveredColor[c] = rgba[c] * coverage;
  return s;
}

void WriteVolumeTexel(const Sums& s, uint8_t* rgba) {
  for (size_t c = 0; c < 3; ++c) rgba[c] = s.MeanOf(c);
  // Where nothing is visible from anywhere there is nothing to weigh with.
  const bool seen = s.visibility > 1e-6 * s.count;
  rgba[3] = uint8_t(std::min(255.0, (seen ? s.visibleCoverage / s.visibility : s.coverage / s.count) + 0.5));
}

void WriteTintTexel(const Sums& s, uint8_t* rgba) {
  for (size_t c = 0; c < 4; ++c) rgba[c] = s.MeanOf(c);
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

// `source`: the Sums of a texel of `rgba`; `write`: a texel of the level from its Sums.
template <class Source, class Write>
MipChain SliceMips(const uint8_t* rgba, uint32_t width, uint32_t height, Source source, Write write) {
  MipChain levels{{rgba, rgba + size_t(width) * height * 4}};
  std::vector<Sums> sums;
  while (width > 1 || height > 1) {
    sums = levels.size() == 1 ? Halve(width, height, source)
                              : Halve(width, height, [&](size_t i) -> const Sums& { return sums[i]; });
    std::vector<uint8_t>& level = levels.emplace_back(sums.size() * 4);
    for (size_t i = 0; i < sums.size(); ++i) write(sums[i], &level[i * 4]);
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
    const auto source = [&](size_t i) { return TexelSums(rgba + i * 4, rgba[i * 4 + 3], double(visibility[i])); };
    slices[j] = SliceMips(rgba, volume.width, volume.height, source, WriteVolumeTexel);
    const float kept = float(1 - heightFalloff * j / volume.layers);
    for (Bundle& b : bundles) Descend(&b, rgba, kept, volume.width, volume.height);
  }
  return slices;
}

std::vector<MipChain> MakeTintMips(const FurVolume& volume) {
  const size_t bytes = size_t(volume.width) * volume.height * 4;
  std::vector<MipChain> slices;
  for (size_t j = 0; j < volume.layers; ++j) {
    const uint8_t *tint = &volume.tint[j * bytes], *rgba = &volume.pixels[j * bytes];
    const auto source = [&](size_t i) { return TexelSums(tint + i * 4, rgba[i * 4 + 3], 1); };
    slices.push_back(SliceMips(tint, volume.width, volume.height, source, WriteTintTexel));
  }
  return slices;
}

namespace {

// Slab i of `shells`, in slices of which slice j has its middle at j.
struct Slab {
  Slab(uint32_t i, uint32_t shells, size_t slices)
      : first(double(i) / shells * double(slices) - 0.5), size(double(slices) / shells), last(double(slices) - 1) {}
  double At(double share) const { return std::clamp(first + share * size, 0.0, last); }
  double first, size, last;
};

double Between(const std::vector<MipChain>& slices, double z, size_t level, size_t byte) {
  const auto below = size_t(z);
  const double lower = slices[below][level][byte], upper = slices[std::min(below + 1, slices.size() - 1)][level][byte];
  return lower + (upper - lower) * (z - double(below));
}

constexpr double kMostCoverage = 0.999;  // fur_shade.hlsli

}  // namespace

std::vector<MipChain> SlicesAtShells(const std::vector<MipChain>& slices, uint32_t shells) {
  std::vector<MipChain> out;
  for (uint32_t i = 0; i < shells; ++i) {
    const double middle = Slab(i, shells, slices.size()).At(0.5);
    MipChain& levels = out.emplace_back(slices[0]);
    for (size_t level = 0; level < levels.size(); ++level)
      for (size_t b = 0; b < levels[level].size(); ++b)
        // Halves to even: at N0 / N = 2 every second value is one, and rounding all of them up would thicken the fur.
        levels[level][b] = uint8_t(std::nearbyint(Between(slices, middle, level, b)));
  }
  return out;
}

std::vector<MipChain> VolumeAtShells(const std::vector<MipChain>& slices, uint32_t shells, double heightFalloff) {
  const auto kept = [&](double z) { return 1 - heightFalloff * z / double(slices.size()); };
  std::vector<MipChain> out = SlicesAtShells(slices, shells);
  for (uint32_t i = 0; i < shells; ++i) {
    const Slab slab(i, shells, slices.size());
    const int steps = kStepsOfASlice * int(std::ceil(slab.size));
    for (size_t level = 0; level < out[i].size(); ++level)
      for (size_t b = 3; b < out[i][level].size(); b += 4) {
        double depth = 0;
        for (int k = 0; k < steps; ++k) {
          const double z = slab.At((k + 0.5) / steps);
          depth -= std::log1p(-std::min(Between(slices, z, level, b) / 255 * kept(z), kMostCoverage));
        }
        const double coverage = -std::expm1(-depth / steps) / kept(slab.At(0.5));
        out[i][level][b] = uint8_t(std::nearbyint(std::min(coverage, 1.0) * 255));
      }
  }
  return out;
}

}  // namespace fur

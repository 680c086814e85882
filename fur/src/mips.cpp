#include "mips.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace fur {
namespace {

using Texel = std::array<double, 4>;

const std::array<double, 256>& DecodeTable() {
  static const std::array<double, 256> table = [] {
    std::array<double, 256> t{};
    for (int i = 0; i < 256; ++i) t[size_t(i)] = SrgbToLinear(i / 255.0);
    return t;
  }();
  return table;
}

uint8_t ToByte(double v) { return uint8_t(std::clamp(v * 255 + 0.5, 0.0, 255.0)); }

Texel Read(const uint8_t* p, MipFilter filter) {
  Texel t{p[0] / 255.0, p[1] / 255.0, p[2] / 255.0, p[3] / 255.0};
  if (filter == MipFilter::Srgb)
    for (size_t c = 0; c < 3; ++c) t[c] = DecodeTable()[p[c]];
  return t;
}

Texel Average(const std::array<Texel, 4>& in) {
  Texel mean{};
  for (const Texel& t : in)
    for (size_t c = 0; c < 4; ++c) mean[c] += t[c] / 4;
  return mean;
}

void Write(const Texel& t, MipFilter filter, uint8_t* p) {
  for (size_t c = 0; c < 3; ++c) p[c] = ToByte(filter == MipFilter::Srgb ? LinearToSrgb(t[c]) : t[c]);
  p[3] = ToByte(t[3]);
}

std::vector<uint8_t> Halve(std::span<const uint8_t> in, uint32_t w, uint32_t h, MipFilter filter) {
  const uint32_t w2 = std::max(1u, w / 2), h2 = std::max(1u, h / 2);
  std::vector<uint8_t> out(size_t(w2) * h2 * 4);
  for (uint32_t y = 0; y < h2; ++y)
    for (uint32_t x = 0; x < w2; ++x) {
      std::array<Texel, 4> box;
      for (uint32_t k = 0; k < 4; ++k) {
        const uint32_t sx = std::min(2 * x + (k & 1), w - 1), sy = std::min(2 * y + (k >> 1), h - 1);
        box[k] = Read(&in[(size_t(sy) * w + sx) * 4], filter);
      }
      Write(Average(box), filter, &out[(size_t(y) * w2 + x) * 4]);
    }
  return out;
}

}  // namespace

double SrgbToLinear(double e) { return e <= 0.04045 ? e / 12.92 : std::pow((e + 0.055) / 1.055, 2.4); }
double LinearToSrgb(double l) { return l <= 0.0031308 ? l * 12.92 : 1.055 * std::pow(l, 1 / 2.4) - 0.055; }

MipChain MakeMips(std::span<const uint8_t> rgba, uint32_t width, uint32_t height, MipFilter filter) {
  MipChain levels{{rgba.begin(), rgba.end()}};
  while (width > 1 || height > 1) {
    levels.push_back(Halve(levels.back(), width, height, filter));
    width = std::max(1u, width / 2);
    height = std::max(1u, height / 2);
  }
  return levels;
}

}  // namespace fur

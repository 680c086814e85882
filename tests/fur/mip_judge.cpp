// The truth: the mean over a texel's footprint of what rays through the mip 0 stack meet.
#include <algorithm>
#include <cmath>

#include "mip_laws.h"

namespace fur::test {
namespace {

template <class Coverage>
void Trace(uint32_t layers, double share, Coverage coverage, Profile* sum) {
  double open = share;
  for (uint32_t j = layers; j-- > 0;) {
    const double a = coverage(j);
    sum->weights[j] += open * a;
    open *= 1 - a;
  }
  sum->transmittance += open;
}

std::vector<Profile> Empty(const Stack& s, uint32_t width, uint32_t height) {
  return std::vector<Profile>(size_t(width) * height, Profile{0, std::vector<double>(s.layers)});
}

}  // namespace

double Stack::Wrapped(int x, int y, uint32_t layer) const {
  const int w = int(width), h = int(height);
  return coverage[Index(uint32_t(((x % w) + w) % w), uint32_t(((y % h) + h) % h), layer)];
}

double Stack::Bilinear(double x, double y, uint32_t layer) const {
  const double fx = x - std::floor(x), fy = y - std::floor(y);
  const int ix = int(std::floor(x)), iy = int(std::floor(y));
  double sum = (1 - fx) * (1 - fy) * Wrapped(ix, iy, layer);
  if (fx > 0) sum += fx * (1 - fy) * Wrapped(ix + 1, iy, layer);
  if (fy > 0) sum += (1 - fx) * fy * Wrapped(ix, iy + 1, layer);
  if (fx > 0 && fy > 0) sum += fx * fy * Wrapped(ix + 1, iy + 1, layer);
  return sum;
}

Stack CompositedStack(const FurVolume& v, double falloff) {
  Stack s(v.width, v.height, v.layers);
  const size_t texels = size_t(v.width) * v.height;
  for (size_t i = 0; i < s.coverage.size(); ++i)
    s.coverage[i] = v.pixels[i * 4 + 3] / 255.0 * (1 - falloff * double(i / texels) / v.layers);
  return s;
}

Stack Quantized(Stack s, double falloff) {
  const size_t texels = size_t(s.width) * s.height;
  for (size_t i = 0; i < s.coverage.size(); ++i) {
    const double kept = 1 - falloff * double(i / texels) / s.layers;
    s.coverage[i] = std::floor(std::clamp(s.coverage[i] / kept, 0.0, 1.0) * 255 + 0.5) / 255 * kept;
  }
  return s;
}

std::vector<Shear> Turned(double s) {
  if (s == 0) return {{0, 0}};
  return {{s, 0}, {-s, 0}, {0, s}, {0, -s}};
}

std::vector<Profile> TrueProfiles(const Stack& s, uint32_t level, Shear shear) {
  const uint32_t width = s.width >> level, height = s.height >> level;
  const double share = 1.0 / double(1u << (2 * level));
  std::vector<Profile> out = Empty(s, width, height);
  for (uint32_t y = 0; y < height << level; ++y)
    for (uint32_t x = 0; x < width << level; ++x)
      Trace(
          s.layers, share, [&](uint32_t j) { return s.Bilinear(x + shear.x * j, y + shear.y * j, j); },
          &out[size_t(y >> level) * width + (x >> level)]);
  return out;
}

std::vector<Profile> MipProfiles(const Stack& s, uint32_t level, Shear shear) {
  std::vector<Profile> out = Empty(s, s.width, s.height);
  const double dx = double(shear.x) / double(1u << level), dy = double(shear.y) / double(1u << level);
  for (uint32_t y = 0; y < s.height; ++y)
    for (uint32_t x = 0; x < s.width; ++x)
      Trace(
          s.layers, 1, [&](uint32_t j) { return s.Bilinear(x + dx * j, y + dy * j, j); },
          &out[size_t(y) * s.width + x]);
  return out;
}

}  // namespace fur::test

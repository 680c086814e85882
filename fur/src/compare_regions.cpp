#include <algorithm>
#include <cmath>

#include "compare_internal.h"

namespace fur {
namespace {

// As floats, like the opacities: 1/255 of a PNG is not above it.
constexpr float kLeastOpacity = 1.0f / 255, kOpaque = 1 - 1e-4f;

// One direction of Dilate, over `count` values `step` apart.
void DilateLine(const uint8_t* in, size_t count, size_t step, size_t radius, uint8_t* out) {
  size_t reach = 0;  // one past the last position that a pixel inside reaches
  for (size_t i = 0; i < std::min(radius, count); ++i)
    if (in[i * step]) reach = i + radius + 1;
  for (size_t i = 0; i < count; ++i) {
    if (i + radius < count && in[(i + radius) * step]) reach = i + 2 * radius + 1;
    out[i * step] = i < reach;
  }
}

}  // namespace

std::vector<uint8_t> FurPixels(const Plane& opacity) {
  std::vector<uint8_t> inside(opacity.values.size());
  for (size_t i = 0; i < inside.size(); ++i) {
    const float a = opacity.values[i];
    inside[i] = a > kLeastOpacity || !std::isfinite(a);
  }
  return inside;
}

std::vector<uint8_t> TranslucentPixels(const Plane& opacity) {
  std::vector<uint8_t> inside(opacity.values.size());
  for (size_t i = 0; i < inside.size(); ++i)
    inside[i] = opacity.values[i] > kLeastOpacity && opacity.values[i] < kOpaque;
  return inside;
}

std::vector<uint8_t> Dilate(const std::vector<uint8_t>& inside, uint32_t width, uint32_t height, uint32_t radius) {
  std::vector<uint8_t> rows(inside.size()), out(inside.size());
  for (size_t y = 0; y < height; ++y) DilateLine(&inside[y * width], width, 1, radius, &rows[y * width]);
  for (size_t x = 0; x < width; ++x) DilateLine(&rows[x], height, width, radius, &out[x]);
  return out;
}

double Percentile(std::span<const float> sorted, double share) {
  const double rank = std::ceil(share * double(sorted.size()));
  return double(sorted[size_t(std::clamp(rank - 1, 0.0, double(sorted.size() - 1)))]);
}

double WeightedPercentile(std::span<const float> sorted, double share) {
  double total = 0, sum = 0;
  for (const float v : sorted) total += double(v);
  for (const float v : sorted) {
    sum += double(v);
    if (sum >= share * total) return double(v);
  }
  return double(sorted.back());
}

}  // namespace fur

#include <algorithm>

#include "compare_internal.h"

namespace fur {
namespace {

// One weight after the other over a whole row: the compiler makes vectors of it.
void AddScaled(const float* in, float weight, uint32_t count, float* out) {
  for (uint32_t i = 0; i < count; ++i) out[i] += weight * in[i];
}

}  // namespace

Plane FilterRows(const Plane& in, const Kernel& kernel) {
  const size_t radius = kernel.size() / 2, width = in.width;
  Plane out{in.width, in.height, std::vector<float>(in.values.size(), 0.0f)};
  std::vector<float> padded(width + 2 * radius);
  for (size_t y = 0; y < in.height; ++y) {
    const float* row = &in.values[y * width];
    std::fill_n(padded.begin(), radius, row[0]);
    std::copy_n(row, width, padded.begin() + std::ptrdiff_t(radius));
    std::fill_n(padded.begin() + std::ptrdiff_t(radius + width), radius, row[width - 1]);
    for (size_t t = 0; t < kernel.size(); ++t) AddScaled(&padded[t], kernel[t], in.width, &out.values[y * width]);
  }
  return out;
}

Plane FilterColumns(const Plane& in, const Kernel& kernel) {
  const auto radius = std::ptrdiff_t(kernel.size() / 2), last = std::ptrdiff_t(in.height) - 1;
  Plane out{in.width, in.height, std::vector<float>(in.values.size(), 0.0f)};
  for (std::ptrdiff_t y = 0; y <= last; ++y)
    for (std::ptrdiff_t t = 0; t < std::ptrdiff_t(kernel.size()); ++t) {
      const auto from = size_t(std::clamp<std::ptrdiff_t>(y + t - radius, 0, last));
      AddScaled(&in.values[from * in.width], kernel[size_t(t)], in.width, &out.values[size_t(y) * in.width]);
    }
  return out;
}

}  // namespace fur

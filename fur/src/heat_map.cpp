#include <algorithm>
#include <array>
#include <cmath>

#include "fur/compare.h"

namespace fur {
namespace {

// Nine equidistant colours of magma (van der Walt and Smith, matplotlib 1.5, dedicated to the public domain by CC0);
// linear in between, which stays within a few steps of the original's 256.
constexpr std::array<std::array<int, 3>, 9> kMagma{{{0, 0, 4},
                                                    {29, 17, 71},
                                                    {81, 18, 124},
                                                    {130, 38, 129},
                                                    {182, 54, 121},
                                                    {230, 81, 100},
                                                    {251, 136, 97},
                                                    {254, 194, 135},
                                                    {252, 253, 191}}};

}  // namespace

std::vector<uint8_t> HeatMap(const Plane& map, double scale) {
  std::vector<uint8_t> rgba;
  rgba.reserve(map.values.size() * 4);
  for (const float value : map.values) {
    const double at = std::clamp(double(value) * scale, 0.0, 1.0) * double(kMagma.size() - 1);
    const size_t low = std::min(size_t(at), kMagma.size() - 2);
    const double t = at - double(low);
    for (size_t c = 0; c < 3; ++c)
      rgba.push_back(uint8_t(std::lround((1 - t) * kMagma[low][c] + t * kMagma[low + 1][c])));
    rgba.push_back(255);
  }
  return rgba;
}

}  // namespace fur

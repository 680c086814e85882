#include "pixel_samples.h"

#include <bit>

#include "random.h"

namespace fur::reference {
namespace {

uint64_t PixelSeed(uint64_t seed, uint32_t x, uint32_t y) {
  // SplitMix64's finaliser (Steele, Lea, Flood 2014).
  uint64_t z = seed * 0x9E3779B97F4A7C15u + ((uint64_t{y} << 32) | x);
  z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9u;
  z = (z ^ (z >> 27)) * 0x94D049BB133111EBu;
  return z ^ (z >> 31);
}

// The sequence's two coordinates, first bit on top: by the identity matrix and by Pascal's triangle modulo 2 (T. Kollig and
// A. Keller, "Efficient Multidimensional Sampling", 2002).
uint32_t Coordinate(uint32_t index, int dimension) {
  uint32_t bits = 0;
  for (uint32_t column = 1u << 31; index > 0; index >>= 1, column = dimension == 0 ? column >> 1 : column ^ (column >> 1))
    if (index & 1) bits ^= column;
  return bits;
}

}  // namespace

PixelSamples::PixelSamples(uint32_t count)
    : count_(count), levels_(uint32_t(std::bit_width(count - 1))), flips_((size_t{1} << levels_) / 32 + 1), points_(count) {}

// Below the last level each point has its part of the interval to itself, where a scrambled tree is a uniform number.
const std::vector<glm::dvec2>& PixelSamples::Of(uint64_t seed, uint32_t x, uint32_t y) {
  Pcg32 random(PixelSeed(seed, x, y));
  const double cell = 1.0 / (uint64_t{1} << levels_);
  for (int dimension = 0; dimension < 2; ++dimension) {
    for (uint32_t& word : flips_) word = random.Next();
    for (uint32_t i = 0; i < count_; ++i) {
      const uint64_t bits = Coordinate(i, dimension);
      uint32_t scrambled = 0;
      for (uint32_t level = 0; level < levels_; ++level) {
        const uint32_t node = (1u << level) | uint32_t(bits >> (32 - level));
        const uint32_t flip = flips_[node / 32] >> (node % 32) & 1;
        scrambled = scrambled << 1 | ((uint32_t(bits >> (31 - level)) & 1) ^ flip);
      }
      points_[i][dimension] = (scrambled + random.Uniform()) * cell;
    }
  }
  return points_;
}

}  // namespace fur::reference

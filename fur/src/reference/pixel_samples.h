// Where the rays of a pixel go through it.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

namespace fur::reference {

// The first points of Sobol's (0,2)-sequence (I. M. Sobol', USSR Comput. Math. Math. Phys. 7, 1967) under Owen's nested
// uniform scrambling (A. Owen, "Randomly Permuted (t,m,s)-Nets and (t,s)-Sequences", 1995): of 2^m points one lies in each of
// the 2^m boxes 2^-a wide and 2^-(m-a) high, for every a, each is uniform, and smooth pictures' errors fall with N^-3/2.
class PixelSamples {
 public:
  explicit PixelSamples(uint32_t count);
  uint32_t Count() const { return count_; }
  // Points in [0, 1)^2 of the pixel, the same whoever asks; valid until the next call.
  const std::vector<glm::dvec2>& Of(uint64_t seed, uint32_t x, uint32_t y);

 private:
  uint32_t count_, levels_;
  std::vector<uint32_t> flips_;  // a bit for each node of a coordinate's binary tree: does it swap its halves?
  std::vector<glm::dvec2> points_;
};

}  // namespace fur::reference

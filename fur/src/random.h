// Random numbers that are the same on every machine (the standard's distributions are not).
#pragma once

#include <cstdint>

namespace fur {

// PCG-XSH-RR 64/32: O'Neill, "PCG: A Family of Simple Fast Space-Efficient Statistically Good Algorithms for Random
// Number Generation", Harvey Mudd College HMC-CS-2014-0905, section 6.3.1; multiplier of section 7, stream 54.
class Pcg32 {
 public:
  explicit Pcg32(uint64_t seed) {
    Next();
    state_ += seed;
    Next();
  }
  uint32_t Next() {
    const uint64_t old = state_;
    state_ = old * 6364136223846793005ull + ((54u << 1u) | 1u);
    const auto xorShifted = static_cast<uint32_t>(((old >> 18u) ^ old) >> 27u);
    const auto rot = static_cast<uint32_t>(old >> 59u);
    return (xorShifted >> rot) | (xorShifted << ((32u - rot) & 31u));
  }
  // Uniform in [0, 1).
  double Uniform() { return Next() * 0x1p-32; }
  // Nearly normal, mean 0, deviation 1, never beyond 3.47: the sum of four uniforms, scaled (Irwin-Hall).
  double Bell() {
    const double sum = Uniform() + Uniform() + Uniform() + Uniform();
    return (sum - 2) * 1.7320508075688772;
  }

 private:
  uint64_t state_ = 0;
};

}  // namespace fur

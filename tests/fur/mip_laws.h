// Candidate laws for the mips of a fur volume, and the truth that judges them.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "fur/model.h"

namespace fur::test {

// Coverage as it is composited, slice 0 at the root. Tiles.
struct Stack {
  uint32_t width = 0, height = 0, layers = 0;
  std::vector<double> coverage;  // width * height * layers

  Stack() = default;
  Stack(uint32_t w, uint32_t h, uint32_t n) : width(w), height(h), layers(n), coverage(size_t(w) * h * n) {}
  size_t Index(uint32_t x, uint32_t y, uint32_t layer) const { return (size_t(layer) * height + y) * width + x; }
  double Wrapped(int x, int y, uint32_t layer) const;
  double Bilinear(double x, double y, uint32_t layer) const;  // in texels, texel 0's centre at 0
};

// The volume's coverage times what the shader takes off with height, 1 - falloff j / layers.
Stack CompositedStack(const FurVolume&, double falloff);

// Texels of mip 0 that a ray moves sideways from one slice to the next, towards the top.
struct Shear {
  double x = 0, y = 0;
};
std::vector<Shear> Turned(double shear);  // along +-u and +-v; {0, 0} alone for no shear

// What a ray meets on its way down to each slice: weights[j] = a_j prod_{k>j} (1 - a_k); transmittance = prod (1 - a).
struct Profile {
  double transmittance = 1;
  std::vector<double> weights;
};

// Rays enter the root slice at the centres of level's texels; from mip 0, the mean over the texel's footprint.
std::vector<Profile> TrueProfiles(const Stack& mip0, uint32_t level, Shear);
std::vector<Profile> MipProfiles(const Stack& mip, uint32_t level, Shear);

struct MipLaw {
  std::string name;
  std::function<Stack(const Stack& mip0, uint32_t level)> make;  // coverage as composited, not yet quantised
};
std::vector<MipLaw> CandidateLaws();
Stack CumulativeMip(const Stack& mip0, uint32_t level);  // the stack-aware law, exact at shear 0

// Coverage rounded to the bytes that a texture holds, before the falloff is applied.
Stack Quantized(Stack, double falloff);

}  // namespace fur::test

// Mip chains made on the CPU, so that every backend samples the same texels.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace fur {

enum class MipFilter {
  Raw,   // box over stored values, as the published demo's driver-made mips
  Srgb,  // rgb averaged in linear light, alpha stored
};

// RGBA8: level 0 and all further levels down to 1x1.
using MipChain = std::vector<std::vector<uint8_t>>;

MipChain MakeMips(std::span<const uint8_t> rgba, uint32_t width, uint32_t height, MipFilter);

double SrgbToLinear(double encoded);  // IEC 61966-2-1, 0..1
double LinearToSrgb(double linear);

}  // namespace fur

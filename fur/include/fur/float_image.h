// Pictures of floats.
#pragma once

#include <cstdint>
#include <glm/vec4.hpp>
#include <vector>

namespace fur {

// Row 0 on top, tightly packed.
struct FloatImage {
  uint32_t width = 0, height = 0;
  std::vector<glm::vec4> pixels;
};

// Decodes sRGB-encoded rgb (IEC 61966-2-1), also beyond 1; alpha stays.
void DecodeSrgb(FloatImage* image);
// The other way, of values clamped to 0..1.
void EncodeSrgb(FloatImage* image);

// RGBA8 of rgb clamped to 0..1 and rounded, as it is; alpha 255.
std::vector<uint8_t> ToBytes(const FloatImage& image);

// The means of squares of `factor` pixels, which divides both sides: a box filter.
FloatImage Reduced(const FloatImage& image, uint32_t factor);

// One number for each pixel; row 0 on top.
struct Plane {
  uint32_t width = 0, height = 0;
  std::vector<float> values;
};

}  // namespace fur

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

// One number for each pixel; row 0 on top.
struct Plane {
  uint32_t width = 0, height = 0;
  std::vector<float> values;
};

}  // namespace fur

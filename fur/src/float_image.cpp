#include "fur/float_image.h"

#include <algorithm>
#include <cmath>

#include "mips.h"

namespace fur {

void DecodeSrgb(FloatImage* image) {
  for (glm::vec4& p : image->pixels)
    for (int c = 0; c < 3; ++c) p[c] = float(SrgbToLinear(double(p[c])));
}

void EncodeSrgb(FloatImage* image) {
  for (glm::vec4& p : image->pixels)
    for (int c = 0; c < 3; ++c) p[c] = float(LinearToSrgb(std::clamp(double(p[c]), 0.0, 1.0)));
}

std::vector<uint8_t> ToBytes(const FloatImage& image) {
  std::vector<uint8_t> bytes;
  bytes.reserve(image.pixels.size() * 4);
  for (const glm::vec4& p : image.pixels) {
    for (int c = 0; c < 3; ++c) bytes.push_back(uint8_t(std::lround(std::clamp(p[c], 0.0f, 1.0f) * 255)));
    bytes.push_back(255);
  }
  return bytes;
}

}  // namespace fur

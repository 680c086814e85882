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

FloatImage Reduced(const FloatImage& image, uint32_t factor) {
  FloatImage out{image.width / factor, image.height / factor, {}};
  out.pixels.resize(size_t{out.width} * out.height, glm::vec4(0));
  const float share = 1 / float(factor * factor);
  for (uint32_t y = 0; y < out.height * factor; ++y)
    for (uint32_t x = 0; x < out.width * factor; ++x)
      out.pixels[size_t{y / factor} * out.width + x / factor] += image.pixels[size_t{y} * image.width + x] * share;
  return out;
}

}  // namespace fur

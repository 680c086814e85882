#include "image.h"

#include <algorithm>

namespace rhi_test {

Difference Compare(const Image& a, const Image& b) {
  Difference d;
  d.sameShape =
      a.width == b.width && a.height == b.height && a.texelBytes == b.texelBytes && a.bytes.size() == b.bytes.size();
  if (!d.sameShape) return d;
  for (uint32_t y = 0; y < a.height; ++y)
    for (uint32_t x = 0; x < a.width; ++x) {
      const size_t at = (size_t(y) * a.width + x) * a.texelBytes;
      if (std::equal(&a.bytes[at], &a.bytes[at] + a.texelBytes, &b.bytes[at])) continue;
      if (d.pixels++ == 0) d.x = x, d.y = y;
    }
  return d;
}

testing::AssertionResult SameImage(const Image& a, const Image& b) {
  const Difference d = Compare(a, b);
  if (!d.sameShape)
    return testing::AssertionFailure() << "pictures of different shape: " << a.width << " x " << a.height << " x "
                                       << a.texelBytes << " and " << b.width << " x " << b.height << " x "
                                       << b.texelBytes;
  if (d.pixels == 0) return testing::AssertionSuccess();
  const size_t at = (size_t(d.y) * a.width + d.x) * a.texelBytes;
  auto result = testing::AssertionFailure();
  result << d.pixels << " of " << a.width * a.height << " pixels differ, the first at " << d.x << ", " << d.y << ":";
  for (uint32_t i = 0; i < a.texelBytes; ++i) result << ' ' << +a.bytes[at + i] << '/' << +b.bytes[at + i];
  return result;
}

uint8_t ToUnorm8(double value) {
  if (!(value > 0)) return 0;
  return uint8_t(std::min(value, 1.0) * 255 + 0.5);
}

double SrgbToLinear(double v) { return v <= 0.04045 ? v / 12.92 : std::pow((v + 0.055) / 1.055, 2.4); }
double LinearToSrgb(double v) { return v <= 0.0031308 ? v * 12.92 : 1.055 * std::pow(v, 1 / 2.4) - 0.055; }

}  // namespace rhi_test

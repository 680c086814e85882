#include "image.h"

#include <algorithm>

namespace rhi_test {

uint8_t ToUnorm8(double value) {
  if (!(value > 0)) return 0;
  return uint8_t(std::min(value, 1.0) * 255 + 0.5);
}

double SrgbToLinear(double v) { return v <= 0.04045 ? v / 12.92 : std::pow((v + 0.055) / 1.055, 2.4); }
double LinearToSrgb(double v) { return v <= 0.0031308 ? v * 12.92 : 1.055 * std::pow(v, 1 / 2.4) - 0.055; }

}  // namespace rhi_test

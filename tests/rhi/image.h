// Pictures that were read back, and comparisons of them: exact unless the caller states a tolerance.
#pragma once

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <sstream>
#include <vector>

#include "rhi/types.h"

namespace rhi_test {

using Rgba8 = std::array<uint8_t, 4>;
using Rgba32F = std::array<float, 4>;

struct Image {
  uint32_t width = 0, height = 0, texelBytes = 0;
  std::vector<uint8_t> bytes;  // tightly packed, row 0 on top

  template <class Texel>
  Texel At(uint32_t x, uint32_t y) const {
    Texel t;
    std::memcpy(&t, bytes.data() + (size_t(y) * width + x) * texelBytes, sizeof t);
    return t;
  }
};

struct Difference {
  uint64_t pixels = 0;    // that differ in any byte
  uint32_t x = 0, y = 0;  // the first of them
  bool sameShape = true;
};
Difference Compare(const Image& a, const Image& b);

// Succeeds when the pictures agree in every byte.
testing::AssertionResult SameImage(const Image& a, const Image& b);

template <class T, size_t N>
std::string Text(const std::array<T, N>& texel) {
  std::ostringstream out;
  out << '(';
  for (size_t i = 0; i < N; ++i) out << (i ? ", " : "") << +texel[i];
  out << ')';
  return out.str();
}

template <class T, size_t N>
bool Near(const std::array<T, N>& a, const std::array<T, N>& b, double tolerance) {
  for (size_t i = 0; i < N; ++i)
    if (!(std::abs(double(a[i]) - double(b[i])) <= tolerance)) return false;
  return true;
}

// Compares every pixel with oracle(x, y), an array of the texel's components. `tolerance` is in the components' own
// units, for each component. Lists the first pixels that are wrong.
template <class Oracle>
testing::AssertionResult Matches(const Image& image, Oracle oracle, double tolerance = 0) {
  using Texel = decltype(oracle(0u, 0u));
  if (sizeof(Texel) != image.texelBytes)
    return testing::AssertionFailure() << "texels have " << image.texelBytes << " bytes, the oracle's "
                                       << sizeof(Texel);
  uint64_t wrong = 0;
  std::ostringstream list;
  for (uint32_t y = 0; y < image.height; ++y)
    for (uint32_t x = 0; x < image.width; ++x) {
      const Texel actual = image.At<Texel>(x, y), expected = oracle(x, y);
      if (Near(actual, expected, tolerance)) continue;
      if (++wrong <= 6)
        list << "\n  pixel " << x << ", " << y << " is " << Text(actual) << ", expected " << Text(expected);
    }
  if (wrong == 0) return testing::AssertionSuccess();
  return testing::AssertionFailure() << wrong << " of " << image.width * image.height
                                     << " pixels are wrong:" << list.str();
}

// 0..1 to 0..255, rounded as Direct3D does. NaN is 0.
uint8_t ToUnorm8(double value);
// The sRGB transfer function and its inverse, 0..1.
double SrgbToLinear(double value);
double LinearToSrgb(double value);

}  // namespace rhi_test

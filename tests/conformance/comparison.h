// Pictures that were read back, and the comparisons of them: the only ones that the tests have. Exact unless the caller
// names a tolerance of tolerances.cpp. What is compared is also recorded for the report (recorder.h).
#pragma once

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <sstream>
#include <string>
#include <vector>

#include "tolerances.h"

namespace conformance {

using Rgba8 = std::array<uint8_t, 4>;
using Rgba32F = std::array<float, 4>;

// How the components of a texel are stored. Packed: several in a word; only equality can be told.
enum class Component { U8, U16, U32, F16, F32, Packed };

struct Image {
  uint32_t width = 0, height = 0, texelBytes = 0;
  std::vector<uint8_t> bytes;  // tightly packed, row 0 on top
  Component component = Component::U8;

  template <class Texel>
  Texel At(uint32_t x, uint32_t y) const {
    Texel t;
    std::memcpy(&t, bytes.data() + (size_t(y) * width + x) * texelBytes, sizeof t);
    return t;
  }
};

// The steps from one component to the other: of integers their difference, of floats units in the last place of the
// larger of |expected| and `floor`. Infinite where either is not a number.
double Distance(double actual, double expected);
double UlpDistance(float actual, float expected, double floor = 0);

// What a comparison of pictures came to.
struct Outcome {
  uint64_t pixels = 0, differing = 0, beyond = 0;  // all; not equal; farther than the limit
  double worst = 0;                                // the greatest distance of two components; infinite for packed ones
  uint32_t x = 0, y = 0;                           // the first pixel beyond
  bool sameShape = true;
  bool Ok(const Tolerance& t) const { return sameShape && beyond <= t.pixels && Share() <= t.differing; }
  double Share() const { return pixels ? double(differing) / double(pixels) : 0; }  // of the pixels that differ
};
Outcome Measure(const Image& result, const Image& reference, double limit = 0);

// Succeeds when the pictures agree in every byte, or within the tolerance. In a case of both backends, exact means: as
// Vulkan and GL have to on these drivers (ParityLimits).
testing::AssertionResult SameImage(const Image& result, const Image& reference, const Tolerance& = kExact);

// One number against its oracle, in the tolerance's unit.
testing::AssertionResult Agrees(double actual, double expected, const Tolerance&);

template <class T, size_t N>
std::string Text(const std::array<T, N>& texel) {
  std::ostringstream out;
  out << '(';
  for (size_t i = 0; i < N; ++i) out << (i ? ", " : "") << +texel[i];
  out << ')';
  return out.str();
}

template <class T>
constexpr Component ComponentOf() {
  if (std::is_floating_point_v<T>) return Component::F32;
  return sizeof(T) == 1 ? Component::U8 : sizeof(T) == 2 ? Component::U16 : Component::U32;
}

// The greatest distance of two components, in the tolerance's unit; of floats, a tolerance in LSB is one in ULP.
template <class T, size_t N>
double Distance(const std::array<T, N>& actual, const std::array<T, N>& expected, const Tolerance& tolerance) {
  double worst = 0;
  for (size_t i = 0; i < N; ++i)
    if (std::is_floating_point_v<T> && tolerance.unit != Unit::Value)
      worst = std::max(worst, UlpDistance(float(actual[i]), float(expected[i]), tolerance.floor));
    else
      worst = std::max(worst, Distance(double(actual[i]), double(expected[i])));
  return worst;
}

// Tells the recorder, and makes the sentence.
testing::AssertionResult Report(const Outcome&, const Tolerance&, const Image& result, const Image& reference,
                                const std::string& firstWrong);

inline constexpr uint64_t kListed = 6;  // wrong pixels, in words

// Compares every pixel with oracle(x, y), an array of the texel's components. Lists the first pixels that are wrong.
template <class Oracle>
testing::AssertionResult Matches(const Image& image, Oracle oracle, const Tolerance& tolerance = kExact) {
  using Texel = decltype(oracle(0u, 0u));
  if (sizeof(Texel) != image.texelBytes)
    return testing::AssertionFailure() << "texels have " << image.texelBytes << " bytes, the oracle's "
                                       << sizeof(Texel);
  Image result = image, reference = image;
  result.component = reference.component = ComponentOf<typename Texel::value_type>();
  Outcome outcome{.pixels = uint64_t(image.width) * image.height};
  std::ostringstream list;
  for (uint32_t y = 0; y < image.height; ++y)
    for (uint32_t x = 0; x < image.width; ++x) {
      const Texel actual = image.At<Texel>(x, y), expected = oracle(x, y);
      std::memcpy(&reference.bytes[(size_t(y) * image.width + x) * sizeof(Texel)], &expected, sizeof expected);
      const double distance = Distance(actual, expected, tolerance);
      outcome.worst = std::max(outcome.worst, distance);
      if (distance > 0) ++outcome.differing;
      if (distance <= tolerance.limit) continue;
      if (++outcome.beyond <= kListed)
        list << "\n  pixel " << x << ", " << y << " is " << Text(actual) << ", expected " << Text(expected);
    }
  return Report(outcome, tolerance, result, reference, list.str());
}

}  // namespace conformance

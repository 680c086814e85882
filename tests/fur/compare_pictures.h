// Small pictures for the tests of fur/compare.h.
#pragma once

#include <gtest/gtest.h>

#include <functional>
#include <limits>

#include "fur/compare.h"

namespace fur::test {

inline constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

inline Picture MakePicture(uint32_t width, uint32_t height, bool encoded, bool hasAlpha,
                           const std::function<glm::vec4(uint32_t x, uint32_t y)>& color) {
  Picture p{{width, height, {}}, encoded, hasAlpha};
  for (uint32_t y = 0; y < height; ++y)
    for (uint32_t x = 0; x < width; ++x) p.image.pixels.push_back(color(x, y));
  return p;
}

// Eight bits, one colour.
inline Picture Flat(uint32_t width, uint32_t height, int r, int g, int b) {
  const glm::vec4 color(float(r) / 255.0f, float(g) / 255.0f, float(b) / 255.0f, 1);
  return MakePicture(width, height, true, false, [&](uint32_t, uint32_t) { return color; });
}

// Linear floats of one colour, without alpha.
inline Picture LinearFlat(uint32_t width, uint32_t height, glm::vec3 color) {
  return MakePicture(width, height, false, false, [&](uint32_t, uint32_t) { return glm::vec4(color, 1); });
}

// Eight bits, an uneven pattern.
inline Picture Pattern(uint32_t width, uint32_t height, uint32_t seed) {
  return MakePicture(width, height, true, false, [&](uint32_t x, uint32_t y) {
    const uint32_t i = x * 37 + y * 101 + x * y * 7 + seed * 29;
    const auto value = [i](uint32_t c) { return float((i + c * 53) % 256) / 255.0f; };
    return glm::vec4(value(0), value(1), value(2), 1);
  });
}

inline Comparison Compared(const Picture& a, const Picture& b, const CompareSettings& settings = {}) {
  Result<Comparison> c = ComparePictures(a, b, settings);
  if (c) return *c;
  ADD_FAILURE() << c.error().message;
  return {};
}

inline Plane MakePlane(uint32_t width, std::vector<float> values) {
  return {width, uint32_t(values.size()) / width, std::move(values)};
}

}  // namespace fur::test

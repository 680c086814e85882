// Pictures of the model as a sampler reads them at mip 0: bilinear, after decoding.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <glm/glm.hpp>

#include "fur/model.h"

namespace fur::reference {

class Texture {
 public:
  Texture() : Texture({"white", 1, 1, {255, 255, 255, 255}}, false) {}
  Texture(Image image, bool srgb);
  void SetWrap(bool wrapU, bool wrapV);
  glm::dvec3 Rgb(const glm::dvec2& uv) const;
  double Red(const glm::dvec2& uv) const;

 private:
  Image image_;
  bool wrapU_ = true, wrapV_ = true;
  std::array<double, 256> decode_;
};

// The two texels beside a coordinate of the unit square, and how far it is from the first.
struct Cell {
  uint32_t x0, x1;
  double fraction;
};
inline Cell CellAt(double coordinate, uint32_t size, bool wrap) {
  const auto n = int64_t(size);
  // A coordinate is small; the cast is much cheaper than std::floor on any x86-64.
  double inside = wrap ? coordinate - double(int64_t(coordinate)) : std::clamp(coordinate, 0.0, 1.0);
  if (inside < 0) inside += 1;
  const double x = inside * double(size) + 0.5;  // texel i - 1 begins at i
  const auto first = int64_t(x);
  const int64_t before = wrap ? n - 1 : 0, after = wrap ? 0 : n - 1;
  const auto x0 = first > 0 ? first - 1 : before;
  return {uint32_t(std::min(x0, n - 1)), uint32_t(first < n ? first : after), x - double(first)};
}

}  // namespace fur::reference

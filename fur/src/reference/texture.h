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
  // No more than any Red between these coordinates; 0 where they are too far apart to look.
  double LeastRed(const glm::dvec2& low, const glm::dvec2& high) const;

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
  // A coordinate is small; the cast is much cheaper than std::floor on any x86-64.
  double inside = wrap ? coordinate - double(int64_t(coordinate)) : std::clamp(coordinate, 0.0, 1.0);
  if (inside < 0) inside += 1;
  const double x = inside * size + 0.5;  // texel i - 1 begins at i
  const auto first = uint32_t(x), last = size - 1;
  const uint32_t x0 = first > 0 ? std::min(first - 1, last) : (wrap ? last : 0);
  return {x0, first < size ? first : (wrap ? 0 : last), x - first};
}

}  // namespace fur::reference

#include "texture.h"

#include <utility>

#include "mips.h"

namespace fur::reference {

Texture::Texture(Image image, bool srgb) : image_(std::move(image)) {
  for (size_t i = 0; i < 256; ++i) decode_[i] = srgb ? SrgbToLinear(double(i) / 255) : double(i) / 255;
}

void Texture::SetWrap(bool wrapU, bool wrapV) {
  wrapU_ = wrapU;
  wrapV_ = wrapV;
}

glm::dvec3 Texture::Rgb(const glm::dvec2& uv) const {
  const Cell u = CellAt(uv.x, image_.width, wrapU_), v = CellAt(uv.y, image_.height, wrapV_);
  const auto texel = [&](uint32_t x, uint32_t y) {
    const uint8_t* p = &image_.pixels[(size_t(y) * image_.width + x) * 4];
    return glm::dvec3(decode_[p[0]], decode_[p[1]], decode_[p[2]]);
  };
  const glm::dvec3 low = glm::mix(texel(u.x0, v.x0), texel(u.x1, v.x0), u.fraction);
  const glm::dvec3 high = glm::mix(texel(u.x0, v.x1), texel(u.x1, v.x1), u.fraction);
  return glm::mix(low, high, v.fraction);
}

double Texture::Red(const glm::dvec2& uv) const {
  const Cell u = CellAt(uv.x, image_.width, wrapU_), v = CellAt(uv.y, image_.height, wrapV_);
  const auto texel = [&](uint32_t x, uint32_t y) { return decode_[image_.pixels[(size_t(y) * image_.width + x) * 4]]; };
  const double low = glm::mix(texel(u.x0, v.x0), texel(u.x1, v.x0), u.fraction);
  const double high = glm::mix(texel(u.x0, v.x1), texel(u.x1, v.x1), u.fraction);
  return glm::mix(low, high, v.fraction);
}

double Texture::LeastRed(const glm::dvec2& low, const glm::dvec2& high) const {
  constexpr double kMostTexels = 4096;
  const glm::dvec2 size(image_.width, image_.height), first = glm::floor(low * size - 1.0), last = glm::ceil(high * size + 1.0);
  if (!((last.x - first.x) * (last.y - first.y) <= kMostTexels)) return 0;
  double least = 1;
  for (double y = first.y; y <= last.y; ++y)
    for (double x = first.x; x <= last.x; ++x) least = std::min(least, Red((glm::dvec2(x, y) + 0.5) / size));
  return least;
}

}  // namespace fur::reference

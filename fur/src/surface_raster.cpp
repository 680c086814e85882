#include "surface_raster.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace fur {

using glm::dvec2;

SurfaceRaster::SurfaceRaster(const Model& model, uint32_t material, uint32_t side)
    : side_(side), points_(size_t{side} * side) {
  for (size_t p = 0; p < model.parts.size(); ++p) {
    const Primitive& primitive = model.primitives[model.parts[p].primitive];
    if (primitive.material != material) continue;
    for (size_t i = 0; i + 2 < primitive.indices.size(); i += 3) {
      const std::array<uint32_t, 3> v{primitive.indices[i], primitive.indices[i + 1], primitive.indices[i + 2]};
      triangles_.push_back({p, v});
      const auto uv = [&](size_t k) { return dvec2(primitive.vertices[v[k]].uv) * double(side); };
      Fill({uv(0), uv(1), uv(2)});
    }
  }
}

// The triangle that was added last.
void SurfaceRaster::Fill(std::array<dvec2, 3> uv) {
  const double side = side_;
  const dvec2 low = glm::floor(glm::min(glm::min(uv[0], uv[1]), uv[2]) / side) * side;
  for (dvec2& corner : uv) corner -= low;  // whole tiles
  const dvec2 from = glm::floor(glm::min(glm::min(uv[0], uv[1]), uv[2])) - 1.0;
  // A triangle over many tiles covers the whole texture anyway.
  const dvec2 to = glm::min(glm::ceil(glm::max(glm::max(uv[0], uv[1]), uv[2])) + 1.0, from + 2 * side);
  const dvec2 ab = uv[1] - uv[0], ac = uv[2] - uv[0];
  const double area = ab.x * ac.y - ab.y * ac.x;
  if (!(std::abs(area) > 1e-12)) return;
  constexpr double kSlack = 0.02;
  for (double y = from.y; y <= to.y; ++y)
    for (double x = from.x; x <= to.x; ++x) {
      const dvec2 p = dvec2(x + 0.5, y + 0.5) - uv[0];
      const double b = (p.x * ac.y - p.y * ac.x) / area, c = (ab.x * p.y - ab.y * p.x) / area, a = 1 - b - c;
      const double least = std::min({a, b, c});
      if (least >= -kSlack) Set(int(x), int(y), {uint32_t(triangles_.size() - 1), least >= 0, {a, b, c}});
    }
}

void SurfaceRaster::Set(int x, int y, const Point& point) {
  Point& there = points_[Wrapped(y) * side_ + Wrapped(x)];
  if (there.inside && !point.inside) return;
  if (there.inside) overlaps_.push_back({there, point});
  there = point;
}

void GrowPicture(uint32_t side, std::vector<uint8_t>* there, std::vector<glm::u8vec4>* pixels) {
  constexpr int kPasses = 24;
  std::vector<size_t> edge;
  for (size_t i = 0; i < there->size(); ++i)
    if ((*there)[i]) edge.push_back(i);
  for (int pass = 0; pass < kPasses; ++pass) {
    std::vector<size_t> next;
    for (const size_t i : edge) {
      const size_t x = i % side, y = i / side;
      for (const auto& [dx, dy] : {std::pair{size_t{1}, size_t{0}}, {side - 1, 0}, {0, 1}, {0, side - 1}}) {
        const size_t j = (y + dy) % side * side + (x + dx) % side;
        if ((*there)[j]) continue;
        (*there)[j] = 1;
        (*pixels)[j] = (*pixels)[i];
        next.push_back(j);
      }
    }
    edge = std::move(next);
  }
}

}  // namespace fur

#include "surface_painter.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "for_all.h"

namespace fur {
namespace {

using glm::dvec2;
using glm::dvec3;

// Which triangle a texel's centre is in, and where: weights of its second and third corner.
struct Texel {
  uint32_t triangle = kNone;
  bool inside = false;  // else a little outside, so that filtering finds no holes
  double b = 0, c = 0;
  static constexpr uint32_t kNone = ~0u;
};

class Raster {
 public:
  Raster(const Model& model, const Body& body, uint32_t material, uint32_t side)
      : side_(side), texels_(size_t{side} * side) {
    for (size_t p = 0; p < model.parts.size(); ++p) {
      const Primitive& primitive = model.primitives[model.parts[p].primitive];
      if (primitive.material != material) continue;
      for (size_t i = 0; i + 2 < primitive.indices.size(); i += 3) {
        std::array<dvec2, 3> uv;
        std::array<const Place*, 3> corners{};
        for (size_t k = 0; k < 3; ++k) {
          const uint32_t v = primitive.indices[i + k];
          uv[k] = dvec2(primitive.vertices[v].uv) * double(side);
          corners[k] = &body.At(p, v);
        }
        triangles_.push_back(corners);
        Fill(uv);
      }
    }
  }

  bool Covers(size_t texel) const { return texels_[texel].triangle != Texel::kNone; }
  Place At(size_t texel) const { return At(texels_[texel]); }
  double OverlapShare() const {
    const auto used = std::count_if(texels_.begin(), texels_.end(), [](const Texel& t) { return t.inside; });
    return used > 0 ? double(overlaps_) / double(used) : 0;
  }

 private:
  Place At(const Texel& t) const { return Mix(triangles_[t.triangle], 1 - t.b - t.c, t.b, t.c); }

  // The triangle that was added last.
  void Fill(std::array<dvec2, 3> uv) {
    const double side = side_;
    const dvec2 low = glm::floor(glm::min(glm::min(uv[0], uv[1]), uv[2]) / side) * side;
    for (dvec2& corner : uv) corner -= low;  // whole tiles: the texture wraps around
    const dvec2 from = glm::floor(glm::min(glm::min(uv[0], uv[1]), uv[2])) - 1.0;
    // A triangle over many tiles covers the whole texture anyway.
    const dvec2 to = glm::min(glm::ceil(glm::max(glm::max(uv[0], uv[1]), uv[2])) + 1.0, from + 2 * side);
    const dvec2 ab = uv[1] - uv[0], ac = uv[2] - uv[0];
    const double area = ab.x * ac.y - ab.y * ac.x;
    if (!(std::abs(area) > 1e-12)) return;
    for (double y = from.y; y <= to.y; ++y)
      for (double x = from.x; x <= to.x; ++x) {
        const dvec2 p = dvec2(x + 0.5, y + 0.5) - uv[0];
        const double b = (p.x * ac.y - p.y * ac.x) / area, c = (ab.x * p.y - ab.y * p.x) / area;
        const double least = std::min({b, c, 1 - b - c});
        if (least >= -kSlack) Set(int(x), int(y), {uint32_t(triangles_.size() - 1), least >= 0, b, c});
      }
  }

  void Set(int x, int y, const Texel& texel) {
    Texel& there = texels_[Wrapped(y) * side_ + Wrapped(x)];
    if (there.inside && !texel.inside) return;
    if (there.inside && glm::length(At(there).p - At(texel).p) > kFarApart) ++overlaps_;
    there = texel;
  }

  size_t Wrapped(int i) const { return size_t((i % int(side_) + int(side_)) % int(side_)); }

  static constexpr double kSlack = 0.02, kFarApart = 0.01;
  uint32_t side_;
  std::vector<Texel> texels_;
  std::vector<std::array<const Place*, 3>> triangles_;
  uint64_t overlaps_ = 0;
};

// Grows what is painted outwards, so that mips and filtering do not mix with what never was.
void Grow(uint32_t side, std::vector<uint8_t>* painted, std::vector<dvec3>* colors) {
  constexpr int kPasses = 24;
  std::vector<size_t> edge;
  for (size_t i = 0; i < painted->size(); ++i)
    if ((*painted)[i]) edge.push_back(i);
  for (int pass = 0; pass < kPasses; ++pass) {
    std::vector<size_t> next;
    for (const size_t i : edge) {
      const size_t x = i % side, y = i / side;
      for (const auto& [dx, dy] : {std::pair{size_t{1}, size_t{0}}, {side - 1, 0}, {0, 1}, {0, side - 1}}) {
        const size_t j = (y + dy) % side * side + (x + dx) % side;
        if ((*painted)[j]) continue;
        (*painted)[j] = 1;
        (*colors)[j] = (*colors)[i];
        next.push_back(j);
      }
    }
    edge = std::move(next);
  }
}

uint8_t Byte(double x) { return uint8_t(std::floor(std::clamp(x, 0.0, 1.0) * 255 + 0.5)); }

}  // namespace

Image PaintSurface(const Model& model, const Body& body, uint32_t material, uint32_t side, const dvec3& plain,
                   const PlaceColor& color) {
  const Raster raster(model, body, material, side);
  std::vector<dvec3> colors(size_t{side} * side, plain);
  std::vector<uint8_t> painted(colors.size(), 0);
  ForAll(side, 0, {}, [&](uint32_t y) {
    for (size_t i = size_t{y} * side; i < size_t{y + 1} * side; ++i) {
      if (!raster.Covers(i)) continue;
      colors[i] = color(raster.At(i));
      painted[i] = 1;
    }
  });
  Grow(side, &painted, &colors);
  Image out{"coat", side, side, {}};
  out.pixels.reserve(colors.size() * 4);
  for (const dvec3& c : colors) out.pixels.insert(out.pixels.end(), {Byte(c.r), Byte(c.g), Byte(c.b), 255});
  return out;
}

double OverlapShare(const Model& model, const Body& body, uint32_t material) {
  return Raster(model, body, material, 512).OverlapShare();
}

}  // namespace fur

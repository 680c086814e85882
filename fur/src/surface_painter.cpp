#include "surface_painter.h"

#include <algorithm>
#include <cmath>

#include "for_all.h"

namespace fur {
namespace {

using glm::dvec3;
using glm::dvec4;

Place PlaceOf(const Body& body, const SurfaceRaster& raster, const SurfaceRaster::Point& point) {
  const SurfaceRaster::Triangle& t = raster.Triangles()[point.triangle];
  const auto corner = [&](size_t k) { return &body.At(t.part, t.vertices[k]); };
  return Mix({corner(0), corner(1), corner(2)}, point.weights[0], point.weights[1], point.weights[2]);
}

glm::u8vec4 Bytes(const dvec4& c) { return glm::u8vec4(glm::floor(glm::clamp(c, 0.0, 1.0) * 255.0 + 0.5)); }

}  // namespace

Image PaintPoints(const SurfaceRaster& raster, uint32_t side, const dvec4& plain, const PointColor& color) {
  std::vector<glm::u8vec4> pixels(size_t{side} * side, Bytes(plain));
  std::vector<uint8_t> painted(pixels.size(), 0);
  ForAll(side, 0, {}, [&](uint32_t y) {
    for (size_t i = size_t{y} * side; i < size_t{y + 1} * side; ++i) {
      const SurfaceRaster::Point& point = raster.Points()[i];
      if (point.IsEmpty()) continue;
      pixels[i] = Bytes(color(point));
      painted[i] = 1;
    }
  });
  GrowPicture(side, &painted, &pixels);
  Image out{"coat", side, side, {}};
  out.pixels.reserve(pixels.size() * 4);
  for (const glm::u8vec4& p : pixels) out.pixels.insert(out.pixels.end(), {p.r, p.g, p.b, p.a});
  return out;
}

Image PaintSurface(const Model& model, const Body& body, uint32_t material, uint32_t side, const dvec3& plain,
                   const PlaceColor& color) {
  const SurfaceRaster raster(model, material, side);
  return PaintPoints(raster, side, dvec4(plain, 1), [&](const SurfaceRaster::Point& point) {
    return dvec4(color(PlaceOf(body, raster, point)), 1);
  });
}

double OverlapShare(const Model& model, const Body& body, uint32_t material) {
  constexpr double kFarApart = 0.01;
  const SurfaceRaster raster(model, material, 512);
  const auto& points = raster.Points();
  const auto used = std::count_if(points.begin(), points.end(), [](const auto& p) { return p.inside; });
  const auto& overlaps = raster.Overlaps();
  const auto apart = std::count_if(overlaps.begin(), overlaps.end(), [&](const SurfaceRaster::Overlap& o) {
    return glm::length(PlaceOf(body, raster, o.first).p - PlaceOf(body, raster, o.last).p) > kFarApart;
  });
  return used > 0 ? double(apart) / double(used) : 0;
}

}  // namespace fur

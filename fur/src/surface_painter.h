// Pictures painted by position: each texel takes the colour of the place on the body that it shows.
#pragma once

#include <functional>

#include "body.h"
#include "fur/model.h"
#include "surface_raster.h"

namespace fur {

// sRGB, 0..1; called from several threads.
using PlaceColor = std::function<glm::dvec3(const Place&)>;

// Of a material, in its texture coordinates, which wrap around: side x side texels. Texels outside of all charts, but near
// one, have its nearest colour; those far away `plain`.
Image PaintSurface(const Model&, const Body&, uint32_t material, uint32_t side, const glm::dvec3& plain,
                   const PlaceColor&);

// Each texel the colour of a point on the skin; the rest as above. Called from several threads.
using PointColor = std::function<glm::dvec4(const SurfaceRaster::Point&)>;
Image PaintPoints(const SurfaceRaster&, uint32_t side, const glm::dvec4& plain, const PointColor&);

// Share of the used texels that show two places more than a hundredth of the body apart: charts that overlap or mirror.
double OverlapShare(const Model&, const Body&, uint32_t material);

}  // namespace fur

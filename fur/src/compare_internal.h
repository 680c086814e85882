// The pieces of fur/compare.h, each testable alone.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "fur/float_image.h"

namespace fur {

// Weights of -radius..radius.
using Kernel = std::vector<float>;

// Correlates along x, along y; pixels of the edge are repeated beyond it.
Plane FilterRows(const Plane& in, const Kernel& kernel);
Plane FilterColumns(const Plane& in, const Kernel& kernel);

struct Rgb {
  uint32_t width = 0, height = 0;
  std::vector<glm::vec3> pixels;
};

// The LDR-FLIP error of each pixel, 0..1. Linear sRGB values of 0..1, of one size.
Plane FlipMap(const Rgb& reference, const Rgb& test, double pixelsPerDegree);

// The structural similarity around each pixel, of values of 0..1.
Plane SsimMap(const Plane& a, const Plane& b);
// Wang's mean: over the windows that lie inside the picture; over all where none does.
double SsimMean(const Plane& map);

// Opacity > 1/255, as 0 or 1 for each pixel; a non-finite one counts as opaque.
std::vector<uint8_t> FurPixels(const Plane& opacity);
// Whether a pixel inside is at most `radius` rows and columns away.
std::vector<uint8_t> Dilate(const std::vector<uint8_t>& inside, uint32_t width, uint32_t height, uint32_t radius);
// 1/255 < opacity < 1 - 1e-4: fur that does not hide what is behind it.
std::vector<uint8_t> TranslucentPixels(const Plane& opacity);

// The smallest value that at least `share` (0..1) of the values do not exceed. `sorted` ascends and is not empty.
double Percentile(std::span<const float> sorted, double share);
// The same, each value, >= 0, counted as often as it is large: FLIP's weighted median is that of 0.5 (Andersson et al.
// 2020, section 5). 0 where all are 0.
double WeightedPercentile(std::span<const float> sorted, double share);

}  // namespace fur

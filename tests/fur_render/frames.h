// Pictures that the renderer draws on any device, and what can be asked of them.
#pragma once

#include <gtest/gtest.h>

#include <array>
#include <string>
#include <vector>

#include "fur/renderer.h"

namespace fur::test {

struct Frame {
  Image image;
  FrameCounts counts;
};
// One animal at `placements`, or in the origin without a turn.
Frame Render(rhi::IDevice&, const Model&, const RenderSettings&, const Camera&,
             const std::vector<glm::dmat4>& placements = {glm::dmat4(1)});

// The same without the counts, which are frames of their own.
Image Draw(rhi::IDevice&, const Model&, const RenderSettings&, const Camera&, const std::vector<glm::dmat4>& placements,
           const Motion& = {});

// The frame before it is brought to 8 bits.
FloatImage Pixels(rhi::IDevice&, const Model&, const RenderSettings&, const Camera&,
                  const std::vector<glm::dmat4>& placements = {glm::dmat4(1)});

// Whether there are pixels, and each is a number.
bool AllFinite(const FloatImage&);

using Rgb = std::array<int, 3>;
Rgb PixelAt(const Image&, uint32_t x, uint32_t y);
Rgb Center(const Image&);
size_t Colors(const Image&);  // how many a picture has: a wrong one tends to have few
uint64_t DifferingPixels(const Image&, const Image&);
// Each channel within `tolerance` of 255 * expected.
void ExpectColor(const Rgb& got, const glm::dvec3& expected, double tolerance, const std::string& what);

}  // namespace fur::test

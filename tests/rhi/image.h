// Pictures that were read back, and their comparisons, by short names; and the arithmetic of formats for oracles.
#pragma once

#include "../conformance/comparison.h"

namespace rhi_test {

using conformance::Agrees;
using conformance::Component;
using conformance::Image;
using conformance::Matches;
using conformance::Rgba32F;
using conformance::Rgba8;
using conformance::SameImage;
using conformance::Text;
using conformance::Within;

// 0..1 to 0..255, rounded as Direct3D does. NaN is 0.
uint8_t ToUnorm8(double value);
// The sRGB transfer function and its inverse, 0..1.
double SrgbToLinear(double value);
double LinearToSrgb(double value);

}  // namespace rhi_test

// Direct3D says how much one unit of RasterizerDesc::depthBias adds to a depth in 32-bit floats: 2^(e - 23), e being the
// exponent of the primitive's greatest depth. GL says 2^(e - n) for n bits of mantissa (OpenGL 4.5 core, 14.6.5), which
// drivers read as this or as its double. So it is measured. For normalised depths GL and Vulkan alike leave the unit to
// the driver, and so do we.
#pragma once

#include "rhi/types.h"

namespace rhi_gl {

// How many units of glPolygonOffset are one of Direct3D's on 32-bit floats: a power of two, 1 where it cannot be
// measured. Draws one pixel on the current context, which is nobody else's: its state is changed.
float MeasureDepthBiasUnits();

}  // namespace rhi_gl

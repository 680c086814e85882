// The little that this backend reads and changes in SPIR-V.
#pragma once

#include <vector>

#include "vulkan_api.h"

namespace rhi_vulkan {

inline constexpr uint32_t kSpirvMagic = 0x07230203, kSpirvHeaderWords = 5;

// Whether it looks like a module at all; what is inside was validated by the build.
bool IsSpirv(const Array<uint32_t>&);

// The locations of a pixel shader's outputs, as bits.
uint32_t ColorOutputs(const Array<uint32_t>&);

// A vertex shader that also writes PointSize 1: Direct3D's points have one pixel, and Vulkan wants that said. HLSL
// cannot say it, and other topologies need not pay for it.
std::vector<uint32_t> WithPointSize(const Array<uint32_t>&);

// For drivers without shaderDrawParameters (SwiftShader): the bases that SV_VertexID and SV_InstanceID subtract read 0,
// which is right for draws that start at 0; other draws see their start included.
std::vector<uint32_t> WithoutDrawParameters(const Array<uint32_t>&);

}  // namespace rhi_vulkan

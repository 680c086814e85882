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

// Where a draw starts, for drivers without shaderDrawParameters (SwiftShader): what SV_VertexID and SV_InstanceID
// subtract. As push constants of a vertex shader; for indirect draws `indirect` is 1, and the two numbers are those
// that were copied from the arguments to the uniform block at kStartsBinding of the constants' set.
struct DrawStarts {
  uint32_t vertex = 0, instance = 0, indirect = 0;
  bool operator==(const DrawStarts&) const = default;
};
inline constexpr uint32_t kStartsBinding = kMaxConstantBuffers;
// A vertex shader that reads them from there.
std::vector<uint32_t> WithoutDrawParameters(const Array<uint32_t>&);

}  // namespace rhi_vulkan

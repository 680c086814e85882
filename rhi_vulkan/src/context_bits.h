// The dirty bits of the Vulkan context beside those of backend::Dirty.
#pragma once

#include "rhi/backend/context_base.h"
#include "vulkan_api.h"

namespace rhi_vulkan {

inline constexpr uint32_t kDirtyPass = 1u << 24;     // no pass is begun
inline constexpr uint32_t kDirtyOffsets = 1u << 25;  // new contents in a dynamic constant buffer
inline constexpr uint32_t kDirtySets = 1u << 26;     // sets 1.. must be bound again; which ones, the context knows

inline constexpr uint32_t kDirtyGraphicsResources =
    (backend::DirtyResources | backend::DirtySamplers) * 7u;  // vertex, geometry, pixel
inline constexpr uint32_t kDirtyCompute =
    backend::DirtyComputeShader | backend::DirtyUavs | (backend::DirtyResources | backend::DirtySamplers) << 3;
inline constexpr uint32_t kDirtyDraw = ((1u << 27) - 1) & ~kDirtyCompute;
inline constexpr uint32_t kDirtyPipeline = backend::DirtyLayout | backend::DirtyTopology | backend::DirtyShaders |
                                           backend::DirtyRaster | backend::DirtyBlend | backend::DirtyBlendFactor |
                                           backend::DirtyTargets;

// What changes most between the draws of a pass: Context::SwitchPipeline.
inline constexpr uint32_t kDirtySwitch = backend::DirtyShaders | backend::DirtyBlend | kDirtyOffsets;

}  // namespace rhi_vulkan

// What the RHI's formats are in Vulkan, and what an adapter can do with them.
#pragma once

#include "vulkan_api.h"

namespace rhi_vulkan {

VkFormat ToVk(Format);
VkImageAspectFlags Aspects(Format);  // all of a format's aspects

FormatSupport QueryFormatSupport(const InstanceTable&, VkPhysicalDevice, Format);
// Whether images of `samples` samples can be made: 0 or 1, as ID3D10Device::CheckMultisampleQualityLevels.
uint32_t QueryMultisample(const InstanceTable&, VkPhysicalDevice, Format, uint32_t samples);

}  // namespace rhi_vulkan

// Xlib's headers define macros like None, Status and Always: only xlib_surface.cpp sees them, and it sees nothing of
// ours.
#pragma once

#include <vulkan/vulkan_core.h>

namespace rhi_vulkan {

// `display` is a Display*, `window` a Window.
VkResult CreateXlibSurface(PFN_vkGetInstanceProcAddr, VkInstance, void* display, unsigned long window,
                           VkSurfaceKHR* out);

}  // namespace rhi_vulkan

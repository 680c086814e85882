#include "xlib_surface.h"

#include <X11/Xlib.h>
#include <vulkan/vulkan_xlib.h>

namespace rhi_vulkan {

VkResult CreateXlibSurface(PFN_vkGetInstanceProcAddr load, VkInstance instance, void* display, unsigned long window,
                           VkSurfaceKHR* out) {
  const auto create = reinterpret_cast<PFN_vkCreateXlibSurfaceKHR>(load(instance, "vkCreateXlibSurfaceKHR"));
  if (!create) return VK_ERROR_EXTENSION_NOT_PRESENT;
  VkXlibSurfaceCreateInfoKHR info{};
  info.sType = VK_STRUCTURE_TYPE_XLIB_SURFACE_CREATE_INFO_KHR;
  info.dpy = static_cast<Display*>(display);
  info.window = window;
  return create(instance, &info, nullptr, out);
}

}  // namespace rhi_vulkan

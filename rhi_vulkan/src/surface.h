// A window as Vulkan sees it, and how pictures are best brought there.
#pragma once

#include "core.h"

namespace rhi_vulkan {

struct Surface {
  VkSurfaceKHR handle = VK_NULL_HANDLE;
  VkSurfaceFormatKHR format{};
  VkPresentModeKHR mode = VK_PRESENT_MODE_FIFO_KHR;

  // Unsupported, with a message, where this adapter cannot show the format in this window.
  Status Open(Core&, const SwapChainDesc&);
  void Close(Core&);

  // What the window is like now. SurfaceLost where it is gone.
  VkResult Query(Core&, VkSurfaceCapabilitiesKHR*) const;

 private:
  bool ChooseFormat(Core&, Format);
  void ChooseMode(Core&, bool vsync);
};

}  // namespace rhi_vulkan

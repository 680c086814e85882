#include "surface.h"

#include "formats.h"
#include "xlib_surface.h"

namespace rhi_vulkan {
namespace {

// What can take a picture of `format` without changing how it looks, the best first. A blit between sRGB and other
// formats would convert the values, so the two kinds never meet.
std::array<VkFormat, 3> Candidates(Format format) {
  const VkFormat own = ToVk(format);
  if (GetFormatInfo(format).sRGB) return {own, VK_FORMAT_B8G8R8A8_SRGB, VK_FORMAT_R8G8B8A8_SRGB};
  return {own, VK_FORMAT_B8G8R8A8_UNORM, VK_FORMAT_R8G8B8A8_UNORM};
}

bool HasFeatures(Core& core, VkFormat format, VkFormatFeatureFlags wanted) {
  VkFormatProperties p{};
  core.instance.vk.vkGetPhysicalDeviceFormatProperties(core.adapter.handle, format, &p);
  return (p.optimalTilingFeatures & wanted) == wanted;
}

std::vector<VkSurfaceFormatKHR> Formats(Core& core, VkSurfaceKHR surface) {
  const auto get = core.instance.vk.vkGetPhysicalDeviceSurfaceFormatsKHR;
  uint32_t count = 0;
  get(core.adapter.handle, surface, &count, nullptr);
  std::vector<VkSurfaceFormatKHR> list(count);
  if (count) get(core.adapter.handle, surface, &count, list.data());
  list.resize(count);
  return list;
}

std::vector<VkPresentModeKHR> Modes(Core& core, VkSurfaceKHR surface) {
  const auto get = core.instance.vk.vkGetPhysicalDeviceSurfacePresentModesKHR;
  uint32_t count = 0;
  get(core.adapter.handle, surface, &count, nullptr);
  std::vector<VkPresentModeKHR> list(count);
  if (count) get(core.adapter.handle, surface, &count, list.data());
  list.resize(count);
  return list;
}

Status Refuse(Core& core, const char* what) {
  core.log.Report(Severity::Error, MsgCode::CapMissing, "",
                  "%s cannot show %s; take a window of nativeDisplay, BGRA8_UNorm, or another adapter",
                  core.adapter.caps.adapter.data(), what);
  return Status::Unsupported;
}

}  // namespace

Status Surface::Open(Core& core, const SwapChainDesc& desc) {
  const InstanceTable& vki = core.instance.vk;
  const auto window = static_cast<unsigned long>(reinterpret_cast<uintptr_t>(desc.nativeWindow));
  VkResult result =
      CreateXlibSurface(vkGetInstanceProcAddr, core.instance.handle, core.instance.display, window, &handle);
  if (Status s = core.Check(result, "", "vkCreateXlibSurfaceKHR"); s != Status::Ok) return s;
  VkBool32 shows = VK_FALSE;
  result = vki.vkGetPhysicalDeviceSurfaceSupportKHR(core.adapter.handle, core.adapter.queueFamily, handle, &shows);
  if (Status s = core.Check(result, "", "vkGetPhysicalDeviceSurfaceSupportKHR"); s != Status::Ok) return s;
  if (!shows) return Refuse(core, "pictures in this window");
  VkSurfaceCapabilitiesKHR caps{};
  if (Status s = core.Check(Query(core, &caps), "", "looking at the window of a swap chain"); s != Status::Ok) return s;
  if (!(caps.supportedUsageFlags & VK_IMAGE_USAGE_TRANSFER_DST_BIT)) return Refuse(core, "pictures made elsewhere");
  if (!ChooseFormat(core, desc.format)) return Refuse(core, rhi::ToString(desc.format));
  ChooseMode(core, desc.vsync);
  return Status::Ok;
}

void Surface::Close(Core& core) {
  if (handle) core.instance.vk.vkDestroySurfaceKHR(core.instance.handle, handle, nullptr);
  handle = VK_NULL_HANDLE;
}

VkResult Surface::Query(Core& core, VkSurfaceCapabilitiesKHR* out) const {
  return core.instance.vk.vkGetPhysicalDeviceSurfaceCapabilitiesKHR(core.adapter.handle, handle, out);
}

bool Surface::ChooseFormat(Core& core, Format wanted) {
  if (!HasFeatures(core, ToVk(wanted), VK_FORMAT_FEATURE_BLIT_SRC_BIT)) return false;
  const std::vector<VkSurfaceFormatKHR> offered = Formats(core, handle);
  for (const VkFormat candidate : Candidates(wanted))
    for (const VkSurfaceFormatKHR& f : offered) {
      if (f.format != candidate || f.colorSpace != VK_COLOR_SPACE_SRGB_NONLINEAR_KHR) continue;
      if (!HasFeatures(core, candidate, VK_FORMAT_FEATURE_BLIT_DST_BIT)) continue;
      format = f;
      return true;
    }
  return false;
}

void Surface::ChooseMode(Core& core, bool vsync) {
  mode = VK_PRESENT_MODE_FIFO_KHR;  // the one that every driver has
  if (vsync) return;
  const std::vector<VkPresentModeKHR> offered = Modes(core, handle);
  for (const VkPresentModeKHR wanted : {VK_PRESENT_MODE_IMMEDIATE_KHR, VK_PRESENT_MODE_MAILBOX_KHR}) {
    if (std::find(offered.begin(), offered.end(), wanted) == offered.end()) continue;
    mode = wanted;
    return;
  }
}

}  // namespace rhi_vulkan

#include "formats.h"

namespace rhi_vulkan {
namespace {

constexpr auto kFormats = std::to_array<VkFormat>({
    VK_FORMAT_UNDEFINED,
    VK_FORMAT_R8_UNORM,
    VK_FORMAT_R8G8_UNORM,
    VK_FORMAT_R8G8B8A8_UNORM,
    VK_FORMAT_R8G8B8A8_SRGB,
    VK_FORMAT_B8G8R8A8_UNORM,
    VK_FORMAT_B8G8R8A8_SRGB,
    VK_FORMAT_R16_SFLOAT,
    VK_FORMAT_R16G16_SFLOAT,
    VK_FORMAT_R16G16B16A16_SFLOAT,
    VK_FORMAT_R32_SFLOAT,
    VK_FORMAT_R32G32_SFLOAT,
    VK_FORMAT_R32G32B32_SFLOAT,
    VK_FORMAT_R32G32B32A32_SFLOAT,
    VK_FORMAT_R16_UINT,
    VK_FORMAT_R32_UINT,
    VK_FORMAT_R8G8B8A8_UINT,
    VK_FORMAT_A2B10G10R10_UNORM_PACK32,
    VK_FORMAT_B10G11R11_UFLOAT_PACK32,
    VK_FORMAT_D16_UNORM,
    VK_FORMAT_D24_UNORM_S8_UINT,
    VK_FORMAT_D32_SFLOAT,
    VK_FORMAT_D32_SFLOAT_S8_UINT,
    VK_FORMAT_BC1_RGBA_UNORM_BLOCK,
    VK_FORMAT_BC3_UNORM_BLOCK,
    VK_FORMAT_BC5_UNORM_BLOCK,
    VK_FORMAT_BC7_UNORM_BLOCK,
});
static_assert(kFormats.size() == size_t(Format::Count));

FormatSupport When(bool condition, FormatSupport bits) { return condition ? bits : FormatSupport::None; }

// Some drivers store sRGB, or depth; no view of ours does, because the others cannot.
FormatSupport TextureSupport(VkFormatFeatureFlags f, bool sRGB) {
  const bool blit = (f & VK_FORMAT_FEATURE_BLIT_SRC_BIT) && (f & VK_FORMAT_FEATURE_BLIT_DST_BIT);
  const bool linear = f & VK_FORMAT_FEATURE_SAMPLED_IMAGE_FILTER_LINEAR_BIT;
  const bool color = f & VK_FORMAT_FEATURE_COLOR_ATTACHMENT_BIT, depth = f & VK_FORMAT_FEATURE_DEPTH_STENCIL_ATTACHMENT_BIT;
  return When(f & VK_FORMAT_FEATURE_SAMPLED_IMAGE_BIT, FormatSupport::Texture2D | FormatSupport::Sample) |
         When(linear, FormatSupport::SampleLinear) |
         When(color, FormatSupport::Texture2D | FormatSupport::RenderTarget) |
         When(f & VK_FORMAT_FEATURE_COLOR_ATTACHMENT_BLEND_BIT, FormatSupport::Blendable) |
         When(depth, FormatSupport::Texture2D | FormatSupport::DepthStencil) |
         When((f & VK_FORMAT_FEATURE_STORAGE_IMAGE_BIT) && !sRGB && !depth, FormatSupport::UnorderedAccess) |
         When(blit && linear && color, FormatSupport::MipAutogen);
}

}  // namespace

VkFormat ToVk(Format format) { return kFormats[size_t(format) < kFormats.size() ? size_t(format) : 0]; }

VkImageAspectFlags Aspects(Format format) {
  const FormatInfo& info = GetFormatInfo(format);
  if (!info.depth) return VK_IMAGE_ASPECT_COLOR_BIT;
  VkImageAspectFlags aspects = VK_IMAGE_ASPECT_DEPTH_BIT;
  if (info.stencil) aspects |= VK_IMAGE_ASPECT_STENCIL_BIT;
  return aspects;
}

FormatSupport QueryFormatSupport(const InstanceTable& vki, VkPhysicalDevice physical, Format format) {
  if (ToVk(format) == VK_FORMAT_UNDEFINED) return FormatSupport::None;
  VkFormatProperties p{};
  vki.vkGetPhysicalDeviceFormatProperties(physical, ToVk(format), &p);
  FormatSupport support = FormatSupport::None;
  // RGB32_Float is a format of vertex elements only; a driver may well sample it, but then not every backend could.
  if (format != Format::RGB32_Float) support = TextureSupport(p.optimalTilingFeatures, GetFormatInfo(format).sRGB);
  const bool vertex = p.bufferFeatures & VK_FORMAT_FEATURE_VERTEX_BUFFER_BIT;
  support = support | When(vertex, FormatSupport::Buffer | FormatSupport::VertexBuffer);
  if (format == Format::R16_UInt || format == Format::R32_UInt) support = support | FormatSupport::IndexBuffer;
  if (QueryMultisample(vki, physical, format, 4)) {
    support = support | FormatSupport::Multisample;
    // Depth cannot be resolved in Direct3D 10, and averaging integers has no meaning.
    if (!GetFormatInfo(format).depth && !GetFormatInfo(format).isInteger) support = support | FormatSupport::Resolve;
  }
  return support;
}

uint32_t QueryMultisample(const InstanceTable& vki, VkPhysicalDevice physical, Format format, uint32_t samples) {
  const FormatInfo& info = GetFormatInfo(format);
  if (format == Format::Unknown || format == Format::RGB32_Float || info.blockSize > 1) return 0;
  if (samples == 0 || samples > 64 || (samples & (samples - 1)) != 0) return 0;
  const VkImageUsageFlags target =
      info.depth ? VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT : VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT;
  VkImageFormatProperties p{};
  const VkResult result = vki.vkGetPhysicalDeviceImageFormatProperties(
      physical, ToVk(format), VK_IMAGE_TYPE_2D, VK_IMAGE_TILING_OPTIMAL, target | VK_IMAGE_USAGE_SAMPLED_BIT, 0, &p);
  return result == VK_SUCCESS && (p.sampleCounts & samples) != 0 ? 1 : 0;
}

}  // namespace rhi_vulkan

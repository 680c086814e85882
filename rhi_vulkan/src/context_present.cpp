// The way of a picture to an image of a window.
#include "context.h"
#include "formats.h"

namespace rhi_vulkan {
namespace {

constexpr VkImageSubresourceRange kWholeImage{VK_IMAGE_ASPECT_COLOR_BIT, 0, 1, 0, 1};

// What the image held does not matter. The stages are those that wait for the image to be free (Core::Submit), so that
// the change of layout waits too.
constexpr Dependency kTake{true,
                           VK_PIPELINE_STAGE_2_ALL_TRANSFER_BIT,
                           kCopyDest.stages,
                           VK_ACCESS_2_NONE,
                           kCopyDest.access,
                           VK_IMAGE_LAYOUT_UNDEFINED,
                           kCopyDest.layout};
// The semaphore that is signalled at the end of the submission makes the contents visible.
constexpr Dependency kGive{true,
                           kCopyDest.stages,
                           VK_PIPELINE_STAGE_2_NONE,
                           kCopyDest.access,
                           VK_ACCESS_2_NONE,
                           kCopyDest.layout,
                           VK_IMAGE_LAYOUT_PRESENT_SRC_KHR};

VkOffset3D Corner(uint32_t x, uint32_t y) { return {int32_t(x), int32_t(y), 1}; }

}  // namespace

Status Context::WriteWindowImage(Texture& from, const WindowImage& to, const PresentSync& sync) {
  EndPass(false);
  Use(from, from.All(), kCopySource);
  barriers_.Image(to.image, kWholeImage, kTake);
  RecordBarriers();
  const VkExtent2D size{from.Desc().width, from.Desc().height};
  const bool same = size.width == to.extent.width && size.height == to.extent.height;
  const VkImageSubresourceLayers layers{VK_IMAGE_ASPECT_COLOR_BIT, 0, 0, 1};
  if (same && ToVk(from.Desc().format) == to.format) {
    const VkImageCopy region{layers, {}, layers, {}, {size.width, size.height, 1}};
    vk_.vkCmdCopyImage(cmd_, from.image, kCopySource.layout, to.image, kCopyDest.layout, 1, &region);
  } else {
    const VkImageBlit region{
        layers, {{}, Corner(size.width, size.height)}, layers, {{}, Corner(to.extent.width, to.extent.height)}};
    vk_.vkCmdBlitImage(cmd_, from.image, kCopySource.layout, to.image, kCopyDest.layout, 1, &region,
                       same ? VK_FILTER_NEAREST : VK_FILTER_LINEAR);
  }
  barriers_.Image(to.image, kWholeImage, kGive);
  RecordBarriers();
  return SubmitAll(sync);
}

}  // namespace rhi_vulkan

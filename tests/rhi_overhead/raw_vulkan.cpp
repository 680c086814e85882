// The workload by hand on Vulkan: one command buffer, dynamic rendering, constants by dynamic offsets into a mapped
// ring.
#include "raw_vulkan.h"

#include <cstring>

namespace rhi_overhead {
namespace {

class RawVulkan final : public Loop {
 public:
  void Frame(uint32_t switchEvery) override;
  std::vector<uint8_t> Picture() override;

 private:
  void Begin();
  void BeginPass();
  void Draw(uint32_t switchEvery);
  void SubmitAndWait();
  void Transition(VkImageLayout from, VkImageLayout to);

  RawVulkanObjects o_;
};

void RawVulkan::Begin() {
  o_.vk.vkResetCommandPool(o_.device, o_.commandPool, 0);
  VkCommandBufferBeginInfo info{VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO};
  info.flags = VK_COMMAND_BUFFER_USAGE_ONE_TIME_SUBMIT_BIT;
  o_.vk.vkBeginCommandBuffer(o_.commands, &info);
}

void RawVulkan::Transition(VkImageLayout from, VkImageLayout to) {
  VkImageMemoryBarrier2 barrier{VK_STRUCTURE_TYPE_IMAGE_MEMORY_BARRIER_2};
  barrier.srcStageMask = barrier.dstStageMask = VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT;
  barrier.srcAccessMask = VK_ACCESS_2_MEMORY_WRITE_BIT;
  barrier.dstAccessMask = VK_ACCESS_2_MEMORY_READ_BIT | VK_ACCESS_2_MEMORY_WRITE_BIT;
  barrier.oldLayout = from;
  barrier.newLayout = to;
  barrier.image = o_.image;
  barrier.subresourceRange = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 1, 0, 1};
  VkDependencyInfo info{VK_STRUCTURE_TYPE_DEPENDENCY_INFO};
  info.imageMemoryBarrierCount = 1;
  info.pImageMemoryBarriers = &barrier;
  o_.vk.vkCmdPipelineBarrier2(o_.commands, &info);
}

void RawVulkan::BeginPass() {
  Transition(VK_IMAGE_LAYOUT_UNDEFINED, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL);
  VkRenderingAttachmentInfo color{VK_STRUCTURE_TYPE_RENDERING_ATTACHMENT_INFO};
  color.imageView = o_.view;
  color.imageLayout = VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL;
  color.loadOp = VK_ATTACHMENT_LOAD_OP_CLEAR;
  color.storeOp = VK_ATTACHMENT_STORE_OP_STORE;
  VkRenderingInfo info{VK_STRUCTURE_TYPE_RENDERING_INFO};
  info.renderArea.extent = {kSize, kSize};
  info.layerCount = info.colorAttachmentCount = 1;
  info.pColorAttachments = &color;
  o_.vk.vkCmdBeginRendering(o_.commands, &info);
}

void RawVulkan::Draw(uint32_t switchEvery) {
  const DrawConstants* constants = Constants().data();
  const VolkDeviceTable& vk = o_.vk;
  const VkCommandBuffer commands = o_.commands;
  uint32_t head = 0;
  for (uint32_t i = 0; i < kDraws; ++i) {
    if (i % switchEvery == 0)
      vk.vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, o_.pipelines[i / switchEvery & 1]);
    std::memcpy(o_.ringData + head, &constants[i], sizeof(DrawConstants));
    vk.vkCmdBindDescriptorSets(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, o_.layout, 0, 1, &o_.set, 1, &head);
    vk.vkCmdDraw(commands, 3, 1, 0, 0);
    head += o_.stride;
  }
}

void RawVulkan::SubmitAndWait() {
  Require(o_.vk.vkEndCommandBuffer(o_.commands), "vkEndCommandBuffer");
  VkCommandBufferSubmitInfo commands{VK_STRUCTURE_TYPE_COMMAND_BUFFER_SUBMIT_INFO};
  commands.commandBuffer = o_.commands;
  VkSubmitInfo2 info{VK_STRUCTURE_TYPE_SUBMIT_INFO_2};
  info.commandBufferInfoCount = 1;
  info.pCommandBufferInfos = &commands;
  Require(o_.vk.vkQueueSubmit2(o_.queue, 1, &info, o_.fence), "vkQueueSubmit2");
  Require(o_.vk.vkWaitForFences(o_.device, 1, &o_.fence, VK_TRUE, UINT64_MAX), "vkWaitForFences");
  Require(o_.vk.vkResetFences(o_.device, 1, &o_.fence), "vkResetFences");
}

void RawVulkan::Frame(uint32_t switchEvery) {
  Begin();
  BeginPass();
  Draw(switchEvery);
  o_.vk.vkCmdEndRendering(o_.commands);
  SubmitAndWait();
}

std::vector<uint8_t> RawVulkan::Picture() {
  Begin();
  Transition(VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL, VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL);
  VkBufferImageCopy copy{};
  copy.imageSubresource = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 0, 1};
  copy.imageExtent = {kSize, kSize, 1};
  o_.vk.vkCmdCopyImageToBuffer(o_.commands, o_.image, VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL, o_.read, 1, &copy);
  SubmitAndWait();
  return {o_.readData, o_.readData + kSize * kSize * 4};
}

}  // namespace

std::unique_ptr<Loop> MakeRawVulkan() { return std::make_unique<RawVulkan>(); }

}  // namespace rhi_overhead

#include "barriers.h"

namespace rhi_vulkan {

VkPipelineStageFlags2 StageBits(Stage stage) {
  switch (stage) {
    case Stage::Vertex: return VK_PIPELINE_STAGE_2_VERTEX_SHADER_BIT;
    case Stage::Geometry: return VK_PIPELINE_STAGE_2_GEOMETRY_SHADER_BIT;
    case Stage::Pixel: return VK_PIPELINE_STAGE_2_FRAGMENT_SHADER_BIT;
    case Stage::Compute: return VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT;
  }
  return VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT;
}

Access SampledRead(Stage stage, bool depth) {
  return {StageBits(stage), VK_ACCESS_2_SHADER_SAMPLED_READ_BIT,
          depth ? VK_IMAGE_LAYOUT_DEPTH_STENCIL_READ_ONLY_OPTIMAL : VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL};
}

Access StorageRead(Stage stage) { return {StageBits(stage), VK_ACCESS_2_SHADER_STORAGE_READ_BIT}; }

Access UniformRead(VkPipelineStageFlags2 stages) { return {stages, VK_ACCESS_2_UNIFORM_READ_BIT}; }

Dependency Advance(ResourceState& state, const Access& use) {
  const bool write = (use.access & kWriteAccess) != 0;
  Dependency d{false, state.writeStages, use.stages, state.writeAccess, use.access, state.layout, use.layout};
  if (!write && state.layout == use.layout) {
    const bool seen = (use.stages & ~state.readStages) == 0 && (use.access & ~state.readAccess) == 0;
    d.needed = !seen && state.writeStages != 0;
    // The earlier readers once more, so that every pair of a stage and an access in the state is covered.
    d.dstStages = state.readStages |= use.stages;
    d.dstAccess = state.readAccess |= use.access;
    return d;
  }
  // A write, or a change of layout, which is one: after all that came before.
  d.srcStages |= state.readStages;
  d.needed = d.srcStages != 0 || state.layout != use.layout;
  state.layout = use.layout;
  state.writeStages = use.stages;
  state.writeAccess = use.access & kWriteAccess;
  state.readStages = write ? 0 : use.stages;
  state.readAccess = write ? 0 : use.access;
  return d;
}

void BarrierBatch::Buffer(VkBuffer buffer, const Dependency& d) {
  VkBufferMemoryBarrier2 b{VK_STRUCTURE_TYPE_BUFFER_MEMORY_BARRIER_2};
  b.srcStageMask = d.srcStages;
  b.srcAccessMask = d.srcAccess;
  b.dstStageMask = d.dstStages;
  b.dstAccessMask = d.dstAccess;
  b.srcQueueFamilyIndex = b.dstQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED;
  b.buffer = buffer;
  b.size = VK_WHOLE_SIZE;
  buffers_.push_back(b);
}

void BarrierBatch::Image(VkImage image, const VkImageSubresourceRange& range, const Dependency& d) {
  VkImageMemoryBarrier2 b{VK_STRUCTURE_TYPE_IMAGE_MEMORY_BARRIER_2};
  b.srcStageMask = d.srcStages;
  b.srcAccessMask = d.srcAccess;
  b.dstStageMask = d.dstStages;
  b.dstAccessMask = d.dstAccess;
  b.oldLayout = d.oldLayout;
  b.newLayout = d.newLayout;
  b.srcQueueFamilyIndex = b.dstQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED;
  b.image = image;
  b.subresourceRange = range;
  images_.push_back(b);
}

uint32_t BarrierBatch::Record(const VolkDeviceTable& vk, VkCommandBuffer cmd) {
  if (Empty()) return 0;
  VkDependencyInfo info{VK_STRUCTURE_TYPE_DEPENDENCY_INFO};
  info.bufferMemoryBarrierCount = uint32_t(buffers_.size());
  info.pBufferMemoryBarriers = buffers_.data();
  info.imageMemoryBarrierCount = uint32_t(images_.size());
  info.pImageMemoryBarriers = images_.data();
  vk.vkCmdPipelineBarrier2(cmd, &info);
  const uint32_t count = uint32_t(buffers_.size() + images_.size());
  buffers_.clear();
  images_.clear();
  return count;
}

}  // namespace rhi_vulkan

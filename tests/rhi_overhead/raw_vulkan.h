// What the hand-written Vulkan loop is made of (raw_vulkan_setup.cpp): nothing that is measured.
#pragma once

#include <volk.h>

#include "workload.h"

namespace rhi_overhead {

void Require(VkResult, const char* what);  // throws unless VK_SUCCESS

struct RawVulkanObjects {
  RawVulkanObjects();
  ~RawVulkanObjects();
  RawVulkanObjects(const RawVulkanObjects&) = delete;
  RawVulkanObjects& operator=(const RawVulkanObjects&) = delete;

  VolkDeviceTable vk{};
  VkInstance instance = VK_NULL_HANDLE;
  VkPhysicalDevice physical = VK_NULL_HANDLE;
  VkDevice device = VK_NULL_HANDLE;
  VkQueue queue = VK_NULL_HANDLE;
  VkImage image = VK_NULL_HANDLE;
  VkImageView view = VK_NULL_HANDLE;
  VkDeviceMemory imageMemory = VK_NULL_HANDLE, ringMemory = VK_NULL_HANDLE, readMemory = VK_NULL_HANDLE;
  VkBuffer ring = VK_NULL_HANDLE, read = VK_NULL_HANDLE;
  uint8_t *ringData = nullptr, *readData = nullptr;
  uint32_t stride = 0;  // of one draw's constants in the ring
  VkDescriptorSetLayout setLayout = VK_NULL_HANDLE;
  VkPipelineLayout layout = VK_NULL_HANDLE;
  VkDescriptorPool descriptorPool = VK_NULL_HANDLE;
  VkDescriptorSet set = VK_NULL_HANDLE;
  std::array<VkPipeline, 2> pipelines{};
  VkCommandPool commandPool = VK_NULL_HANDLE;
  VkCommandBuffer commands = VK_NULL_HANDLE;
  VkFence fence = VK_NULL_HANDLE;

 private:
  void MakeInstance();
  void MakeDevice();
  uint32_t MemoryType(uint32_t allowed, VkMemoryPropertyFlags);
  VkDeviceMemory Allocate(const VkMemoryRequirements&, VkMemoryPropertyFlags);
  void MakeTarget();
  void MakeBuffer(VkDeviceSize, VkBufferUsageFlags, VkBuffer*, VkDeviceMemory*, uint8_t** data);
  void MakeDescriptors();
  void MakeCommands();
  VkPipeline MakePipeline(VkShaderModule vs, VkShaderModule ps, bool blend);
};

}  // namespace rhi_overhead

// The least allocator that serves: Debian 12 packages no VMA. Blocks of each memory type are split first-fit; buffers
// and images live in different blocks, so bufferImageGranularity never matters; big ones get a block of their own.
#pragma once

#include <memory>
#include <vector>

#include "vulkan_api.h"

namespace rhi_vulkan {

enum class MemoryKind : uint8_t {
  Gpu,      // device-local
  Upload,   // mapped, coherent, device-local if there is such a type: the CPU writes, the GPU reads
  Readback  // mapped, coherent, cached if there is such a type: the GPU writes, the CPU reads
};

struct MemoryBlock;
struct Allocation {
  MemoryBlock* block = nullptr;
  VkDeviceSize offset = 0, size = 0;
  uint8_t* mapped = nullptr;  // null for MemoryKind::Gpu
};

class Allocator {
 public:
  Allocator(const VolkDeviceTable& vk, VkDevice device, const VkPhysicalDeviceMemoryProperties& properties);
  ~Allocator();
  Allocator(const Allocator&) = delete;
  Allocator& operator=(const Allocator&) = delete;

  VkResult AllocateFor(VkBuffer, MemoryKind, Allocation*);  // and binds
  VkResult AllocateFor(VkImage, Allocation*);
  void Free(const Allocation&);  // null is fine

 private:
  VkResult Allocate(const VkMemoryRequirements&, MemoryKind, bool image, Allocation*);
  VkResult TryType(const VkMemoryRequirements&, uint32_t type, bool mapped, bool image, Allocation*);
  VkResult NewBlock(VkDeviceSize size, uint32_t type, bool mapped, bool image, MemoryBlock**);
  void DestroyBlock(MemoryBlock*);

  const VolkDeviceTable& vk_;
  VkDevice device_;
  VkPhysicalDeviceMemoryProperties properties_;
  std::vector<std::unique_ptr<MemoryBlock>> blocks_;
};

}  // namespace rhi_vulkan

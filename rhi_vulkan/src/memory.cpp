#include "memory.h"

namespace rhi_vulkan {

struct MemoryBlock {
  struct Range {
    VkDeviceSize offset, size;
  };
  VkDeviceMemory memory = VK_NULL_HANDLE;
  VkDeviceSize size = 0;
  uint32_t type = 0;
  bool image = false, hostMapped = false;
  uint8_t* mapped = nullptr;
  std::vector<Range> free;  // by offset, never adjacent

  bool Take(VkDeviceSize need, VkDeviceSize alignment, VkDeviceSize* offset);
  void Give(VkDeviceSize offset, VkDeviceSize bytes);
  bool Empty() const { return free.size() == 1 && free[0].size == size; }
};

namespace {

constexpr VkDeviceSize kBlockBytes = 32u << 20;

struct Wish {
  VkMemoryPropertyFlags need, like;
};
Wish WishOf(MemoryKind kind) {
  constexpr VkMemoryPropertyFlags kMapped =
      VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT | VK_MEMORY_PROPERTY_HOST_COHERENT_BIT;  // every driver has such a type
  switch (kind) {
    case MemoryKind::Gpu: return {0, VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT};
    case MemoryKind::Upload: return {kMapped, VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT};
    case MemoryKind::Readback: return {kMapped, VK_MEMORY_PROPERTY_HOST_CACHED_BIT};
  }
  return {};
}

}  // namespace

bool MemoryBlock::Take(VkDeviceSize need, VkDeviceSize alignment, VkDeviceSize* offset) {
  for (size_t i = 0; i < free.size(); ++i) {
    const Range range = free[i];
    const VkDeviceSize start = AlignUp(range.offset, alignment), end = start + need;
    if (end > range.offset + range.size) continue;
    const Range before{range.offset, start - range.offset}, after{end, range.offset + range.size - end};
    free.erase(free.begin() + ptrdiff_t(i));
    if (after.size) free.insert(free.begin() + ptrdiff_t(i), after);
    if (before.size) free.insert(free.begin() + ptrdiff_t(i), before);
    *offset = start;
    return true;
  }
  return false;
}

void MemoryBlock::Give(VkDeviceSize offset, VkDeviceSize bytes) {
  auto next =
      std::lower_bound(free.begin(), free.end(), offset, [](const Range& r, VkDeviceSize o) { return r.offset < o; });
  next = free.insert(next, {offset, bytes});
  if (auto after = next + 1; after != free.end() && next->offset + next->size == after->offset) {
    next->size += after->size;
    free.erase(after);
  }
  if (next == free.begin()) return;
  if (auto before = next - 1; before->offset + before->size == next->offset) {
    before->size += next->size;
    free.erase(next);
  }
}

Allocator::Allocator(const VolkDeviceTable& vk, VkDevice device, const VkPhysicalDeviceMemoryProperties& properties)
    : vk_(vk), device_(device), properties_(properties) {}

Allocator::~Allocator() {
  while (!blocks_.empty()) DestroyBlock(blocks_.back().get());
}

VkResult Allocator::AllocateFor(VkBuffer buffer, MemoryKind kind, Allocation* out) {
  VkMemoryRequirements need{};
  vk_.vkGetBufferMemoryRequirements(device_, buffer, &need);
  if (VkResult r = Allocate(need, kind, false, out); r != VK_SUCCESS) return r;
  return vk_.vkBindBufferMemory(device_, buffer, out->block->memory, out->offset);
}

VkResult Allocator::AllocateFor(VkImage image, Allocation* out) {
  VkMemoryRequirements need{};
  vk_.vkGetImageMemoryRequirements(device_, image, &need);
  if (VkResult r = Allocate(need, MemoryKind::Gpu, true, out); r != VK_SUCCESS) return r;
  return vk_.vkBindImageMemory(device_, image, out->block->memory, out->offset);
}

VkResult Allocator::Allocate(const VkMemoryRequirements& need, MemoryKind kind, bool image, Allocation* out) {
  const Wish wish = WishOf(kind);
  const bool mapped = kind != MemoryKind::Gpu;
  VkResult last = VK_ERROR_OUT_OF_DEVICE_MEMORY;
  // First the types that have all that is liked, then those that have what is needed.
  for (const VkMemoryPropertyFlags flags : {wish.need | wish.like, wish.need})
    for (uint32_t type = 0; type < properties_.memoryTypeCount; ++type) {
      if (!(need.memoryTypeBits & (1u << type))) continue;
      if ((properties_.memoryTypes[type].propertyFlags & flags) != flags) continue;
      last = TryType(need, type, mapped, image, out);
      if (last == VK_SUCCESS) return last;
    }
  return last;
}

VkResult Allocator::TryType(const VkMemoryRequirements& need, uint32_t type, bool mapped, bool image, Allocation* out) {
  MemoryBlock* found = nullptr;
  VkDeviceSize offset = 0;
  for (const auto& block : blocks_) {
    if (block->type != type || block->image != image || block->hostMapped != mapped) continue;
    if (!block->Take(need.size, need.alignment, &offset)) continue;
    found = block.get();
    break;
  }
  if (!found) {
    const VkDeviceSize size = need.size > kBlockBytes / 4 ? need.size : kBlockBytes;
    if (VkResult r = NewBlock(size, type, mapped, image, &found); r != VK_SUCCESS) return r;
    found->Take(need.size, need.alignment, &offset);
  }
  *out = {found, offset, need.size, found->mapped ? found->mapped + offset : nullptr};
  return VK_SUCCESS;
}

VkResult Allocator::NewBlock(VkDeviceSize size, uint32_t type, bool mapped, bool image, MemoryBlock** out) {
  auto block = std::make_unique<MemoryBlock>();
  block->size = size;
  block->type = type;
  block->image = image;
  block->hostMapped = mapped;
  block->free.push_back({0, size});
  VkMemoryAllocateInfo info{VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO};
  info.allocationSize = size;
  info.memoryTypeIndex = type;
  if (VkResult r = vk_.vkAllocateMemory(device_, &info, nullptr, &block->memory); r != VK_SUCCESS) return r;
  if (mapped) {
    void* data = nullptr;
    if (VkResult r = vk_.vkMapMemory(device_, block->memory, 0, VK_WHOLE_SIZE, 0, &data); r != VK_SUCCESS) {
      vk_.vkFreeMemory(device_, block->memory, nullptr);
      return r;
    }
    block->mapped = static_cast<uint8_t*>(data);
  }
  *out = block.get();
  blocks_.push_back(std::move(block));
  return VK_SUCCESS;
}

void Allocator::DestroyBlock(MemoryBlock* block) {
  vk_.vkFreeMemory(device_, block->memory, nullptr);  // unmaps too
  std::erase_if(blocks_, [&](const auto& b) { return b.get() == block; });
}

void Allocator::Free(const Allocation& allocation) {
  MemoryBlock* block = allocation.block;
  if (!block) return;
  block->Give(allocation.offset, allocation.size);
  if (!block->Empty()) return;
  // One empty block of a kind is kept, so that a frame that makes and drops a resource does not allocate.
  const bool spare = std::any_of(blocks_.begin(), blocks_.end(), [&](const auto& b) {
    return b.get() != block && b->type == block->type && b->image == block->image &&
           b->hostMapped == block->hostMapped && b->Empty();
  });
  if (spare || block->size > kBlockBytes) DestroyBlock(block);
}

}  // namespace rhi_vulkan

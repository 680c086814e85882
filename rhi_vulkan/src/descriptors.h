// Descriptor set layouts, made once for equal bindings, and the descriptor sets of one submission, found by contents.
#pragma once

#include <memory>
#include <unordered_map>
#include <vector>

#include "vulkan_api.h"

namespace rhi_vulkan {

class Core;

struct SetBinding {
  uint32_t binding;
  VkDescriptorType type;
  bool operator==(const SetBinding&) const = default;
};

struct SetLayout {
  VkDescriptorSetLayout handle = VK_NULL_HANDLE;
  VkShaderStageFlags stages = 0;
  std::vector<SetBinding> bindings;
};

class LayoutCache {
 public:
  explicit LayoutCache(Core& core) : core_(core) {}
  ~LayoutCache();

  Status Init();
  const SetLayout* Get(VkShaderStageFlags stages, std::vector<SetBinding> bindings);  // null: out of memory
  // Set 0 is the constants', then `sets`; null entries become the empty set.
  VkPipelineLayout GetPipelineLayout(const std::array<const SetLayout*, 3>& sets);
  const SetLayout* Constants() const { return constants_; }
  const SetLayout* Empty() const { return empty_; }

 private:
  struct PipelineLayout {
    std::array<const SetLayout*, 3> sets;
    VkPipelineLayout handle;
  };
  Core& core_;
  std::vector<std::unique_ptr<SetLayout>> sets_;
  std::vector<PipelineLayout> pipelines_;
  const SetLayout *constants_ = nullptr, *empty_ = nullptr;
};

// What a set holds, as words: equal words mean an equal set. Handles may be used again by the driver after their object
// is gone, so the words are ids that never are.
class SetKey {
 public:
  void Clear() { count_ = 0; }
  void Add(uint64_t word) { words_[count_++] = word; }
  uint64_t Hash() const;
  uint32_t Count() const { return count_; }
  const uint64_t* Words() const { return words_.data(); }

 private:
  std::array<uint64_t, 1 + 3 * 32> words_;
  uint32_t count_ = 0;
};

// Pools and sets of one submission.
class DescriptorArena {
 public:
  explicit DescriptorArena(Core& core) : core_(core) {}
  ~DescriptorArena();
  DescriptorArena(const DescriptorArena&) = delete;
  DescriptorArena& operator=(const DescriptorArena&) = delete;

  void Reset();
  // The set of `key`; *isNew: it is to be written now. Null: out of memory.
  VkDescriptorSet Find(const SetLayout&, const SetKey& key, bool* isNew);

 private:
  struct Entry {
    std::vector<uint64_t> words;
    VkDescriptorSet set;
  };
  VkDescriptorSet Allocate(VkDescriptorSetLayout);
  VkDescriptorPool NewPool();

  Core& core_;
  std::vector<VkDescriptorPool> pools_;
  size_t pool_ = 0;
  std::unordered_map<uint64_t, Entry> sets_;
};

}  // namespace rhi_vulkan

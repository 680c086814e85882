#include "descriptors.h"

#include <cstring>

#include "core.h"
#include "spirv.h"

namespace rhi_vulkan {
namespace {

VkShaderStageFlags AllStages(const Caps& caps) {
  VkShaderStageFlags stages = VK_SHADER_STAGE_VERTEX_BIT | VK_SHADER_STAGE_FRAGMENT_BIT | VK_SHADER_STAGE_COMPUTE_BIT;
  if (caps.geometryShader) stages |= VK_SHADER_STAGE_GEOMETRY_BIT;
  return stages;
}

}  // namespace

LayoutCache::~LayoutCache() {
  for (const PipelineLayout& p : pipelines_) core_.vk.vkDestroyPipelineLayout(core_.device, p.handle, nullptr);
  for (const auto& set : sets_) core_.vk.vkDestroyDescriptorSetLayout(core_.device, set->handle, nullptr);
}

Status LayoutCache::Init() {
  std::vector<SetBinding> registers;
  for (uint32_t i = 0; i < kMaxConstantBuffers; ++i)
    registers.push_back({i, VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER_DYNAMIC});
  if (!core_.adapter.features.drawParameters) registers.push_back({kStartsBinding, VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER});
  constants_ = Get(AllStages(core_.adapter.caps), std::move(registers));
  empty_ = Get(0, {});
  return constants_ && empty_ ? Status::Ok : core_.Failure();
}

const SetLayout* LayoutCache::Get(VkShaderStageFlags stages, std::vector<SetBinding> bindings) {
  if (bindings.empty()) stages = 0;
  for (const auto& set : sets_)
    if (set->stages == stages && set->bindings == bindings) return set.get();
  std::vector<VkDescriptorSetLayoutBinding> list;
  list.reserve(bindings.size());
  for (const SetBinding& b : bindings) list.push_back({b.binding, b.type, 1, stages, nullptr});
  VkDescriptorSetLayoutCreateInfo info{VK_STRUCTURE_TYPE_DESCRIPTOR_SET_LAYOUT_CREATE_INFO};
  info.bindingCount = uint32_t(list.size());
  info.pBindings = list.data();
  auto set = std::make_unique<SetLayout>();
  set->stages = stages;
  set->bindings = std::move(bindings);
  const VkResult result = core_.vk.vkCreateDescriptorSetLayout(core_.device, &info, nullptr, &set->handle);
  if (core_.Check(result, "", "vkCreateDescriptorSetLayout") != Status::Ok) return nullptr;
  sets_.push_back(std::move(set));
  return sets_.back().get();
}

VkPipelineLayout LayoutCache::GetPipelineLayout(const std::array<const SetLayout*, 3>& sets) {
  for (const PipelineLayout& p : pipelines_)
    if (p.sets == sets) return p.handle;
  std::array<VkDescriptorSetLayout, 4> handles{constants_->handle};
  for (uint32_t i = 0; i < 3; ++i) handles[i + 1] = sets[i] ? sets[i]->handle : empty_->handle;
  VkPipelineLayoutCreateInfo info{VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO};
  info.setLayoutCount = uint32_t(handles.size());
  info.pSetLayouts = handles.data();
  const VkPushConstantRange starts{VK_SHADER_STAGE_VERTEX_BIT, 0, sizeof(DrawStarts)};
  info.pushConstantRangeCount = core_.adapter.features.drawParameters ? 0 : 1;
  info.pPushConstantRanges = &starts;
  VkPipelineLayout layout = VK_NULL_HANDLE;
  if (core_.Check(core_.vk.vkCreatePipelineLayout(core_.device, &info, nullptr, &layout), "",
                  "vkCreatePipelineLayout") != Status::Ok)
    return VK_NULL_HANDLE;
  pipelines_.push_back({sets, layout});
  return layout;
}

uint64_t SetKey::Hash() const {
  uint64_t h = 0xcbf29ce484222325ull;
  for (uint32_t i = 0; i < count_; ++i) {
    h = (h ^ words_[i]) * 0x9e3779b97f4a7c15ull;
    h ^= h >> 29;
  }
  return h;
}

DescriptorArena::~DescriptorArena() {
  for (VkDescriptorPool pool : pools_) core_.vk.vkDestroyDescriptorPool(core_.device, pool, nullptr);
}

void DescriptorArena::Reset() {
  for (VkDescriptorPool pool : pools_) core_.vk.vkResetDescriptorPool(core_.device, pool, 0);
  pool_ = 0;
  sets_.clear();
}

VkDescriptorSet DescriptorArena::Find(const SetLayout& layout, const SetKey& key, bool* isNew) {
  const uint64_t hash = key.Hash();
  const auto it = sets_.find(hash);
  *isNew = false;
  if (it != sets_.end() && it->second.words.size() == key.Count() &&
      std::memcmp(it->second.words.data(), key.Words(), key.Count() * sizeof(uint64_t)) == 0)
    return it->second.set;
  const VkDescriptorSet set = Allocate(layout.handle);
  if (!set) return set;
  *isNew = true;
  // Should two keys ever share a hash, the later takes the place; the earlier's set stays valid and is made anew later.
  sets_[hash] = {std::vector<uint64_t>(key.Words(), key.Words() + key.Count()), set};
  return set;
}

VkDescriptorSet DescriptorArena::Allocate(VkDescriptorSetLayout layout) {
  VkDescriptorSetAllocateInfo info{VK_STRUCTURE_TYPE_DESCRIPTOR_SET_ALLOCATE_INFO};
  info.descriptorSetCount = 1;
  info.pSetLayouts = &layout;
  for (;; ++pool_) {
    const bool fresh = pool_ == pools_.size();
    if (fresh && !NewPool()) return VK_NULL_HANDLE;
    info.descriptorPool = pools_[pool_];
    VkDescriptorSet set = VK_NULL_HANDLE;
    const VkResult result = core_.vk.vkAllocateDescriptorSets(core_.device, &info, &set);
    if (result == VK_SUCCESS) return set;
    const bool full = result == VK_ERROR_OUT_OF_POOL_MEMORY || result == VK_ERROR_FRAGMENTED_POOL;
    if (full && !fresh) continue;
    core_.CheckOnce(result, "", "vkAllocateDescriptorSets");
    return VK_NULL_HANDLE;
  }
}

VkDescriptorPool DescriptorArena::NewPool() {
  constexpr uint32_t kSets = 256;
  constexpr auto kSizes = std::to_array<VkDescriptorPoolSize>({{VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER_DYNAMIC, kSets * 2},
                                                               {VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER, kSets},
                                                               {VK_DESCRIPTOR_TYPE_SAMPLED_IMAGE, kSets * 4},
                                                               {VK_DESCRIPTOR_TYPE_SAMPLER, kSets * 4},
                                                               {VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, kSets * 2},
                                                               {VK_DESCRIPTOR_TYPE_STORAGE_IMAGE, kSets}});
  VkDescriptorPoolCreateInfo info{VK_STRUCTURE_TYPE_DESCRIPTOR_POOL_CREATE_INFO};
  info.maxSets = kSets;
  info.poolSizeCount = uint32_t(kSizes.size());
  info.pPoolSizes = kSizes.data();
  VkDescriptorPool pool = VK_NULL_HANDLE;
  const VkResult result = core_.vk.vkCreateDescriptorPool(core_.device, &info, nullptr, &pool);
  if (core_.CheckOnce(result, "", "vkCreateDescriptorPool") != Status::Ok) return VK_NULL_HANDLE;
  pools_.push_back(pool);
  return pool;
}

}  // namespace rhi_vulkan

// Graphics pipelines, found by the ids of what they are made of. Viewports, scissors, the whole depth-stencil state,
// culling, depth bias, topology within its class and vertex strides are dynamic and so not part of the key.
#pragma once

#include <bit>
#include <unordered_map>

#include "core.h"
#include "states.h"

namespace rhi_vulkan {

enum class TopologyClass : uint8_t { Point, Line, Triangle, LineAdj, TriangleAdj };
TopologyClass ClassOf(PrimitiveTopology);
VkPrimitiveTopology ToVk(PrimitiveTopology);
bool IsStrip(PrimitiveTopology);

// Everything static. Compared and hashed as bytes: no padding, no pointers.
struct PipelineKey {
  uint32_t vs = 0, gs = 0, ps = 0;  // Shader::id
  uint32_t layout = 0, blend = 0;   // 0: none
  uint32_t sampleMask = ~0u;
  std::array<Format, kMaxRenderTargets> rtv{};  // Unknown: no target there
  Format dsv = Format::Unknown;
  TopologyClass topology = TopologyClass::Triangle;
  uint8_t rtvCount = 0, samples = 1;
  uint8_t wireframe = 0, depthClip = 1, unused[2]{};
  bool operator==(const PipelineKey&) const = default;
};
static_assert(sizeof(PipelineKey) == 6 * 4 + 8 + 8);

// The objects behind the key, for the moment of creation. Null states: defaults.
struct PipelineParts {
  Shader *vs = nullptr, *gs = nullptr, *ps = nullptr;
  const InputLayout* layout = nullptr;
  const BlendDesc* blend = nullptr;
};

struct Pipeline {
  VkPipeline handle = VK_NULL_HANDLE;  // null: see `status`
  Status status = Status::Ok;
  VkPipelineLayout layout = VK_NULL_HANDLE;
  std::array<const SetLayout*, 3> sets{};  // of vertex, geometry and pixel shader; null: no such shader
};

class PipelineCache {
 public:
  explicit PipelineCache(Core& core) : core_(core) {}
  ~PipelineCache();

  Status Init(const void* blob, size_t size);
  const Pipeline& Get(const PipelineKey&, const PipelineParts&);  // made if need be
  // What Get gave lately, for a fraction of its cost; null: ask Get.
  const Pipeline* Recent(const PipelineKey& key) const {
    const RecentEntry& entry = recent_[RecentSlot(key)];
    return entry.pipeline && SameBytes(entry.key, key) ? entry.pipeline : nullptr;
  }
  void ForgetFailed();           // those that failed for another reason than a shader: to be tried again
  void Forget(uint32_t shader);  // when a shader is destroyed: the GPU is past its pipelines
  // The driver's data behind a header of ours: drivers need not check what they are given, so we do.
  size_t Blob(void* out, size_t capacity);
  VkPipelineCache Handle() const { return cache_; }

  uint64_t made = 0;  // pipelines made so far; Stats::pipelineMisses

 private:
  struct Hash {
    size_t operator()(const PipelineKey&) const;
  };
  struct RecentEntry {
    PipelineKey key;
    const Pipeline* pipeline = nullptr;
  };
  using Words = std::array<uint64_t, sizeof(PipelineKey) / 8>;
  static bool SameBytes(const PipelineKey& a, const PipelineKey& b) {
    const auto x = std::bit_cast<Words>(a), y = std::bit_cast<Words>(b);
    return ((x[0] ^ y[0]) | (x[1] ^ y[1]) | (x[2] ^ y[2]) | (x[3] ^ y[3]) | (x[4] ^ y[4])) == 0;
  }
  static size_t RecentSlot(const PipelineKey& k) {  // shaders and blending are what changes between draws
    return (k.vs * 5u + k.gs * 11u + k.ps + k.blend * 31u) % kRecent;
  }
  static constexpr size_t kRecent = 64;

  Pipeline Make(const PipelineKey&, const PipelineParts&);
  const char* ProblemOf(const void* blob, size_t size) const;  // null: the driver may have it
  VkResult Create(const void* data, size_t size);

  Core& core_;
  VkPipelineCache cache_ = VK_NULL_HANDLE;
  std::unordered_map<PipelineKey, Pipeline, Hash> pipelines_;
  bool anyFailed_ = false;
  std::array<RecentEntry, kRecent> recent_{};  // into pipelines_, whose elements stay where they are
};

}  // namespace rhi_vulkan

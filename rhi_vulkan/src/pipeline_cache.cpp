#include <cstring>

#include "pipeline.h"

namespace rhi_vulkan {
namespace {

constexpr size_t kBlobHeaderBytes = 32;  // VkPipelineCacheHeaderVersionOne

// For want of memory, say, and not because the driver refuses it.
bool FailedForNow(const Pipeline& p) { return p.status != Status::Ok && p.status != Status::CompileFailed; }

}  // namespace

TopologyClass ClassOf(PrimitiveTopology topology) {
  switch (topology) {
    case PrimitiveTopology::PointList: return TopologyClass::Point;
    case PrimitiveTopology::LineList:
    case PrimitiveTopology::LineStrip: return TopologyClass::Line;
    case PrimitiveTopology::LineListAdj:
    case PrimitiveTopology::LineStripAdj: return TopologyClass::LineAdj;
    case PrimitiveTopology::TriangleListAdj:
    case PrimitiveTopology::TriangleStripAdj: return TopologyClass::TriangleAdj;
    default: return TopologyClass::Triangle;
  }
}

VkPrimitiveTopology ToVk(PrimitiveTopology topology) {
  switch (topology) {
    case PrimitiveTopology::PointList: return VK_PRIMITIVE_TOPOLOGY_POINT_LIST;
    case PrimitiveTopology::LineList: return VK_PRIMITIVE_TOPOLOGY_LINE_LIST;
    case PrimitiveTopology::LineStrip: return VK_PRIMITIVE_TOPOLOGY_LINE_STRIP;
    case PrimitiveTopology::TriangleList: return VK_PRIMITIVE_TOPOLOGY_TRIANGLE_LIST;
    case PrimitiveTopology::TriangleStrip: return VK_PRIMITIVE_TOPOLOGY_TRIANGLE_STRIP;
    case PrimitiveTopology::LineListAdj: return VK_PRIMITIVE_TOPOLOGY_LINE_LIST_WITH_ADJACENCY;
    case PrimitiveTopology::LineStripAdj: return VK_PRIMITIVE_TOPOLOGY_LINE_STRIP_WITH_ADJACENCY;
    case PrimitiveTopology::TriangleListAdj: return VK_PRIMITIVE_TOPOLOGY_TRIANGLE_LIST_WITH_ADJACENCY;
    case PrimitiveTopology::TriangleStripAdj: return VK_PRIMITIVE_TOPOLOGY_TRIANGLE_STRIP_WITH_ADJACENCY;
  }
  return VK_PRIMITIVE_TOPOLOGY_TRIANGLE_LIST;
}

bool IsStrip(PrimitiveTopology topology) {
  return topology == PrimitiveTopology::LineStrip || topology == PrimitiveTopology::TriangleStrip ||
         topology == PrimitiveTopology::LineStripAdj || topology == PrimitiveTopology::TriangleStripAdj;
}

size_t PipelineCache::Hash::operator()(const PipelineKey& key) const {
  std::array<uint64_t, sizeof(PipelineKey) / 8> words;
  std::memcpy(words.data(), &key, sizeof key);
  uint64_t h = 0;
  for (const uint64_t word : words) {
    h = (h ^ word) * 0x9e3779b97f4a7c15ull;
    h ^= h >> 32;
  }
  return size_t(h);
}

PipelineCache::~PipelineCache() {
  for (const auto& [key, pipeline] : pipelines_) core_.vk.vkDestroyPipeline(core_.device, pipeline.handle, nullptr);
  if (cache_) core_.vk.vkDestroyPipelineCache(core_.device, cache_, nullptr);
}

bool PipelineCache::BlobFits(const void* blob, size_t size) const {
  VkPipelineCacheHeaderVersionOne header{};
  if (size < kBlobHeaderBytes) return false;
  std::memcpy(&header, blob, kBlobHeaderBytes);
  const VkPhysicalDeviceProperties& p = core_.adapter.properties;
  return header.headerSize == kBlobHeaderBytes && header.headerVersion == VK_PIPELINE_CACHE_HEADER_VERSION_ONE &&
         header.vendorID == p.vendorID && header.deviceID == p.deviceID &&
         std::memcmp(header.pipelineCacheUUID, p.pipelineCacheUUID, VK_UUID_SIZE) == 0;
}

Status PipelineCache::Init(const void* blob, size_t size) {
  VkPipelineCacheCreateInfo info{VK_STRUCTURE_TYPE_PIPELINE_CACHE_CREATE_INFO};
  if (blob && BlobFits(blob, size)) {
    info.initialDataSize = size;
    info.pInitialData = blob;
  } else if (blob) {
    core_.log.Report(Severity::Info, MsgCode::None, "",
                     "the pipeline cache blob is of another driver or adapter, or damaged; it is ignored");
  }
  return core_.Check(core_.vk.vkCreatePipelineCache(core_.device, &info, nullptr, &cache_), "",
                     "vkCreatePipelineCache");
}

const Pipeline& PipelineCache::Get(const PipelineKey& key, const PipelineParts& parts) {
  const auto [it, isNew] = pipelines_.try_emplace(key);
  if (isNew) it->second = Make(key, parts);  // a refused pipeline is remembered too, so that it is tried once
  anyFailed_ = anyFailed_ || FailedForNow(it->second);
  recent_[RecentSlot(key)] = {key, &it->second};
  return it->second;
}

void PipelineCache::ForgetFailed() {
  if (!anyFailed_) return;
  anyFailed_ = false;
  recent_ = {};
  std::erase_if(pipelines_, [](const auto& entry) { return FailedForNow(entry.second); });
}

void PipelineCache::Forget(uint32_t shader) {
  recent_ = {};
  std::erase_if(pipelines_, [&](const auto& entry) {
    const PipelineKey& key = entry.first;
    if (key.vs != shader && key.gs != shader && key.ps != shader) return false;
    core_.vk.vkDestroyPipeline(core_.device, entry.second.handle, nullptr);
    return true;
  });
}

size_t PipelineCache::Blob(void* out, size_t capacity) {
  size_t size = 0;
  if (core_.lost) return 0;
  const VkResult result = core_.vk.vkGetPipelineCacheData(core_.device, cache_, &size, nullptr);
  if (core_.Check(result, "", "vkGetPipelineCacheData") != Status::Ok) return 0;
  if (!core_.adapter.caps.pipelineCacheBlob || size <= kBlobHeaderBytes) return 0;
  if (out && capacity >= size) core_.vk.vkGetPipelineCacheData(core_.device, cache_, &size, out);
  return size;
}

}  // namespace rhi_vulkan

#include <cstring>

#include "pipeline.h"

namespace rhi_vulkan {
namespace {

constexpr size_t kDriverHeaderBytes = 32;  // VkPipelineCacheHeaderVersionOne

struct BlobHeader {
  uint64_t magic, bytes, hash;  // bytes and hash: of what follows, the driver's data
};
constexpr uint64_t kBlobMagic = 0x3143'4550'4950'5546;  // "FUPIPEC1"

// FNV-1a: every changed bit changes it.
uint64_t HashOf(const uint8_t* data, size_t bytes) {
  uint64_t h = 0xcbf29ce484222325ull;
  for (size_t i = 0; i < bytes; ++i) h = (h ^ data[i]) * 0x100000001b3ull;
  return h;
}

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

const char* PipelineCache::ProblemOf(const void* blob, size_t size) const {
  BlobHeader ours;
  VkPipelineCacheHeaderVersionOne driver{};
  if (size < sizeof ours + kDriverHeaderBytes) return "it is too short";
  std::memcpy(&ours, blob, sizeof ours);
  const uint8_t* data = static_cast<const uint8_t*>(blob) + sizeof ours;
  if (ours.magic != kBlobMagic) return "it does not come from GetPipelineCacheBlob";
  if (ours.bytes != size - sizeof ours || ours.hash != HashOf(data, ours.bytes)) return "it is damaged";
  std::memcpy(&driver, data, kDriverHeaderBytes);
  const VkPhysicalDeviceProperties& p = core_.adapter.properties;
  const bool fits = driver.headerSize == kDriverHeaderBytes &&
                    driver.headerVersion == VK_PIPELINE_CACHE_HEADER_VERSION_ONE && driver.vendorID == p.vendorID &&
                    driver.deviceID == p.deviceID &&
                    std::memcmp(driver.pipelineCacheUUID, p.pipelineCacheUUID, VK_UUID_SIZE) == 0;
  return fits ? nullptr : "it is of another driver or adapter, or of another version of the driver";
}

VkResult PipelineCache::Create(const void* data, size_t size) {
  VkPipelineCacheCreateInfo info{VK_STRUCTURE_TYPE_PIPELINE_CACHE_CREATE_INFO};
  info.initialDataSize = size;
  info.pInitialData = data;
  return core_.vk.vkCreatePipelineCache(core_.device, &info, nullptr, &cache_);
}

Status PipelineCache::Init(const void* blob, size_t size) {
  const char* problem = blob ? ProblemOf(blob, size) : nullptr;
  if (blob && !problem) {
    if (Create(static_cast<const uint8_t*>(blob) + sizeof(BlobHeader), size - sizeof(BlobHeader)) == VK_SUCCESS)
      return Status::Ok;
    cache_ = VK_NULL_HANDLE;
    problem = "the driver does not take it";
  }
  if (problem)
    core_.log.Report(Severity::Warning, MsgCode::PipelineCacheRefused, "",
                     "the pipeline cache blob of %zu bytes is ignored: %s; pipelines are made anew", size, problem);
  return core_.Check(Create(nullptr, 0), "", "vkCreatePipelineCache");
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
  size_t bytes = 0;
  if (core_.lost || !core_.adapter.caps.pipelineCacheBlob) return 0;
  const auto get = [&](uint8_t* data) {
    const VkResult result = core_.vk.vkGetPipelineCacheData(core_.device, cache_, &bytes, data);
    return core_.Check(result, "", "vkGetPipelineCacheData") == Status::Ok;
  };
  if (!get(nullptr) || bytes <= kDriverHeaderBytes) return 0;
  if (!out || capacity < sizeof(BlobHeader) + bytes) return sizeof(BlobHeader) + bytes;
  uint8_t* data = static_cast<uint8_t*>(out) + sizeof(BlobHeader);
  if (!get(data)) return 0;
  const BlobHeader ours{kBlobMagic, bytes, HashOf(data, bytes)};
  std::memcpy(out, &ours, sizeof ours);
  return sizeof ours + bytes;
}

}  // namespace rhi_vulkan

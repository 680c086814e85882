#include "queries.h"

#include <cmath>
#include <cstring>

namespace rhi_vulkan {
namespace {

constexpr uint32_t kPoolSlots = 64;

VkQueryType ToVk(SegmentKind kind) {
  switch (kind) {
    case SegmentKind::Occlusion: return VK_QUERY_TYPE_OCCLUSION;
    case SegmentKind::Statistics: return VK_QUERY_TYPE_PIPELINE_STATISTICS;
    case SegmentKind::Timestamp: return VK_QUERY_TYPE_TIMESTAMP;
  }
  return VK_QUERY_TYPE_OCCLUSION;
}

template <class T>
Status Give(const T& value, void* data) {
  if (data) std::memcpy(data, &value, sizeof value);
  return Status::Ok;
}

}  // namespace

QuerySegment::~QuerySegment() { heap.free_[size_t(kind)].push_back({pool, index, heap.core_.recording}); }

QueryHeap::~QueryHeap() {
  for (VkQueryPool pool : pools_) core_.vk.vkDestroyQueryPool(core_.device, pool, nullptr);
}

VkQueryPipelineStatisticFlags QueryHeap::Statistics() const {
  VkQueryPipelineStatisticFlags flags = VK_QUERY_PIPELINE_STATISTIC_INPUT_ASSEMBLY_VERTICES_BIT |
                                        VK_QUERY_PIPELINE_STATISTIC_INPUT_ASSEMBLY_PRIMITIVES_BIT |
                                        VK_QUERY_PIPELINE_STATISTIC_VERTEX_SHADER_INVOCATIONS_BIT |
                                        VK_QUERY_PIPELINE_STATISTIC_CLIPPING_INVOCATIONS_BIT |
                                        VK_QUERY_PIPELINE_STATISTIC_CLIPPING_PRIMITIVES_BIT |
                                        VK_QUERY_PIPELINE_STATISTIC_FRAGMENT_SHADER_INVOCATIONS_BIT |
                                        VK_QUERY_PIPELINE_STATISTIC_COMPUTE_SHADER_INVOCATIONS_BIT;
  if (core_.adapter.caps.geometryShader)
    flags |= VK_QUERY_PIPELINE_STATISTIC_GEOMETRY_SHADER_INVOCATIONS_BIT |
             VK_QUERY_PIPELINE_STATISTIC_GEOMETRY_SHADER_PRIMITIVES_BIT;
  return flags;
}

uint32_t QueryHeap::ValueCount(SegmentKind kind) const {
  if (kind != SegmentKind::Statistics) return 1;
  return core_.adapter.caps.geometryShader ? 9 : 7;
}

bool QueryHeap::NewPool(SegmentKind kind) {
  VkQueryPoolCreateInfo info{VK_STRUCTURE_TYPE_QUERY_POOL_CREATE_INFO};
  info.queryType = ToVk(kind);
  info.queryCount = kPoolSlots;
  if (kind == SegmentKind::Statistics) info.pipelineStatistics = Statistics();
  VkQueryPool pool = VK_NULL_HANDLE;
  const VkResult result = core_.vk.vkCreateQueryPool(core_.device, &info, nullptr, &pool);
  if (core_.CheckOnce(result, "", "vkCreateQueryPool") != Status::Ok) return false;
  pools_.push_back(pool);
  for (uint32_t i = 0; i < kPoolSlots; ++i) free_[size_t(kind)].push_front({pool, i, 0});
  return true;
}

std::shared_ptr<QuerySegment> QueryHeap::Take(SegmentKind kind) {
  std::deque<Slot>& list = free_[size_t(kind)];
  if ((list.empty() || list.front().serial > core_.Completed()) && !NewPool(kind)) return nullptr;
  const Slot slot = list.front();
  list.pop_front();
  core_.vk.vkResetQueryPool(core_.device, slot.pool, slot.index, 1);
  return std::shared_ptr<QuerySegment>(new QuerySegment{*this, kind, slot.pool, slot.index});
}

Status QueryHeap::AddResults(const QuerySegment& s, std::array<uint64_t, kMaxSegmentValues>* sums) const {
  std::array<uint64_t, kMaxSegmentValues> values{};
  const uint32_t count = ValueCount(s.kind);
  const VkResult result = core_.vk.vkGetQueryPoolResults(core_.device, s.pool, s.index, 1, count * sizeof(uint64_t),
                                                         values.data(), sizeof values, VK_QUERY_RESULT_64_BIT);
  if (result == VK_NOT_READY) return Status::StillDrawing;
  if (Status status = core_.Check(result, "", "vkGetQueryPoolResults"); status != Status::Ok) return status;
  // Without geometry shaders their two values are missing in the middle.
  if (s.kind == SegmentKind::Statistics && count == 7) {
    std::copy_backward(values.begin() + 3, values.begin() + 7, values.end());
    values[3] = values[4] = 0;
  }
  for (uint32_t i = 0; i < kMaxSegmentValues; ++i) (*sums)[i] += values[i];
  return Status::Ok;
}

Status Query::Read(const QueryHeap& heap, void* data) const {
  std::array<uint64_t, kMaxSegmentValues> sums{};
  for (const auto& segment : segments)
    if (Status s = heap.AddResults(*segment, &sums); s != Status::Ok) return s;
  switch (type_) {
    case QueryType::Event: return Give(true, data);
    case QueryType::Occlusion:
    case QueryType::Timestamp: return Give(sums[0], data);
    case QueryType::OcclusionPredicate: return Give(sums[0] != 0, data);
    case QueryType::TimestampDisjoint: {
      const double period = core_->adapter.caps.timestampPeriodNs;
      return Give(TimestampDisjoint{period > 0 ? uint64_t(std::llround(1e9 / period)) : 0, false}, data);
    }
    case QueryType::PipelineStatistics: {
      PipelineStatistics out{};
      static_assert(sizeof out == sizeof sums);
      std::memcpy(&out, sums.data(), sizeof out);
      return Give(out, data);
    }
  }
  return Status::InternalError;
}

}  // namespace rhi_vulkan

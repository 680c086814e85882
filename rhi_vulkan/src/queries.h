// Queries. Vulkan wants a query to begin and end inside one pass or outside of all, Direct3D 10 does not care: so a
// query is the sum of segments, one for each pass (or dispatch) between its Begin and its End. Queries of one kind that
// run at the same time share segments, because Vulkan runs only one of a kind.
#pragma once

#include "core.h"

namespace rhi_vulkan {

enum class SegmentKind : uint8_t { Occlusion, Statistics, Timestamp };
inline constexpr uint32_t kSegmentKinds = 3;
inline constexpr uint32_t kMaxSegmentValues = 9;

class QueryHeap;

struct QuerySegment {
  QueryHeap& heap;
  SegmentKind kind;
  VkQueryPool pool;
  uint32_t index;
  ~QuerySegment();
};

// Slots of query pools, used again when the GPU has passed their last use.
class QueryHeap {
 public:
  explicit QueryHeap(Core& core) : core_(core) {}
  ~QueryHeap();
  std::shared_ptr<QuerySegment> Take(SegmentKind);  // reset and ready; null: out of memory
  // Adds the segment's values; the GPU must be past it.
  Status AddResults(const QuerySegment&, std::array<uint64_t, kMaxSegmentValues>* sums) const;
  uint32_t ValueCount(SegmentKind) const;

 private:
  friend struct QuerySegment;
  struct Slot {
    VkQueryPool pool;
    uint32_t index;
    uint64_t serial;  // free when this one is complete
  };
  bool NewPool(SegmentKind);
  VkQueryPipelineStatisticFlags Statistics() const;

  Core& core_;
  std::vector<VkQueryPool> pools_;
  std::array<std::deque<Slot>, kSegmentKinds> free_;
};

class Query final : public VkObject<IQuery> {
 public:
  Query(std::shared_ptr<Core> core, QueryType type) : VkObject(std::move(core)), type_(type) {}
  QueryType Type() const override { return type_; }
  Status Read(const QueryHeap&, void* data) const;  // null: only whether it is there

  std::vector<std::shared_ptr<QuerySegment>> segments;
  uint64_t serial = 0;  // submission of its End; 0: never ended
  bool active = false;

 private:
  QueryType type_;
};

}  // namespace rhi_vulkan

// Queries. GL runs one of a kind at a time, Direct3D 10 any number: so a query is the sum of segments, and queries that
// run at the same time share them.
#pragma once

#include "core.h"

namespace rhi_gl {

using backend::Object;

// The kinds of which GL runs one query at a time.
inline constexpr uint32_t kQueryTargets = 2;  // samples passed, pipeline statistics

// GL queries that begin and end together: one, or one for each pipeline statistic.
class QuerySegment {
 public:
  static constexpr uint32_t kMaxNames = 9;

  QuerySegment(const CorePtr& core, QueryType type);
  ~QuerySegment();
  QuerySegment(const QuerySegment&) = delete;
  QuerySegment& operator=(const QuerySegment&) = delete;

  void Begin();
  void End();  // of one that does not run: nothing
  void Stamp();
  bool Ready() const;
  void AddTo(std::array<uint64_t, kMaxNames>* sums) const;

 private:
  CorePtr core_;
  QueryType type_;
  uint32_t count_;
  bool running_ = false;
  std::array<GLuint, kMaxNames> names_{};
};
using SegmentPtr = std::shared_ptr<QuerySegment>;

class Query final : public Object<IQuery> {
 public:
  static Status Create(const CorePtr&, const QueryDesc&, Ref<IQuery>* out);
  ~Query() override;
  QueryType Type() const override { return type; }

  enum class State : uint8_t { Idle, Active, Ended };

  bool HasBegin() const { return type != QueryType::Event && type != QueryType::Timestamp; }
  // Index into the context's running segments; kQueryTargets: none is needed.
  uint32_t Target() const;
  // An old segment that nobody shares is used again.
  SegmentPtr TakeSegment();
  void EndGl();
  bool Ready(bool flush);
  void Result(void* out) const;

  const QueryType type;
  State state = State::Idle;
  std::vector<SegmentPtr> segments;

 private:
  Query(const CorePtr& core, QueryType t) : type(t), core_(core) {}

  CorePtr core_;
  GLsync fence_ = nullptr;
};

}  // namespace rhi_gl

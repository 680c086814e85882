#pragma once

#include "core.h"

namespace rhi_gl {

using backend::Object;

// The kinds of which GL runs one query at a time.
inline constexpr uint32_t kQueryTargets = 2;  // samples passed, pipeline statistics

class Query final : public Object<IQuery> {
 public:
  static Status Create(const CorePtr&, const QueryDesc&, Ref<IQuery>* out);
  ~Query() override;
  QueryType Type() const override { return type; }

  enum class State : uint8_t { Idle, Active, Ended };
  static constexpr uint32_t kMaxNames = 9;

  bool HasBegin() const { return type != QueryType::Event && type != QueryType::Timestamp; }
  // Index into the context's active queries; kQueryTargets: none is needed.
  uint32_t Target() const;
  void BeginGl();
  void EndGl();
  bool Ready(bool flush);
  uint32_t ResultSize() const;
  void Result(void* out) const;

  const QueryType type;
  State state = State::Idle;

 private:
  Query(const CorePtr& core, QueryType t) : type(t), core_(core) {}
  uint64_t Value(uint32_t i) const;

  CorePtr core_;
  uint32_t nameCount_ = 0;
  std::array<GLuint, kMaxNames> names_{};
  GLsync fence_ = nullptr;
};

}  // namespace rhi_gl

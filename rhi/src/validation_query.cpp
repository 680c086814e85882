// Queries, debug events, the end of a frame.
#include "validation_context.h"

#include "rhi/backend/data_checks.h"

namespace rhi::validation {
namespace {

const char* ToString(QueryType type) {
  constexpr auto kNames = std::to_array<const char*>(
      {"Event", "Occlusion", "OcclusionPredicate", "Timestamp", "TimestampDisjoint", "PipelineStatistics"});
  return size_t(type) < kNames.size() ? kNames[size_t(type)] : "no QueryType";
}

bool HasBegin(QueryType type) { return type != QueryType::Event && type != QueryType::Timestamp; }
bool CountsWork(QueryType type) { return HasBegin(type) && type != QueryType::TimestampDisjoint; }

}  // namespace

bool Context::CheckBegin(IQuery* query) {
  if (!NotNull("Begin", query, "the query") || !v_.Owns("Begin", query)) return false;
  const QueryType type = query->Type();
  if (!HasBegin(type))
    return v_.Error(MsgCode::QueryOrder, query, "Begin of a query of type %s, which takes only End; it is ignored",
                    ToString(type));
  if (v_.objects.Find(query)->active)
    return v_.Error(MsgCode::QueryOrder, query,
                    "Begin of a query that is begun already; call End first; it is ignored");
  return true;
}

void Context::Begin(IQuery* query) {
  if (!CheckBegin(query)) return;
  ObjectRecord& record = *v_.objects.Find(query);
  record.active = true;
  record.ended = false;
  record.workAtBegin = work_;
  inner_.Begin(query);
}

bool Context::CheckEnd(IQuery* query) {
  if (!NotNull("End", query, "the query") || !v_.Owns("End", query)) return false;
  const ObjectRecord& record = *v_.objects.Find(query);
  if (HasBegin(query->Type()) && !record.active)
    return v_.Error(MsgCode::QueryOrder, query, "End of a query of type %s without Begin; it is ignored",
                    ToString(query->Type()));
  if (CountsWork(query->Type()) && record.workAtBegin == work_)
    v_.Inform(MsgCode::QueryEmpty, query,
              "End of a query of type %s with no draw or dispatch since its Begin; its result will be 0; put the draws "
              "between them",
              ToString(query->Type()));
  return true;
}

void Context::End(IQuery* query) {
  if (!CheckEnd(query)) return;
  ObjectRecord& record = *v_.objects.Find(query);
  record.active = false;
  record.ended = true;
  inner_.End(query);
}

Status Context::GetData(IQuery* query, void* data, uint32_t size, bool flush) {
  if (!query) {
    v_.Error(MsgCode::QueryOrder, {nullptr, "GetData"}, "GetData of no query");
    return Status::InvalidArg;
  }
  if (!v_.Owns("GetData", query)) return Status::InvalidArg;
  if (!v_.objects.Find(query)->ended) {
    v_.Error(MsgCode::QueryOrder, query, "GetData of a query of type %s that was not ended; call End first",
             ToString(query->Type()));
    return Status::InvalidArg;
  }
  if (data && size != backend::ResultSize(query->Type())) {
    v_.Error(MsgCode::OutOfBounds, query, "GetData: %u bytes given, the result of type %s has %u", size,
             ToString(query->Type()), backend::ResultSize(query->Type()));
    return Status::InvalidArg;
  }
  return inner_.GetData(query, data, size, flush);
}

void Context::BeginEvent(const char* name) {
  if (!NotNull("BeginEvent", name, "the name")) return;
  ++eventDepth_;
  inner_.BeginEvent(name);
}

void Context::EndEvent() {
  if (eventDepth_ == 0) {
    v_.Warn(MsgCode::QueryOrder, {nullptr, "EndEvent"}, "EndEvent without a BeginEvent; it is ignored");
    return;
  }
  --eventDepth_;
  inner_.EndEvent();
}

void Context::CheckOpenAtFrameEnd() {
  for (const auto& [object, record] : v_.objects.Records()) {
    if (record.AnyMapped())
      v_.Warn(MsgCode::MapOpen, object, "EndFrame while a %s is mapped; call Unmap before",
              validation::ToString(record.kind));
    if (record.active)
      v_.Warn(MsgCode::QueryOpen, object, "EndFrame while a query of type %s is begun and not ended; call End before",
              ToString(static_cast<const IQuery*>(object)->Type()));
  }
  if (eventDepth_ > 0)
    v_.Warn(MsgCode::EventOpen, {nullptr, "EndFrame"},
            "EndFrame with %u events open; call EndEvent for each BeginEvent", eventDepth_);
}

void Context::EndFrame() {
  CheckOpenAtFrameEnd();
  inner_.EndFrame();
  v_.objects.Sweep();
  v_.NewFrame();
}

}  // namespace rhi::validation

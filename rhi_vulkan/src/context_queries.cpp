#include "context.h"
#include "rhi/backend/data_checks.h"

namespace rhi_vulkan {
namespace {

bool IsRange(QueryType type) {
  return type == QueryType::Occlusion || type == QueryType::OcclusionPredicate || type == QueryType::PipelineStatistics;
}

size_t KindOf(QueryType type) {
  return size_t(type == QueryType::PipelineStatistics ? SegmentKind::Statistics : SegmentKind::Occlusion);
}

}  // namespace

// Starts what is active: all inside a pass, only statistics around a dispatch.
void Context::StartSegments(bool compute) {
  for (size_t kind = compute ? 1 : 0; kind < active_.size(); ++kind) {
    if (active_[kind].empty() || running_[kind]) continue;
    running_[kind] = core_->queries->Take(SegmentKind(kind));
    if (!running_[kind]) continue;
    const bool precise = SegmentKind(kind) == SegmentKind::Occlusion && core_->adapter.caps.occlusionPrecise;
    const VkQueryControlFlags flags = precise ? VkQueryControlFlags(VK_QUERY_CONTROL_PRECISE_BIT) : 0;
    vk_.vkCmdBeginQuery(cmd_, running_[kind]->pool, running_[kind]->index, flags);
  }
}

void Context::StopSegments() {
  for (size_t kind = 0; kind < active_.size(); ++kind) {
    if (!running_[kind]) continue;
    vk_.vkCmdEndQuery(cmd_, running_[kind]->pool, running_[kind]->index);
    for (const Ref<Query>& query : active_[kind]) query->segments.push_back(running_[kind]);
    running_[kind].reset();
  }
}

void Context::Begin(IQuery* target) {
  auto* query = static_cast<Query*>(target);
  if (!query) return Complain(MsgCode::QueryOrder, "", "Begin of no query; it is ignored");
  const bool disjoint = query->Type() == QueryType::TimestampDisjoint;  // Vulkan's timestamps never are
  if (disjoint && !query->active) {
    query->active = true;
    return;
  }
  if (!IsRange(query->Type()) || query->active) {
    log_.Report(Severity::Error, MsgCode::QueryOrder, query->Name().c_str(),
                "Begin of an Event or Timestamp query, or of one that is begun already; it is ignored");
    return;
  }
  StopSegments();  // the new query must not count what came before
  query->segments.clear();
  query->active = true;
  query->serial = 0;
  active_[KindOf(query->Type())].push_back(Ref<Query>(query));
  if (inPass_) StartSegments(false);
}

void Context::End(IQuery* target) {
  auto* query = static_cast<Query*>(target);
  if (!query) return Complain(MsgCode::QueryOrder, "", "End of no query; it is ignored");
  const bool needsBegin = IsRange(query->Type()) || query->Type() == QueryType::TimestampDisjoint;
  if (needsBegin && !query->active) {
    log_.Report(Severity::Error, MsgCode::QueryOrder, query->Name().c_str(),
                "End of a query without Begin; it is ignored");
    return;
  }
  query->active = false;
  query->serial = core_->recording;
  if (query->Type() == QueryType::Timestamp) {
    query->segments.assign(1, core_->queries->Take(SegmentKind::Timestamp));
    if (!query->segments[0]) return query->segments.clear();
    vk_.vkCmdWriteTimestamp2(cmd_, VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT, query->segments[0]->pool,
                             query->segments[0]->index);
  }
  if (!IsRange(query->Type())) return;
  StopSegments();
  std::erase_if(active_[KindOf(query->Type())], [&](const Ref<Query>& q) { return q.get() == query; });
  if (inPass_) StartSegments(false);
}

Status Context::GetData(IQuery* target, void* data, uint32_t size, bool flush) {
  auto* query = static_cast<Query*>(target);
  if (core_->lost) return Status::DeviceLost;
  if (!query || query->active || query->serial == 0) {
    log_.Report(Severity::Error, MsgCode::QueryOrder, query ? query->Name().c_str() : "",
                "GetData before End; there is nothing to wait for");
    return Status::InvalidArg;
  }
  if (data && size != backend::ResultSize(query->Type())) {
    log_.Report(Severity::Error, MsgCode::OutOfBounds, query->Name().c_str(),
                "GetData: %u bytes given, the result has %u", size, backend::ResultSize(query->Type()));
    return Status::InvalidArg;
  }
  if (query->serial == core_->recording) {
    if (!flush) return Status::StillDrawing;
    Flush();
  }
  if (core_->Completed() < query->serial) return core_->lost ? Status::DeviceLost : Status::StillDrawing;
  return query->Read(*core_->queries, data);
}

}  // namespace rhi_vulkan

#include "queries.h"

#include <cstring>

#include "context.h"

namespace rhi_gl {
namespace {

// In the order of rhi::PipelineStatistics.
constexpr std::array<GLenum, Query::kMaxNames> kStatistics{GL_VERTICES_SUBMITTED_ARB,
                                                           GL_PRIMITIVES_SUBMITTED_ARB,
                                                           GL_VERTEX_SHADER_INVOCATIONS_ARB,
                                                           GL_GEOMETRY_SHADER_INVOCATIONS,
                                                           GL_GEOMETRY_SHADER_PRIMITIVES_EMITTED_ARB,
                                                           GL_CLIPPING_INPUT_PRIMITIVES_ARB,
                                                           GL_CLIPPING_OUTPUT_PRIMITIVES_ARB,
                                                           GL_FRAGMENT_SHADER_INVOCATIONS_ARB,
                                                           GL_COMPUTE_SHADER_INVOCATIONS_ARB};
static_assert(sizeof(PipelineStatistics) == sizeof(uint64_t) * Query::kMaxNames);

GLenum TargetOf(QueryType type, uint32_t i) {
  switch (type) {
    case QueryType::Occlusion:
    case QueryType::OcclusionPredicate: return GL_SAMPLES_PASSED;
    case QueryType::PipelineStatistics: return kStatistics[i];
    default: return GL_TIMESTAMP;
  }
}

uint32_t NamesOf(QueryType type) {
  switch (type) {
    case QueryType::Event:
    case QueryType::TimestampDisjoint: return 0;
    case QueryType::PipelineStatistics: return Query::kMaxNames;
    default: return 1;
  }
}

}  // namespace

Status Query::Create(const CorePtr& core, const QueryDesc& desc, Ref<IQuery>* out) {
  if (desc.type > QueryType::PipelineStatistics) {
    core->log.Report(Severity::Error, MsgCode::InvalidDesc, "", "QueryDesc::type %u is none", uint32_t(desc.type));
    return Status::InvalidArg;
  }
  if (desc.type == QueryType::PipelineStatistics && !core->caps.pipelineStatistics) {
    core->log.Report(Severity::Error, MsgCode::CapMissing, "", "this driver has no pipeline statistics");
    return Status::Unsupported;
  }
  auto query = Ref<Query>::Adopt(new Query(core, desc.type));
  query->nameCount_ = NamesOf(desc.type);
  // Not glCreateQueries: Mesa's knows no pipeline statistics.
  glGenQueries(GLsizei(query->nameCount_), query->names_.data());
  *out = query;
  return Status::Ok;
}

Query::~Query() {
  for (uint32_t i = 0; i < nameCount_; ++i) core_->Discard(NameKind::Query, names_[i]);
  core_->DiscardSync(fence_);
}

uint32_t Query::Target() const {
  if (type == QueryType::Occlusion || type == QueryType::OcclusionPredicate) return 0;
  return type == QueryType::PipelineStatistics ? 1 : kQueryTargets;
}

void Query::BeginGl() {
  state = State::Active;
  for (uint32_t i = 0; i < nameCount_; ++i) glBeginQuery(TargetOf(type, i), names_[i]);
}

void Query::EndGl() {
  state = State::Ended;
  if (type == QueryType::Event) {
    core_->DiscardSync(fence_);
    fence_ = glFenceSync(GL_SYNC_GPU_COMMANDS_COMPLETE, 0);
  } else if (type == QueryType::Timestamp) {
    glQueryCounter(names_[0], GL_TIMESTAMP);
  } else {
    for (uint32_t i = 0; i < nameCount_; ++i) glEndQuery(TargetOf(type, i));
  }
}

bool Query::Ready(bool flush) {
  if (type == QueryType::Event) {
    const GLenum s = glClientWaitSync(fence_, flush ? GL_SYNC_FLUSH_COMMANDS_BIT : 0u, 0);
    return s == GL_ALREADY_SIGNALED || s == GL_CONDITION_SATISFIED;
  }
  if (flush) glFlush();
  for (uint32_t i = 0; i < nameCount_; ++i) {
    GLuint available = GL_FALSE;
    glGetQueryObjectuiv(names_[i], GL_QUERY_RESULT_AVAILABLE, &available);
    if (!available) return false;
  }
  return true;
}

uint64_t Query::Value(uint32_t i) const {
  GLuint64 value = 0;
  glGetQueryObjectui64v(names_[i], GL_QUERY_RESULT, &value);
  return value;
}

uint32_t Query::ResultSize() const {
  switch (type) {
    case QueryType::Event:
    case QueryType::OcclusionPredicate: return sizeof(bool);
    case QueryType::Occlusion:
    case QueryType::Timestamp: return sizeof(uint64_t);
    case QueryType::TimestampDisjoint: return sizeof(TimestampDisjoint);
    case QueryType::PipelineStatistics: return sizeof(PipelineStatistics);
  }
  return 0;
}

void Query::Result(void* out) const {
  const auto put = [out](const auto& value) { std::memcpy(out, &value, sizeof value); };
  switch (type) {
    case QueryType::Event: return put(true);
    case QueryType::OcclusionPredicate: return put(Value(0) != 0);
    case QueryType::Occlusion:
    case QueryType::Timestamp: return put(Value(0));
    case QueryType::TimestampDisjoint: return put(TimestampDisjoint{1'000'000'000, false});  // GL's unit is 1 ns
    case QueryType::PipelineStatistics: break;
  }
  std::array<uint64_t, kMaxNames> values;
  for (uint32_t i = 0; i < kMaxNames; ++i) values[i] = Value(i);
  std::memcpy(out, values.data(), sizeof values);
}

// ------------------------------------------------------------------------------------------------------- the context

bool Context::CheckQuery(const Query& q, bool begin) {
  const char* wrong = nullptr;
  const uint32_t target = q.Target();
  if (begin && !q.HasBegin()) wrong = "Event and Timestamp take only End";
  if (begin && q.state == Query::State::Active) wrong = "Begin was called already; call End first";
  if (begin && !wrong && target < kQueryTargets && activeQueries_[target])
    wrong = "another query of this kind is active; GL runs one at a time, so end it first";
  if (!begin && q.HasBegin() && q.state != Query::State::Active) wrong = "End needs a Begin";
  if (wrong) log_.Report(Severity::Error, MsgCode::QueryOrder, q.Name().c_str(), "%s", wrong);
  return !wrong;
}

void Context::Begin(IQuery* query) {
  auto* q = static_cast<Query*>(query);
  if (!Enter() || !q || !CheckQuery(*q, true)) return;
  q->BeginGl();
  // Held until its End: GL's query must not die while it runs.
  if (q->Target() < kQueryTargets) activeQueries_[q->Target()] = Ref<Query>(q);
}

void Context::End(IQuery* query) {
  auto* q = static_cast<Query*>(query);
  if (!Enter() || !q || !CheckQuery(*q, false)) return;
  q->EndGl();
  if (q->Target() < kQueryTargets) activeQueries_[q->Target()] = nullptr;
}

Status Context::GetData(IQuery* query, void* data, uint32_t size, bool flush) {
  auto* q = static_cast<Query*>(query);
  if (!core_.Alive() || !Enter()) return Status::DeviceLost;
  if (!q || q->state != Query::State::Ended) {
    log_.Report(Severity::Error, MsgCode::QueryOrder, q ? q->Name().c_str() : "",
                "GetData needs a query that was ended");
    return Status::InvalidArg;
  }
  if (data && size != q->ResultSize()) {
    log_.Report(Severity::Error, MsgCode::OutOfBounds, q->Name().c_str(), "GetData: %u bytes given, the result has %u",
                size, q->ResultSize());
    return Status::InvalidArg;
  }
  if (!q->Ready(flush)) return Status::StillDrawing;
  if (data) q->Result(data);
  return Status::Ok;
}

}  // namespace rhi_gl

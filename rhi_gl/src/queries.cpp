#include "queries.h"

#include "rhi/backend/data_checks.h"

#include <cstring>

#include "context.h"

namespace rhi_gl {
namespace {

// In the order of rhi::PipelineStatistics.
constexpr std::array<GLenum, QuerySegment::kMaxNames> kStatistics{GL_VERTICES_SUBMITTED_ARB,
                                                                  GL_PRIMITIVES_SUBMITTED_ARB,
                                                                  GL_VERTEX_SHADER_INVOCATIONS_ARB,
                                                                  GL_GEOMETRY_SHADER_INVOCATIONS,
                                                                  GL_GEOMETRY_SHADER_PRIMITIVES_EMITTED_ARB,
                                                                  GL_CLIPPING_INPUT_PRIMITIVES_ARB,
                                                                  GL_CLIPPING_OUTPUT_PRIMITIVES_ARB,
                                                                  GL_FRAGMENT_SHADER_INVOCATIONS_ARB,
                                                                  GL_COMPUTE_SHADER_INVOCATIONS_ARB};
static_assert(sizeof(PipelineStatistics) == sizeof(uint64_t) * QuerySegment::kMaxNames);

GLenum TargetOf(QueryType type, uint32_t i) {
  switch (type) {
    case QueryType::Occlusion:
    case QueryType::OcclusionPredicate: return GL_SAMPLES_PASSED;
    case QueryType::PipelineStatistics: return kStatistics[i];
    default: return GL_TIMESTAMP;
  }
}

}  // namespace

// Not glCreateQueries: Mesa's knows no pipeline statistics.
QuerySegment::QuerySegment(const CorePtr& core, QueryType type)
    : core_(core), type_(type), count_(type == QueryType::PipelineStatistics ? kMaxNames : 1) {
  glGenQueries(GLsizei(count_), names_.data());
}

QuerySegment::~QuerySegment() {
  for (uint32_t i = 0; i < count_; ++i) core_->Discard(NameKind::Query, names_[i]);
}

void QuerySegment::Begin() {
  running_ = true;
  for (uint32_t i = 0; i < count_; ++i) glBeginQuery(TargetOf(type_, i), names_[i]);
}

void QuerySegment::End() {
  if (!running_) return;
  running_ = false;
  for (uint32_t i = 0; i < count_; ++i) glEndQuery(TargetOf(type_, i));
}

void QuerySegment::Stamp() { glQueryCounter(names_[0], GL_TIMESTAMP); }

bool QuerySegment::Ready() const {
  for (uint32_t i = 0; i < count_; ++i) {
    GLuint available = GL_FALSE;
    glGetQueryObjectuiv(names_[i], GL_QUERY_RESULT_AVAILABLE, &available);
    if (!available) return false;
  }
  return true;
}

void QuerySegment::AddTo(std::array<uint64_t, kMaxNames>* sums) const {
  for (uint32_t i = 0; i < count_; ++i) {
    GLuint64 value = 0;
    glGetQueryObjectui64v(names_[i], GL_QUERY_RESULT, &value);
    (*sums)[i] += value;
  }
}

Status Query::Create(const CorePtr& core, const QueryDesc& desc, Ref<IQuery>* out) {
  if (desc.type > QueryType::PipelineStatistics) {
    core->log.Report(Severity::Error, MsgCode::InvalidDesc, "", "QueryDesc::type %u is none", uint32_t(desc.type));
    return Status::InvalidArg;
  }
  if (desc.type == QueryType::PipelineStatistics && !core->caps.pipelineStatistics) {
    core->log.Report(Severity::Error, MsgCode::CapMissing, "", "this driver has no pipeline statistics");
    return Status::Unsupported;
  }
  *out = Ref<Query>::Adopt(new Query(core, desc.type));
  return Status::Ok;
}

Query::~Query() { core_->DiscardSync(fence_); }

uint32_t Query::Target() const {
  if (type == QueryType::Occlusion || type == QueryType::OcclusionPredicate) return 0;
  return type == QueryType::PipelineStatistics ? 1 : kQueryTargets;
}

SegmentPtr Query::TakeSegment() {
  SegmentPtr free;
  if (!segments.empty() && segments[0].use_count() == 1) free = std::move(segments[0]);
  segments.clear();
  return free ? free : std::make_shared<QuerySegment>(core_, type);
}

void Query::EndGl() {
  state = State::Ended;
  if (type == QueryType::Event) {
    core_->DiscardSync(fence_);
    fence_ = glFenceSync(GL_SYNC_GPU_COMMANDS_COMPLETE, 0);
  } else if (type == QueryType::Timestamp) {
    segments.push_back(TakeSegment());
    segments[0]->Stamp();
  } else {
    for (const SegmentPtr& s : segments) s->End();
  }
}

bool Query::Ready(bool flush) {
  if (type == QueryType::Event) {
    const GLenum s = glClientWaitSync(fence_, flush ? GL_SYNC_FLUSH_COMMANDS_BIT : 0u, 0);
    return s == GL_ALREADY_SIGNALED || s == GL_CONDITION_SATISFIED;
  }
  if (flush) glFlush();
  return std::all_of(segments.begin(), segments.end(), [](const SegmentPtr& s) { return s->Ready(); });
}

void Query::Result(void* out) const {
  std::array<uint64_t, QuerySegment::kMaxNames> sums{};
  for (const SegmentPtr& s : segments) s->AddTo(&sums);
  const auto put = [out](const auto& value) { std::memcpy(out, &value, sizeof value); };
  switch (type) {
    case QueryType::Event: return put(true);
    case QueryType::OcclusionPredicate: return put(sums[0] != 0);
    case QueryType::Occlusion:
    case QueryType::Timestamp: return put(sums[0]);
    case QueryType::TimestampDisjoint: return put(TimestampDisjoint{1'000'000'000, false});  // GL's unit is 1 ns
    case QueryType::PipelineStatistics: return put(sums);
  }
}

// ------------------------------------------------------------------------------------------------------- the context

bool Context::CheckQuery(const Query* q, bool begin) {
  const char* wrong = nullptr;
  if (!q) {
    wrong = begin ? "Begin of no query; it is ignored" : "End of no query; it is ignored";
  } else if (begin && !q->HasBegin()) {
    wrong = "Event and Timestamp take only End";
  } else if (begin && q->state == Query::State::Active) {
    wrong = "Begin was called already; call End first";
  } else if (!begin && q->HasBegin() && q->state != Query::State::Active) {
    wrong = "End needs a Begin";
  }
  if (wrong) log_.Report(Severity::Error, MsgCode::QueryOrder, q ? q->Name().c_str() : "", "%s", wrong);
  return !wrong;
}

// What runs has counted all it should; what is still active goes on in a new segment.
void Context::NextSegment(uint32_t target, SegmentPtr next) {
  if (runningSegments_[target]) runningSegments_[target]->End();
  runningSegments_[target] = nullptr;
  for (const Ref<Query>& q : activeQueries_) {
    if (q->Target() != target) continue;
    if (!next) next = std::make_shared<QuerySegment>(corePtr_, q->type);
    q->segments.push_back(next);
    runningSegments_[target] = next;
  }
  if (runningSegments_[target]) runningSegments_[target]->Begin();
}

void Context::Begin(IQuery* query) {
  auto* q = static_cast<Query*>(query);
  if (!Enter() || !CheckQuery(q, true)) return;
  q->state = Query::State::Active;
  if (q->Target() == kQueryTargets) return;
  SegmentPtr segment = q->TakeSegment();
  activeQueries_.push_back(Ref<Query>(q));  // held until its End: GL's query must not die while it runs
  NextSegment(q->Target(), std::move(segment));
}

void Context::End(IQuery* query) {
  auto* q = static_cast<Query*>(query);
  if (!Enter() || !CheckQuery(q, false)) return;
  const uint32_t target = q->Target();
  if (target == kQueryTargets) return q->EndGl();
  q->state = Query::State::Ended;
  const Ref<Query> held(q);
  std::erase_if(activeQueries_, [q](const Ref<Query>& active) { return active.get() == q; });
  NextSegment(target, nullptr);
}

Status Context::GetData(IQuery* query, void* data, uint32_t size, bool flush) {
  auto* q = static_cast<Query*>(query);
  if (!core_.Alive() || !Enter()) return Status::DeviceLost;
  if (!q || q->state != Query::State::Ended) {
    log_.Report(Severity::Error, MsgCode::QueryOrder, q ? q->Name().c_str() : "",
                "GetData needs a query that was ended");
    return Status::InvalidArg;
  }
  if (data && size != backend::ResultSize(q->type)) {
    log_.Report(Severity::Error, MsgCode::OutOfBounds, q->Name().c_str(), "GetData: %u bytes given, the result has %u",
                size, backend::ResultSize(q->type));
    return Status::InvalidArg;
  }
  if (!q->Ready(flush)) return Status::StillDrawing;
  if (data) q->Result(data);
  return Status::Ok;
}

}  // namespace rhi_gl

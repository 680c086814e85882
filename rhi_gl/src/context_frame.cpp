// The life of the context, frames, debug groups.
#include <cstring>

#include "context.h"

namespace rhi_gl {

using namespace backend;

Context::Context(IDevice& device, const CorePtr& core, const DeviceDesc& desc)
    : ContextBase(core->log),
      device_(device),
      corePtr_(core),
      core_(*core),
      ring_(*core, desc.ringPageBytes),
      framesInFlight_(std::max(desc.framesInFlight, 1u)) {
  glCreateVertexArrays(1, &emptyArray_.name);
  emptyArray_.uid = core_.NewUid();
  core_.context = this;
  CreateSamplerState(core, SamplerDesc{}, &defaultSampler_);
  CreateSamplerState(core, {.min = Filter::Point, .mag = Filter::Point, .mip = Filter::Point}, &loadSampler_);
}

// The other GL objects of the context end with it.
Context::~Context() {
  core_.context = nullptr;
  const bool usable = core_.Enter();
  for (const Ref<Query>& q : activeQueries_)
    if (q && usable) q->EndGl();
  ClearState();
}

void Context::ReportOnce(Severity severity, MsgCode code, const char* format, ...) {
  uint64_t& frame = reported_[uint16_t(code)];
  if (frame == core_.frames.Current()) return;
  frame = core_.frames.Current();
  char text[1024];
  va_list args;
  va_start(args, format);
  std::vsnprintf(text, sizeof text, format, args);
  va_end(args);
  log_.Report(severity, code, "", "%s", text);
}

void Context::LoseThread() {
  dirty_ |= DirtyThread;
  ring_.Close();
}

bool Context::Enter() {
  if (!core_.Enter()) return false;
  if (!(dirty_ & DirtyThread)) return true;
  dirty_ &= ~uint32_t(DirtyThread);
  ring_.Open();
  return true;
}

void Context::AfterFrame() {
  if (ring_.Recycle()) dirty_ |= DirtyConstants;
  firstVertex_ = -1;  // its slice of the ring may be used again
  core_.Drain();
  LoseThread();  // between frames somebody else may have used the thread
}

// What was waited for is there only if the device still is.
Status Context::FinishAll() {
  core_.Finish();
  if (!core_.Alive()) return Status::DeviceLost;
  AfterFrame();
  return Status::Ok;
}

void Context::Flush() {
  if (!Enter()) return;
  core_.Drain();
  glFlush();
  core_.Alive();
}

void Context::EndFrame() {
  if (!Enter()) return;
  const bool done = core_.frames.EndFrame(framesInFlight_);
  if (!core_.Alive() || (!done && !core_.Lose("the GPU does not finish its work"))) return;
  AfterFrame();
}

Status Context::WaitIdle() {
  if (!Enter()) return Status::DeviceLost;
  const Status status = FinishAll();
  core_.Leave();  // so that another thread may go on with the device
  return status;
}

void Context::BeginEvent(const char* name) {
  if (!Enter()) return;
  // GL's stack holds itself as its first entry; deeper groups are counted only.
  if (++eventDepth_ >= core_.limits.maxDebugGroups) return;
  const size_t length = std::min<size_t>(std::strlen(name = name ? name : ""), core_.limits.maxDebugMessage - 1);
  glPushDebugGroup(GL_DEBUG_SOURCE_APPLICATION, 0, GLsizei(length), name);
}

void Context::EndEvent() {
  if (!Enter()) return;
  if (eventDepth_ == 0) {
    ReportOnce(Severity::Warning, MsgCode::QueryOrder, "EndEvent without a BeginEvent is ignored");
    return;
  }
  if (eventDepth_-- < core_.limits.maxDebugGroups) glPopDebugGroup();
}

Status Context::Precache(const PipelineKeyDesc& key) {
  if (!core_.Alive() || !Enter()) return Status::DeviceLost;
  const auto *vs = static_cast<const Shader*>(key.vs), *gs = static_cast<const Shader*>(key.gs),
             *ps = static_cast<const Shader*>(key.ps);
  const bool fit =
      vs && vs->stage == Stage::Vertex && (!gs || gs->stage == Stage::Geometry) && (!ps || ps->stage == Stage::Pixel);
  if (!fit || key.rtvCount > kMaxRenderTargets) {
    Refuse(MsgCode::NoVertexShader, "", "PrecachePipeline",
           "it needs a vertex shader, each shader in its place, and at most 8 targets");
    return Status::InvalidArg;
  }
  const Program& program = core_.programs.Get(vs, gs, ps, &stats_.pipelineMisses);
  return program.name ? Status::Ok : Status::CompileFailed;
}

Stats Context::GetStats(bool reset) {
  Stats result = stats_;
  result.ringBytes += ring_.Taken() - ringTakenAtReset_;
  if (reset) {
    stats_ = {};
    ringTakenAtReset_ = ring_.Taken();
  }
  return result;
}

}  // namespace rhi_gl

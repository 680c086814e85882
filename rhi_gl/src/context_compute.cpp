#include "context.h"
#include "rhi/backend/data_checks.h"

namespace rhi_gl {

using namespace backend;

void Context::Barrier() {
  glMemoryBarrier(GL_ALL_BARRIER_BITS);
  ++stats_.barriers;
  dirty_ &= ~uint32_t(DirtyBarrier);
}

bool Context::Settle() {
  if (!Enter()) return false;
  if (dirty_ & DirtyBarrier) Barrier();
  return true;
}

bool Context::PrepareDispatch() {
  const auto* shader = static_cast<const Shader*>(state_.shaders[size_t(Stage::Compute)].get());
  if (!shader) {
    ReportOnce(Severity::Error, MsgCode::NothingBound, "a dispatch is skipped: no compute shader is set");
    return false;
  }
  if (!Settle()) return false;
  gl_.UseProgram(shader->code->uid, shader->code->computeProgram);
  BindStage(Stage::Compute, *shader);
  BindUavs(*shader);
  BindConstants(0xF);
  dirty_ &= ~uint32_t(DirtyConstants);
  return true;
}

void Context::FinishDispatch() {
  const auto* shader = static_cast<const Shader*>(state_.shaders[size_t(Stage::Compute)].get());
  ++stats_.dispatches;
  if (!shader->writable.empty()) dirty_ |= DirtyBarrier;
  // Compute shares program, units and blocks with the other stages: the next draw must look at all of them again.
  dirty_ |= DirtyShaders;
}

void Context::Dispatch(uint32_t x, uint32_t y, uint32_t z) {
  if (CheckGroups(x, y, z).Refuses(log_, "") || !PrepareDispatch()) return;
  glDispatchCompute(x, y, z);
  FinishDispatch();
}

void Context::DispatchIndirect(IBuffer* args, uint32_t offset) {
  const Buffer* buffer = CheckIndirect(args, offset, sizeof(DispatchArgs));
  if (!buffer || !PrepareDispatch()) return;
  gl_.UseDispatchIndirect(buffer->uid, buffer->name);
  glDispatchComputeIndirect(GLintptr(uint64_t(buffer->offset) + offset));
  FinishDispatch();
}

}  // namespace rhi_gl

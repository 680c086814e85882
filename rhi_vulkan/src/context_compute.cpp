// Dispatches. They are few, so nothing is remembered from one to the next.
#include "context.h"
#include "rhi/backend/data_checks.h"

namespace rhi_vulkan {

void Context::Dispatch(uint32_t x, uint32_t y, uint32_t z) {
  if (backend::CheckGroups(x, y, z).Refuses(log_, "") || !PrepareDispatch()) return;
  vk_.vkCmdDispatch(cmd_, x, y, z);
  EndDispatch();
}

void Context::DispatchIndirect(IBuffer* args, uint32_t offset) {
  LeavePass();
  Buffer* buffer = PrepareIndirect(args, offset, sizeof(DispatchArgs), kNoStarts);
  if (!buffer || !PrepareDispatch()) return;
  vk_.vkCmdDispatchIndirect(cmd_, buffer->Handle(), buffer->Offset() + offset);
  EndDispatch();
}

bool Context::PrepareDispatch() {
  const auto* shader = static_cast<const Shader*>(state_.shaders[size_t(Stage::Compute)].get());
  if (!shader) {
    Report(Severity::Error, MsgCode::NothingBound, "",
           "dispatch without a compute shader; call CSSetShader; it is skipped");
    return false;
  }
  if (core_->lost) return false;
  LeavePass();
  UseStageInputs(Stage::Compute, shader);
  for (const ShaderResource& r : shader->reflection.resources) {
    const bool writable = r.kind == ShaderResourceKind::RWTexture || r.kind == ShaderResourceKind::RWStructuredBuffer;
    auto* view = writable ? static_cast<UavView*>(state_.uavs[r.slot].get()) : nullptr;
    if (view && view->texture) Use(*view->texture, view->Range(), kStorageWrite);
    if (view && view->buffer) Use(*view->buffer, kStorageWrite);
    if (r.kind != ShaderResourceKind::RWTexture || core_->adapter.features.nullDescriptor) continue;
    if (view && Fits(*view, r)) continue;
    Report(Severity::Error, view ? MsgCode::ViewMismatch : MsgCode::NothingBound, r.name,
           "nothing that fits is bound to a RWTexture register, and this driver has no null descriptors; the dispatch "
           "is skipped");
    return false;
  }
  for (const Ref<IBuffer>& constants : state_.constants)
    if (constants) Use(static_cast<Buffer&>(*constants), UniformRead(StageBits(Stage::Compute)));
  RecordBarriers();

  const bool hasInputs = !shader->layout->bindings.empty(), hasUavs = !shader->uavLayout->bindings.empty();
  const std::array<VkDescriptorSet, 3> sets{ConstantSet(), hasInputs ? StageSet(Stage::Compute, *shader) : nullptr,
                                            hasUavs ? UavSet(*shader) : nullptr};
  if (!sets[0] || (hasInputs && !sets[1]) || (hasUavs && !sets[2])) return false;  // out of memory
  vk_.vkCmdBindPipeline(cmd_, VK_PIPELINE_BIND_POINT_COMPUTE, shader->compute);
  for (uint32_t i = 0; i < sets.size(); ++i)
    if (sets[i])
      vk_.vkCmdBindDescriptorSets(cmd_, VK_PIPELINE_BIND_POINT_COMPUTE, shader->computeLayout, i, 1, &sets[i],
                                  i == 0 ? kMaxConstantBuffers : 0, constantOffsets_.data());
  StartSegments(true);
  return true;
}

void Context::EndDispatch() {
  StopSegments();
  ++stats_.dispatches;
}

}  // namespace rhi_vulkan

#include "rhi/backend/context_base.h"

#include <cstring>

namespace rhi::backend {
namespace {

// As bits, so that a NaN equals itself; two words, because a call of memcmp costs more than the comparison.
bool SameFactors(const float* a, const float* b) {
  uint64_t x[2], y[2];
  std::memcpy(x, a, sizeof x);
  std::memcpy(y, b, sizeof y);
  return x[0] == y[0] && x[1] == y[1];
}

bool RangesOverlap(uint32_t firstA, uint32_t countA, uint32_t firstB, uint32_t countB) {
  return firstA < firstB + countB && firstB < firstA + countA;
}

}  // namespace

bool ViewsOverlap(const IView& a, const IView& b) {
  if (a.Resource() != b.Resource()) return false;
  const ViewDesc &x = a.Desc(), &y = b.Desc();
  return RangesOverlap(x.firstMip, x.mipCount, y.firstMip, y.mipCount) &&
         RangesOverlap(x.firstSlice, x.sliceCount, y.firstSlice, y.sliceCount);
}

// The release of what was bound comes last, so that it can be a jump.
template <class T>
void ContextBase::Replace(Ref<T>& slot, T* value, uint32_t dirty) {
  if (slot.get() == value) {
    ++stats_.redundantSets;
    return;
  }
  dirty_ |= dirty;
  slot = Ref<T>(value);
}

bool ContextBase::CheckSlots(const char* what, uint32_t first, uint32_t count, uint32_t limit) {
  if (first <= limit && count <= limit - first) return true;
  log_.Report(Severity::Error, MsgCode::SlotOutOfRange, "", "%s: slots %u..%u asked for, there are %u; the call is ignored", what,
              first, first + count, limit);
  return false;
}

void ContextBase::IASetInputLayout(IInputLayout* layout) {
  Replace(state_.layout, layout, DirtyLayout);
}

void ContextBase::IASetPrimitiveTopology(PrimitiveTopology topology) {
  if (state_.topology == topology) {
    ++stats_.redundantSets;
    return;
  }
  state_.topology = topology;
  dirty_ |= DirtyTopology;
}

void ContextBase::IASetVertexBuffers(uint32_t first, uint32_t count, IBuffer* const* buffers, const uint32_t* strides,
                                     const uint32_t* offsets) {
  if (!CheckSlots("IASetVertexBuffers", first, count, kMaxVertexBuffers)) return;
  for (uint32_t i = 0; i < count; ++i) {
    VertexBufferBinding& slot = state_.vertexBuffers[first + i];
    if (slot.buffer.get() == buffers[i] && slot.stride == strides[i] && slot.offset == offsets[i]) {
      ++stats_.redundantSets;
      continue;
    }
    slot = {Ref<IBuffer>(buffers[i]), strides[i], offsets[i]};
    dirty_ |= DirtyVertexBuffers;
  }
}

void ContextBase::IASetIndexBuffer(IBuffer* buffer, Format format, uint32_t offset) {
  if (buffer && format != Format::R16_UInt && format != Format::R32_UInt) {
    log_.Report(Severity::Error, MsgCode::FormatMismatch, "", "IASetIndexBuffer: %s is no index format; use R16_UInt or R32_UInt",
                ToString(format));
    return;
  }
  if (state_.indexBuffer.get() == buffer && state_.indexFormat == format && state_.indexOffset == offset) {
    ++stats_.redundantSets;
    return;
  }
  state_.indexBuffer = Ref<IBuffer>(buffer);
  state_.indexFormat = format;
  state_.indexOffset = offset;
  dirty_ |= DirtyIndexBuffer;
}

void ContextBase::SetShader(Stage stage, IShader* shader) {
  if (shader && shader->GetStage() != stage) {
    log_.Report(Severity::Error, MsgCode::WrongStage, "", "a %s shader was set as the %s shader; the call is ignored",
                ToString(shader->GetStage()), ToString(stage));
    return;
  }
  Replace(state_.shaders[size_t(stage)], shader, stage == Stage::Compute ? DirtyComputeShader : DirtyShaders);
}

void ContextBase::SetConstantBuffers(uint32_t first, uint32_t count, IBuffer* const* buffers) {
  if (!CheckSlots("SetConstantBuffers", first, count, kMaxConstantBuffers)) return;
  for (uint32_t i = 0; i < count; ++i)
    Replace(state_.constants[first + i], buffers[i], DirtyConstants);
}

bool ContextBase::BoundAsTarget(const IView& input) const {
  for (uint32_t i = 0; i < state_.targetCount; ++i)
    if (state_.targets[i] && ViewsOverlap(input, *state_.targets[i])) return true;
  return state_.depthTarget && ViewsOverlap(input, *state_.depthTarget);
}

void ContextBase::SetShaderResources(Stage stage, uint32_t first, uint32_t count, IShaderResourceView* const* views) {
  if (!CheckSlots("SetShaderResources", first, count, kMaxShaderResources)) return;
  for (uint32_t i = 0; i < count; ++i) {
    IShaderResourceView* view = views[i];
    if (view && BoundAsTarget(*view)) {
      log_.Report(Severity::Warning, MsgCode::InputStillBoundAsTarget, "",
                  "%s t%u: the resource is bound as a target, so the slot is set to null; unbind the target first", ToString(stage),
                  first + i);
      view = nullptr;
    }
    Replace(state_.resources[size_t(stage)][first + i], view, DirtyResources << uint32_t(stage));
  }
}

void ContextBase::SetSamplers(Stage stage, uint32_t first, uint32_t count, ISamplerState* const* samplers) {
  if (!CheckSlots("SetSamplers", first, count, kMaxSamplers)) return;
  for (uint32_t i = 0; i < count; ++i)
    Replace(state_.samplers[size_t(stage)][first + i], samplers[i], DirtySamplers << uint32_t(stage));
}

void ContextBase::CSSetUnorderedAccessViews(uint32_t first, uint32_t count, IUnorderedAccessView* const* views) {
  if (!CheckSlots("CSSetUnorderedAccessViews", first, count, kMaxUnorderedAccess)) return;
  for (uint32_t i = 0; i < count; ++i) {
    if (views[i]) UnbindInputsOf(*views[i]);
    Replace(state_.uavs[first + i], views[i], DirtyUavs);
  }
}

void ContextBase::RSSetState(IRasterizerState* raster) {
  Replace(state_.raster, raster, DirtyRaster);
}

void ContextBase::RSSetViewports(uint32_t count, const Viewport* viewports) {
  if (!CheckSlots("RSSetViewports", 0, count, kMaxViewports)) return;
  std::copy(viewports, viewports + count, state_.viewports.begin());
  state_.viewportCount = count;
  dirty_ |= DirtyViewports;
}

void ContextBase::RSSetScissorRects(uint32_t count, const Rect* rects) {
  if (!CheckSlots("RSSetScissorRects", 0, count, kMaxViewports)) return;
  std::copy(rects, rects + count, state_.scissors.begin());
  state_.scissorCount = count;
  dirty_ |= DirtyScissors;
}

void ContextBase::OMSetBlendState(IBlendState* blend, const float factor[4], uint32_t sampleMask) {
  constexpr float kOnes[4] = {1, 1, 1, 1};
  if (!factor) factor = kOnes;
  if (!SameFactors(factor, state_.blendFactor.data()) || sampleMask != state_.sampleMask) {
    std::copy(factor, factor + 4, state_.blendFactor.begin());
    state_.sampleMask = sampleMask;
    dirty_ |= DirtyBlendFactor;
  }
  Replace(state_.blend, blend, DirtyBlend);
}

void ContextBase::OMSetDepthStencilState(IDepthStencilState* depthStencil, uint32_t stencilRef) {
  if (stencilRef != state_.stencilRef) {
    state_.stencilRef = stencilRef;
    dirty_ |= DirtyStencilRef;
  }
  Replace(state_.depthStencil, depthStencil, DirtyDepthStencil);
}

void ContextBase::UnbindInputsOf(const IView& target) {
  for (uint32_t stage = 0; stage < kStageCount; ++stage)
    for (uint32_t slot = 0; slot < kMaxShaderResources; ++slot) {
      Ref<IShaderResourceView>& view = state_.resources[stage][slot];
      if (!view || !ViewsOverlap(*view, target)) continue;
      log_.Report(Severity::Warning, MsgCode::TargetStillBoundAsInput, "",
                  "%s t%u showed a resource that is now bound for writing; the slot is set to null, as Direct3D 10 does",
                  ToString(Stage(stage)), slot);
      view = nullptr;
      dirty_ |= DirtyResources << stage;
    }
}

void ContextBase::OMSetRenderTargets(uint32_t count, IRenderTargetView* const* targets, IDepthStencilView* depth) {
  if (!CheckSlots("OMSetRenderTargets", 0, count, kMaxRenderTargets)) return;
  bool changed = false;
  for (uint32_t i = 0; i < kMaxRenderTargets; ++i) {
    IRenderTargetView* target = i < count ? targets[i] : nullptr;
    if (target) UnbindInputsOf(*target);
    if (state_.targets[i].get() == target) continue;
    state_.targets[i] = Ref<IRenderTargetView>(target);
    changed = true;
  }
  if (depth) UnbindInputsOf(*depth);
  if (state_.depthTarget.get() != depth) {
    state_.depthTarget = Ref<IDepthStencilView>(depth);
    changed = true;
  }
  if (state_.targetCount != count) changed = true;
  state_.targetCount = count;
  if (changed) {
    dirty_ |= DirtyTargets;
  } else {
    ++stats_.redundantSets;
  }
}

void ContextBase::ClearState() {
  state_ = BoundState{};
  dirty_ = DirtyAll;
}

}  // namespace rhi::backend

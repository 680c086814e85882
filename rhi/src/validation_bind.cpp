// Setters: slots, bind flags, objects of this device.
#include <cmath>

#include "validation_context.h"

namespace rhi::validation {

using backend::ContextBase;

bool Context::NotNull(const char* call, const void* pointer, const char* what) {
  return pointer || v_.Error(MsgCode::InvalidDesc, {nullptr, call}, "%s: %s is null; the call is ignored", call, what);
}

bool Context::IsBuffer(const IObject* object) {
  const ObjectRecord* record = v_.objects.Find(object);
  return record && record->kind == ObjectKind::Buffer;
}

bool Context::Slots(const char* call, uint32_t first, uint32_t count, uint32_t limit, const void* array) {
  if (first > limit || count > limit - first)
    return v_.Error(MsgCode::SlotOutOfRange, {nullptr, call},
                    "%s: %u slots from %u asked for, there are %u; the call is ignored", call, count, first, limit);
  return count == 0 || NotNull(call, array, "the array");
}

bool Context::ValidStage(const char* call, Stage stage) {
  return uint32_t(stage) < kStageCount ||
         v_.Error(MsgCode::WrongStage, {nullptr, call}, "%s: stage %u is none; use a value of rhi::Stage", call,
                  uint32_t(stage));
}

bool Context::Bindable(const char* call, IBuffer* buffer, Bind flag, const char* flagName) {
  if (!v_.Owns(call, buffer)) return false;
  if (!buffer || (buffer->Desc().bind & flag)) return true;
  return v_.Error(MsgCode::WrongBindFlag, buffer,
                  "%s: the buffer was made without Bind::%s (its flags are 0x%X); add the flag to its BufferDesc; the "
                  "call is ignored",
                  call, flagName, uint32_t(buffer->Desc().bind));
}

void Context::IASetInputLayout(IInputLayout* layout) {
  if (!v_.Owns("IASetInputLayout", layout)) return;
  ContextBase::IASetInputLayout(layout);
  inner_.IASetInputLayout(layout);
}

void Context::IASetPrimitiveTopology(PrimitiveTopology topology) {
  if (topology > PrimitiveTopology::TriangleStripAdj) {
    v_.Error(MsgCode::InvalidDesc, {nullptr, "IASetPrimitiveTopology"},
             "IASetPrimitiveTopology: %u is no topology; use a value of rhi::PrimitiveTopology; the call is ignored",
             uint32_t(topology));
    return;
  }
  ContextBase::IASetPrimitiveTopology(topology);
  inner_.IASetPrimitiveTopology(topology);
}

void Context::IASetVertexBuffers(uint32_t first, uint32_t count, IBuffer* const* buffers, const uint32_t* strides,
                                 const uint32_t* offsets) {
  constexpr const char* kCall = "IASetVertexBuffers";
  if (!Slots(kCall, first, count, kMaxVertexBuffers, buffers)) return;
  if (count && (!NotNull(kCall, strides, "strides") || !NotNull(kCall, offsets, "offsets"))) return;
  for (uint32_t i = 0; i < count; ++i)
    if (!Bindable(kCall, buffers[i], Bind::VertexBuffer, "VertexBuffer")) return;
  ContextBase::IASetVertexBuffers(first, count, buffers, strides, offsets);
  inner_.IASetVertexBuffers(first, count, buffers, strides, offsets);
}

void Context::IASetIndexBuffer(IBuffer* buffer, Format format, uint32_t offset) {
  if (!Bindable("IASetIndexBuffer", buffer, Bind::IndexBuffer, "IndexBuffer")) return;
  if (buffer && format != Format::R16_UInt && format != Format::R32_UInt) {
    v_.Error(MsgCode::FormatMismatch, buffer,
             "IASetIndexBuffer: %s is no index format; use R16_UInt or R32_UInt; the call is ignored",
             rhi::ToString(format));
    return;
  }
  if (buffer && offset % GetFormatInfo(format).blockBytes != 0) {
    v_.Error(MsgCode::OutOfBounds, buffer,
             "IASetIndexBuffer: offset %u is no multiple of the index size %u; the call is ignored", offset,
             uint32_t(GetFormatInfo(format).blockBytes));
    return;
  }
  ContextBase::IASetIndexBuffer(buffer, format, offset);
  inner_.IASetIndexBuffer(buffer, format, offset);
}

void Context::SetShader(Stage stage, IShader* shader) {
  if (!ValidStage("SetShader", stage) || !v_.Owns("SetShader", shader)) return;
  if (shader && shader->GetStage() != stage) {
    v_.Error(MsgCode::WrongStage, shader, "SetShader: a %s shader was set as the %s shader; the call is ignored",
             rhi::ToString(shader->GetStage()), rhi::ToString(stage));
    return;
  }
  ContextBase::SetShader(stage, shader);
  inner_.SetShader(stage, shader);
}

void Context::SetConstantBuffers(uint32_t first, uint32_t count, IBuffer* const* buffers) {
  if (!Slots("SetConstantBuffers", first, count, kMaxConstantBuffers, buffers)) return;
  for (uint32_t i = 0; i < count; ++i)
    if (!Bindable("SetConstantBuffers", buffers[i], Bind::ConstantBuffer, "ConstantBuffer")) return;
  ContextBase::SetConstantBuffers(first, count, buffers);
  inner_.SetConstantBuffers(first, count, buffers);
}

void Context::SetShaderResources(Stage stage, uint32_t first, uint32_t count, IShaderResourceView* const* views) {
  constexpr const char* kCall = "SetShaderResources";
  if (!ValidStage(kCall, stage) || !Slots(kCall, first, count, kMaxShaderResources, views)) return;
  if (!OwnsAll(kCall, count, views)) return;
  ContextBase::SetShaderResources(stage, first, count, views);
  inner_.SetShaderResources(stage, first, count, views);
}

void Context::SetSamplers(Stage stage, uint32_t first, uint32_t count, ISamplerState* const* samplers) {
  constexpr const char* kCall = "SetSamplers";
  if (!ValidStage(kCall, stage) || !Slots(kCall, first, count, kMaxSamplers, samplers)) return;
  if (!OwnsAll(kCall, count, samplers)) return;
  ContextBase::SetSamplers(stage, first, count, samplers);
  inner_.SetSamplers(stage, first, count, samplers);
}

void Context::CSSetUnorderedAccessViews(uint32_t first, uint32_t count, IUnorderedAccessView* const* views) {
  constexpr const char* kCall = "CSSetUnorderedAccessViews";
  if (!Slots(kCall, first, count, kMaxUnorderedAccess, views) || !OwnsAll(kCall, count, views)) return;
  ContextBase::CSSetUnorderedAccessViews(first, count, views);
  inner_.CSSetUnorderedAccessViews(first, count, views);
}

void Context::RSSetState(IRasterizerState* state) {
  if (!v_.Owns("RSSetState", state)) return;
  ContextBase::RSSetState(state);
  inner_.RSSetState(state);
}

bool Context::ViewportOk(const Viewport& p) {
  const bool finite = std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.width) && std::isfinite(p.height);
  const bool depth = p.minDepth >= 0 && p.minDepth <= p.maxDepth && p.maxDepth <= 1;  // false for NaN
  if (finite && depth && p.width >= 0 && p.height >= 0) return true;
  return v_.Error(
      MsgCode::InvalidDesc, {nullptr, "RSSetViewports"},
      "RSSetViewports: (%g, %g), %g x %g, depth %g..%g; sizes must be 0 or more, depths ordered within 0..1; "
      "the call is ignored",
      double(p.x), double(p.y), double(p.width), double(p.height), double(p.minDepth), double(p.maxDepth));
}

void Context::RSSetViewports(uint32_t count, const Viewport* viewports) {
  if (!Slots("RSSetViewports", 0, count, kMaxViewports, viewports)) return;
  for (uint32_t i = 0; i < count; ++i)
    if (!ViewportOk(viewports[i])) return;
  ContextBase::RSSetViewports(count, viewports);
  inner_.RSSetViewports(count, viewports);
}

void Context::RSSetScissorRects(uint32_t count, const Rect* rects) {
  if (!Slots("RSSetScissorRects", 0, count, kMaxViewports, rects)) return;
  ContextBase::RSSetScissorRects(count, rects);
  inner_.RSSetScissorRects(count, rects);
}

void Context::OMSetBlendState(IBlendState* state, const float factor[4], uint32_t sampleMask) {
  if (!v_.Owns("OMSetBlendState", state)) return;
  ContextBase::OMSetBlendState(state, factor, sampleMask);
  inner_.OMSetBlendState(state, factor, sampleMask);
}

void Context::OMSetDepthStencilState(IDepthStencilState* state, uint32_t stencilRef) {
  if (!v_.Owns("OMSetDepthStencilState", state)) return;
  ContextBase::OMSetDepthStencilState(state, stencilRef);
  inner_.OMSetDepthStencilState(state, stencilRef);
}

void Context::OMSetRenderTargets(uint32_t count, IRenderTargetView* const* targets, IDepthStencilView* depth) {
  constexpr const char* kCall = "OMSetRenderTargets";
  if (!Slots(kCall, 0, count, kMaxRenderTargets, targets) || !OwnsAll(kCall, count, targets)) return;
  if (!v_.Owns(kCall, depth)) return;
  ContextBase::OMSetRenderTargets(count, targets, depth);
  inner_.OMSetRenderTargets(count, targets, depth);
}

void Context::ClearState() {
  ContextBase::ClearState();
  inner_.ClearState();
}

}  // namespace rhi::validation

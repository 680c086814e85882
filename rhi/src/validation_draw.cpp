// Draws and dispatches: the state as a whole, and the ranges of buffers that a direct draw reads.
#include <cstring>

#include "validation_context.h"

namespace rhi::validation {
namespace {

// The topology that a geometry shader sees: strips are cut into their primitives.
PrimitiveTopology ListOf(PrimitiveTopology topology) {
  switch (topology) {
    case PrimitiveTopology::LineStrip: return PrimitiveTopology::LineList;
    case PrimitiveTopology::LineStripAdj: return PrimitiveTopology::LineListAdj;
    case PrimitiveTopology::TriangleStrip: return PrimitiveTopology::TriangleList;
    case PrimitiveTopology::TriangleStripAdj: return PrimitiveTopology::TriangleListAdj;
    default: return topology;
  }
}

struct Extent {
  uint32_t width, height, samples;
};

Extent ExtentOf(const IView& target) {
  const TextureDesc& d = static_cast<const ITexture*>(target.Resource())->Desc();
  const uint32_t mip = target.Desc().firstMip;
  return {backend::MipSize(d.width, mip), backend::MipSize(d.height, mip), d.sampleCount};
}

bool Same(const ShaderInput& a, const ShaderInput& b) {
  return a.semanticIndex == b.semanticIndex && a.location == b.location && std::strcmp(a.semantic, b.semantic) == 0;
}

const ShaderInput* FindInput(const ObjectRecord& layout, const ShaderInput& wanted) {
  for (const ShaderInput& input : layout.inputs)
    if (Same(input, wanted)) return &input;
  return nullptr;
}

}  // namespace

// -------------------------------------------------------------------------------------------------------------- state

bool Context::CheckVertexShader(const char* call) {
  return state_.shaders[size_t(Stage::Vertex)] ||
         v_.Error(MsgCode::NoVertexShader, {nullptr, call},
                  "%s without a vertex shader; call VSSetShader; it is skipped", call);
}

bool Context::CheckTopology(const char* call) {
  const IShader* gs = state_.shaders[size_t(Stage::Geometry)].get();
  if (!gs) return true;
  const PrimitiveTopology wanted = v_.objects.Find(gs)->shader.gsInput;
  return ListOf(state_.topology) == wanted ||
         v_.Error(MsgCode::TopologyMismatch, gs,
                  "%s: the geometry shader takes %s but the topology is %s; call IASetPrimitiveTopology or unbind the "
                  "shader; it is skipped",
                  call, rhi::ToString(wanted), rhi::ToString(state_.topology));
}

bool Context::CheckTargets(const char* call) {
  const IView* first = nullptr;
  Extent size{};
  const auto fits = [&](const IView* view) {
    if (!view) return true;
    const Extent e = ExtentOf(*view);
    if (!first) {
      first = view;
      size = e;
    }
    return (e.width == size.width && e.height == size.height && e.samples == size.samples) ||
           v_.Error(MsgCode::TargetsDiffer, view,
                    "%s: a target of %u x %u with %u samples beside '%s' of %u x %u with %u; take equal ones; it is "
                    "skipped",
                    call, e.width, e.height, e.samples, Name(first), size.width, size.height, size.samples);
  };
  for (uint32_t i = 0; i < state_.targetCount; ++i)
    if (!fits(state_.targets[i].get())) return false;
  if (!fits(state_.depthTarget.get())) return false;
  if (!first)
    return v_.Error(MsgCode::NoTarget, {nullptr, call}, "%s without a target; call OMSetRenderTargets; it is skipped",
                    call);
  if (state_.viewportCount == 0)
    return v_.Error(MsgCode::NothingBound, {nullptr, call}, "%s without a viewport; call RSSetViewports; it is skipped",
                    call);
  CheckViewports(call, size.width, size.height);
  return true;
}

// A viewport partly outside is how large pictures are drawn in tiles; one that shows nothing is an oversight.
void Context::CheckViewports(const char* call, uint32_t width, uint32_t height) {
  for (uint32_t i = 0; i < state_.viewportCount; ++i) {
    const Viewport& p = state_.viewports[i];
    const float right = p.x + p.width, bottom = p.y + p.height;
    if (p.x >= 0 && p.y >= 0 && right <= float(width) && bottom <= float(height) && p.width > 0 && p.height > 0)
      continue;
    const bool nothing =
        p.width <= 0 || p.height <= 0 || right <= 0 || bottom <= 0 || p.x >= float(width) || p.y >= float(height);
    constexpr const char* kText =
        "%s: viewport %u, (%g, %g)..(%g, %g), %s the targets of %u x %u; was it set for others?";
    if (nothing) {
      v_.Warn(MsgCode::ViewportOutside, {nullptr, call}, kText, call, i, double(p.x), double(p.y), double(right),
              double(bottom), "shows nothing of", width, height);
    } else {
      v_.Inform(MsgCode::ViewportOutside, {nullptr, call}, kText, call, i, double(p.x), double(p.y), double(right),
                double(bottom), "reaches beyond", width, height);
    }
  }
}

bool Context::CheckLayout(const char* call) {
  const IShader* vs = state_.shaders[size_t(Stage::Vertex)].get();
  const ShaderReflection& reflection = v_.objects.Find(vs)->shader;
  if (reflection.inputs.size == 0) return true;
  if (!state_.layout)
    return v_.Error(
        MsgCode::LayoutMismatch, vs,
        "%s: the vertex shader has %u inputs but no input layout is bound; call IASetInputLayout; it is skipped", call,
        reflection.inputs.size);
  const ObjectRecord& layout = *v_.objects.Find(state_.layout.get());
  for (const ShaderInput& input : reflection.inputs)
    if (!FindInput(layout, input))
      return v_.Error(
          MsgCode::LayoutMismatch, vs,
          "%s: the vertex shader reads %s%u at location %u, which the bound layout, made for another shader, "
          "does not give; make one for this shader; it is skipped",
          call, input.semantic, input.semanticIndex, input.location);
  return true;
}

// -------------------------------------------------------------------------------------------------------------- ranges

bool Context::CheckVertices(const char* call, const Range& r, bool indexed) {
  const ObjectRecord* layout = v_.objects.Find(state_.layout.get());
  if (!layout || v_.objects.Find(state_.shaders[size_t(Stage::Vertex)].get())->shader.inputs.size == 0) return true;
  for (const InputElement& e : layout->elements) {
    const backend::VertexBufferBinding& slot = state_.vertexBuffers[e.slot];
    if (!slot.buffer) {
      v_.Warn(MsgCode::NothingBound, {state_.layout.get(), e.semantic},
              "%s: %s%u is read from slot %u, which has no vertex buffer; it reads 0; call IASetVertexBuffers", call,
              e.semantic, e.semanticIndex, e.slot);
      continue;
    }
    const bool instanced = e.inputClass == InputClass::PerInstance;
    if (r.count == 0 || r.instances == 0 || (indexed && !instanced)) continue;
    const uint64_t last = instanced ? r.firstInstance + (r.instances - 1) / e.stepRate : r.first + r.count - 1;
    const uint64_t end = slot.offset + last * slot.stride + e.offset + GetFormatInfo(e.format).blockBytes;
    if (end <= slot.buffer->Desc().byteWidth) continue;
    return v_.Error(
        MsgCode::OutOfBounds, slot.buffer.get(),
        "%s reads %s%u of %s %llu, up to byte %llu of a vertex buffer of %u (slot %u, stride %u, offset %u); "
        "draw fewer or make the buffer larger; it is skipped",
        call, e.semantic, e.semanticIndex, instanced ? "instance step" : "vertex",
        static_cast<unsigned long long>(last), static_cast<unsigned long long>(end), slot.buffer->Desc().byteWidth,
        e.slot, slot.stride, slot.offset);
  }
  return true;
}

bool Context::CheckIndices(const char* call, const Range& r) {
  const uint64_t size = GetFormatInfo(state_.indexFormat).blockBytes;
  const uint64_t end = state_.indexOffset + (r.first + r.count) * size;
  const uint32_t width = state_.indexBuffer->Desc().byteWidth;
  if (r.count == 0 || end <= width) return true;
  return v_.Error(
      MsgCode::OutOfBounds, state_.indexBuffer.get(),
      "%s reads indices %llu..%llu, up to byte %llu of an index buffer of %u (%s, offset %u); it is skipped", call,
      static_cast<unsigned long long>(r.first), static_cast<unsigned long long>(r.first + r.count),
      static_cast<unsigned long long>(end), width, rhi::ToString(state_.indexFormat), state_.indexOffset);
}

bool Context::CheckBoundMapped(const char* call, bool indexed, bool compute) {
  if (v_.objects.mappedCount == 0) return true;
  bool ok = true;
  const auto look = [&](const IResource* r) { ok = ok && NotMapped(call, r); };
  for (const Ref<IBuffer>& b : state_.constants) look(b.get());
  if (!compute)
    for (const backend::VertexBufferBinding& b : state_.vertexBuffers) look(b.buffer.get());
  if (indexed) look(state_.indexBuffer.get());
  for (uint32_t stage = 0; stage < kStageCount; ++stage)
    if ((stage == uint32_t(Stage::Compute)) == compute)
      for (const Ref<IShaderResourceView>& view : state_.resources[stage])
        if (view) look(view->Resource());
  return ok;
}

bool Context::CheckDraw(const char* call, bool indexed) {
  if (!CheckVertexShader(call) || !CheckLayout(call) || !CheckTopology(call) || !CheckTargets(call)) return false;
  if (indexed && !state_.indexBuffer)
    return v_.Error(MsgCode::IndexBufferMissing, {nullptr, call},
                    "%s without an index buffer; call IASetIndexBuffer; it is skipped", call);
  for (const Stage stage : {Stage::Vertex, Stage::Geometry, Stage::Pixel})
    if (!CheckRegisters(call, stage)) return false;
  return CheckBoundMapped(call, indexed, false);
}

// --------------------------------------------------------------------------------------------------------------- draws

void Context::CountWork() {
  ++work_;
  for (uint32_t i = 0; i < kMaxConstantBuffers; ++i) lastConstants_[i] = state_.constants[i].get();
}

bool Context::UsedByLastDraw(const IObject* object) const {
  return std::find(lastConstants_.begin(), lastConstants_.end(), object) != lastConstants_.end();
}

void Context::Draw(uint32_t count, uint32_t start) {
  if (!CheckDraw("Draw", false) || !CheckVertices("Draw", {start, count, 0, 1}, false)) return;
  CountWork();
  inner_.Draw(count, start);
}

void Context::DrawIndexed(uint32_t count, uint32_t start, int32_t baseVertex) {
  constexpr const char* kCall = "DrawIndexed";
  const Range r{start, count, 0, 1};
  if (!CheckDraw(kCall, true) || !CheckIndices(kCall, r) || !CheckVertices(kCall, r, true)) return;
  CountWork();
  inner_.DrawIndexed(count, start, baseVertex);
}

void Context::DrawInstanced(uint32_t count, uint32_t instances, uint32_t start, uint32_t startInstance) {
  constexpr const char* kCall = "DrawInstanced";
  if (!CheckDraw(kCall, false) || !CheckVertices(kCall, {start, count, startInstance, instances}, false)) return;
  CountWork();
  inner_.DrawInstanced(count, instances, start, startInstance);
}

void Context::DrawIndexedInstanced(uint32_t count, uint32_t instances, uint32_t start, int32_t baseVertex,
                                   uint32_t startInstance) {
  constexpr const char* kCall = "DrawIndexedInstanced";
  const Range r{start, count, startInstance, instances};
  if (!CheckDraw(kCall, true) || !CheckIndices(kCall, r) || !CheckVertices(kCall, r, true)) return;
  CountWork();
  inner_.DrawIndexedInstanced(count, instances, start, baseVertex, startInstance);
}

bool Context::CheckIndirect(const char* call, IBuffer* args, uint32_t offset, uint32_t size) {
  if (!args)
    return v_.Error(MsgCode::WrongBindFlag, {nullptr, call},
                    "%s: the arguments are null; pass a buffer made with Bind::IndirectArgs; it is skipped", call);
  if (!Bindable(call, args, Bind::IndirectArgs, "IndirectArgs")) return false;
  const uint32_t width = args->Desc().byteWidth;
  if (offset % 4 != 0 || uint64_t(offset) + size > width)
    return v_.Error(
        MsgCode::OutOfBounds, args,
        "%s reads %u bytes at offset %u of a buffer of %u; stay within it, at a multiple of 4; it is skipped", call,
        size, offset, width);
  return NotMapped(call, args);
}

void Context::DrawInstancedIndirect(IBuffer* args, uint32_t offset) {
  constexpr const char* kCall = "DrawInstancedIndirect";
  if (!CheckIndirect(kCall, args, offset, sizeof(DrawArgs)) || !CheckDraw(kCall, false)) return;
  if (!CheckVertices(kCall, {}, false)) return;  // only what is bound: the counts are the GPU's
  CountWork();
  inner_.DrawInstancedIndirect(args, offset);
}

void Context::DrawIndexedInstancedIndirect(IBuffer* args, uint32_t offset) {
  constexpr const char* kCall = "DrawIndexedInstancedIndirect";
  if (!CheckIndirect(kCall, args, offset, sizeof(DrawIndexedArgs)) || !CheckDraw(kCall, true)) return;
  if (!CheckVertices(kCall, {}, true)) return;
  CountWork();
  inner_.DrawIndexedInstancedIndirect(args, offset);
}

bool Context::CheckDispatch(const char* call) {
  if (!state_.shaders[size_t(Stage::Compute)])
    return v_.Error(MsgCode::NothingBound, {nullptr, call},
                    "%s without a compute shader; call CSSetShader; it is skipped", call);
  return CheckRegisters(call, Stage::Compute) && CheckBoundMapped(call, false, true);
}

void Context::Dispatch(uint32_t x, uint32_t y, uint32_t z) {
  if (Is(backend::CheckGroups(x, y, z), nullptr) || !CheckDispatch("Dispatch")) return;
  CountWork();
  inner_.Dispatch(x, y, z);
}

void Context::DispatchIndirect(IBuffer* args, uint32_t offset) {
  constexpr const char* kCall = "DispatchIndirect";
  if (!CheckIndirect(kCall, args, offset, sizeof(DispatchArgs)) || !CheckDispatch(kCall)) return;
  CountWork();
  inner_.DispatchIndirect(args, offset);
}

}  // namespace rhi::validation

#include <bit>

#include "context.h"

namespace rhi_gl {
namespace {

using namespace backend;

constexpr uint32_t kConstantSlots = 0xFu * DirtyConstantSlot;
constexpr uint32_t kGraphicsStages = 0x7u;
constexpr uint32_t kGraphicsRest = DirtyLayout | DirtyTopology | DirtyVertexBuffers | DirtyIndexBuffer | DirtyShaders |
                                   DirtyConstants | DirtyRaster | DirtyViewports | DirtyScissors | DirtyBlend |
                                   DirtyBlendFactor | DirtyDepthStencil | DirtyStencilRef | DirtyTargets |
                                   kGraphicsStages * DirtyResources | kGraphicsStages * DirtySamplers | DirtyBarrier |
                                   DirtyUnusable | DirtyThread | DirtyFirstVertex;
constexpr uint32_t kGraphics = kGraphicsRest | kConstantSlots;
constexpr uint32_t kOutput = DirtyRaster | DirtyViewports | DirtyScissors | DirtyDepthStencil | DirtyStencilRef |
                             DirtyBlendFactor | DirtyTargets;

constexpr int64_t kFirstVertexLater = -2;  // an indirect draw: the GPU knows it

constexpr std::array<GLenum, 9> kModes{GL_POINTS,
                                       GL_LINES,
                                       GL_LINE_STRIP,
                                       GL_TRIANGLES,
                                       GL_TRIANGLE_STRIP,
                                       GL_LINES_ADJACENCY,
                                       GL_LINE_STRIP_ADJACENCY,
                                       GL_TRIANGLES_ADJACENCY,
                                       GL_TRIANGLE_STRIP_ADJACENCY};

bool IsStrip(PrimitiveTopology t) {
  return t == PrimitiveTopology::LineStrip || t == PrimitiveTopology::TriangleStrip ||
         t == PrimitiveTopology::LineStripAdj || t == PrimitiveTopology::TriangleStripAdj;
}

// The list that a strip is made of; what a geometry shader declares.
PrimitiveTopology ListOf(PrimitiveTopology t) {
  switch (t) {
    case PrimitiveTopology::LineStrip: return PrimitiveTopology::LineList;
    case PrimitiveTopology::TriangleStrip: return PrimitiveTopology::TriangleList;
    case PrimitiveTopology::LineStripAdj: return PrimitiveTopology::LineListAdj;
    case PrimitiveTopology::TriangleStripAdj: return PrimitiveTopology::TriangleListAdj;
    default: return t;
  }
}

const Shader* ShaderOf(const BoundState& state, Stage stage) {
  return static_cast<const Shader*>(state.shaders[size_t(stage)].get());
}

TargetSet TargetsOf(const BoundState& state) {
  TargetSet set;
  set.colorCount = state.targetCount;
  for (uint32_t i = 0; i < state.targetCount; ++i)
    set.colors[i] = static_cast<const RenderTargetView*>(state.targets[i].get());
  set.depth = static_cast<const DepthStencilView*>(state.depthTarget.get());
  return set;
}

}  // namespace

// ---------------------------------------------------------------------------------------------------- the short way

// The usual draw differs from the one before by its constants alone, which UpdateConstants has bound already.
inline bool Context::Ready(uint32_t firstVertex) const { return !(dirty_ & kGraphics) && firstVertex == readyFirst_; }

inline bool Context::Prepare(int64_t firstVertex) {
  if ((dirty_ & kGraphics) && !ApplyGraphics()) return false;
  if (firstVertex == kFirstVertexLater) {
    dirty_ |= DirtyFirstVertex;
    return true;
  }
  readyFirst_ = uint32_t(firstVertex);
  if (usesVertexId_ && firstVertex != firstVertex_) SetFirstVertex(int32_t(firstVertex));
  return true;
}

bool Context::PrepareIndexed() {
  if (!Ready(0) && !Prepare(0)) return false;
  if (hasIndices_) [[likely]]
    return true;
  ReportOnce(Severity::Error, MsgCode::IndexBufferMissing,
             "an indexed draw without an index buffer is skipped; call IASetIndexBuffer");
  return false;
}

inline const void* Context::IndexPointer(uint32_t startIndex) const {
  return reinterpret_cast<const void*>(indexBase_ + (uint64_t(startIndex) << indexShift_));
}

void Context::Draw(uint32_t vertexCount, uint32_t startVertex) {
  if (!Ready(startVertex)) [[unlikely]]
    return PrepareAndDraw(vertexCount, startVertex);  // a tail call: the usual way saves no registers
  ++stats_.draws;
  glDrawArrays(mode_, GLint(startVertex), GLsizei(vertexCount));
}

void Context::PrepareAndDraw(uint32_t vertexCount, uint32_t startVertex) {
  if (!Prepare(startVertex)) return;
  ++stats_.draws;
  glDrawArrays(mode_, GLint(startVertex), GLsizei(vertexCount));
}

void Context::DrawIndexed(uint32_t indexCount, uint32_t startIndex, int32_t baseVertex) {
  if (!PrepareIndexed()) return;
  ++stats_.draws;
  glDrawElementsBaseVertex(mode_, GLsizei(indexCount), indexType_, IndexPointer(startIndex), baseVertex);
}

void Context::DrawInstanced(uint32_t vertexCount, uint32_t instanceCount, uint32_t startVertex,
                            uint32_t startInstance) {
  if (!Ready(startVertex)) [[unlikely]]
    if (!Prepare(startVertex)) return;
  ++stats_.draws;
  glDrawArraysInstancedBaseInstance(mode_, GLint(startVertex), GLsizei(vertexCount), GLsizei(instanceCount),
                                    startInstance);
}

void Context::DrawIndexedInstanced(uint32_t indexCount, uint32_t instanceCount, uint32_t startIndex, int32_t baseVertex,
                                   uint32_t startInstance) {
  if (!PrepareIndexed()) return;
  ++stats_.draws;
  glDrawElementsInstancedBaseVertexBaseInstance(mode_, GLsizei(indexCount), indexType_, IndexPointer(startIndex),
                                                GLsizei(instanceCount), baseVertex, startInstance);
}

// --------------------------------------------------------------------------------------------------------- indirect

const Buffer* Context::CheckIndirect(IBuffer* args, uint32_t offset, uint32_t size) {
  const auto* buffer = static_cast<const Buffer*>(args);
  if (!buffer || !(buffer->Desc().bind & Bind::IndirectArgs)) {
    ReportOnce(Severity::Error, MsgCode::WrongBindFlag,
               "an indirect call is skipped: its arguments need a buffer made with Bind::IndirectArgs");
    return nullptr;
  }
  if (offset % 4 == 0 && uint64_t(offset) + size <= buffer->Desc().byteWidth) return buffer;
  ReportOnce(Severity::Error, MsgCode::OutOfBounds,
             "an indirect call is skipped: %u bytes at %u of a buffer of %u; stay within it, at a multiple of 4", size,
             offset, buffer->Desc().byteWidth);
  return nullptr;
}

// Only the GPU knows the first vertex, so the GPU copies it to where the shader reads it.
void Context::BindFirstVertexFrom(const Buffer& args, uint32_t offset) {
  if (indirectFirst_ == 0) {
    glCreateBuffers(1, &indirectFirst_);
    glNamedBufferStorage(indirectFirst_, 16, nullptr, 0);
  }
  glCopyNamedBufferSubData(args.name, indirectFirst_, args.offset + offset, 0, sizeof(uint32_t));
  glBindBufferRange(GL_UNIFORM_BUFFER, kGlDrawParametersBlock, indirectFirst_, 0, 16);
  firstVertex_ = -1;
}

void Context::DrawInstancedIndirect(IBuffer* args, uint32_t offset) {
  const Buffer* buffer = CheckIndirect(args, offset, sizeof(DrawArgs));
  if (!buffer || !Prepare(kFirstVertexLater)) return;
  if (usesVertexId_) BindFirstVertexFrom(*buffer, offset + uint32_t(offsetof(DrawArgs, startVertex)));
  gl_.UseIndirect(buffer->uid, buffer->name);
  ++stats_.draws;
  glDrawArraysIndirect(mode_, reinterpret_cast<const void*>(uint64_t(buffer->offset) + offset));
}

// Indirect draws count indices from the start of GL's buffer, Direct3D from the offset it was bound with: they get a
// copy that starts there.
bool Context::IndicesFromZero() {
  auto* buffer = static_cast<Buffer*>(state_.indexBuffer.get());
  const uint64_t bytes = buffer->Desc().byteWidth - state_.indexOffset;
  if (scratchIndicesBytes_ < bytes) {
    core_.Discard(NameKind::Buffer, scratchIndices_);
    const bool fits = core_.Allocates([&] {
      glCreateBuffers(1, &scratchIndices_);
      glNamedBufferStorage(scratchIndices_, GLsizeiptr(bytes), nullptr, 0);
    });
    scratchIndicesBytes_ = fits ? bytes : 0;
    if (!fits) core_.OutOfMemory("", "copy of the indices of an indirect draw, which is skipped");
    if (!fits) return false;
  }
  glCopyNamedBufferSubData(buffer->name, scratchIndices_, GLintptr(indexBase_), 0, GLsizeiptr(bytes));
  const auto* layout = static_cast<const InputLayout*>(state_.layout.get());
  glVertexArrayElementBuffer(layout ? layout->array.name : emptyArray_.name, scratchIndices_);
  return true;
}

void Context::DrawIndexedInstancedIndirect(IBuffer* args, uint32_t offset) {
  const Buffer* buffer = CheckIndirect(args, offset, sizeof(DrawIndexedArgs));
  if (!buffer || !PrepareIndexed()) return;
  if (indexBase_ != 0 && !IndicesFromZero()) return;
  gl_.UseIndirect(buffer->uid, buffer->name);
  ++stats_.draws;
  glDrawElementsIndirect(mode_, indexType_, reinterpret_cast<const void*>(uint64_t(buffer->offset) + offset));
  if (indexBase_ == 0) return;
  auto* layout = static_cast<InputLayout*>(state_.layout.get());
  (layout ? layout->array : emptyArray_).indexUid = kUnknownUid;
  dirty_ |= DirtyIndexBuffer;
}

void Context::SetFirstVertex(int32_t first) {
  firstVertex_ = first;
  if (first == 0) {
    glBindBufferRange(GL_UNIFORM_BUFFER, kGlDrawParametersBlock, core_.zeroBuffer, 0, 16);
    return;
  }
  const Ring::Slice slice = ring_.Take(16);
  if (!slice.data) return;
  const int32_t block[4] = {first, 0, 0, 0};
  std::copy(std::begin(block), std::end(block), reinterpret_cast<int32_t*>(slice.data));
  glBindBufferRange(GL_UNIFORM_BUFFER, kGlDrawParametersBlock, slice.name, slice.offset, 16);
}

// ---------------------------------------------------------------------------------------------------- the long way

inline bool Context::CheckInputs(const Shader& vs, const Shader* gs) {
  const auto* layout = static_cast<const InputLayout*>(state_.layout.get());
  const bool fed = (vs.inputMask & ~(layout ? layout->attributeMask : 0u)) == 0;
  if (fed && (!gs || gs->reflection.gsInput == ListOf(state_.topology))) [[likely]]
    return true;
  if (!fed) {
    ReportOnce(Severity::Error, MsgCode::LayoutMismatch, "a draw is skipped: %s reads inputs that the input layout %s",
               vs.Name().c_str(), layout ? "was not made for" : "(none is set) does not give");
  } else {
    ReportOnce(Severity::Error, MsgCode::TopologyMismatch, "a draw is skipped: %s takes %s, the topology is %s",
               gs->Name().c_str(), ToString(gs->reflection.gsInput), ToString(state_.topology));
  }
  return false;
}

// Finds the framebuffer and the program; false, with a message, if nothing can be drawn.
inline bool Context::CheckGraphics() {
  const Shader *vs = ShaderOf(state_, Stage::Vertex), *gs = ShaderOf(state_, Stage::Geometry);
  if (!vs) {
    ReportOnce(Severity::Error, MsgCode::NoVertexShader, "a draw is skipped: no vertex shader is set");
    return false;
  }
  if (!CheckInputs(*vs, gs)) return false;
  if (dirty_ & DirtyTargets) framebuffer_ = &core_.framebuffers.Get(TargetsOf(state_));
  if (framebuffer_->problem != MsgCode::None) {
    ReportOnce(Severity::Error, framebuffer_->problem, "a draw is skipped: %s", framebuffer_->explanation.c_str());
    return false;
  }
  if (state_.viewportCount == 0) {
    ReportOnce(Severity::Error, MsgCode::NothingBound, "a draw is skipped: no viewport is set; call RSSetViewports");
    return false;
  }
  if (dirty_ & DirtyShaders) {
    program_ = &core_.programs.Get(vs, gs, ShaderOf(state_, Stage::Pixel), &stats_.pipelineMisses);
    ++stats_.pipelineLookups;
  }
  if (program_->name != 0) return true;
  ReportOnce(Severity::Error, MsgCode::ShaderRejected, "a draw is skipped: its shaders did not link");
  return false;
}

inline void Context::ApplyProgram() {
  if (dirty_ & DirtyTopology) {
    mode_ = kModes[size_t(state_.topology)];
    gl_.Set(GlState::StripCut, IsStrip(state_.topology));
  }
  gl_.UseProgram(program_->uid, program_->name);
  usesVertexId_ = program_->usesVertexId;
  if (!program_->readsResources) return;
  for (uint32_t stage = 0; stage < uint32_t(Stage::Compute); ++stage) {
    const uint32_t causes = DirtyShaders | DirtyResources << stage | DirtySamplers << stage;
    const Shader* shader = ShaderOf(state_, Stage(stage));
    if (shader && shader->readsResources && (dirty_ & causes)) BindStage(Stage(stage), *shader);
  }
}

void Context::ApplyVertexArray() {
  auto* layout = static_cast<InputLayout*>(state_.layout.get());
  VertexArray& array = layout ? layout->array : emptyArray_;
  gl_.UseVertexArray(array.uid, array.name);
  for (uint32_t left = array.slotMask; left != 0; left &= left - 1) {
    const uint32_t slot = uint32_t(std::countr_zero(left));
    const VertexBufferBinding& b = state_.vertexBuffers[slot];
    const auto* buffer = static_cast<const Buffer*>(b.buffer.get());
    // What is not bound reads 0: from the buffer of zeros, without a stride.
    const VertexArray::BoundBuffer wanted =
        buffer ? VertexArray::BoundBuffer{buffer->uid, buffer->offset + b.offset, b.stride}
               : VertexArray::BoundBuffer{0, 0, 0};
    if (array.buffers[slot] == wanted) continue;
    array.buffers[slot] = wanted;
    glVertexArrayVertexBuffer(array.name, slot, buffer ? buffer->name : core_.zeroBuffer, GLintptr(wanted.offset),
                              GLsizei(wanted.stride));
  }
  ApplyIndexBuffer(array);
}

void Context::ApplyIndexBuffer(VertexArray& array) {
  const auto* buffer = static_cast<const Buffer*>(state_.indexBuffer.get());
  hasIndices_ = buffer != nullptr;
  if (!buffer) return;
  const bool small = state_.indexFormat == Format::R16_UInt;
  indexType_ = small ? GL_UNSIGNED_SHORT : GL_UNSIGNED_INT;
  indexShift_ = small ? 1 : 2;
  indexBase_ = uint64_t(buffer->offset) + state_.indexOffset;
  if (array.indexUid == buffer->uid) return;
  array.indexUid = buffer->uid;
  glVertexArrayElementBuffer(array.name, buffer->name);
}

// Rasterizer and output merger, without its blending.
void Context::ApplyOutput() {
  static const RasterizerDesc kRaster;
  static const DepthStencilDesc kDepth;
  const RasterizerDesc& raster = state_.raster ? state_.raster->Desc() : kRaster;
  if ((dirty_ & DirtyRaster) || (raster.depthBias != 0 && (dirty_ & DirtyTargets)))
    gl_.SetRaster(raster, framebuffer_->floatDepth ? core_.depthBiasUnits : 1);
  if (dirty_ & DirtyViewports) gl_.SetViewports(state_.viewports.data(), state_.viewportCount);
  if (dirty_ & DirtyScissors) gl_.SetScissors(state_.scissors.data(), state_.scissorCount);
  if (dirty_ & (DirtyDepthStencil | DirtyStencilRef))
    gl_.SetDepthStencil(state_.depthStencil ? state_.depthStencil->Desc() : kDepth, state_.stencilRef);
  if (dirty_ & DirtyBlendFactor) gl_.SetBlendFactor(state_.blendFactor);
  if (dirty_ & (DirtyBlendFactor | DirtyTargets)) gl_.SetSampleMask(state_.sampleMask, framebuffer_->samples);
}

inline void Context::ApplyBlend() {
  static const BlendDesc kBlend;
  // Without a pixel shader colours stay as they are; GL would write whatever it finds.
  const bool colors = ShaderOf(state_, Stage::Pixel) != nullptr;
  const auto* blend = static_cast<const BlendState*>(state_.blend.get());
  if ((dirty_ & (DirtyBlend | DirtyTargets)) || colors != writesColors_)
    gl_.SetBlend(blend ? blend->Desc() : kBlend, colors, state_.targetCount);
  writesColors_ = colors;
}

bool Context::ApplyGraphics() {
  if ((dirty_ & DirtyThread) && !Enter()) return false;
  if (dirty_ & DirtyBarrier) Barrier();
  if (!CheckGraphics()) {
    dirty_ |= DirtyUnusable;
    return false;
  }
  if (gl_.UseFramebuffer(framebuffer_->uid, framebuffer_->name)) ++stats_.passes;
  ApplyProgram();
  if (dirty_ & (DirtyLayout | DirtyVertexBuffers | DirtyIndexBuffer)) ApplyVertexArray();
  if (dirty_ & kOutput) ApplyOutput();
  if (dirty_ & (DirtyBlend | DirtyTargets | DirtyShaders)) ApplyBlend();
  if (dirty_ & (DirtyConstants | kConstantSlots))
    BindConstants(dirty_ & DirtyConstants ? 0xFu : (dirty_ & kConstantSlots) / DirtyConstantSlot);
  dirty_ &= ~kGraphics;
  return true;
}

}  // namespace rhi_gl

// Draws: the short way (nothing changed, or only constants) and PrepareDraw.
#include <cstddef>

#include "context.h"

namespace rhi_vulkan {
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

// What a use of resources must look at again.
constexpr uint32_t kDirtyInputs = kDirtyPass | kDirtyGraphicsResources | backend::DirtyShaders | backend::DirtyLayout |
                                  backend::DirtyVertexBuffers | backend::DirtyIndexBuffer | backend::DirtyConstants;
constexpr uint32_t kDirtyChecks = backend::DirtyShaders | backend::DirtyLayout | backend::DirtyTargets |
                                  backend::DirtyViewports | backend::DirtyTopology;

bool IsFed(const Shader& vs, const IInputLayout* layout) {
  return !(vs.inputMask & ~(layout ? static_cast<const InputLayout*>(layout)->locationMask : 0u));
}

}  // namespace

void Context::Draw(uint32_t vertexCount, uint32_t startVertex) {
  if (!ReadyToDraw()) return;
  if (emulateStarts_) [[unlikely]]
    PushStarts({startVertex, 0});
  vk_.vkCmdDraw(cmd_, vertexCount, 1, startVertex, 0);
  ++stats_.draws;
}

void Context::DrawIndexed(uint32_t indexCount, uint32_t startIndex, int32_t baseVertex) {
  if (!ReadyToDraw() || !CheckIndexBuffer()) return;
  if (emulateStarts_) [[unlikely]]
    PushStarts({uint32_t(baseVertex), 0});
  vk_.vkCmdDrawIndexed(cmd_, indexCount, 1, startIndex, baseVertex, 0);
  ++stats_.draws;
}

void Context::DrawInstanced(uint32_t vertexCountPerInstance, uint32_t instanceCount, uint32_t startVertex,
                            uint32_t startInstance) {
  if (!ReadyToDraw()) return;
  if (emulateStarts_) [[unlikely]]
    PushStarts({startVertex, startInstance});
  vk_.vkCmdDraw(cmd_, vertexCountPerInstance, instanceCount, startVertex, startInstance);
  ++stats_.draws;
}

void Context::DrawIndexedInstanced(uint32_t indexCountPerInstance, uint32_t instanceCount, uint32_t startIndex,
                                   int32_t baseVertex, uint32_t startInstance) {
  if (!ReadyToDraw() || !CheckIndexBuffer()) return;
  if (emulateStarts_) [[unlikely]]
    PushStarts({uint32_t(baseVertex), startInstance});
  vk_.vkCmdDrawIndexed(cmd_, indexCountPerInstance, instanceCount, startIndex, baseVertex, startInstance);
  ++stats_.draws;
}

void Context::DrawInstancedIndirect(IBuffer* args, uint32_t offset) {
  Buffer* buffer = PrepareIndirect(args, offset, sizeof(DrawArgs), offsetof(DrawArgs, startVertex));
  if (!buffer || !ReadyToDraw()) return;
  if (emulateStarts_) PushStarts({0, 0, 1});
  vk_.vkCmdDrawIndirect(cmd_, buffer->Handle(), buffer->Offset() + offset, 1, 0);
  ++stats_.draws;
}

void Context::DrawIndexedInstancedIndirect(IBuffer* args, uint32_t offset) {
  Buffer* buffer = PrepareIndirect(args, offset, sizeof(DrawIndexedArgs), offsetof(DrawIndexedArgs, baseVertex));
  if (!buffer || !ReadyToDraw() || !CheckIndexBuffer()) return;
  if (emulateStarts_) PushStarts({0, 0, 1});
  vk_.vkCmdDrawIndexedIndirect(cmd_, buffer->Handle(), buffer->Offset() + offset, 1, 0);
  ++stats_.draws;
}

bool Context::CheckIndexBuffer() {
  if (state_.indexBuffer) [[likely]]
    return true;
  Report(Severity::Error, MsgCode::IndexBufferMissing, "",
         "indexed draw without an index buffer; call IASetIndexBuffer; it is skipped");
  return false;
}

Buffer* Context::PrepareIndirect(IBuffer* args, uint32_t offset, uint32_t size, uint32_t startsAt) {
  auto* buffer = static_cast<Buffer*>(args);
  if (!buffer || !(buffer->Desc().bind & Bind::IndirectArgs)) {
    Report(Severity::Error, MsgCode::WrongBindFlag, buffer ? buffer->Name().c_str() : "",
           "indirect arguments need a buffer made with Bind::IndirectArgs; the call is skipped");
    return nullptr;
  }
  if (offset % 4 != 0 || offset > buffer->Desc().byteWidth || size > buffer->Desc().byteWidth - offset) {
    Report(Severity::Error, MsgCode::OutOfBounds, buffer->Name().c_str(),
           "indirect arguments reach beyond the buffer, or the offset is no multiple of 4; the call is skipped");
    return nullptr;
  }
  if (emulateStarts_ && startsAt < size) CopyStarts(*buffer, offset + startsAt);
  Use(*buffer, kIndirectRead);
  RecordBarriers();
  return buffer;
}

void Context::PushStarts(const DrawStarts& starts) {
  if (pushedStarts_ == starts) return;
  pushedStarts_ = starts;
  vk_.vkCmdPushConstants(cmd_, pipeline_->layout, VK_SHADER_STAGE_VERTEX_BIT, 0, sizeof starts, &starts);
}

// Only the GPU knows where an indirect draw starts, and only a copy brings that to the shader: at the cost of a pass.
void Context::CopyStarts(Buffer& args, uint32_t offset) {
  static_assert(offsetof(DrawArgs, startInstance) == offsetof(DrawArgs, startVertex) + 4);
  static_assert(offsetof(DrawIndexedArgs, startInstance) == offsetof(DrawIndexedArgs, baseVertex) + 4);
  const auto* vs = static_cast<const Shader*>(state_.shaders[size_t(Stage::Vertex)].get());
  if (!vs || !(vs->reflection.usesVertexId || vs->reflection.usesInstanceId)) return;
  LeavePass();
  Use(args, kCopySource);
  starts_.state.readStages |= StageBits(Stage::Vertex);  // of direct draws, which look at it too and do not say so
  UseStaging(starts_, kCopyDest);
  RecordBarriers();
  const VkBufferCopy region{args.Offset() + offset, 0, 2 * sizeof(uint32_t)};
  vk_.vkCmdCopyBuffer(cmd_, args.Handle(), starts_.handle, 1, &region);
  UseStaging(starts_, UniformRead(StageBits(Stage::Vertex)));
  RecordBarriers();
}

// Other shaders or blending, and nothing else: with the same pipeline layout the shaders read the same registers, so
// neither barriers nor sets change. False: PrepareDraw must look.
bool Context::SwitchPipeline() {
  const auto shader = [&](Stage s) { return static_cast<const Shader*>(state_.shaders[size_t(s)].get()); };
  const Shader *vs = shader(Stage::Vertex), *gs = shader(Stage::Geometry), *ps = shader(Stage::Pixel);
  if (!pipeline_ || !vs || !IsFed(*vs, state_.layout.get())) return false;
  if (gs && ListOf(state_.topology) != gs->reflection.gsInput) return false;
  const auto* blend = static_cast<const BlendState*>(state_.blend.get());
  PipelineKey key = key_;
  key.vs = vs->id;
  key.gs = gs ? gs->id : 0;
  key.ps = ps ? ps->id : 0;
  key.blend = blend ? blend->id : 0;
  const Pipeline* pipeline = core_->pipelines->Recent(key);
  if (!pipeline || !pipeline->handle || pipeline->layout != pipeline_->layout) return false;
  if (pipeline != pipeline_) {
    ++stats_.pipelineLookups;
    vk_.vkCmdBindPipeline(cmd_, VK_PIPELINE_BIND_POINT_GRAPHICS, pipeline->handle);
    pipeline_ = pipeline;
    key_ = key;
  }
  if (dirty_ & kDirtyOffsets) BindConstantOffsets();
  dirty_ &= ~kDirtySwitch;
  return true;
}

bool Context::PrepareDraw() {
  if (core_->lost) return false;
  if ((dirty_ & kDirtyChecks) && !CheckDraw()) return false;
  PassTargets targets;
  const bool newTargets = dirty_ & (backend::DirtyTargets | kDirtyPass);
  if (newTargets && !GatherTargets(&targets)) return false;
  if (state_.viewportCount == 0) {
    Report(Severity::Error, MsgCode::NothingBound, "", "draw without a viewport; call RSSetViewports; it is skipped");
    return false;
  }
  if (newTargets && inPass_ && !(targets == pass_)) EndPass(false);
  if (dirty_ & kDirtyInputs) UseInputs();
  RecordBarriers();
  if (!inPass_) {
    if (!newTargets && !GatherTargets(&targets)) return false;
    BeginPass(targets);
  }
  if ((dirty_ & kDirtyPipeline) && !BindPipeline()) return false;
  ApplyDynamicState();
  if (dirty_ & (backend::DirtyVertexBuffers | backend::DirtyLayout)) BindVertexBuffers();
  if ((dirty_ & backend::DirtyIndexBuffer) && state_.indexBuffer) BindIndexBuffer();
  if ((dirty_ & (kDirtyGraphicsResources | kDirtySets)) && !BindStageSets()) return false;
  if ((dirty_ & (backend::DirtyConstants | kDirtyOffsets)) && !BindConstants()) return false;
  dirty_ &= ~kDirtyDraw;
  return true;
}

bool Context::CheckDraw() {
  const auto* vs = static_cast<const Shader*>(state_.shaders[size_t(Stage::Vertex)].get());
  const auto* gs = static_cast<const Shader*>(state_.shaders[size_t(Stage::Geometry)].get());
  if (!vs) {
    Report(Severity::Error, MsgCode::NoVertexShader, "",
           "draw without a vertex shader; call VSSetShader; it is skipped");
    return false;
  }
  if (!IsFed(*vs, state_.layout.get())) {
    Report(Severity::Error, MsgCode::LayoutMismatch, vs->Name().c_str(),
           "the vertex shader has inputs that no input layout, or not the bound one, gives; call IASetInputLayout with "
           "one made for it; the draw is skipped");
    return false;
  }
  return !gs || CheckGeometryInput(gs);
}

bool Context::CheckGeometryInput(const Shader* gs) {
  if (ListOf(state_.topology) == gs->reflection.gsInput) return true;
  char text[160];
  std::snprintf(text, sizeof text, "the geometry shader takes %s but the topology is %s; the draw is skipped",
                rhi::ToString(gs->reflection.gsInput), rhi::ToString(state_.topology));
  Report(Severity::Error, MsgCode::TopologyMismatch, gs->Name().c_str(), text);
  return false;
}

// Looks again only at what may have changed: what was in order stays so until work outside of the pass.
void Context::UseInputs() {
  const uint32_t dirty = dirty_ & kDirtyPass ? ~0u : dirty_;
  for (uint32_t i = 0; i < 3; ++i)
    if (dirty & (backend::DirtyShaders | backend::DirtyResources << i))
      UseStageInputs(Stage(i), static_cast<const Shader*>(state_.shaders[i].get()));
  const auto* layout = static_cast<const InputLayout*>(state_.layout.get());
  if (layout && (dirty & (backend::DirtyVertexBuffers | backend::DirtyLayout)))
    for (uint32_t slot = 0; layout->slotMask >> slot; ++slot)
      if (auto* buffer = static_cast<Buffer*>(state_.vertexBuffers[slot].buffer.get());
          buffer && (layout->slotMask >> slot & 1u))
        Use(*buffer, kVertexRead);
  if (state_.indexBuffer && (dirty & backend::DirtyIndexBuffer))
    Use(static_cast<Buffer&>(*state_.indexBuffer), kIndexRead);
  if (!(dirty & backend::DirtyConstants)) return;
  for (const Ref<IBuffer>& constants : state_.constants)
    if (constants) Use(static_cast<Buffer&>(*constants), UniformRead(constantStages_));
}

void Context::UseStageInputs(Stage stage, const Shader* shader) {
  if (!shader || !shader->reflection.resources.size) return;
  for (const ShaderResource& r : shader->reflection.resources) {
    auto* view = static_cast<ShaderView*>(state_.resources[size_t(stage)][r.slot].get());
    if (!view) continue;
    if (view->texture) {
      Use(*view->texture, view->Range(), SampledRead(stage, GetFormatInfo(view->Desc().format).depth));
    } else {
      Use(*view->buffer, StorageRead(stage));
    }
  }
}

PipelineKey Context::CurrentKey() const {
  const auto id = [](const auto* object) { return object ? object->id : 0u; };
  const auto shader = [&](Stage s) { return id(static_cast<const Shader*>(state_.shaders[size_t(s)].get())); };
  PipelineKey key;
  key.vs = shader(Stage::Vertex);
  key.gs = shader(Stage::Geometry);
  key.ps = shader(Stage::Pixel);
  key.layout = id(static_cast<const InputLayout*>(state_.layout.get()));
  key.blend = id(static_cast<const BlendState*>(state_.blend.get()));
  key.sampleMask = state_.sampleMask;
  for (uint32_t i = 0; i < pass_.colorCount; ++i)
    if (pass_.colors[i]) key.rtv[i] = pass_.colors[i]->Desc().format;
  if (pass_.depth) key.dsv = pass_.depth->Desc().format;
  key.topology = ClassOf(state_.topology);
  key.rtvCount = uint8_t(pass_.colorCount);
  key.samples = uint8_t(pass_.samples);
  if (const auto* raster = static_cast<const RasterState*>(state_.raster.get())) {
    key.wireframe = raster->Desc().fill == FillMode::Wireframe;
    key.depthClip = raster->Desc().depthClip;
  }
  return key;
}

bool Context::BindPipeline() {
  const PipelineKey key = CurrentKey();
  if (pipeline_ && key == key_) return true;
  ++stats_.pipelineLookups;
  const auto shader = [&](Stage s) { return static_cast<Shader*>(state_.shaders[size_t(s)].get()); };
  const auto* blend = static_cast<const BlendState*>(state_.blend.get());
  const PipelineParts parts{shader(Stage::Vertex), shader(Stage::Geometry), shader(Stage::Pixel),
                            static_cast<const InputLayout*>(state_.layout.get()), blend ? &blend->Desc() : nullptr};
  const Pipeline& pipeline = core_->pipelines->Get(key, parts);
  if (!pipeline.handle) {
    pipeline_ = nullptr;
    if (pipeline.status == Status::OutOfMemory || pipeline.status == Status::DeviceLost) return false;
    Report(Severity::Error, MsgCode::ShaderRejected, parts.vs->Name().c_str(),
           "the driver refused the pipeline of this draw; it is skipped");
    return false;
  }
  vk_.vkCmdBindPipeline(cmd_, VK_PIPELINE_BIND_POINT_GRAPHICS, pipeline.handle);
  if (!pipeline_ || pipeline_->layout != pipeline.layout) dirty_ |= kDirtySets;
  pipeline_ = &pipeline;
  key_ = key;
  return true;
}

void Context::BindVertexBuffers() {
  const auto* layout = static_cast<const InputLayout*>(state_.layout.get());
  if (!layout || !layout->slotMask) return;
  std::array<VkBuffer, kMaxVertexBuffers> handles;
  std::array<VkDeviceSize, kMaxVertexBuffers> offsets, sizes, strides;
  uint32_t count = 0;
  for (uint32_t slot = 0; layout->slotMask >> slot; ++slot, ++count) {
    const backend::VertexBufferBinding& b = state_.vertexBuffers[slot];
    const auto* buffer = static_cast<const Buffer*>(b.buffer.get());
    const bool inside = buffer && b.offset < buffer->Desc().byteWidth;
    handles[slot] = inside ? buffer->Handle() : null_.zeros.handle;  // unbound: every vertex reads 0
    offsets[slot] = inside ? buffer->Offset() + b.offset : 0;
    sizes[slot] = inside ? buffer->Desc().byteWidth - b.offset : kMaxConstantBufferBytes;
    strides[slot] = inside ? b.stride : 0;
  }
  vk_.vkCmdBindVertexBuffers2(cmd_, 0, count, handles.data(), offsets.data(), sizes.data(), strides.data());
}

void Context::BindIndexBuffer() {
  const auto& buffer = static_cast<const Buffer&>(*state_.indexBuffer);
  const bool is16 = state_.indexFormat == Format::R16_UInt;
  const VkIndexType type = is16 ? VK_INDEX_TYPE_UINT16 : VK_INDEX_TYPE_UINT32;
  if (state_.indexOffset >= buffer.Desc().byteWidth || state_.indexOffset % (is16 ? 2 : 4) != 0) {
    Report(Severity::Error, MsgCode::OutOfBounds, buffer.Name().c_str(),
           "the index buffer's offset is beyond its end or no multiple of the index size; its indices read 0");
    return vk_.vkCmdBindIndexBuffer(cmd_, null_.zeros.handle, 0, type);
  }
  vk_.vkCmdBindIndexBuffer(cmd_, buffer.Handle(), buffer.Offset() + state_.indexOffset, type);
}

}  // namespace rhi_vulkan

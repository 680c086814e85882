// For backends: the part of a context that only remembers what is bound. It keeps the references, drops sets that change
// nothing, applies Direct3D 10's rule for resources bound as input and as target, and leaves dirty bits to the backend.
#pragma once

#include "rhi/backend/object.h"

namespace rhi::backend {

// What changed since the backend last looked. Resources and Samplers are shifted by the stage.
enum Dirty : uint32_t {
  DirtyLayout = 1u << 0,
  DirtyTopology = 1u << 1,
  DirtyVertexBuffers = 1u << 2,
  DirtyIndexBuffer = 1u << 3,
  DirtyShaders = 1u << 4,  // vertex, geometry or pixel
  DirtyComputeShader = 1u << 5,
  DirtyConstants = 1u << 6,  // another buffer in a slot; new contents are the backend's business
  DirtyRaster = 1u << 7,
  DirtyViewports = 1u << 8,
  DirtyScissors = 1u << 9,
  DirtyBlend = 1u << 10,
  DirtyBlendFactor = 1u << 11,  // factor or sample mask
  DirtyDepthStencil = 1u << 12,
  DirtyStencilRef = 1u << 13,
  DirtyTargets = 1u << 14,
  DirtyUavs = 1u << 15,
  DirtyResources = 1u << 16,  // << stage
  DirtySamplers = 1u << 20,   // << stage
  DirtyAll = ~0u
};

struct VertexBufferBinding {
  Ref<IBuffer> buffer;
  uint32_t stride = 0, offset = 0;
};

struct BoundState {
  Ref<IInputLayout> layout;
  PrimitiveTopology topology = PrimitiveTopology::TriangleList;
  std::array<VertexBufferBinding, kMaxVertexBuffers> vertexBuffers;
  Ref<IBuffer> indexBuffer;
  Format indexFormat = Format::R32_UInt;
  uint32_t indexOffset = 0;

  std::array<Ref<IShader>, kStageCount> shaders;
  std::array<Ref<IBuffer>, kMaxConstantBuffers> constants;
  std::array<std::array<Ref<IShaderResourceView>, kMaxShaderResources>, kStageCount> resources;
  std::array<std::array<Ref<ISamplerState>, kMaxSamplers>, kStageCount> samplers;
  std::array<Ref<IUnorderedAccessView>, kMaxUnorderedAccess> uavs;

  Ref<IRasterizerState> raster;
  std::array<Viewport, kMaxViewports> viewports{};
  std::array<Rect, kMaxViewports> scissors{};
  uint32_t viewportCount = 0, scissorCount = 0;

  Ref<IBlendState> blend;
  std::array<float, 4> blendFactor{1, 1, 1, 1};
  uint32_t sampleMask = ~0u;
  Ref<IDepthStencilState> depthStencil;
  uint32_t stencilRef = 0;
  std::array<Ref<IRenderTargetView>, kMaxRenderTargets> targets;
  uint32_t targetCount = 0;
  Ref<IDepthStencilView> depthTarget;
};

class ContextBase : public IContext {
 public:
  void IASetInputLayout(IInputLayout*) override;
  void IASetPrimitiveTopology(PrimitiveTopology) override;
  void IASetVertexBuffers(uint32_t firstSlot, uint32_t count, IBuffer* const* buffers, const uint32_t* strides,
                          const uint32_t* offsets) override;
  void IASetIndexBuffer(IBuffer*, Format, uint32_t offset) override;
  void SetShader(Stage, IShader*) override;
  void SetConstantBuffers(uint32_t first, uint32_t count, IBuffer* const*) override;
  void SetShaderResources(Stage, uint32_t first, uint32_t count, IShaderResourceView* const*) override;
  void SetSamplers(Stage, uint32_t first, uint32_t count, ISamplerState* const*) override;
  void CSSetUnorderedAccessViews(uint32_t first, uint32_t count, IUnorderedAccessView* const*) override;
  void RSSetState(IRasterizerState*) override;
  void RSSetViewports(uint32_t count, const Viewport*) override;
  void RSSetScissorRects(uint32_t count, const Rect*) override;
  void OMSetBlendState(IBlendState*, const float factor[4], uint32_t sampleMask) override;
  void OMSetDepthStencilState(IDepthStencilState*, uint32_t stencilRef) override;
  void OMSetRenderTargets(uint32_t count, IRenderTargetView* const*, IDepthStencilView*) override;
  void ClearState() override;

 protected:
  explicit ContextBase(const MessageLog& log) : log_(log) {}
  ~ContextBase() = default;

  BoundState state_;
  uint32_t dirty_ = DirtyAll;
  Stats stats_;
  const MessageLog& log_;

 private:
  template <class T>
  void Replace(Ref<T>& slot, T* value, uint32_t dirty);  // sets `dirty` unless it was bound already
  bool CheckSlots(const char* what, uint32_t first, uint32_t count, uint32_t limit);
  bool BoundAsTarget(const IView& input) const;
  void UnbindInputsOf(const IView& target);
};

// Whether two views show a common subresource of one resource.
bool ViewsOverlap(const IView& a, const IView& b);

}  // namespace rhi::backend

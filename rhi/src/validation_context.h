// The validating context. Its base keeps a shadow of what is bound, by the same code as the backends.
#pragma once

#include "rhi/backend/checks.h"
#include "rhi/backend/context_base.h"
#include "rhi/backend/data_checks.h"
#include "validation_log.h"

namespace rhi::validation {

using backend::Misuse;

class Context final : public backend::ContextBase {
 public:
  Context(Validation& v, IContext& inner, IDevice& device)
      : ContextBase(v.quiet), v_(v), inner_(inner), device_(device) {}
  void CheckOpenAtFrameEnd();
  // A backend may keep the constant buffers of the last draw or dispatch beyond ClearState, until the next one.
  bool UsedByLastDraw(const IObject*) const;

  // validation_bind.cpp
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

  // validation_data.cpp
  Status Map(IResource*, uint32_t subresource, MapMode, Mapped*) override;
  void Unmap(IResource*, uint32_t subresource) override;
  void UpdateConstants(IBuffer*, const void* data, uint32_t size) override;
  void UpdateSubresource(IResource*, uint32_t subresource, const Box*, const void* data, uint32_t rowPitch,
                         uint32_t slicePitch) override;

  // validation_copy.cpp
  void ClearRenderTargetView(IRenderTargetView*, const float rgba[4]) override;
  void ClearDepthStencilView(IDepthStencilView*, bool clearDepth, float depth, bool clearStencil,
                             uint8_t stencil) override;
  void CopyResource(IResource* dst, IResource* src) override;
  void CopySubresourceRegion(IResource* dst, uint32_t dstSubresource, uint32_t x, uint32_t y, uint32_t z,
                             IResource* src, uint32_t srcSubresource, const Box*) override;
  void ResolveSubresource(ITexture* dst, uint32_t dstSubresource, ITexture* src, uint32_t srcSubresource,
                          Format) override;
  void GenerateMips(IShaderResourceView*) override;

  // validation_draw.cpp
  void Draw(uint32_t vertexCount, uint32_t startVertex) override;
  void DrawIndexed(uint32_t indexCount, uint32_t startIndex, int32_t baseVertex) override;
  void DrawInstanced(uint32_t vertexCountPerInstance, uint32_t instanceCount, uint32_t startVertex,
                     uint32_t startInstance) override;
  void DrawIndexedInstanced(uint32_t indexCountPerInstance, uint32_t instanceCount, uint32_t startIndex,
                            int32_t baseVertex, uint32_t startInstance) override;
  void DrawInstancedIndirect(IBuffer* args, uint32_t offset) override;
  void DrawIndexedInstancedIndirect(IBuffer* args, uint32_t offset) override;
  void Dispatch(uint32_t x, uint32_t y, uint32_t z) override;
  void DispatchIndirect(IBuffer* args, uint32_t offset) override;

  // validation_query.cpp
  void Begin(IQuery*) override;
  void End(IQuery*) override;
  Status GetData(IQuery*, void* data, uint32_t size, bool flush) override;
  void BeginEvent(const char* name) override;
  void EndEvent() override;
  void Flush() override { inner_.Flush(); }
  void EndFrame() override;
  IDevice* Device() override { return &device_; }

 private:
  struct Range {  // of a direct draw
    uint64_t first = 0, count = 0, firstInstance = 0, instances = 1;
  };
  // What several topics use.
  bool Is(const Misuse&, const IObject*);  // true, and said: the call is ignored
  bool NotNull(const char* call, const void*, const char* what);
  bool NotMapped(const char* call, const IResource*);
  bool IsBuffer(const IObject*);
  const char* Name(const IObject* o) const { return v_.objects.NameOf(o); }

  bool Slots(const char* call, uint32_t first, uint32_t count, uint32_t limit, const void* array);
  bool ValidStage(const char* call, Stage);
  bool OwnsAll(const char* call, uint32_t count, const auto* objects) {
    for (uint32_t i = 0; i < count; ++i)
      if (!v_.Owns(call, objects[i])) return false;
    return true;
  }
  bool Bindable(const char* call, IBuffer*, Bind flag, const char* flagName);
  bool ViewportOk(const Viewport&);

  bool CheckMap(IResource*, uint32_t subresource, MapMode, const Mapped*);
  bool CheckUpdateConstants(IBuffer*, const void* data, uint32_t size);

  bool CheckPair(const char* call, IResource* dst, IResource* src);

  bool CheckDraw(const char* call, bool indexed);
  bool CheckVertexShader(const char* call);
  bool CheckTopology(const char* call);
  bool CheckTargets(const char* call);
  void CheckViewports(const char* call, uint32_t width, uint32_t height);
  bool CheckLayout(const char* call);
  bool CheckVertices(const char* call, const Range&, bool indexed);
  bool CheckIndices(const char* call, const Range&);
  bool CheckIndirect(const char* call, IBuffer* args, uint32_t offset, uint32_t size);
  bool CheckDispatch(const char* call);
  bool CheckBoundMapped(const char* call, bool indexed, bool compute);

  // validation_registers.cpp
  bool CheckRegisters(const char* call, Stage);
  bool CheckConstants(const char* call, Stage, const IShader&, const ShaderConstantBuffer&);
  bool CheckResource(const char* call, Stage, const IShader&, const ShaderResource&);
  bool CheckView(const char* call, const IShader&, const ShaderResource&, const IView&);

  void CountWork();

  bool CheckBegin(IQuery*);
  bool CheckEnd(IQuery*);

  Validation& v_;
  IContext& inner_;
  IDevice& device_;
  uint64_t work_ = 0;                                                // draws and dispatches
  std::array<const IObject*, kMaxConstantBuffers> lastConstants_{};  // addresses only
  uint32_t eventDepth_ = 0;
};

}  // namespace rhi::validation

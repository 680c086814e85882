#pragma once

#include "null_objects.h"
#include "rhi/backend/context_base.h"

namespace rhi::null_backend {

class Context final : public backend::ContextBase {
 public:
  Context(Core& core, IDevice& device) : ContextBase(core.log), device_(device) {}

  // null_data.cpp
  Status Map(IResource*, uint32_t subresource, MapMode, Mapped*) override;
  void Unmap(IResource*, uint32_t subresource) override;
  void UpdateConstants(IBuffer*, const void* data, uint32_t size) override;
  void UpdateSubresource(IResource*, uint32_t subresource, const Box*, const void* data, uint32_t rowPitch,
                         uint32_t slicePitch) override;
  void CopyResource(IResource* dst, IResource* src) override;
  void CopySubresourceRegion(IResource* dst, uint32_t dstSubresource, uint32_t x, uint32_t y, uint32_t z,
                             IResource* src, uint32_t srcSubresource, const Box*) override;
  void ResolveSubresource(ITexture* dst, uint32_t dstSubresource, ITexture* src, uint32_t srcSubresource,
                          Format) override;
  void GenerateMips(IShaderResourceView*) override;
  Status ReadBack(ITexture*, uint32_t subresource, void* out, size_t capacity, uint32_t rowPitch);
  Status ReadBack(IBuffer*, uint32_t offset, uint32_t size, void* out);

  // null_context.cpp
  void ClearRenderTargetView(IRenderTargetView*, const float rgba[4]) override;
  void ClearDepthStencilView(IDepthStencilView*, bool clearDepth, float depth, bool clearStencil,
                             uint8_t stencil) override;
  void Draw(uint32_t, uint32_t) override { ++stats_.draws; }
  void DrawIndexed(uint32_t, uint32_t, int32_t) override { ++stats_.draws; }
  void DrawInstanced(uint32_t, uint32_t, uint32_t, uint32_t) override { ++stats_.draws; }
  void DrawIndexedInstanced(uint32_t, uint32_t, uint32_t, int32_t, uint32_t) override { ++stats_.draws; }
  void DrawInstancedIndirect(IBuffer*, uint32_t) override { ++stats_.draws; }
  void DrawIndexedInstancedIndirect(IBuffer*, uint32_t) override { ++stats_.draws; }
  void Dispatch(uint32_t, uint32_t, uint32_t) override { ++stats_.dispatches; }
  void DispatchIndirect(IBuffer*, uint32_t) override { ++stats_.dispatches; }
  void Begin(IQuery*) override;
  void End(IQuery*) override;
  Status GetData(IQuery*, void* data, uint32_t size, bool flush) override;
  void BeginEvent(const char*) override {}
  void EndEvent() override {}
  void Flush() override {}
  void EndFrame() override {}
  IDevice* Device() override { return &device_; }

  Stats TakeStats(bool reset) { return reset ? std::exchange(stats_, {}) : stats_; }

 private:
  struct Side {  // of a copy
    Texture& texture;
    uint32_t subresource, x, y, z;
  };
  Status Refuse(MsgCode, const char* object, const char* text);  // InvalidArg
  bool CheckKinds(IResource* dst, IResource* src);
  void CopyBuffers(Buffer& dst, uint32_t at, const Buffer& src, const Box*);
  void CopyTextures(const Side& dst, const Side& src, const Box*);

  IDevice& device_;
};

}  // namespace rhi::null_backend

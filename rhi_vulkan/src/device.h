#pragma once

#include "context.h"

namespace rhi_vulkan {

class VulkanDevice final : public backend::Object<IDevice> {
 public:
  VulkanDevice(std::shared_ptr<Core> core, const DeviceDesc& desc);
  ~VulkanDevice() override;
  Status Init(const DeviceDesc& desc);

  const Caps& GetCaps() const override { return core_->adapter.caps; }
  FormatSupport CheckFormatSupport(Format) const override;
  uint32_t CheckMultisample(Format, uint32_t samples) const override;
  Status CreateBuffer(const BufferDesc&, const void* init, Ref<IBuffer>*) override;
  Status CreateTexture(const TextureDesc&, const SubresourceData* init, Ref<ITexture>*) override;
  Status CreateShaderResourceView(IResource*, const ViewDesc*, Ref<IShaderResourceView>*) override;
  Status CreateRenderTargetView(ITexture*, const ViewDesc*, Ref<IRenderTargetView>*) override;
  Status CreateDepthStencilView(ITexture*, const ViewDesc*, Ref<IDepthStencilView>*) override;
  Status CreateUnorderedAccessView(IResource*, const ViewDesc*, Ref<IUnorderedAccessView>*) override;
  Status CreateShader(const ShaderBlob&, Ref<IShader>*) override;
  Status CreateInputLayout(const InputElement*, uint32_t count, IShader* vs, Ref<IInputLayout>*) override;
  Status CreateBlendState(const BlendDesc&, Ref<IBlendState>*) override;
  Status CreateDepthStencilState(const DepthStencilDesc&, Ref<IDepthStencilState>*) override;
  Status CreateRasterizerState(const RasterizerDesc&, Ref<IRasterizerState>*) override;
  Status CreateSamplerState(const SamplerDesc&, Ref<ISamplerState>*) override;
  Status CreateQuery(const QueryDesc&, Ref<IQuery>*) override;
  Status CreateSwapChain(const SwapChainDesc&, Ref<ISwapChain>*) override;
  Status PrecachePipeline(const PipelineKeyDesc&) override;
  size_t GetPipelineCacheBlob(void* out, size_t capacity) override;
  IContext* ImmediateContext() override { return context_.get(); }
  Status ReadBack(ITexture*, uint32_t subresource, void* out, size_t capacity, uint32_t rowPitch) override;
  Status ReadBack(IBuffer*, uint32_t offset, uint32_t size, void* out) override;
  Status WaitIdle() override { return context_->Finish(); }
  Stats GetStats(bool reset) override { return context_->TakeStats(reset); }

 private:
  template <class Interface>
  Status CreateTextureView(Texture*, const ViewDesc*, Bind need, Ref<Interface>*);
  template <class Interface>
  Status CreateBufferView(Buffer*, const ViewDesc*, Bind need, Ref<Interface>*);
  template <class Interface>
  Status CreateView(IResource*, const ViewDesc*, Bind need, Ref<Interface>*);
  template <class Object, class Desc, class Interface>
  Status CreateState(const Desc&, Ref<Interface>*);
  Status Refuse(Status, MsgCode, const char* object, const char* text) const;

  std::shared_ptr<Core> core_;
  std::unique_ptr<Context> context_;
};

}  // namespace rhi_vulkan

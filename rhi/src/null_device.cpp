#include <strings.h>

#include <cstring>

#include "null_context.h"

namespace rhi::null_backend {
namespace {

Caps MakeCaps() {
  Caps c;
  std::strcpy(c.adapter.data(), "null device");
  std::strcpy(c.driver.data(), "none");
  c.software = true;
  c.geometryShader = c.layeredRendering = c.alphaToCoverage = c.independentBlend = c.dualSourceBlend = c.wireframe =
      c.depthClipDisable = c.depthBiasClamp = c.instanceStepRate = c.customBorderColor = true;
  c.timestamp = c.pipelineStatistics = c.occlusionPrecise = c.drawIndirect = c.compute = c.samplerAnisotropy =
      c.textureCompressionBC = true;
  c.maxTexture2D = 8192;  // what Direct3D 10 asks for
  c.maxTexture3D = 2048;
  c.maxArrayLayers = 512;
  c.maxColorSamples = 8;
  c.maxGSOutputVertices = c.maxGSOutputComponents = 1024;
  c.timestampPeriodNs = 1;
  return c;
}

bool IsColorTarget(const FormatInfo& f) { return f.blockBytes > 0 && f.blockSize == 1 && !f.depth; }

FormatSupport SupportOf(Format format) {
  const FormatInfo& f = GetFormatInfo(format);
  using enum FormatSupport;
  if (f.blockBytes == 0) return None;
  FormatSupport s = format == Format::RGB32_Float ? None : Texture2D | Sample;
  if (IsColorTarget(f)) s = s | VertexBuffer;
  if (format == Format::R16_UInt || format == Format::R32_UInt) s = s | IndexBuffer;
  if (format == Format::RGB32_Float) return s;
  if (!f.isInteger) s = s | SampleLinear;
  if (f.depth) s = s | DepthStencil | Multisample;
  if (IsColorTarget(f)) s = s | RenderTarget | Multisample | UnorderedAccess;
  if (IsColorTarget(f) && !f.isInteger) s = s | Blendable | Resolve | MipAutogen;
  return s;
}

class Device final : public backend::Object<IDevice> {
 public:
  explicit Device(IMessageSink* sink) : core_(std::make_shared<Core>(sink)), context_(*core_, *this) {
    core_->caps = MakeCaps();
  }
  ~Device() override { context_.ClearState(); }

  const Caps& GetCaps() const override { return core_->caps; }
  FormatSupport CheckFormatSupport(Format f) const override { return SupportOf(f); }
  uint32_t CheckMultisample(Format f, uint32_t samples) const override {
    const bool power = samples > 0 && (samples & (samples - 1)) == 0;
    return power && samples <= core_->caps.maxColorSamples && (SupportOf(f) & FormatSupport::Multisample);
  }

  Status CreateBuffer(const BufferDesc&, const void* init, Ref<IBuffer>*) override;
  Status CreateTexture(const TextureDesc&, const SubresourceData* init, Ref<ITexture>*) override;
  Status CreateShaderResourceView(IResource* r, const ViewDesc* d, Ref<IShaderResourceView>* out) override {
    return MakeView(r, d, Bind::ShaderResource, out);
  }
  Status CreateRenderTargetView(ITexture* t, const ViewDesc* d, Ref<IRenderTargetView>* out) override {
    return MakeView(t, d, Bind::RenderTarget, out);
  }
  Status CreateDepthStencilView(ITexture* t, const ViewDesc* d, Ref<IDepthStencilView>* out) override {
    return MakeView(t, d, Bind::DepthStencil, out);
  }
  Status CreateUnorderedAccessView(IResource* r, const ViewDesc* d, Ref<IUnorderedAccessView>* out) override {
    return MakeView(r, d, Bind::UnorderedAccess, out);
  }
  Status CreateShader(const ShaderBlob&, Ref<IShader>*) override;
  Status CreateInputLayout(const InputElement*, uint32_t count, IShader* vs, Ref<IInputLayout>*) override;
  Status CreateBlendState(const BlendDesc& d, Ref<IBlendState>* out) override {
    return Intern<BlendState>(backend::CheckBlendDesc(d, core_->caps, core_->log), d, out);
  }
  Status CreateDepthStencilState(const DepthStencilDesc& d, Ref<IDepthStencilState>* out) override {
    return Intern<DepthStencilState>(backend::CheckDepthStencilDesc(d, core_->log), d, out);
  }
  Status CreateRasterizerState(const RasterizerDesc& d, Ref<IRasterizerState>* out) override {
    return Intern<RasterizerState>(backend::CheckRasterizerDesc(d, core_->caps, core_->log), d, out);
  }
  Status CreateSamplerState(const SamplerDesc& d, Ref<ISamplerState>* out) override {
    return Intern<SamplerState>(backend::CheckSamplerDesc(d, core_->caps, core_->log), d, out);
  }
  Status CreateQuery(const QueryDesc& d, Ref<IQuery>* out) override {
    *out = nullptr;
    if (d.type > QueryType::PipelineStatistics) return Invalid("", "QueryDesc::type is none");
    *out = Ref<Query>::Adopt(new Query(d.type));
    return Status::Ok;
  }
  Status CreateSwapChain(const SwapChainDesc& d, Ref<ISwapChain>* out) override {
    *out = nullptr;
    return backend::CheckSwapChainDesc(d, core_->caps, core_->log);
  }

  Status PrecachePipeline(const PipelineKeyDesc& d) override {
    if (d.vs && d.rtvCount <= kMaxRenderTargets) return Status::Ok;
    return Fail(MsgCode::NoVertexShader, "", "PrecachePipeline needs a vertex shader, and at most 8 targets");
  }
  size_t GetPipelineCacheBlob(void*, size_t) override { return 0; }
  IContext* ImmediateContext() override { return &context_; }
  Status ReadBack(ITexture* t, uint32_t subresource, void* out, size_t capacity, uint32_t rowPitch) override {
    return context_.ReadBack(t, subresource, out, capacity, rowPitch);
  }
  Status ReadBack(IBuffer* b, uint32_t offset, uint32_t size, void* out) override {
    return context_.ReadBack(b, offset, size, out);
  }
  Status WaitIdle() override { return Status::Ok; }
  Stats GetStats(bool reset) override { return context_.TakeStats(reset); }

 private:
  Status Fail(MsgCode code, const char* object, const char* text) {
    core_->log.Report(Severity::Error, code, object, "%s", text);
    return Status::InvalidArg;
  }
  Status Invalid(const char* object, const char* text) { return Fail(MsgCode::InvalidDesc, object, text); }

  template <class Interface>
  Status MakeView(IResource* resource, const ViewDesc* wanted, Bind need, Ref<Interface>* out) {
    *out = nullptr;
    if (!resource) return Invalid("", "a view needs a resource; it is null");
    ViewDesc desc;
    const Buffer* b = AsBuffer(resource);
    const Status s = b ? backend::ResolveBufferView(b->Desc(), wanted, need, &desc, core_->log)
                       : backend::ResolveTextureView(AsTexture(resource)->Desc(), wanted, need, &desc, core_->log);
    if (s == Status::Ok) *out = Ref<View<Interface>>::Adopt(new View<Interface>(resource, desc));
    return s;
  }

  // The living object of an equal descriptor, or a new one.
  template <class S, class D, class Interface>
  Status Intern(Status checked, const D& desc, Ref<Interface>* out) {
    *out = nullptr;
    if (checked != Status::Ok) return checked;
    auto& table = std::get<backend::Interner<D, S>>(core_->states);
    Ref<S> state = table.Find(desc);
    if (!state) {
      state = Ref<S>::Adopt(new S(core_, desc));
      table.Remember(state.get());
    }
    *out = state;
    return Status::Ok;
  }

  CorePtr core_;
  Context context_;
};

Status Device::CreateBuffer(const BufferDesc& d, const void* init, Ref<IBuffer>* out) {
  *out = nullptr;
  if (Status s = backend::CheckBufferDesc(d, init, core_->caps, core_->log); s != Status::Ok) return s;
  *out = Ref<Buffer>::Adopt(new Buffer(d, init));
  return Status::Ok;
}

Status Device::CreateTexture(const TextureDesc& desc, const SubresourceData* init, Ref<ITexture>* out) {
  *out = nullptr;
  TextureDesc d = desc;
  if (Status s = backend::CheckTextureDesc(&d, init, core_->caps, core_->log); s != Status::Ok) return s;
  *out = Ref<Texture>::Adopt(new Texture(d, init));
  return Status::Ok;
}

Status Device::CreateShader(const ShaderBlob& blob, Ref<IShader>* out) {
  *out = nullptr;
  if (uint32_t(blob.stage) >= kStageCount) return Fail(MsgCode::ShaderRejected, blob.name, "ShaderBlob::stage is none");
  *out = Ref<Shader>::Adopt(new Shader(blob));
  return Status::Ok;
}

Status Device::CreateInputLayout(const InputElement* elements, uint32_t count, IShader* vs, Ref<IInputLayout>* out) {
  *out = nullptr;
  if (!vs || vs->GetStage() != Stage::Vertex || count > kMaxVertexElements)
    return Fail(MsgCode::LayoutMismatch, "", "an input layout needs a vertex shader and at most 16 elements");
  for (uint32_t i = 0; i < count; ++i) {
    const InputElement& e = elements[i];
    if (e.slot >= kMaxVertexBuffers || (e.inputClass == InputClass::PerInstance && e.stepRate == 0))
      return Invalid(e.semantic, "an element needs a slot below 16, and PerInstance a stepRate of at least 1");
    if (!(SupportOf(e.format) & FormatSupport::VertexBuffer)) {
      Fail(MsgCode::CapMissing, e.semantic, "the element's format is no vertex format; see CheckFormatSupport");
      return Status::Unsupported;
    }
  }
  for (const ShaderInput& input : static_cast<Shader*>(vs)->reflection.inputs) {
    const bool found = std::any_of(elements, elements + count, [&](const InputElement& e) {
      return e.semanticIndex == input.semanticIndex && strcasecmp(e.semantic, input.semantic) == 0;
    });
    if (!found) return Fail(MsgCode::LayoutMismatch, input.semantic, "the shader reads it and no element gives it");
  }
  *out = Ref<InputLayout>::Adopt(new InputLayout);
  return Status::Ok;
}

}  // namespace
}  // namespace rhi::null_backend

namespace rhi {

Status CreateNullDevice(const DeviceDesc& desc, Ref<IDevice>* out) {
  *out = Ref<IDevice>::Adopt(new null_backend::Device(desc.sink));
  return Status::Ok;
}

}  // namespace rhi

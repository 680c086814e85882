#include "caps.h"
#include "context.h"
#include "formats.h"
#include "rhi_gl/rhi_gl.h"
#include "swap_chain.h"

namespace rhi_gl {
namespace {

class Device final : public Object<IDevice> {
 public:
  Device(const CorePtr& core, const DeviceDesc& desc);
  ~Device() override;

  const Caps& GetCaps() const override { return core_->caps; }
  FormatSupport CheckFormatSupport(Format format) const override {
    return formats_[size_t(format) < formats_.size() ? size_t(format) : 0];
  }
  uint32_t CheckMultisample(Format format, uint32_t samples) const override;

  Status CreateBuffer(const BufferDesc& desc, const void* init, Ref<IBuffer>* out) override {
    return Make(out, [&] { return Buffer::Create(core_, desc, init, out); });
  }
  Status CreateTexture(const TextureDesc& desc, const SubresourceData* init, Ref<ITexture>* out) override {
    return Make(out, [&] { return Texture::Create(core_, desc, init, out); });
  }
  Status CreateShaderResourceView(IResource* r, const ViewDesc* desc, Ref<IShaderResourceView>* out) override {
    return Make(out, [&] { return rhi_gl::CreateShaderResourceView(core_, r, desc, out); });
  }
  Status CreateRenderTargetView(ITexture* t, const ViewDesc* desc, Ref<IRenderTargetView>* out) override {
    return Make(out, [&] { return rhi_gl::CreateRenderTargetView(core_, t, desc, out); });
  }
  Status CreateDepthStencilView(ITexture* t, const ViewDesc* desc, Ref<IDepthStencilView>* out) override {
    return Make(out, [&] { return rhi_gl::CreateDepthStencilView(core_, t, desc, out); });
  }
  Status CreateUnorderedAccessView(IResource* r, const ViewDesc* desc, Ref<IUnorderedAccessView>* out) override {
    return Make(out, [&] { return rhi_gl::CreateUnorderedAccessView(core_, r, desc, out); });
  }
  Status CreateShader(const ShaderBlob& blob, Ref<IShader>* out) override {
    return Make(out, [&] { return Shader::Create(core_, blob, out); });
  }
  Status CreateInputLayout(const InputElement* e, uint32_t count, IShader* vs, Ref<IInputLayout>* out) override {
    return Make(out, [&] { return InputLayout::Create(core_, e, count, vs, out); });
  }
  Status CreateBlendState(const BlendDesc& desc, Ref<IBlendState>* out) override {
    return MakeState(out, [&] { return rhi_gl::CreateBlendState(core_, desc, out); });
  }
  Status CreateDepthStencilState(const DepthStencilDesc& desc, Ref<IDepthStencilState>* out) override {
    return MakeState(out, [&] { return rhi_gl::CreateDepthStencilState(core_, desc, out); });
  }
  Status CreateRasterizerState(const RasterizerDesc& desc, Ref<IRasterizerState>* out) override {
    return MakeState(out, [&] { return rhi_gl::CreateRasterizerState(core_, desc, out); });
  }
  Status CreateSamplerState(const SamplerDesc& desc, Ref<ISamplerState>* out) override {
    return Make(out, [&] { return rhi_gl::CreateSamplerState(core_, desc, out); });
  }
  Status CreateQuery(const QueryDesc& desc, Ref<IQuery>* out) override {
    return Make(out, [&] { return Query::Create(core_, desc, out); });
  }
  Status CreateSwapChain(const SwapChainDesc& desc, Ref<ISwapChain>* out) override {
    return Make(out, [&] { return SwapChain::Create(core_, desc, out); });
  }

  Status PrecachePipeline(const PipelineKeyDesc& key) override { return context_->Precache(key); }
  size_t GetPipelineCacheBlob(void*, size_t) override { return 0; }
  IContext* ImmediateContext() override { return context_.get(); }
  Status ReadBack(ITexture* t, uint32_t subresource, void* out, size_t capacity, uint32_t rowPitch) override {
    return context_->ReadBack(t, subresource, out, capacity, rowPitch);
  }
  Status ReadBack(IBuffer* b, uint32_t offset, uint32_t size, void* out) override {
    return context_->ReadBack(b, offset, size, out);
  }
  Status WaitIdle() override { return context_->WaitIdle(); }
  Stats GetStats(bool reset) override { return context_->GetStats(reset); }

 private:
  // Runs `make` unless the device is lost; and what was made while it was lost is nothing.
  template <class T, class F>
  Status Make(Ref<T>* out, F&& make) {
    *out = nullptr;
    if (!core_->Alive()) return Status::DeviceLost;
    const Status s = make();
    if (core_->Alive()) return s;
    *out = nullptr;
    return Status::DeviceLost;
  }
  // The same for what is no object of GL's.
  template <class T, class F>
  Status MakeState(Ref<T>* out, F&& make) {
    *out = nullptr;
    return core_->IsLost() ? Status::DeviceLost : make();
  }

  CorePtr core_;
  std::array<FormatSupport, size_t(Format::Count)> formats_{};
  std::unique_ptr<Context> context_;
};

Device::Device(const CorePtr& core, const DeviceDesc& desc) : core_(core) {
  for (size_t i = 0; i < formats_.size(); ++i) formats_[i] = QueryFormatSupport(Format(i), core->caps);
  context_ = std::make_unique<Context>(*this, core, desc);
}

Device::~Device() {
  context_.reset();
  if (core_->Enter()) core_->Drain();
  core_->log = MessageLog();  // the sink must outlive the device, not the objects that are released after it
}

uint32_t Device::CheckMultisample(Format format, uint32_t samples) const {
  return core_->Enter() && samples > 0 && samples <= GetCaps().maxColorSamples && SupportsSamples(format, samples) ? 1 : 0;
}

// ------------------------------------------------------------------------------------------------------ the adapters

// Caps of whatever OpenGL a place gives; *why where it gives none. Leaves no context current.
bool Probe(const EglPlace& place, Caps* caps, std::string* why) {
  EglContext context;
  Core::ForgetThread();
  if (!context.Create(place, {.major = 0, .minor = 0}, why)) return false;
  *caps = QueryCaps();
  caps->software = caps->software || place.software;
  context.Release();
  return true;
}

bool NameMatches(const Caps& caps, const char* wanted) {
  return std::string(caps.adapter.data()).find(wanted) != std::string::npos ||
         std::string(caps.driver.data()).find(wanted) != std::string::npos;
}

// A device at one place, or the reason why there is none.
CorePtr TryPlace(const EglPlace& place, const DeviceDesc& desc, std::string* why) {
  Caps found;
  const char* wanted = desc.adapter ? desc.adapter : "";
  if (!Probe(place, &found, why)) return nullptr;
  const std::string name = found.adapter.data();
  if (!NameMatches(found, wanted)) {
    *why = name + " is not the adapter asked for, '" + wanted + "'";
    return nullptr;
  }
  auto core = std::make_shared<Core>(desc, found);
  Core::ForgetThread();
  if (!core->egl.Create(place, {.major = 4, .minor = 5, .debug = desc.apiValidation}, why)) {
    *why = name + " has OpenGL " + std::to_string(found.apiMajor) + "." + std::to_string(found.apiMinor) +
           "; OpenGL 4.5 core is needed";
    return nullptr;
  }
  core->caps = QueryCaps();
  core->caps.software = core->caps.software || place.software;
  core->caps.swapChain = desc.nativeDisplay != nullptr;
  core->limits = QueryLimits();
  if (core->Start()) return core;
  *why = name + " has no memory left";
  return nullptr;
}

}  // namespace

Status CreateDevice(const DeviceDesc& desc, Ref<IDevice>* device) {
  *device = nullptr;
  const MessageLog log(desc.sink);
  std::vector<EglPlace> places = ListEglPlaces(desc.nativeDisplay);
  if (desc.preferSoftware)
    std::stable_partition(places.begin(), places.end(), [](const EglPlace& p) { return p.software; });
  std::string reasons = places.empty() ? "EGL lists no device and no surfaceless platform" : "";
  for (const EglPlace& place : places) {
    std::string why;
    if (CorePtr core = TryPlace(place, desc, &why)) {
      *device = Ref<IDevice>::Adopt(new Device(core, desc));
      return Status::Ok;
    }
    reasons += (reasons.empty() ? "" : "; ") + why;
  }
  log.Report(Severity::Error, MsgCode::DeviceUnavailable, "", "no OpenGL device: %s", reasons.c_str());
  return Status::Unsupported;
}

std::vector<Caps> EnumerateAdapters() {
  std::vector<Caps> all;
  for (const EglPlace& place : ListEglPlaces(nullptr)) {
    Caps caps;
    std::string why;
    if (Probe(place, &caps, &why)) all.push_back(caps);
  }
  return all;
}

}  // namespace rhi_gl

// The validating device and swap chain: they forward, and enter what is made into the table.
#include <strings.h>

#include <algorithm>
#include <memory>

#include "rhi/validation.h"
#include "validation_context.h"

namespace rhi::validation {
namespace {

class SwapChain final : public backend::Object<ISwapChain> {
 public:
  SwapChain(std::shared_ptr<Validation> v, Ref<ISwapChain> inner) : v_(std::move(v)), inner_(std::move(inner)) {}

  ITexture* BackBuffer() override {
    ITexture* texture = inner_->BackBuffer();
    if (texture == known_) return texture;
    Forget();
    known_ = texture;
    if (texture) v_->objects.Borrow(ObjectKind::Texture, texture, "back buffer");
    return texture;
  }
  Status Present() override { return inner_->Present(); }
  // Views that the caller has released must not keep the old back buffer.
  Status Resize(uint32_t width, uint32_t height) override {
    v_->objects.Sweep();
    const Status s = inner_->Resize(width, height);
    BackBuffer();
    return s;
  }
  void SetName(const char* name) override { inner_->SetName(name); }

 private:
  ~SwapChain() override {
    Forget();
    v_->objects.Sweep();
  }
  void Forget() {
    if (known_) v_->objects.Return(known_);
    known_ = nullptr;
  }
  std::shared_ptr<Validation> v_;
  Ref<ISwapChain> inner_;
  ITexture* known_ = nullptr;
};

// State objects are interned, and a backend may hold one of its own accord; the QueryOpen of an open query says enough.
bool CanLeak(const ObjectRecord& record) {
  const bool interned = record.kind == ObjectKind::BlendState || record.kind == ObjectKind::DepthStencilState ||
                        record.kind == ObjectKind::RasterizerState || record.kind == ObjectKind::SamplerState;
  return record.object && !record.active && !interned;
}

class Device final : public backend::Object<IDevice> {
 public:
  Device(Ref<IDevice> inner, IMessageSink* sink)
      : inner_(std::move(inner)),
        v_(std::make_shared<Validation>(sink)),
        context_(*v_, *inner_->ImmediateContext(), *this) {}

  void SetName(const char* name) override { inner_->SetName(name); }
  const Caps& GetCaps() const override { return inner_->GetCaps(); }
  FormatSupport CheckFormatSupport(Format f) const override { return inner_->CheckFormatSupport(f); }
  uint32_t CheckMultisample(Format f, uint32_t samples) const override { return inner_->CheckMultisample(f, samples); }

  Status CreateBuffer(const BufferDesc& d, const void* init, Ref<IBuffer>* out) override {
    return Enter(inner_->CreateBuffer(d, init, out), ObjectKind::Buffer, *out, d.name);
  }
  Status CreateTexture(const TextureDesc& d, const SubresourceData* init, Ref<ITexture>* out) override {
    return Enter(inner_->CreateTexture(d, init, out), ObjectKind::Texture, *out, d.name);
  }
  Status CreateShaderResourceView(IResource* r, const ViewDesc* d, Ref<IShaderResourceView>* out) override {
    if (!Owns("CreateShaderResourceView", r, out)) return Status::InvalidArg;
    return Enter(inner_->CreateShaderResourceView(r, d, out), ObjectKind::ShaderResourceView, *out, NameOf(r));
  }
  Status CreateRenderTargetView(ITexture* t, const ViewDesc* d, Ref<IRenderTargetView>* out) override {
    if (!Owns("CreateRenderTargetView", t, out)) return Status::InvalidArg;
    return Enter(inner_->CreateRenderTargetView(t, d, out), ObjectKind::RenderTargetView, *out, NameOf(t));
  }
  Status CreateDepthStencilView(ITexture* t, const ViewDesc* d, Ref<IDepthStencilView>* out) override {
    if (!Owns("CreateDepthStencilView", t, out)) return Status::InvalidArg;
    return Enter(inner_->CreateDepthStencilView(t, d, out), ObjectKind::DepthStencilView, *out, NameOf(t));
  }
  Status CreateUnorderedAccessView(IResource* r, const ViewDesc* d, Ref<IUnorderedAccessView>* out) override {
    if (!Owns("CreateUnorderedAccessView", r, out)) return Status::InvalidArg;
    return Enter(inner_->CreateUnorderedAccessView(r, d, out), ObjectKind::UnorderedAccessView, *out, NameOf(r));
  }
  Status CreateShader(const ShaderBlob& blob, Ref<IShader>* out) override;
  Status CreateInputLayout(const InputElement*, uint32_t count, IShader* vs, Ref<IInputLayout>* out) override;
  Status CreateBlendState(const BlendDesc& d, Ref<IBlendState>* out) override {
    return Enter(inner_->CreateBlendState(d, out), ObjectKind::BlendState, *out, "");
  }
  Status CreateDepthStencilState(const DepthStencilDesc& d, Ref<IDepthStencilState>* out) override {
    return Enter(inner_->CreateDepthStencilState(d, out), ObjectKind::DepthStencilState, *out, "");
  }
  Status CreateRasterizerState(const RasterizerDesc& d, Ref<IRasterizerState>* out) override {
    return Enter(inner_->CreateRasterizerState(d, out), ObjectKind::RasterizerState, *out, "");
  }
  Status CreateSamplerState(const SamplerDesc& d, Ref<ISamplerState>* out) override {
    return Enter(inner_->CreateSamplerState(d, out), ObjectKind::SamplerState, *out, "");
  }
  Status CreateQuery(const QueryDesc& d, Ref<IQuery>* out) override {
    return Enter(inner_->CreateQuery(d, out), ObjectKind::Query, *out, "");
  }
  Status CreateSwapChain(const SwapChainDesc& d, Ref<ISwapChain>* out) override {
    const Status s = inner_->CreateSwapChain(d, out);
    if (s == Status::Ok) *out = Ref<ISwapChain>::Adopt(new SwapChain(v_, *out));
    return s;
  }

  Status PrecachePipeline(const PipelineKeyDesc& d) override;
  size_t GetPipelineCacheBlob(void* out, size_t capacity) override {
    return inner_->GetPipelineCacheBlob(out, capacity);
  }
  IContext* ImmediateContext() override { return &context_; }
  Status ReadBack(ITexture* t, uint32_t subresource, void* out, size_t capacity, uint32_t rowPitch) override {
    if (!CheckReadBack(t, out)) return Status::InvalidArg;
    return inner_->ReadBack(t, subresource, out, capacity, rowPitch);
  }
  Status ReadBack(IBuffer* b, uint32_t offset, uint32_t size, void* out) override {
    if (!CheckReadBack(b, out)) return Status::InvalidArg;
    return inner_->ReadBack(b, offset, size, out);
  }
  Status WaitIdle() override { return inner_->WaitIdle(); }
  Stats GetStats(bool reset) override { return inner_->GetStats(reset); }

 private:
  ~Device() override;

  template <class T>
  Status Enter(Status s, ObjectKind kind, const Ref<T>& made, const char* name) {
    if (s == Status::Ok) v_->objects.Add(kind, made.get(), name);
    return s;
  }
  template <class T>
  bool Owns(const char* call, const IObject* object, Ref<T>* out) {
    *out = nullptr;
    return v_->Owns(call, object);
  }
  const char* NameOf(const IObject* object) const { return v_->objects.NameOf(object); }
  bool CheckReadBack(const IResource* resource, const void* out) {
    if (out) return v_->Owns("ReadBack", resource);
    return v_->Error(MsgCode::InvalidDesc, resource, "ReadBack: the memory for the result is null");
  }
  bool IsLive(const ObjectRecord&) const;
  uint32_t LiveCount() const;
  void ReportLive();
  void SettleTable();

  Ref<IDevice> inner_;
  std::shared_ptr<Validation> v_;  // swap chains may outlive the device
  Context context_;
};

Status Device::CreateShader(const ShaderBlob& blob, Ref<IShader>* out) {
  const Status s = inner_->CreateShader(blob, out);
  if (s == Status::Ok) v_->objects.Add(ObjectKind::Shader, out->get(), blob.name).shader = blob.reflection;
  return s;
}

// Remembers the element of each of the shader's inputs; the creation found them all.
Status Device::CreateInputLayout(const InputElement* elements, uint32_t count, IShader* vs, Ref<IInputLayout>* out) {
  if (!Owns("CreateInputLayout", vs, out)) return Status::InvalidArg;
  const Status s = inner_->CreateInputLayout(elements, count, vs, out);
  if (s != Status::Ok) return s;
  const ShaderReflection reflection = v_->objects.Find(vs)->shader;
  ObjectRecord& record = v_->objects.Add(ObjectKind::InputLayout, out->get(), NameOf(vs));
  for (const ShaderInput& input : reflection.inputs)
    for (uint32_t i = 0; i < count; ++i) {
      if (elements[i].semanticIndex != input.semanticIndex || strcasecmp(elements[i].semantic, input.semantic) != 0)
        continue;
      InputElement element = elements[i];
      element.semantic = input.semantic;  // the caller's text need not live on
      element.stepRate = std::max(1u, element.stepRate);
      record.inputs.push_back(input);
      record.elements.push_back(element);
      break;
    }
  return s;
}

Status Device::PrecachePipeline(const PipelineKeyDesc& d) {
  const IObject* const parts[] = {d.vs, d.gs, d.ps, d.layout, d.blend, d.depth, d.raster};
  for (const IObject* part : parts)
    if (!v_->Owns("PrecachePipeline", part)) return Status::InvalidArg;
  return inner_->PrecachePipeline(d);
}

bool Device::IsLive(const ObjectRecord& record) const {
  if (!CanLeak(record)) return false;
  const uint32_t backends = context_.UsedByLastDraw(record.object.get()) ? 1 : 0;
  return OtherCounts(*record.object) > backends;
}

uint32_t Device::LiveCount() const {
  return uint32_t(std::count_if(v_->objects.Records().begin(), v_->objects.Records().end(),
                                [this](const auto& entry) { return IsLive(entry.second); }));
}

void Device::ReportLive() {
  constexpr uint32_t kMost = 16;  // a program that leaks leaks a lot
  uint32_t said = 0;
  for (const auto& [object, record] : v_->objects.Records()) {
    if (record.active)
      v_->Warn(MsgCode::QueryOpen, object,
               "the device is released while a query is begun and not ended; call End before");
    if (IsLive(record) && ++said <= kMost)
      v_->Warn(MsgCode::LiveObjects, object, "a %s is still referenced when its device is released; release it before",
               ToString(record.kind));
  }
  if (const uint32_t live = LiveCount(); live > kMost)
    v_->Warn(MsgCode::LiveObjects, {nullptr, "and more"},
             "%u objects in all are still referenced when their device is released", live);
}

// A view that goes may keep its resource in the backend's list of what the GPU still uses; each round frees one more
// link of such a chain.
void Device::SettleTable() {
  constexpr int kLongestChain = 4;
  for (int round = 0; round < kLongestChain && LiveCount() > 0; ++round) {
    inner_->WaitIdle();
    v_->objects.Sweep();
  }
}

Device::~Device() {
  v_->NewFrame();
  context_.ClearState();
  v_->objects.Sweep();
  SettleTable();
  ReportLive();
  v_->objects.Clear();
}

}  // namespace
}  // namespace rhi::validation

namespace rhi {

Ref<IDevice> WrapWithValidation(Ref<IDevice> inner, IMessageSink* sink) {
  if (!inner) return {};
  return Ref<IDevice>::Adopt(new validation::Device(std::move(inner), sink));
}

}  // namespace rhi

#include "device.h"

#include "formats.h"
#include "swap_chain.h"

namespace rhi_vulkan {
namespace {

constexpr const char* kNullArgument = "a null object was given; the object is not made";

bool QueryAvailable(QueryType type, const Caps& caps, const Features& features) {
  switch (type) {
    case QueryType::Event:
    case QueryType::TimestampDisjoint: return true;
    case QueryType::Occlusion: return caps.occlusionPrecise;
    case QueryType::OcclusionPredicate: return features.hostQueryReset;
    case QueryType::Timestamp: return caps.timestamp;
    case QueryType::PipelineStatistics: return caps.pipelineStatistics;
  }
  return false;
}

// Moves a finished object to the caller.
template <class Interface, class Object>
Status Give(Ref<Object> object, Status status, Ref<Interface>* out) {
  if (status == Status::Ok) *out = object;
  return status;
}

}  // namespace

VulkanDevice::VulkanDevice(std::shared_ptr<Core> core, const DeviceDesc& desc)
    : core_(std::move(core)), context_(std::make_unique<Context>(*this, core_, desc.framesInFlight)) {}

VulkanDevice::~VulkanDevice() {
  core_->vk.vkDeviceWaitIdle(core_->device);
  context_.reset();
  core_->Close();
}

Status VulkanDevice::Init(const DeviceDesc&) { return context_->Init(); }

Status VulkanDevice::Refuse(Status status, MsgCode code, const char* object, const char* text) const {
  core_->log.Report(Severity::Error, code, object, "%s", text);
  return status;
}

FormatSupport VulkanDevice::CheckFormatSupport(Format format) const {
  return QueryFormatSupport(core_->instance.vk, core_->adapter.handle, format);
}

uint32_t VulkanDevice::CheckMultisample(Format format, uint32_t samples) const {
  if (samples > GetCaps().maxColorSamples) return 0;
  return QueryMultisample(core_->instance.vk, core_->adapter.handle, format, samples);
}

Status VulkanDevice::CreateBuffer(const BufferDesc& desc, const void* init, Ref<IBuffer>* out) {
  *out = nullptr;
  if (core_->lost) return Status::DeviceLost;
  if (Status s = backend::CheckBufferDesc(desc, init, GetCaps(), core_->log); s != Status::Ok) return s;
  auto buffer = Ref<Buffer>::Adopt(new Buffer(core_, desc));
  Status s = buffer->Create();
  if (s == Status::Ok && init) s = context_->InitBuffer(*buffer, init);
  return Give(buffer, s, out);
}

Status VulkanDevice::CreateTexture(const TextureDesc& desc, const SubresourceData* init, Ref<ITexture>* out) {
  *out = nullptr;
  if (core_->lost) return Status::DeviceLost;
  TextureDesc resolved = desc;
  if (Status s = backend::CheckTextureDesc(&resolved, init, GetCaps(), core_->log); s != Status::Ok) return s;
  auto texture = Ref<Texture>::Adopt(new Texture(core_, resolved));
  Status s = texture->Create();
  if (s == Status::Ok && init) s = context_->InitTexture(*texture, init);
  return Give(texture, s, out);
}

template <class Interface>
Status VulkanDevice::CreateTextureView(Texture* texture, const ViewDesc* desc, Bind need, Ref<Interface>* out) {
  ViewDesc resolved;
  if (Status s = backend::ResolveTextureView(texture->Desc(), desc, need, &resolved, core_->log); s != Status::Ok)
    return s;
  auto view = Ref<View<Interface>>::Adopt(new View<Interface>(core_, texture, resolved));
  view->texture = texture;
  const VkResult result = CreateImageView(*core_, *texture, resolved, need, &view->view);
  return Give(view, core_->Check(result, texture->Name().c_str(), "vkCreateImageView"), out);
}

template <class Interface>
Status VulkanDevice::CreateBufferView(Buffer* buffer, const ViewDesc* desc, Bind need, Ref<Interface>* out) {
  ViewDesc resolved;
  if (Status s = backend::ResolveBufferView(buffer->Desc(), desc, need, &resolved, core_->log); s != Status::Ok)
    return s;
  const VkDeviceSize alignment = core_->adapter.properties.limits.minStorageBufferOffsetAlignment;
  if (VkDeviceSize(resolved.firstElement) * buffer->Desc().structureStride % alignment != 0)
    return Refuse(Status::Unsupported, MsgCode::CapMissing, buffer->Name().c_str(),
                  "firstElement * structureStride does not meet this adapter's alignment; 256 bytes always do");
  auto view = Ref<View<Interface>>::Adopt(new View<Interface>(core_, buffer, resolved));
  view->buffer = buffer;
  return Give(view, Status::Ok, out);
}

template <class Interface>
Status VulkanDevice::CreateView(IResource* resource, const ViewDesc* desc, Bind need, Ref<Interface>* out) {
  *out = nullptr;
  if (core_->lost) return Status::DeviceLost;
  if (!resource) return Refuse(Status::InvalidArg, MsgCode::InvalidDesc, "", kNullArgument);
  if (Buffer* buffer = AsBuffer(resource)) return CreateBufferView(buffer, desc, need, out);
  return CreateTextureView(static_cast<Texture*>(resource), desc, need, out);
}

Status VulkanDevice::CreateShaderResourceView(IResource* resource, const ViewDesc* desc,
                                              Ref<IShaderResourceView>* out) {
  return CreateView(resource, desc, Bind::ShaderResource, out);
}

Status VulkanDevice::CreateRenderTargetView(ITexture* texture, const ViewDesc* desc, Ref<IRenderTargetView>* out) {
  return CreateView(texture, desc, Bind::RenderTarget, out);
}

Status VulkanDevice::CreateDepthStencilView(ITexture* texture, const ViewDesc* desc, Ref<IDepthStencilView>* out) {
  return CreateView(texture, desc, Bind::DepthStencil, out);
}

Status VulkanDevice::CreateUnorderedAccessView(IResource* resource, const ViewDesc* desc,
                                               Ref<IUnorderedAccessView>* out) {
  return CreateView(resource, desc, Bind::UnorderedAccess, out);
}

Status VulkanDevice::CreateShader(const ShaderBlob& blob, Ref<IShader>* out) {
  *out = nullptr;
  if (core_->lost) return Status::DeviceLost;
  auto shader = Ref<Shader>::Adopt(new Shader(core_, blob));
  return Give(shader, shader->Create(blob), out);
}

Status VulkanDevice::CreateInputLayout(const InputElement* elements, uint32_t count, IShader* vs,
                                       Ref<IInputLayout>* out) {
  *out = nullptr;
  if (core_->lost) return Status::DeviceLost;
  if (!vs || vs->GetStage() != Stage::Vertex || count > kMaxVertexElements)
    return Refuse(Status::InvalidArg, MsgCode::LayoutMismatch, "",
                  "an input layout needs a vertex shader and at most 16 elements");
  std::vector<LayoutElement> resolved;
  const Status s = ResolveElements(elements, count, static_cast<Shader&>(*vs), *core_, &resolved);
  if (s != Status::Ok) return s;
  const uint32_t id = core_->states->layouts.IdOf(resolved);
  return Give(Ref<InputLayout>::Adopt(new InputLayout(core_, std::move(resolved), id)), s, out);
}

template <class Object, class Desc, class Interface>
Status VulkanDevice::CreateState(const Desc& desc, Ref<Interface>* out) {
  auto& table = core_->states->TableOf(desc);
  Ref<Object> state = table.living.Find(desc);
  if (!state) {
    state = Ref<Object>::Adopt(new Object(core_, desc, table.ids.IdOf(desc)));
    table.living.Remember(state.get());
  }
  *out = state;
  return Status::Ok;
}

Status VulkanDevice::CreateBlendState(const BlendDesc& desc, Ref<IBlendState>* out) {
  *out = nullptr;
  if (core_->lost) return Status::DeviceLost;
  const Status s = backend::CheckBlendDesc(desc, GetCaps(), core_->log);
  return s == Status::Ok ? CreateState<BlendState>(desc, out) : s;
}

Status VulkanDevice::CreateDepthStencilState(const DepthStencilDesc& desc, Ref<IDepthStencilState>* out) {
  *out = nullptr;
  if (core_->lost) return Status::DeviceLost;
  const Status s = backend::CheckDepthStencilDesc(desc, core_->log);
  return s == Status::Ok ? CreateState<DepthState>(desc, out) : s;
}

Status VulkanDevice::CreateRasterizerState(const RasterizerDesc& desc, Ref<IRasterizerState>* out) {
  *out = nullptr;
  if (core_->lost) return Status::DeviceLost;
  const Status s = backend::CheckRasterizerDesc(desc, GetCaps(), core_->log);
  return s == Status::Ok ? CreateState<RasterState>(desc, out) : s;
}

Status VulkanDevice::CreateSamplerState(const SamplerDesc& desc, Ref<ISamplerState>* out) {
  *out = nullptr;
  if (core_->lost) return Status::DeviceLost;
  if (Status s = backend::CheckSamplerDesc(desc, GetCaps(), core_->log); s != Status::Ok) return s;
  Ref<Sampler> sampler = core_->states->samplers.Find(desc);
  if (sampler) return Give(sampler, Status::Ok, out);
  sampler = Ref<Sampler>::Adopt(new Sampler(core_, desc));
  const Status s = sampler->Create();
  if (s == Status::Ok) core_->states->samplers.Remember(sampler.get());
  return Give(sampler, s, out);
}

Status VulkanDevice::CreateQuery(const QueryDesc& desc, Ref<IQuery>* out) {
  *out = nullptr;
  if (core_->lost) return Status::DeviceLost;
  if (desc.type > QueryType::PipelineStatistics)
    return Refuse(Status::InvalidArg, MsgCode::InvalidDesc, "", "QueryDesc::type is none");
  if (!QueryAvailable(desc.type, GetCaps(), core_->adapter.features))
    return Refuse(Status::Unsupported, MsgCode::CapMissing, "",
                  "this adapter has no such query; see Caps::timestamp, pipelineStatistics and occlusionPrecise");
  return Give(Ref<Query>::Adopt(new Query(core_, desc.type)), Status::Ok, out);
}

Status VulkanDevice::CreateSwapChain(const SwapChainDesc& desc, Ref<ISwapChain>* out) {
  *out = nullptr;
  if (core_->lost) return Status::DeviceLost;
  if (Status s = backend::CheckSwapChainDesc(desc, GetCaps(), core_->log); s != Status::Ok) return s;
  auto swapChain = Ref<SwapChain>::Adopt(new SwapChain(core_, desc));
  return Give(swapChain, swapChain->Create(), out);
}

Status VulkanDevice::PrecachePipeline(const PipelineKeyDesc& d) {
  if (core_->lost) return Status::DeviceLost;
  const auto fits = [](const IShader* s, Stage stage) { return !s || s->GetStage() == stage; };
  if (!d.vs || !fits(d.vs, Stage::Vertex) || !fits(d.gs, Stage::Geometry) || !fits(d.ps, Stage::Pixel) ||
      d.rtvCount > kMaxRenderTargets)
    return Refuse(Status::InvalidArg, MsgCode::NoVertexShader, "",
                  "PrecachePipeline needs a vertex shader, each shader in its place, and at most 8 targets");
  const auto shader = [](IShader* s) { return static_cast<Shader*>(s); };
  const auto id = [](const auto* object) { return object ? object->id : 0u; };
  const auto* layout = static_cast<const InputLayout*>(d.layout);
  const auto* blend = static_cast<const BlendState*>(d.blend);
  PipelineKey key;
  key.vs = id(shader(d.vs));
  key.gs = id(shader(d.gs));
  key.ps = id(shader(d.ps));
  key.layout = id(layout);
  key.blend = id(blend);
  std::copy(d.rtv.begin(), d.rtv.begin() + d.rtvCount, key.rtv.begin());
  key.rtvCount = uint8_t(d.rtvCount);
  key.dsv = d.dsv;
  key.samples = uint8_t(d.samples);
  key.topology = ClassOf(d.topology);
  if (d.raster) {
    key.wireframe = d.raster->Desc().fill == FillMode::Wireframe;
    key.depthClip = d.raster->Desc().depthClip;
  }
  const PipelineParts parts{shader(d.vs), shader(d.gs), shader(d.ps), layout, blend ? &blend->Desc() : nullptr};
  core_->pipelines->ForgetFailed();
  core_->SpeakAgain();
  return core_->pipelines->Get(key, parts).status;
}

size_t VulkanDevice::GetPipelineCacheBlob(void* out, size_t capacity) { return core_->pipelines->Blob(out, capacity); }

Status VulkanDevice::ReadBack(ITexture* texture, uint32_t subresource, void* out, size_t capacity, uint32_t rowPitch) {
  if (!texture) return Refuse(Status::InvalidArg, MsgCode::InvalidDesc, "", kNullArgument);
  return context_->ReadTexture(static_cast<Texture&>(*texture), subresource, out, capacity, rowPitch);
}

Status VulkanDevice::ReadBack(IBuffer* buffer, uint32_t offset, uint32_t size, void* out) {
  if (!buffer) return Refuse(Status::InvalidArg, MsgCode::InvalidDesc, "", kNullArgument);
  return context_->ReadBuffer(static_cast<Buffer&>(*buffer), offset, size, out);
}

}  // namespace rhi_vulkan

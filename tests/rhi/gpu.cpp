#include "gpu.h"

#include <chrono>
#include <stdexcept>
#include <thread>

#include "../conformance/recorder.h"
#include "rhi_gl/rhi_gl.h"
#include "rhi_test_shaders/shaders.h"
#include "rhi_vulkan/rhi_vulkan.h"

namespace rhi_test {

using namespace rhi;

std::vector<Backend> Backends() { return {Backend::Vulkan, Backend::OpenGL}; }

Status CreateDevice(Backend backend, const DeviceDesc& desc, Ref<IDevice>* device) {
  return backend == Backend::Vulkan ? rhi_vulkan::CreateDevice(desc, device) : rhi_gl::CreateDevice(desc, device);
}

namespace {

std::map<Backend, std::string>& Adapters() {
  static std::map<Backend, std::string> names;
  return names;
}

conformance::Component ComponentOf(Format format) {
  const FormatInfo& f = GetFormatInfo(format);
  const uint32_t bits = f.components ? 8u * f.blockBytes / f.components : 0;
  const bool even = f.blockSize == 1 && bits * f.components == 8u * f.blockBytes;
  if (!even || (f.depth && f.stencil)) return Component::Packed;
  if (bits == 8) return Component::U8;
  if (bits == 16) return f.isFloat ? Component::F16 : Component::U16;
  if (bits == 32) return f.isFloat ? Component::F32 : Component::U32;
  return Component::Packed;
}

}  // namespace

void UseAdapter(Backend backend, const std::string& name) { Adapters()[backend] = name; }

DeviceDesc TestDeviceDesc(Backend backend, IMessageSink* sink) {
  DeviceDesc desc;
  desc.apiValidation = desc.syncValidation = true;
  const std::string& adapter = Adapters()[backend];
  desc.adapter = adapter.c_str();
  desc.preferSoftware = adapter.empty();
  desc.sink = sink;
  return desc;
}

Gpu::Gpu(Backend b) : backend(b) {
  Require(CreateDevice(b, TestDeviceDesc(b, &sink), &device), "CreateDevice");
  context = device->ImmediateContext();
  draw_ = Buffer(
      {.byteWidth = sizeof(DrawConstants), .usage = Usage::Dynamic, .bind = Bind::ConstantBuffer, .name = "draw"});
}

Gpu::~Gpu() { Close(); }

void Gpu::Close() {
  if (!device) return;
  context->ClearState();
  draw_ = nullptr;
  shaders_.clear();
  context = nullptr;
  device = nullptr;
}

void Gpu::Require(Status status, const char* what) {
  if (status == Status::Ok) return;
  throw std::runtime_error(std::string(what) + " on " + BackendName(backend) + " gave " + ToString(status) + "\n" +
                           sink.Dump());
}

void Gpu::Finish() {
  context->ClearState();
  context->EndFrame();
  Require(device->WaitIdle(), "WaitIdle");
}

Ref<IBuffer> Gpu::Buffer(const BufferDesc& desc, const void* init) {
  Ref<IBuffer> b;
  Require(device->CreateBuffer(desc, init, &b), "CreateBuffer");
  return b;
}

Ref<ITexture> Gpu::Texture(const TextureDesc& desc, const SubresourceData* init) {
  Ref<ITexture> t;
  Require(device->CreateTexture(desc, init, &t), "CreateTexture");
  return t;
}

Ref<IShaderResourceView> Gpu::View(IResource* resource, const ViewDesc* desc) {
  Ref<IShaderResourceView> v;
  Require(device->CreateShaderResourceView(resource, desc, &v), "CreateShaderResourceView");
  return v;
}

Ref<IRenderTargetView> Gpu::TargetView(ITexture* texture, const ViewDesc* desc) {
  Ref<IRenderTargetView> v;
  Require(device->CreateRenderTargetView(texture, desc, &v), "CreateRenderTargetView");
  return v;
}

Ref<IDepthStencilView> Gpu::DepthView(ITexture* texture, const ViewDesc* desc) {
  Ref<IDepthStencilView> v;
  Require(device->CreateDepthStencilView(texture, desc, &v), "CreateDepthStencilView");
  return v;
}

Ref<IUnorderedAccessView> Gpu::WriteView(IResource* resource, const ViewDesc* desc) {
  Ref<IUnorderedAccessView> v;
  Require(device->CreateUnorderedAccessView(resource, desc, &v), "CreateUnorderedAccessView");
  return v;
}

Ref<IShader> Gpu::Shader(const ShaderBlob& blob) {
  Ref<IShader>& s = shaders_[&blob];
  if (!s) Require(device->CreateShader(blob, &s), blob.name);
  return s;
}

Ref<IInputLayout> Gpu::Layout(std::span<const InputElement> elements, IShader* vs) {
  Ref<IInputLayout> l;
  Require(device->CreateInputLayout(elements.data(), uint32_t(elements.size()), vs, &l), "CreateInputLayout");
  return l;
}

Ref<IBlendState> Gpu::Blend(const BlendDesc& desc) {
  Ref<IBlendState> s;
  Require(device->CreateBlendState(desc, &s), "CreateBlendState");
  return s;
}

Ref<IDepthStencilState> Gpu::DepthStencil(const DepthStencilDesc& desc) {
  Ref<IDepthStencilState> s;
  Require(device->CreateDepthStencilState(desc, &s), "CreateDepthStencilState");
  return s;
}

Ref<IRasterizerState> Gpu::Rasterizer(const RasterizerDesc& desc) {
  Ref<IRasterizerState> s;
  Require(device->CreateRasterizerState(desc, &s), "CreateRasterizerState");
  return s;
}

Ref<ISamplerState> Gpu::Sampler(const SamplerDesc& desc) {
  Ref<ISamplerState> s;
  Require(device->CreateSamplerState(desc, &s), "CreateSamplerState");
  return s;
}

Ref<IQuery> Gpu::Query(QueryType type) {
  Ref<IQuery> q;
  Require(device->CreateQuery({type}, &q), "CreateQuery");
  return q;
}

Target Gpu::MakeTarget(const TargetDesc& d) {
  Target t{d.width, d.height, {}, {}, {}, {}};
  const TextureDim dim = d.samples > 1 ? TextureDim::Tex2DMS : TextureDim::Tex2D;
  t.color = Texture({.dim = dim,
                     .width = d.width,
                     .height = d.height,
                     .sampleCount = d.samples,
                     .format = d.format,
                     .bind = Bind::RenderTarget | Bind::ShaderResource,
                     .name = "target"});
  t.rtv = TargetView(t.color.get());
  if (d.depthFormat == Format::Unknown) return t;
  t.depth = Texture({.dim = dim,
                     .width = d.width,
                     .height = d.height,
                     .sampleCount = d.samples,
                     .format = d.depthFormat,
                     .bind = Bind::DepthStencil,
                     .name = "depth target"});
  t.dsv = DepthView(t.depth.get());
  return t;
}

void Gpu::SetShaders(const ShaderBlob& vs, const ShaderBlob& ps) {
  context->VSSetShader(Shader(vs).get());
  context->PSSetShader(Shader(ps).get());
}

void Gpu::SetGeometryShader(const ShaderBlob& gs) { context->GSSetShader(Shader(gs).get()); }

void Gpu::SetTarget(const Target& t) {
  IRenderTargetView* rtv = t.rtv.get();
  context->OMSetRenderTargets(1, &rtv, t.dsv.get());
  SetViewport(0, 0, float(t.width), float(t.height));
}

void Gpu::SetViewport(float x, float y, float width, float height) {
  const Viewport v{x, y, width, height, 0, 1};
  context->RSSetViewports(1, &v);
}

void Gpu::SetTexture(Stage stage, uint32_t slot, IResource* resource) {
  const Ref<IShaderResourceView> view = resource ? View(resource) : Ref<IShaderResourceView>();
  IShaderResourceView* v = view.get();
  context->SetShaderResources(stage, slot, 1, &v);
}

void Gpu::SetSampler(Stage stage, uint32_t slot, const SamplerDesc& desc) {
  const Ref<ISamplerState> state = Sampler(desc);
  ISamplerState* s = state.get();
  context->SetSamplers(stage, slot, 1, &s);
}

void Gpu::SetVertices(IBuffer* buffer, uint32_t stride, uint32_t offset, uint32_t slot) {
  context->IASetVertexBuffers(slot, 1, &buffer, &stride, &offset);
}

void Gpu::SetDraw(const DrawConstants& draw) {
  context->UpdateConstants(draw_.get(), &draw, sizeof draw);
  IBuffer* b = draw_.get();
  context->SetConstantBuffers(3, 1, &b);
}

void Gpu::DrawRect(const ShaderBlob& ps, const DrawConstants& draw) {
  SetShaders(test_shaders::rect_VSRect, ps);
  SetDraw(draw);
  context->IASetInputLayout(nullptr);
  context->IASetPrimitiveTopology(PrimitiveTopology::TriangleStrip);
  context->Draw(4, 0);
}

void Gpu::Clear(const Target& t, const Rgba32F& color, float depth, uint8_t stencil) {
  context->ClearRenderTargetView(t.rtv.get(), color.data());
  if (!t.dsv) return;
  const bool hasStencil = GetFormatInfo(t.depth->Desc().format).stencil;
  context->ClearDepthStencilView(t.dsv.get(), true, depth, hasStencil, stencil);
}

Image Gpu::Read(const Target& t) {
  if (t.color->Desc().sampleCount == 1) return Read(t.color.get());
  const Format format = t.color->Desc().format;
  const Ref<ITexture> one =
      Texture({.width = t.width, .height = t.height, .format = format, .bind = Bind::RenderTarget});
  context->ResolveSubresource(one.get(), 0, t.color.get(), 0, format);
  return Read(one.get());
}

Image Gpu::Read(ITexture* texture, uint32_t mip, uint32_t slice) {
  const TextureDesc& d = texture->Desc();
  const uint32_t depth = d.dim == TextureDim::Tex3D ? std::max(1u, d.depthOrArray >> mip) : 1;
  Image image{
      std::max(1u, d.width >> mip), std::max(1u, d.height >> mip) * depth, GetFormatInfo(d.format).blockBytes, {}};
  image.bytes.resize(size_t(image.width) * image.height * image.texelBytes);
  Require(device->ReadBack(texture, Subresource(mip, slice, d.mipLevels), image.bytes.data(), image.bytes.size()),
          "ReadBack");
  image.component = ComponentOf(d.format);
  conformance::TheRecorder().ReadBack(image);
  return image;
}

std::vector<uint8_t> Gpu::Read(IBuffer* buffer, uint32_t offset, uint32_t size) {
  std::vector<uint8_t> bytes(size);
  Require(device->ReadBack(buffer, offset, size, bytes.data()), "ReadBack");
  conformance::TheRecorder().ReadBack({size, 1, 1, bytes});
  return bytes;
}

void Gpu::WaitFor(IQuery* query, void* data, uint32_t size) {
  const auto deadline = std::chrono::steady_clock::now() + std::chrono::seconds(20);
  Status status = context->GetData(query, data, size, true);
  while (status == Status::StillDrawing && std::chrono::steady_clock::now() < deadline) {
    std::this_thread::yield();
    status = context->GetData(query, data, size, true);
  }
  Require(status, "GetData");
}

}  // namespace rhi_test

#include "rig.h"

#include "rhi_gl/rhi_gl.h"
#include "rhi_vulkan/rhi_vulkan.h"

namespace rhi_stress {

using namespace rhi;

std::string BackendName(Backend b) { return b == Backend::Vulkan ? "vulkan" : "gl"; }

Rig::Rig(Backend backend, bool validation) {
  DeviceDesc desc;
  desc.apiValidation = desc.syncValidation = validation;
  desc.preferSoftware = true;
  desc.sink = &sink;
  Require(backend == Backend::Vulkan ? rhi_vulkan::CreateDevice(desc, &device) : rhi_gl::CreateDevice(desc, &device),
          "CreateDevice");
  context = device->ImmediateContext();
}

Rig::Rig(Ref<IDevice> made) : device(std::move(made)), context(device->ImmediateContext()) {}

Rig::~Rig() {
  if (device) context->ClearState();
}

void Rig::Require(Status status, const char* what) const {
  if (status != Status::Ok)
    throw std::runtime_error(std::string(what) + " gave " + ToString(status) + "\n" + sink.Dump());
}

Ref<IBuffer> Rig::Constants() {
  return Buffer({.byteWidth = sizeof(DrawConstants), .usage = Usage::Dynamic, .bind = Bind::ConstantBuffer});
}

Ref<IBuffer> Rig::Buffer(const BufferDesc& desc, const void* init) {
  Ref<IBuffer> b;
  Require(device->CreateBuffer(desc, init, &b), "CreateBuffer");
  return b;
}

Ref<ITexture> Rig::Texture(const TextureDesc& desc, const SubresourceData* init) {
  Ref<ITexture> t;
  Require(device->CreateTexture(desc, init, &t), "CreateTexture");
  return t;
}

Ref<ITexture> Rig::Plain(uint32_t size, const Rgba8& color) {
  const std::vector<Rgba8> texels(size_t(size) * size, color);
  const SubresourceData init{texels.data(), size * 4, size * size * 4};
  return Texture({.width = size, .height = size, .format = Format::RGBA8_UNorm}, &init);
}

Ref<IShaderResourceView> Rig::View(ITexture* texture) {
  Ref<IShaderResourceView> v;
  Require(device->CreateShaderResourceView(texture, nullptr, &v), "CreateShaderResourceView");
  return v;
}

Ref<IShader> Rig::Shader(const ShaderBlob& blob) {
  Ref<IShader> s;
  Require(device->CreateShader(blob, &s), blob.name);
  return s;
}

Target Rig::MakeTarget(uint32_t size, uint32_t samples) {
  Target t;
  t.texture = Texture({.dim = samples > 1 ? TextureDim::Tex2DMS : TextureDim::Tex2D,
                       .width = size,
                       .height = size,
                       .sampleCount = samples,
                       .format = Format::RGBA8_UNorm,
                       .bind = Bind::RenderTarget | Bind::ShaderResource});
  Require(device->CreateRenderTargetView(t.texture.get(), nullptr, &t.view), "CreateRenderTargetView");
  return t;
}

void Rig::SetTarget(const Target& t) {
  IRenderTargetView* view = t.view.get();
  const TextureDesc& d = t.texture->Desc();
  const Viewport viewport{0, 0, float(d.width), float(d.height), 0, 1};
  context->OMSetRenderTargets(1, &view, nullptr);
  context->RSSetViewports(1, &viewport);
}

void Rig::SetConstants(IBuffer* buffer, const DrawConstants& constants) {
  context->SetConstantBuffers(3, 1, &buffer);
  context->UpdateConstants(buffer, &constants, sizeof constants);
}

void Rig::DrawRect(IShader* vs, IShader* ps) {
  context->VSSetShader(vs);
  context->PSSetShader(ps);
  context->IASetPrimitiveTopology(PrimitiveTopology::TriangleStrip);
  context->Draw(4, 0);
}

Image Rig::Read(ITexture* texture) {
  const TextureDesc& d = texture->Desc();
  Image image{d.width, d.height, GetFormatInfo(d.format).blockBytes, {}};
  image.bytes.resize(size_t(image.width) * image.height * image.texelBytes);
  Require(device->ReadBack(texture, 0, image.bytes.data(), image.bytes.size()), "ReadBack");
  return image;
}

void Rig::ExpectUsable() {
  context->ClearState();
  const Target target = MakeTarget(8);
  const Ref<IBuffer> constants = Constants();
  context->ClearRenderTargetView(target.view.get(), Rgba32F{0, 0, 1, 1}.data());
  SetTarget(target);
  SetConstants(constants.get(), {.tint = {1, 0, 0, 1}, .rectangle = {-1, 1, 0, -1}});
  DrawRect(Shader(stress_shaders::stress_VSRect).get(), Shader(stress_shaders::stress_PSTint).get());
  EXPECT_TRUE(Matches(Read(target.texture.get()), [](uint32_t x, uint32_t) {
    return x < 4 ? Rgba8{255, 0, 0, 255} : Rgba8{0, 0, 255, 255};
  }));
  context->ClearState();
}

void Rig::Finish() {
  context->ClearState();
  context->EndFrame();
  Require(device->WaitIdle(), "WaitIdle");
}

}  // namespace rhi_stress

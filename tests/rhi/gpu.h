// One device with a sink that fails tests, and short ways to make resources and pictures with it. Everything here
// throws std::runtime_error, with the messages, where the RHI gives an error; gtest turns that into a failure of the
// test.
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <span>

#include "../conformance/drivers.h"
#include "image.h"
#include "rhi/rhi.h"
#include "test_sink.h"

namespace rhi_test {

// Every backend that this build has. All are required: a test fails where one cannot be made.
std::vector<rhi::Backend> Backends();
rhi::Status CreateDevice(rhi::Backend, const rhi::DeviceDesc&, rhi::Ref<rhi::IDevice>*);
using conformance::BackendName;
// Headless, with API and synchronization validation; on the adapter that UseAdapter named, or on a CPU rasteriser where
// there is one.
rhi::DeviceDesc TestDeviceDesc(rhi::Backend, rhi::IMessageSink*);
// Part of the name of the adapter of all devices of this backend that are made from now on.
void UseAdapter(rhi::Backend, const std::string& name);

// Where a picture is drawn: a colour texture and perhaps a depth texture, with their views.
struct Target {
  uint32_t width = 0, height = 0;
  rhi::Ref<rhi::ITexture> color, depth;
  rhi::Ref<rhi::IRenderTargetView> rtv;
  rhi::Ref<rhi::IDepthStencilView> dsv;
};
struct TargetDesc {
  uint32_t width = 16, height = 16;
  rhi::Format format = rhi::Format::RGBA8_UNorm;
  rhi::Format depthFormat = rhi::Format::Unknown;  // Unknown: no depth texture
  uint32_t samples = 1;
};

// The constants that most test shaders read, at b3 (shaders/common.hlsli).
struct DrawConstants {
  Rgba32F tint{1, 1, 1, 1};
  Rgba32F rectangle{-1, 1, 1, -1};  // left, top, right, bottom in clip space
  Rgba32F extra{0, 0, 0, 0};        // x: depth of the rectangle; the rest by shader
};

class Gpu {
 public:
  explicit Gpu(rhi::Backend);
  ~Gpu();
  Gpu(const Gpu&) = delete;
  Gpu& operator=(const Gpu&) = delete;

  TestSink sink;
  rhi::Ref<rhi::IDevice> device;
  rhi::IContext* context = nullptr;
  rhi::Backend backend;

  // Releases the device; nothing else can be done after it.
  void Close();
  // Unbinds all and waits, so that late messages come before Verify.
  void Finish();

  rhi::Ref<rhi::IBuffer> Buffer(const rhi::BufferDesc&, const void* init = nullptr);
  template <class T>
  rhi::Ref<rhi::IBuffer> BufferOf(rhi::Bind bind, const std::vector<T>& data, uint32_t stride = 0) {
    return Buffer({.byteWidth = uint32_t(data.size() * sizeof(T)), .bind = bind, .structureStride = stride},
                  data.data());
  }
  rhi::Ref<rhi::ITexture> Texture(const rhi::TextureDesc&, const rhi::SubresourceData* init = nullptr);
  // A texture whose mip `m` of slice `s` is filled by texel(x, y, m, s).
  template <class Texel>
  rhi::Ref<rhi::ITexture> TextureOf(rhi::TextureDesc desc,
                                    const std::function<Texel(uint32_t, uint32_t, uint32_t, uint32_t)>& texel);
  rhi::Ref<rhi::IShaderResourceView> View(rhi::IResource*, const rhi::ViewDesc* = nullptr);
  rhi::Ref<rhi::IRenderTargetView> TargetView(rhi::ITexture*, const rhi::ViewDesc* = nullptr);
  rhi::Ref<rhi::IDepthStencilView> DepthView(rhi::ITexture*, const rhi::ViewDesc* = nullptr);
  rhi::Ref<rhi::IUnorderedAccessView> WriteView(rhi::IResource*, const rhi::ViewDesc* = nullptr);
  rhi::Ref<rhi::IShader> Shader(const rhi::ShaderBlob&);  // made once for each
  rhi::Ref<rhi::IInputLayout> Layout(std::span<const rhi::InputElement>, rhi::IShader* vs);
  rhi::Ref<rhi::IBlendState> Blend(const rhi::BlendDesc&);
  rhi::Ref<rhi::IDepthStencilState> DepthStencil(const rhi::DepthStencilDesc&);
  rhi::Ref<rhi::IRasterizerState> Rasterizer(const rhi::RasterizerDesc&);
  rhi::Ref<rhi::ISamplerState> Sampler(const rhi::SamplerDesc&);
  rhi::Ref<rhi::IQuery> Query(rhi::QueryType);
  Target MakeTarget(const TargetDesc&);

  // Binding in one line; the context keeps the references.
  void SetShaders(const rhi::ShaderBlob& vs, const rhi::ShaderBlob& ps);
  void SetGeometryShader(const rhi::ShaderBlob& gs);
  void SetTarget(const Target&);  // and a viewport that covers it
  void SetViewport(float x, float y, float width, float height);
  void SetTexture(rhi::Stage, uint32_t slot, rhi::IResource*);
  void SetSampler(rhi::Stage, uint32_t slot, const rhi::SamplerDesc&);
  void SetVertices(rhi::IBuffer*, uint32_t stride, uint32_t offset = 0, uint32_t slot = 0);
  void SetDraw(const DrawConstants&);
  // The rectangle of `draw` as a strip of two clockwise triangles, with VSRect and `ps`.
  void DrawRect(const rhi::ShaderBlob& ps, const DrawConstants& draw = {});

  void Clear(const Target&, const Rgba32F& color, float depth = 1, uint8_t stencil = 0);
  Image Read(const Target&);  // resolves multisampled targets
  Image Read(rhi::ITexture*, uint32_t mip = 0, uint32_t slice = 0);
  std::vector<uint8_t> Read(rhi::IBuffer*, uint32_t offset, uint32_t size);
  template <class T>
  std::vector<T> ReadAs(rhi::IBuffer* buffer, uint32_t offset, uint32_t count) {
    const std::vector<uint8_t> bytes = Read(buffer, offset, uint32_t(count * sizeof(T)));
    std::vector<T> values(count);
    std::memcpy(values.data(), bytes.data(), bytes.size());
    return values;
  }
  template <class T>
  T Result(rhi::IQuery* query) {
    T value{};
    WaitFor(query, &value, sizeof value);
    return value;
  }

 private:
  void Require(rhi::Status, const char* what);
  void WaitFor(rhi::IQuery*, void* data, uint32_t size);
  rhi::Ref<rhi::IBuffer> draw_;  // DrawConstants
  std::map<const rhi::ShaderBlob*, rhi::Ref<rhi::IShader>> shaders_;
};

// The shared device of a backend, made at its first use and kept to the end.
Gpu& SharedGpu(rhi::Backend);

template <class Texel>
rhi::Ref<rhi::ITexture> Gpu::TextureOf(rhi::TextureDesc desc,
                                       const std::function<Texel(uint32_t, uint32_t, uint32_t, uint32_t)>& texel) {
  if (desc.mipLevels == 0) desc.mipLevels = rhi::FullMipCount(desc.width, desc.height);
  std::vector<std::vector<Texel>> texels;
  std::vector<rhi::SubresourceData> init;
  for (uint32_t slice = 0; slice < desc.depthOrArray; ++slice)
    for (uint32_t mip = 0; mip < desc.mipLevels; ++mip) {
      const uint32_t w = std::max(1u, desc.width >> mip), h = std::max(1u, desc.height >> mip);
      std::vector<Texel>& data = texels.emplace_back();
      for (uint32_t y = 0; y < h; ++y)
        for (uint32_t x = 0; x < w; ++x) data.push_back(texel(x, y, mip, slice));
      init.push_back({data.data(), uint32_t(w * sizeof(Texel)), uint32_t(w * h * sizeof(Texel))});
    }
  return Texture(desc, init.data());
}

}  // namespace rhi_test

// Making a technique's objects: one place that keeps the first failure of a series.
#pragma once

#include <string>

#include "driver_error.h"
#include "rhi/rhi.h"

namespace fur {

class Creation {
 public:
  explicit Creation(rhi::IDevice& device) : device_(device) {}
  rhi::IDevice& Device() { return device_; }
  bool Failed() const { return failed_; }
  const Error& Failure() const { return error_; }
  void Check(rhi::Status status, const std::string& what) {
    if (status == rhi::Status::Ok || failed_) return;
    failed_ = true;
    error_ = DriverError(status, "cannot create " + what);
  }

  rhi::Ref<rhi::IShader> Shader(const rhi::ShaderBlob& blob) {
    rhi::Ref<rhi::IShader> shader;
    Check(device_.CreateShader(blob, &shader), blob.name);
    return shader;
  }
  rhi::Ref<rhi::IRasterizerState> Raster(rhi::CullMode cull, bool frontCCW) {
    rhi::Ref<rhi::IRasterizerState> state;
    Check(device_.CreateRasterizerState({.cull = cull, .frontCCW = frontCCW, .multisample = true}, &state),
          "a rasterizer state");
    return state;
  }
  rhi::Ref<rhi::IDepthStencilState> Depth(const rhi::DepthStencilDesc& desc) {
    rhi::Ref<rhi::IDepthStencilState> state;
    Check(device_.CreateDepthStencilState(desc, &state), "a depth state");
    return state;
  }
  // The same factors for colour and alpha; One and Zero: opaque.
  rhi::Ref<rhi::IBlendState> Blend(rhi::Blend source, rhi::Blend dest) {
    rhi::BlendDesc desc;
    desc.rt[0] = {.enable = source != rhi::Blend::One || dest != rhi::Blend::Zero,
                  .src = source, .dest = dest, .srcAlpha = source, .destAlpha = dest};
    return Blend(desc);
  }
  rhi::Ref<rhi::IBlendState> Blend(const rhi::BlendDesc& desc) {
    rhi::Ref<rhi::IBlendState> state;
    Check(device_.CreateBlendState(desc, &state), "a blend state");
    return state;
  }
  // For draws that only leave their depth.
  rhi::Ref<rhi::IBlendState> NoColor() {
    rhi::BlendDesc desc;
    desc.rt[0].writeMask = 0;
    return Blend(desc);
  }
  rhi::Ref<rhi::ISamplerState> Sampler(rhi::AddressMode uv, float mipBias) {
    rhi::SamplerDesc desc;
    desc.mipBias = mipBias;
    desc.u = desc.v = uv;
    rhi::Ref<rhi::ISamplerState> sampler;
    Check(device_.CreateSamplerState(desc, &sampler), "a sampler");
    return sampler;
  }
  rhi::Ref<rhi::IBuffer> Buffer(const rhi::BufferDesc& desc) {
    rhi::Ref<rhi::IBuffer> buffer;
    Check(device_.CreateBuffer(desc, nullptr, &buffer), desc.name);
    return buffer;
  }
  rhi::Ref<rhi::IBuffer> DynamicConstants(size_t bytes, const char* name) {
    return Buffer({.byteWidth = uint32_t(bytes), .usage = rhi::Usage::Dynamic, .bind = rhi::Bind::ConstantBuffer,
                   .name = name});
  }

 private:
  rhi::IDevice& device_;
  bool failed_ = false;
  Error error_;
};

}  // namespace fur

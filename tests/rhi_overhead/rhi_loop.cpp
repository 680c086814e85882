// The workload through the RHI, as a user would write it.
#include <cstdio>
#include <stdexcept>

#include "rhi_gl/rhi_gl.h"
#include "rhi_overhead_shaders/shaders.h"
#include "rhi_vulkan/rhi_vulkan.h"
#include "workload.h"

namespace rhi_overhead {
namespace {

using namespace rhi;

void Require(Status status, const char* what) {
  if (status != Status::Ok) throw std::runtime_error(std::string(what) + " gave " + ToString(status));
}

class StderrSink final : public IMessageSink {
 public:
  void OnMessage(const Message& m) override {
    if (m.severity >= Severity::Warning) std::fprintf(stderr, "rhi: %s\n", m.text);
  }
};

class RhiLoop final : public Loop {
 public:
  explicit RhiLoop(Backend);
  void Frame(uint32_t switchEvery) override;
  std::vector<uint8_t> Picture() override;

 private:
  void MakeTarget();
  void MakeStates();

  StderrSink sink_;
  Ref<IDevice> device_;
  IContext* context_ = nullptr;
  Ref<ITexture> target_;
  Ref<IRenderTargetView> targetView_;
  Ref<IBuffer> constants_;
  Ref<IShader> vs_;
  std::array<Ref<IShader>, 2> ps_;
  std::array<Ref<IBlendState>, 2> blends_;
};

RhiLoop::RhiLoop(Backend backend) {
  const DeviceDesc desc{.preferSoftware = true, .sink = &sink_};
  Require(backend == Backend::Vulkan ? rhi_vulkan::CreateDevice(desc, &device_) : rhi_gl::CreateDevice(desc, &device_),
          "CreateDevice");
  context_ = device_->ImmediateContext();
  MakeTarget();
  MakeStates();
  IRenderTargetView* target = targetView_.get();
  context_->OMSetRenderTargets(1, &target, nullptr);
  const Viewport viewport{0, 0, float(kSize), float(kSize), 0, 1};
  context_->RSSetViewports(1, &viewport);
  context_->VSSetShader(vs_.get());
  IBuffer* constants = constants_.get();
  context_->SetConstantBuffers(kConstantSlot, 1, &constants);
}

void RhiLoop::MakeTarget() {
  Require(device_->CreateTexture(
              {.width = kSize, .height = kSize, .format = Format::RGBA8_UNorm, .bind = Bind::RenderTarget}, nullptr,
              &target_),
          "CreateTexture");
  Require(device_->CreateRenderTargetView(target_.get(), nullptr, &targetView_), "CreateRenderTargetView");
}

void RhiLoop::MakeStates() {
  Require(
      device_->CreateBuffer({.byteWidth = sizeof(DrawConstants), .usage = Usage::Dynamic, .bind = Bind::ConstantBuffer},
                            nullptr, &constants_),
      "CreateBuffer");
  Require(device_->CreateShader(overhead_shaders::pixel_VSPixel, &vs_), "CreateShader");
  Require(device_->CreateShader(overhead_shaders::pixel_PSColor, &ps_[0]), "CreateShader");
  Require(device_->CreateShader(overhead_shaders::pixel_PSSwapped, &ps_[1]), "CreateShader");
  BlendDesc blend;
  Require(device_->CreateBlendState(blend, &blends_[0]), "CreateBlendState");
  blend.rt[0] = {.enable = true,
                 .src = Blend::SrcAlpha,
                 .dest = Blend::InvSrcAlpha,
                 .srcAlpha = Blend::One,
                 .destAlpha = Blend::Zero};
  Require(device_->CreateBlendState(blend, &blends_[1]), "CreateBlendState");
}

void RhiLoop::Frame(uint32_t switchEvery) {
  constexpr float kBlack[4] = {0, 0, 0, 0};
  const DrawConstants* constants = Constants().data();
  IContext& c = *context_;
  c.ClearRenderTargetView(targetView_.get(), kBlack);
  for (uint32_t i = 0; i < kDraws; ++i) {
    if (i % switchEvery == 0) {
      const uint32_t which = i / switchEvery & 1;
      c.PSSetShader(ps_[which].get());
      c.OMSetBlendState(blends_[which].get());
    }
    c.UpdateConstants(constants_.get(), &constants[i], sizeof(DrawConstants));
    c.Draw(3, 0);
  }
  c.EndFrame();
  Require(device_->WaitIdle(), "WaitIdle");
}

std::vector<uint8_t> RhiLoop::Picture() {
  std::vector<uint8_t> bytes(size_t(kSize) * kSize * 4);
  Require(device_->ReadBack(target_.get(), 0, bytes.data(), bytes.size()), "ReadBack");
  return bytes;
}

}  // namespace

std::unique_ptr<Loop> MakeRhiVulkan() { return std::make_unique<RhiLoop>(Backend::Vulkan); }
std::unique_ptr<Loop> MakeRhiGl() { return std::make_unique<RhiLoop>(Backend::OpenGL); }

}  // namespace rhi_overhead

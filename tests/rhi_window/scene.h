// A device for the display, a scene to draw with it, and the fixture that compares windows with textures.
#pragma once

#include <gtest/gtest.h>

#include <map>

#include "rhi/rhi.h"
#include "test_sink.h"
#include "window.h"

namespace rhi_test {

std::string DisplayProblem();  // why there is no display for windows, or empty
std::string BackendName(rhi::Backend);
rhi::Status CreateDevice(rhi::Backend, const rhi::DeviceDesc&, rhi::Ref<rhi::IDevice>*);
// For the display of the windows, on a CPU rasteriser where there is one, with API and synchronization validation.
rhi::DeviceDesc WindowDeviceDesc(rhi::IMessageSink*);

// What `texture` (RGBA8 or BGRA8) holds.
Pixels Read(rhi::IDevice&, rhi::ITexture* texture);
// Succeeds when the pictures agree in every byte.
testing::AssertionResult SamePixels(const Pixels& a, const Pixels& b);

// A moving textured triangle. Throws std::runtime_error where the RHI gives an error.
class Scene {
 public:
  explicit Scene(rhi::IDevice&);
  // Binds everything but the target; once is enough.
  void Bind();
  // Makes `target` the one that Draw draws to.
  void SetTarget(rhi::ITexture* target);
  void Draw(float time);

 private:
  rhi::IDevice& device_;
  rhi::IContext& context_;
  rhi::Ref<rhi::IShader> vs_, ps_;
  rhi::Ref<rhi::IBuffer> constants_;
  rhi::Ref<rhi::ITexture> texture_;
  rhi::Ref<rhi::IShaderResourceView> view_;
  rhi::Ref<rhi::ISamplerState> sampler_;
  rhi::Ref<rhi::IRenderTargetView> target_;
};

class WindowTest : public testing::TestWithParam<rhi::Backend> {
 protected:
  void SetUp() override;
  void TearDown() override;

  rhi::Ref<rhi::ISwapChain> MakeSwapChain(const Window&, rhi::SwapChainDesc desc);
  // Draws at `time`, presents, ends the frame.
  void Frame(rhi::ISwapChain&, float time);
  // Succeeds when the window shows the back buffer, bit for bit. Waits a little for it: presentation may take its time.
  testing::AssertionResult Shows(const Window&, rhi::ISwapChain&);
  // Succeeds when the back buffer holds what a texture holds to which the same was drawn.
  testing::AssertionResult HoldsTheScene(rhi::ISwapChain&, float time);

  TestSink sink;
  rhi::Ref<rhi::IDevice> device;
  std::unique_ptr<Scene> scene;
};

inline std::string NameOfBackend(const testing::TestParamInfo<rhi::Backend>& info) { return BackendName(info.param); }

}  // namespace rhi_test

#define WINDOW_TESTS_ON_EVERY_BACKEND(suite)                                                        \
  INSTANTIATE_TEST_SUITE_P(Rhi, suite, testing::Values(rhi::Backend::Vulkan, rhi::Backend::OpenGL), \
                           rhi_test::NameOfBackend)

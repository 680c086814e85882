// One device of a backend, with or without API validation, and short ways to make objects and draw with them. What
// fails throws std::runtime_error with the messages; gtest turns that into a failure.
#pragma once

#include <gtest/gtest.h>

#include <stdexcept>

#include "image.h"
#include "rhi/rhi.h"
#include "rhi_stress_shaders/shaders.h"
#include "test_sink.h"

namespace rhi_stress {

using rhi_test::Image;
using rhi_test::Matches;
using rhi_test::Rgba32F;
using rhi_test::Rgba8;
using rhi_test::TestSink;
using rhi_test::Within;

#if defined(__SANITIZE_ADDRESS__)
inline constexpr bool kAddressSanitizer = true;  // keeps freed memory, and maps terabytes
#else
inline constexpr bool kAddressSanitizer = false;
#endif

struct DrawConstants {  // of shaders/stress.hlsl, at b3
  Rgba32F tint{1, 1, 1, 1};
  Rgba32F rectangle{-1, 1, 1, -1};
};

struct Target {
  rhi::Ref<rhi::ITexture> texture;
  rhi::Ref<rhi::IRenderTargetView> view;
};

class Rig {
 public:
  Rig(rhi::Backend, bool validation);
  explicit Rig(rhi::Ref<rhi::IDevice>);  // whose messages go elsewhere
  ~Rig();
  Rig(const Rig&) = delete;
  Rig& operator=(const Rig&) = delete;

  TestSink sink;
  rhi::Ref<rhi::IDevice> device;
  rhi::IContext* context = nullptr;

  void Require(rhi::Status, const char* what) const;
  rhi::Ref<rhi::IBuffer> Constants();  // dynamic, for DrawConstants
  rhi::Ref<rhi::IBuffer> Buffer(const rhi::BufferDesc&, const void* init = nullptr);
  rhi::Ref<rhi::ITexture> Texture(const rhi::TextureDesc&, const rhi::SubresourceData* init = nullptr);
  rhi::Ref<rhi::ITexture> Plain(uint32_t size, const Rgba8& color);  // a texture of one colour
  rhi::Ref<rhi::IShaderResourceView> View(rhi::ITexture*);
  rhi::Ref<rhi::IShader> Shader(const rhi::ShaderBlob&);
  Target MakeTarget(uint32_t size, uint32_t samples = 1);

  // Binds, and draws one rectangle as a strip of two triangles.
  void SetTarget(const Target&);
  void SetConstants(rhi::IBuffer*, const DrawConstants&);
  void DrawRect(rhi::IShader* vs, rhi::IShader* ps);
  Image Read(rhi::ITexture*);
  // Clears a new target, draws into a part of it and compares: the device is sound.
  void ExpectUsable();
  void Finish();  // unbinds all, and waits
};

// The running test's device and a check at its end that no message came.
class StressTest : public testing::TestWithParam<rhi::Backend> {
 protected:
  static constexpr bool kValidation = true;
  void Open(bool validation) { rig = std::make_unique<Rig>(GetParam(), validation); }
  void TearDown() override {
    if (!rig) return;
    if (rig->device) rig->Finish();
    rig->sink.Verify();
  }
  std::unique_ptr<Rig> rig;
};

std::string BackendName(rhi::Backend);
inline std::string NameOfBackend(const testing::TestParamInfo<rhi::Backend>& info) { return BackendName(info.param); }

}  // namespace rhi_stress

#define STRESS_ON_EVERY_BACKEND(suite)                                                                 \
  INSTANTIATE_TEST_SUITE_P(Stress, suite, testing::Values(rhi::Backend::Vulkan, rhi::Backend::OpenGL), \
                           rhi_stress::NameOfBackend)

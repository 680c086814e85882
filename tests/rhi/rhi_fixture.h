// The fixture of tests that run on every backend: TEST_P(SomeTest, CaseName), shown as area/SomeTest.CaseName/vulkan.
#pragma once

#include "gpu.h"
#include "rhi_test_shaders/shaders.h"

namespace rhi_test {

class RhiTest : public testing::TestWithParam<rhi::Backend> {
 protected:
  RhiTest() : gpu(SharedGpu(GetParam())), device(*gpu.device), context(*gpu.context), sink(gpu.sink) {}
  void TearDown() override {
    gpu.Finish();
    sink.Verify();
  }
  const rhi::Caps& Caps() const { return device.GetCaps(); }

  Gpu& gpu;
  rhi::IDevice& device;
  rhi::IContext& context;
  TestSink& sink;
};

inline std::string NameOfBackend(const testing::TestParamInfo<rhi::Backend>& info) { return BackendName(info.param); }

}  // namespace rhi_test

// Skips the running test where a cap is missing, naming it.
#define RHI_NEEDS_CAP(cap) \
  if (!Caps().cap) GTEST_SKIP() << "this adapter lacks Caps::" #cap

// Runs the suite on every backend.
#define RHI_ON_EVERY_BACKEND(suite) \
  INSTANTIATE_TEST_SUITE_P(Rhi, suite, testing::ValuesIn(rhi_test::Backends()), rhi_test::NameOfBackend)

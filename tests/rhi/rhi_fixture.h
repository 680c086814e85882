// Fixtures of cases that run on every backend, and of those that compare the two. docs/conformance.md has the names.
//
//   class BlendTest : public RhiTest                      TEST_P(BlendTest, WriteMask)      blend.write_mask.vulkan,
//   .gl RHI_ON_EVERY_BACKEND(BlendTest); class BlendFactorTest : public RhiTestOf<Factor>      ... Parameter() ...
//   blend.source_factor/one.gl RHI_MATRIX(BlendFactorTest, kFactors, FactorName);    the name is of letters, digits and
//   _ class FurModeTest : public BothTest                   ... vulkan, gl ...                fur.fins_are_alike.both
//   RHI_ON_BOTH(FurModeTest);
//   class FurModelTest : public BothTestOf<Model>         ... Parameter() ...               fur.picture/cat.both
//   RHI_MATRIX_ON_BOTH(FurModelTest, kModels, ModelName);
#pragma once

#include <tuple>

#include "gpu.h"
#include "rhi_test_shaders/shaders.h"

namespace rhi_test {

// A case on one backend's shared device. Any message of a driver or of the RHI fails it, unless `sink` was told.
class RhiCase : public testing::Test {
 protected:
  explicit RhiCase(rhi::Backend b)
      : gpu(SharedGpu(b)), device(*gpu.device), context(*gpu.context), sink(gpu.sink), backend(b) {}
  void TearDown() override {
    gpu.Finish();
    sink.Verify();
  }
  const rhi::Caps& Caps() const { return device.GetCaps(); }

  Gpu& gpu;
  rhi::IDevice& device;
  rhi::IContext& context;
  TestSink& sink;
  const rhi::Backend backend;
};

class RhiTest : public RhiCase, public testing::WithParamInterface<rhi::Backend> {
 protected:
  RhiTest() : RhiCase(GetParam()) {}
};

// Each value of P on each backend.
template <class P>
class RhiTestOf : public RhiCase, public testing::WithParamInterface<std::tuple<P, rhi::Backend>> {
 public:
  using Value = P;

 protected:
  RhiTestOf() : RhiCase(std::get<1>(this->GetParam())) {}
  const P& Parameter() const { return std::get<0>(this->GetParam()); }
};

// A case that needs both backends.
class BothCase : public testing::Test {
 protected:
  BothCase() : vulkan(SharedGpu(rhi::Backend::Vulkan)), gl(SharedGpu(rhi::Backend::OpenGL)) {}
  void TearDown() override {
    for (Gpu* gpu : {&vulkan, &gl}) {
      gpu->Finish();
      gpu->sink.Verify();
    }
  }
  Gpu &vulkan, &gl;
};

struct Both {};  // both backends, as the parameter of a case
inline void PrintTo(const Both&, std::ostream* out) { *out << "both"; }
class BothTest : public BothCase, public testing::WithParamInterface<Both> {};

template <class P>
class BothTestOf : public BothCase, public testing::WithParamInterface<P> {
 protected:
  const P& Parameter() const { return this->GetParam(); }
};

inline std::string NameOfBackend(const testing::TestParamInfo<rhi::Backend>& info) { return BackendName(info.param); }

// Names for GoogleTest, from a function that names a parameter.
template <class P, class Name>
auto WithBackend(Name name) {
  return [name](const testing::TestParamInfo<std::tuple<P, rhi::Backend>>& info) {
    return std::string(name(std::get<0>(info.param))) + "_" + BackendName(std::get<1>(info.param));
  };
}
template <class P, class Name>
auto OnBoth(Name name) {
  return [name](const testing::TestParamInfo<P>& info) { return std::string(name(info.param)) + "_both"; };
}

}  // namespace rhi_test

// Skips the running test where a cap is missing, naming it.
#define RHI_NEEDS_CAP(cap) \
  if (!Caps().cap) GTEST_SKIP() << "this adapter lacks Caps::" #cap

#define RHI_ON_EVERY_BACKEND(suite) \
  INSTANTIATE_TEST_SUITE_P(Rhi, suite, testing::ValuesIn(rhi_test::Backends()), rhi_test::NameOfBackend)
// `values`: a container or an array; name(value): letters, digits and _.
#define RHI_MATRIX(suite, values, name)                                                                          \
  INSTANTIATE_TEST_SUITE_P(Rhi, suite,                                                                           \
                           testing::Combine(testing::ValuesIn(values), testing::ValuesIn(rhi_test::Backends())), \
                           rhi_test::WithBackend<suite::Value>(name))
#define RHI_ON_BOTH(suite)                                                \
  INSTANTIATE_TEST_SUITE_P(Rhi, suite, testing::Values(rhi_test::Both{}), \
                           [](const testing::TestParamInfo<rhi_test::Both>&) { return std::string("both"); })
#define RHI_MATRIX_ON_BOTH(suite, values, name) \
  INSTANTIATE_TEST_SUITE_P(Rhi, suite, testing::ValuesIn(values), rhi_test::OnBoth<suite::ParamType>(name))

// A driver without geometry shaders: fins and shells that need one are refused in words. What it draws in the other ways is
// seen by the conformance suite.
#include "swiftshader.h"

#include "fur/builtin.h"
#include "support.h"

namespace fur::test {
namespace {

class SwiftShader : public testing::Test {
 protected:
  void SetUp() override {
    if (rhi_stress::SwiftShaderIcd().empty())
      GTEST_SKIP() << "no SwiftShader: install the Debian package chromium-common, or set FUR_SWIFTSHADER_ICD";
    device_ = std::make_unique<TestDevice>(Backends()[0]);
    ASSERT_TRUE(*device_);
    const rhi::Caps& caps = (*device_)->GetCaps();
    ASSERT_NE(std::string(caps.adapter.data()).find("SwiftShader"), std::string::npos) << caps.adapter.data();
    ASSERT_FALSE(caps.geometryShader);
  }

  void ExpectRefused(const RenderSettings& settings, const std::string& instead) {
    const auto refused = MakeRenderer(**device_, MakeBuiltinAnimal(), settings);
    ASSERT_FALSE(refused);
    EXPECT_EQ(refused.error().code, ErrorCode::NoDevice);
    for (const std::string& word : {std::string("geometry shader"), std::string("SwiftShader"), instead})
      EXPECT_NE(refused.error().message.find(word), std::string::npos) << refused.error().message;
  }

  std::unique_ptr<TestDevice> device_;
};

TEST_F(SwiftShader, GeometryShadersAreRefusedInWords) {
  ExpectRefused({.finMode = FinMode::Geometry}, "pulled or compacted");
  ExpectRefused({.shellMode = ShellMode::Amplified}, "instanced");
}

}  // namespace
}  // namespace fur::test

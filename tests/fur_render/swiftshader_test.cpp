// A driver without geometry shaders: fins and shells work in the other ways, and those that need one are refused in
// words.
#include "swiftshader.h"

#include <algorithm>

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

  Image Picture(const RenderSettings& settings) {
    static const Model animal = MakeBuiltinAnimal();
    const Camera camera = FrameBounds(ComputeBounds(animal), PlaceAnimals(1, 1), 40, 4.0 / 3);
    return Render(*device_, animal, settings, camera, PlaceAnimals(1, 1)).image;
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

TEST_F(SwiftShader, FinsPulledAndCompacted) {
  for (const uint32_t samples : {1u, 4u}) {
    RenderSettings settings{.width = 120, .height = 90, .samples = samples, .drawShells = false};
    settings.finMode = FinMode::Pulled;
    const Image pulled = Picture(settings);
    EXPECT_GT(Colors(pulled), 100u);
    settings.finMode = FinMode::Compacted;
    EXPECT_EQ(DifferingPixels(pulled, Picture(settings)), 0u);
    settings.finMode = FinMode::Auto;
    EXPECT_EQ(DifferingPixels(pulled, Picture(settings)), 0u);
    settings.drawFins = false;
    EXPECT_GT(DifferingPixels(pulled, Picture(settings)), 100u) << "the fins hardly show";
  }
}

TEST_F(SwiftShader, ShellsInstancedAndByDraws) {
  RenderSettings settings{.width = 120, .height = 90};
  const Image instanced = Picture(settings);
  EXPECT_GT(Colors(instanced), 100u);
  settings.shellMode = ShellMode::Draws;
  EXPECT_EQ(DifferingPixels(instanced, Picture(settings)), 0u);
}

TEST_F(SwiftShader, GeometryShadersAreRefusedInWords) {
  ExpectRefused({.finMode = FinMode::Geometry}, "pulled or compacted");
  ExpectRefused({.shellMode = ShellMode::Amplified}, "instanced");
}

}  // namespace
}  // namespace fur::test

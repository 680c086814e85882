// Several shells of a triangle at once: how far the picture is from shell by shell. That the other ways of shells and fins
// are one picture: tests/conformance/fur_modes.cpp.
#include <algorithm>
#include <cstdlib>
#include <filesystem>

#include "fur/builtin.h"
#include "fur/gltf.h"
#include "models.h"
#include "support.h"

namespace fur::test {
namespace {

constexpr uint32_t kWidth = 160, kHeight = 120;

struct ModeCase {
  const char* model;
  BackendCase backend;
};
void PrintTo(const ModeCase& c, std::ostream* out) { *out << c.model << " on " << c.backend.name; }
std::string ModeCaseName(const testing::TestParamInfo<ModeCase>& info) {
  return std::filesystem::path(info.param.model).stem().string() + "_" + info.param.backend.name;
}
std::vector<ModeCase> ModeCases() {
  std::vector<ModeCase> cases;
  for (const char* model : {"builtin", "cat/cat.gltf", "torus/torus.gltf", "spot/spot.glb"})
    for (const BackendCase& backend : Backends()) cases.push_back({model, backend});
  return cases;
}

std::filesystem::path AssetsFolder() {
  if (const char* folder = std::getenv("FUR_ASSETS")) return folder;
  return FUR_ASSETS_DIR;
}

struct Difference {
  uint64_t pixels = 0, above1 = 0;
  int most = 0;  // of 255
};
Difference Compare(const Image& a, const Image& b) {
  Difference d{.pixels = DifferingPixels(a, b)};
  for (uint32_t y = 0; y < a.height && a.pixels.size() == b.pixels.size(); ++y)
    for (uint32_t x = 0; x < a.width; ++x) {
      int most = 0;
      for (size_t c = 0; c < 3; ++c) most = std::max(most, std::abs(PixelAt(a, x, y)[c] - PixelAt(b, x, y)[c]));
      d.above1 += most > 1;
      d.most = std::max(d.most, most);
    }
  return d;
}

class Modes : public testing::TestWithParam<ModeCase> {
 protected:
  void SetUp() override {
    const std::string name = GetParam().model;
    if (name != "builtin" && !std::filesystem::exists(AssetsFolder() / name))
      GTEST_SKIP() << "no " << AssetsFolder() / name;
    Result<Model> model = name == "builtin" ? MakeBuiltinAnimal() : LoadGltf(AssetsFolder() / name);
    ASSERT_TRUE(model) << model.error().message;
    model_ = std::move(*model);
    device_ = std::make_unique<TestDevice>(GetParam().backend);
    ASSERT_TRUE(*device_);
  }

  Model model_;
  std::unique_ptr<TestDevice> device_;
};
INSTANTIATE_TEST_SUITE_P(All, Modes, testing::ValuesIn(ModeCases()), ModeCaseName);

// Limbs that overlap are blended limb by limb instead of shell by shell, so that the pictures differ there. Prints the
// table of docs/measured.md.
TEST_P(Modes, SeveralShellsAtOnceDifferWhereLimbsOverlap) {
  const std::vector<glm::dmat4> placements = PlaceAnimals(1, 1);
  const Camera front = FrameBounds(ComputeBounds(model_), placements, 40, double(kWidth) / kHeight);
  for (const int turn : {0, 140}) {
    RenderSettings settings{.width = kWidth, .height = kHeight, .drawFins = false, .shellMode = ShellMode::Instanced};
    const auto picture = [&] { return Draw(*device_, model_, settings, TurnCamera(front, turn), placements); };
    const Image instanced = picture();
    settings.shellMode = ShellMode::Amplified;
    std::printf("%s, %d degrees; at once: pixels that differ, by more than 1, most\n", GetParam().model, turn);
    for (const uint32_t atOnce : {14u, 7u, 4u, 2u, 1u}) {
      settings.shellsAtOnce = atOnce;
      const Difference d = Compare(instanced, picture());
      const double percent = 100.0 / (kWidth * kHeight);
      std::printf("  %2u: %.3f %%, %.3f %%, %d\n", atOnce, double(d.pixels) * percent, double(d.above1) * percent,
                  d.most);
      EXPECT_LT(double(d.pixels) * percent, 4) << "in the list's order: up to 12";
    }
  }
}

class ShellsAtOnce : public OnEachBackend {};
INSTANTIATE_TEST_SUITE_P(Backends, ShellsAtOnce, testing::ValuesIn(Backends()), BackendName);

TEST_P(ShellsAtOnce, OutOfRangeIsRefused) {
  for (const uint32_t atOnce : {0u, 15u}) {
    const RenderSettings settings{.width = kWidth, .height = kHeight, .shellMode = ShellMode::Amplified, .shellsAtOnce = atOnce};
    const auto refused = MakeRenderer(**device_, Cube(UniformCoat(16, 60)), settings);
    ASSERT_FALSE(refused);
    EXPECT_EQ(refused.error().code, ErrorCode::Usage);
    EXPECT_NE(refused.error().message.find("1 to 14"), std::string::npos) << refused.error().message;
  }
}

}  // namespace
}  // namespace fur::test

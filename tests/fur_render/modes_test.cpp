// Fins three ways and shells three ways, one picture.
//
// Modes whose last stage before the rasteriser is a vertex shader agree to the bit. Behind a geometry shader Mesa
// brings positions to the viewport in other arithmetic than behind a vertex shader, so that an edge moves by up to a
// step of the rasteriser's grid and colours are interpolated to other last bits: a few pixels differ, nearly all by 1
// of 255.
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <glm/gtc/matrix_transform.hpp>

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

Image Picture(TestDevice& device, const Model& model, const RenderSettings& settings, const Camera& camera) {
  Result<std::unique_ptr<Renderer>> renderer = MakeRenderer(*device, model, settings);
  if (!renderer) {
    ADD_FAILURE() << renderer.error().message;
    return {};
  }
  (*renderer)->Draw(camera, PlaceAnimals(1, 1));
  Result<Image> image = (*renderer)->ReadImage();
  if (!image) ADD_FAILURE() << image.error().message;
  return image ? std::move(*image) : Image{};
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

void ExpectEqualThroughGeometryShader(const Image& expected, const Image& got, const std::string& what) {
  const Difference d = Compare(expected, got);
  EXPECT_LE(d.pixels, uint64_t{expected.width} * expected.height / 1000) << what;
  EXPECT_EQ(d.above1, 0u) << what << ", up to " << d.most;
}

void ExpectEqual(const Image& expected, const Image& got, const std::string& what) {
  EXPECT_EQ(DifferingPixels(expected, got), 0u) << what;
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

  // From two sides, without and with multisampling.
  template <class F>
  void ForEachView(F check) {
    const Camera front = FrameBounds(ComputeBounds(model_), PlaceAnimals(1, 1), 40, double(kWidth) / kHeight);
    for (const double turn : {0.0, 140.0})
      for (const uint32_t samples : {1u, 4u})
        check(TurnCamera(front, turn), RenderSettings{.width = kWidth, .height = kHeight, .samples = samples},
              std::to_string(int(turn)) + " degrees, " + std::to_string(samples) + " samples");
  }

  Model model_;
  std::unique_ptr<TestDevice> device_;
};
INSTANTIATE_TEST_SUITE_P(All, Modes, testing::ValuesIn(ModeCases()), ModeCaseName);

TEST_P(Modes, FinsThreeWays) {
  ForEachView([&](const Camera& camera, RenderSettings settings, const std::string& what) {
    settings.drawShells = false;
    const auto fins = [&](FinMode mode) {
      settings.finMode = mode;
      return Picture(*device_, model_, settings, camera);
    };
    const Image pulled = fins(FinMode::Pulled);
    EXPECT_GT(Colors(pulled), 100u) << "there is hardly anything to compare";
    ExpectEqual(pulled, fins(FinMode::Compacted), "compacted, " + what);
    ExpectEqualThroughGeometryShader(pulled, fins(FinMode::Geometry), "geometry, " + what);
    settings.drawFins = false;
    EXPECT_GT(DifferingPixels(pulled, fins(FinMode::Pulled)), 100u) << "the fins hardly show";
  });
}

TEST_P(Modes, ShellsThreeWays) {
  ForEachView([&](const Camera& camera, RenderSettings settings, const std::string& what) {
    settings.drawFins = false;
    const auto shells = [&](ShellMode mode) {
      settings.shellMode = mode;
      return Picture(*device_, model_, settings, camera);
    };
    const Image instanced = shells(ShellMode::Instanced);
    EXPECT_GT(Colors(instanced), 100u) << "there is hardly anything to compare";
    ExpectEqual(instanced, shells(ShellMode::Draws), "one draw each, " + what);
    ExpectEqualThroughGeometryShader(instanced, shells(ShellMode::Amplified), "amplified, " + what);
  });
}

// Limbs that overlap are blended limb by limb instead of shell by shell, so that the pictures differ there. Prints the
// table of docs/measured.md.
TEST_P(Modes, SeveralShellsAtOnceDifferWhereLimbsOverlap) {
  ForEachView([&](const Camera& camera, RenderSettings settings, const std::string& what) {
    if (settings.samples > 1) return;
    settings.drawFins = false;
    settings.shellMode = ShellMode::Instanced;
    const Image instanced = Picture(*device_, model_, settings, camera);
    settings.shellMode = ShellMode::Amplified;
    std::printf("%s, %s; at once: pixels that differ, by more than 1, most\n", GetParam().model, what.c_str());
    for (const uint32_t atOnce : {14u, 7u, 4u, 2u, 1u}) {
      settings.shellsAtOnce = atOnce;
      const Difference d = Compare(instanced, Picture(*device_, model_, settings, camera));
      const double percent = 100.0 / (kWidth * kHeight);
      std::printf("  %2u: %.3f %%, %.3f %%, %d\n", atOnce, double(d.pixels) * percent, double(d.above1) * percent,
                  d.most);
      EXPECT_LT(double(d.pixels) * percent, 4) << "in the list's order: up to 12";
    }
  });
}

// ------------------------------------------------------------------------------------ several shells of a triangle at
// once
class ShellsAtOnce : public OnEachBackend {
 protected:
  static constexpr RenderSettings kSettings{.width = kWidth, .height = kHeight, .drawFins = false};

  // Instanced against sorted, and against 14, 5 and 2 at once.
  void ExpectEqualAtOnce(const Model& model, RenderSettings settings, const Camera& camera, const std::string& what) {
    settings.shellMode = ShellMode::Instanced;
    const Image instanced = Picture(*device_, model, settings, camera);
    EXPECT_GT(Colors(instanced), 100u) << what;
    settings.shellMode = ShellMode::Sorted;
    ExpectEqual(instanced, Picture(*device_, model, settings, camera), what + ", sorted");
    settings.shellMode = ShellMode::Amplified;
    for (const uint32_t atOnce : {14u, 5u, 2u}) {
      settings.shellsAtOnce = atOnce;
      ExpectEqualThroughGeometryShader(instanced, Picture(*device_, model, settings, camera),
                                       what + ", " + std::to_string(atOnce) + " at once");
    }
  }
};
INSTANTIATE_TEST_SUITE_P(Backends, ShellsAtOnce, testing::ValuesIn(Backends()), BackendName);

// Stripes, so that each triangle looks different from its neighbours in the middle of the fur.
Coat LongCoat() {
  Coat coat = UniformCoat(16, 60, {190, 128, 220});
  coat.length = 0.6;
  return coat;
}

// Crossed on a ray: the prisms back to front, and within one its shells; or shell by shell. Both are the same order
// there.
TEST_P(ShellsAtOnce, ConvexBodiesAreSortedExactly) {
  for (const auto& [name, model] : {std::pair("tetrahedron", Tetrahedron(LongCoat())), {"cube", Cube(LongCoat())}})
    for (const double yaw : {20.0, 200.0})
      for (const uint32_t shells : {16u, 32u}) {
        RenderSettings settings = kSettings;
        settings.shells = shells;
        ExpectEqualAtOnce(
            model, settings, CameraAt(6, yaw, 30),
            std::string(name) + " at " + std::to_string(int(yaw)) + ", " + std::to_string(shells) + " shells");
      }
}

// The eye reaches each part's own axes, mirrored and stretched ones too; and each part has an order of its own.
TEST_P(ShellsAtOnce, PartsOfOnePrimitiveAreSortedApart) {
  Model model = Cube(LongCoat());
  model.parts[0].transform = glm::translate(glm::dmat4(1), glm::dvec3(-1.5, 0.3, 0));
  model.parts[0].transform = glm::scale(model.parts[0].transform, glm::dvec3(0.5, 0.4, 0.6));
  model.parts.push_back({.primitive = 0, .transform = glm::translate(glm::dmat4(1), glm::dvec3(1.5, -0.2, 0))});
  model.parts[1].transform = glm::scale(model.parts[1].transform, glm::dvec3(-0.5, 0.5, 0.3));
  ExpectEqualAtOnce(model, kSettings, CameraAt(6, 10, 15), "two parts");
}

TEST_P(ShellsAtOnce, OutOfRangeIsRefused) {
  RenderSettings settings = kSettings;
  settings.shellMode = ShellMode::Amplified;
  for (const uint32_t atOnce : {0u, 15u}) {
    settings.shellsAtOnce = atOnce;
    const auto refused = MakeRenderer(**device_, Cube(LongCoat()), settings);
    ASSERT_FALSE(refused);
    EXPECT_EQ(refused.error().code, ErrorCode::Usage);
    EXPECT_NE(refused.error().message.find("1 to 14"), std::string::npos) << refused.error().message;
  }
}

}  // namespace
}  // namespace fur::test

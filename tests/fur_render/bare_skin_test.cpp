// Bare skin with more samples than the fur (RenderSettings::skinSamples, fur/src/skin_pass.h).
#include <glm/gtc/matrix_transform.hpp>

#include "models.h"
#include "support.h"

namespace fur::test {
namespace {

constexpr uint32_t kWidth = 96, kHeight = 64;

class BareSkin : public OnEachBackend {};
INSTANTIATE_TEST_SUITE_P(Backends, BareSkin, testing::ValuesIn(Backends()), BackendName);

RenderSettings Settings(uint32_t samples, uint32_t skinSamples) {
  return {.width = kWidth, .height = kHeight, .samples = samples, .target = TargetFormat::Float32,
          .background = glm::dvec3(0.1, 0.2, 0.4), .skinSamples = skinSamples};
}

// Three turned squares: two cross in the picture at different depths, one is on its own.
Model Squares() {
  Model model = BaldSquare(0.5, {250, 220, 180, 255});
  model.parts.resize(3, model.parts[0]);
  const glm::dvec3 places[] = {{-0.3, 0, 0}, {0.1, 0.2, -0.8}, {1.4, -0.5, 0.3}};
  for (size_t i = 0; i < 3; ++i)
    model.parts[i].transform = glm::rotate(glm::translate(glm::dmat4(1), places[i]), 0.4 + double(i), glm::dvec3(0, 0, 1));
  return model;
}

double Largest(const FloatImage& a, const FloatImage& b) {
  double largest = 0;
  for (size_t i = 0; i < a.pixels.size(); ++i)
    for (int c = 0; c < 4; ++c) largest = std::max(largest, double(std::abs(a.pixels[i][c] - b.pixels[i][c])));
  return largest;
}

// Without any fur all of the frame has four samples, and the driver's resolve is the oracle.
TEST_P(BareSkin, IsAsAFrameOfFourSamples) {
  const Model model = Squares();
  const std::vector<glm::dmat4> one{glm::dmat4(1)}, some{glm::dmat4(1), glm::translate(glm::dmat4(1), glm::dvec3(0.5, 0.6, -2)),
                                                         glm::translate(glm::dmat4(1), glm::dvec3(-40, 0, 0))};
  for (const auto& placements : {one, some})
    for (const Camera& camera : {CameraAt(5, 0, 0), CameraAt(3, 20, 10), CameraAt(0.9, 60, 0), CameraAt(1.4, 0, 0)}) {
      const FloatImage four = Pixels(*device_, model, Settings(4, 0), camera, placements),
                       bare = Pixels(*device_, model, Settings(1, 4), camera, placements),
                       rough = Pixels(*device_, model, Settings(1, 0), camera, placements);
      EXPECT_LT(Largest(four, bare), 1e-6) << placements.size();
      EXPECT_GT(Largest(four, rough), 0.05) << placements.size() << ": no edge in the picture";
    }
}

// One renderer draws near and far: what is drawn apart grows, and what was there before does not show.
TEST_P(BareSkin, EachFrameIsItsOwn) {
  const Model model = Squares();
  auto renderer = MakeRenderer(*device_, model, Settings(1, 4));
  ASSERT_TRUE(renderer);
  const std::vector<glm::dmat4> placements{glm::dmat4(1)};
  for (const double distance : {12.0, 3.0, 30.0, 1.0, 6.0}) {
    const Camera camera = CameraAt(distance, 10, 5);
    (*renderer)->Draw(camera, placements);
    const Result<FloatImage> image = (*renderer)->ReadPixels();
    ASSERT_TRUE(image);
    EXPECT_LT(Largest(*image, Pixels(*device_, model, Settings(4, 0), camera)), 1e-6) << distance;
  }
}

// A furred square, and a bare one before or behind it.
Model FurredAndBare(double z) {
  Model model = FurredSquare(1, {200, 150, 100, 255}, UniformCoat(16, 60));
  Model bare = BaldSquare(0.4, {});
  bare.materials[0].baseColor = glm::vec4(0.05f, 0.05f, 0.05f, 1);  // of the furred square's picture
  model.primitives.push_back(bare.primitives[0]);
  model.primitives.back().material = uint32_t(model.materials.size());
  model.materials.push_back(bare.materials[0]);
  model.parts.push_back(bare.parts[0]);
  model.parts.back().primitive = 1;
  model.parts.back().transform = glm::rotate(glm::translate(glm::dmat4(1), glm::dvec3(0, 0, z)), 0.3, glm::dvec3(0, 0, 1));
  return model;
}

// Behind the furred skin it is hidden in all samples; in front its inside and all else are as before, its edge is between.
TEST_P(BareSkin, LiesBetweenSkinAndFurByItsDepth) {
  const Camera camera = CameraAt(3, 0, 0);
  const Model behind = FurredAndBare(-0.2), before = FurredAndBare(0.5),
              plain = FurredSquare(1, {200, 150, 100, 255}, UniformCoat(16, 60));
  EXPECT_EQ(Largest(Pixels(*device_, behind, Settings(1, 4), camera), Pixels(*device_, plain, Settings(1, 0), camera)), 0);
  const FloatImage rough = Pixels(*device_, before, Settings(1, 0), camera),
                   smooth = Pixels(*device_, before, Settings(1, 4), camera),
                   four = Pixels(*device_, before, Settings(4, 0), camera);
  size_t changed = 0;
  for (size_t i = 0; i < rough.pixels.size(); ++i) {
    changed += rough.pixels[i] != smooth.pixels[i];
    if (four.pixels[i] == rough.pixels[i]) {
      EXPECT_EQ(smooth.pixels[i], rough.pixels[i]) << "no edge at pixel " << i;
    }
  }
  EXPECT_GT(changed, 30u);
}

TEST_P(BareSkin, CostsNothingWhereNoneIs) {
  const Model model = FurredSquare(1, {200, 150, 100, 255}, UniformCoat(16, 60));
  RenderSettings settings{.width = kWidth, .height = kHeight};
  const Frame one = Render(*device_, model, settings, CameraAt(3, 10, 0));
  settings.skinSamples = 4;
  const Frame bare = Render(*device_, model, settings, CameraAt(3, 10, 0));
  EXPECT_EQ(DifferingPixels(one.image, bare.image), 0u);
  EXPECT_EQ(one.counts.draws, bare.counts.draws);
}

TEST_P(BareSkin, RefusesWhatHasNoMeaning) {
  const Model model = Squares();
  RenderSettings settings = Settings(4, 1);
  EXPECT_FALSE(MakeRenderer(*device_, model, settings)) << "fewer than the fur";
  settings = Settings(1, 4);
  settings.technique = Technique::Seed;
  settings.target = TargetFormat::Auto;
  const auto seed = MakeRenderer(*device_, model, settings);
  ASSERT_FALSE(seed);
  EXPECT_EQ(seed.error().code, ErrorCode::Usage);
  EXPECT_NE(seed.error().message.find("--skin-samples"), std::string::npos) << seed.error().message;
}

}  // namespace
}  // namespace fur::test

// One picture on every backend, to the bit.
#include <algorithm>
#include <ostream>

#include "fur/builtin.h"
#include "models.h"
#include "support.h"

namespace fur::test {
namespace {

struct Combination {
  Technique technique;
  Look look;
  Semantics semantics;
  uint32_t samples;
};

class Parity : public testing::TestWithParam<Combination> {};

void PrintTo(const Combination& c, std::ostream* out) {
  *out << "technique " << int(c.technique) << ", look " << int(c.look) << ", semantics " << int(c.semantics) << ", " << c.samples << " samples";
}
std::string CombinationName(const testing::TestParamInfo<Combination>& info) {
  return std::string(info.param.technique == Technique::Seed ? "seed_" : "shells_") +
         (info.param.look == Look::Seed ? "seed" : "correct") +
         (info.param.semantics == Semantics::Sheet ? "_sheet_" : "_volume_") + std::to_string(info.param.samples);
}

std::vector<Combination> AllCombinations() {
  std::vector<Combination> all;
  for (const Technique technique : {Technique::Seed, Technique::Shells})
    for (const Look look : {Look::Seed, Look::Correct})
      for (const Semantics semantics : {Semantics::Sheet, Semantics::Volume})
        for (const uint32_t samples : {1u, 4u}) all.push_back({technique, look, semantics, samples});
  return all;
}
INSTANTIATE_TEST_SUITE_P(All, Parity, testing::ValuesIn(AllCombinations()), CombinationName);

const Model& Animal() {
  static const Model animal = MakeBuiltinAnimal();
  return animal;
}

Camera CloseCamera() { return FrameBounds(ComputeBounds(Animal()), PlaceAnimals(1, 1), 40, 160 / 120.0); }

void ExpectSameFrames(const RenderSettings& settings, const Model& model, const Camera& camera,
                      const std::vector<glm::dmat4>& placements) {
  std::vector<Frame> frames;
  for (const BackendCase& backend : Backends()) {
    TestDevice device(backend);
    ASSERT_TRUE(device);
    frames.push_back(Render(device, model, settings, camera, placements));
  }
  EXPECT_GT(Colors(frames[0].image), 100u) << "there is hardly anything to compare";
  for (size_t i = 1; i < frames.size(); ++i) {
    EXPECT_EQ(DifferingPixels(frames[0].image, frames[i].image), 0u);
    EXPECT_EQ(frames[0].counts.baseFragments, frames[i].counts.baseFragments);
    EXPECT_EQ(frames[0].counts.finFragments, frames[i].counts.finFragments);
    EXPECT_EQ(frames[0].counts.shellFragments, frames[i].counts.shellFragments);
    EXPECT_GT(frames[i].counts.finFragments, 0u);
  }
}

RenderSettings Settings(const Combination& c) {
  return {.width = 160,
          .height = 120,
          .samples = c.samples,
          .technique = c.technique,
          .look = c.look,
          .semantics = c.semantics};
}

TEST_P(Parity, BuiltinAnimal) { ExpectSameFrames(Settings(GetParam()), Animal(), CloseCamera(), PlaceAnimals(1, 1)); }

// Overlapping animals, some cut by the picture's edge, on the published camera.
TEST(ParityField, FiveAnimals) {
  RenderSettings settings = Settings({Technique::Shells, Look::Correct, Semantics::Volume, 1});
  settings.background = {0.1, 0.2, 0.3};
  ExpectSameFrames(settings, Animal(), {}, PlaceAnimals(5, 0.25));
}

// Slices that fall between shells must round alike.
TEST(ParityField, MoreShellsThanSlices) {
  RenderSettings settings = Settings({Technique::Seed, Look::Seed, Semantics::Sheet, 1});
  settings.shells = 32;
  ExpectSameFrames(settings, Animal(), CloseCamera(), PlaceAnimals(1, 1));
}

// Between two slices, and all of the shells' other ways and switches.
TEST(ParityField, ShellsInEveryMode) {
  RenderSettings settings = Settings({Technique::Shells, Look::Correct, Semantics::Volume, 1});
  settings.comb = {0.2, -0.5, 0.7};
  for (const uint32_t shells : {5u, 17u, 40u})
    for (const ShellMode mode : {ShellMode::Instanced, ShellMode::Draws, ShellMode::Amplified})
      for (const FinMode fins : {FinMode::Geometry, FinMode::Pulled, FinMode::Compacted}) {
        settings.shells = shells;
        settings.shellMode = mode;
        settings.finMode = fins;
        SCOPED_TRACE(std::to_string(shells) + " shells, mode " + std::to_string(int(mode)) + ", fins " +
                     std::to_string(int(fins)));
        ExpectSameFrames(settings, Animal(), CloseCamera(), PlaceAnimals(1, 1));
      }
}

// A second frame on the same renderer, and one on a second renderer of the same device.
TEST(ParityField, FramesRepeatExactly) {
  for (const BackendCase& backend : Backends()) {
    TestDevice device(backend);
    ASSERT_TRUE(device);
    const RenderSettings settings = Settings({Technique::Shells, Look::Correct, Semantics::Volume, 1});
    const std::vector<glm::dmat4> placements = PlaceAnimals(1, 1);
    Result<std::unique_ptr<Renderer>> renderer = MakeRenderer(*device, Animal(), settings);
    ASSERT_TRUE(renderer) << renderer.error().message;
    (*renderer)->Draw(CloseCamera(), placements);
    const Result<Image> first = (*renderer)->ReadImage();
    for (int i = 1; i <= 4; ++i) (*renderer)->Draw(TurnCamera(CloseCamera(), 10 * i), placements);
    (*renderer)->Draw(CloseCamera(), placements);
    const Result<Image> again = (*renderer)->ReadImage();
    ASSERT_TRUE(first && again);
    EXPECT_EQ(DifferingPixels(*first, *again), 0u) << backend.name;
    EXPECT_EQ(DifferingPixels(*first, Render(device, Animal(), settings, CloseCamera(), placements).image), 0u)
        << backend.name;
  }
}

}  // namespace
}  // namespace fur::test

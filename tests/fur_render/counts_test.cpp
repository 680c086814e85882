// What a frame submits and shades, exactly.
#include <glm/gtc/matrix_transform.hpp>

#include "models.h"
#include "support.h"

namespace fur::test {
namespace {

class Counts : public OnEachBackend {};
INSTANTIATE_TEST_SUITE_P(Backends, Counts, testing::ValuesIn(Backends()), BackendName);

constexpr uint64_t kPixels = 64 * 48;
RenderSettings Settings(uint32_t shells) { return {.width = 64, .height = 48, .technique = Technique::Seed, .semantics = Semantics::Sheet, .shells = shells}; }

Model FullScreen() { return FurredSquare(40, {180, 120, 60, 255}, UniformCoat(16, 128)); }

// A square that fills the screen: each pixel once in the base pass and once in each shell.
TEST_P(Counts, FullScreenSquare) {
  for (const Look look : {Look::Seed, Look::Correct})
    for (const Semantics semantics : {Semantics::Sheet, Semantics::Volume})
      for (const uint32_t shells : {1u, 16u, 64u}) {
        RenderSettings settings = Settings(shells);
        settings.look = look;
        settings.semantics = semantics;
        const FrameCounts c = Render(*device_, FullScreen(), settings, CameraAt(3, 0, 0)).counts;
        EXPECT_EQ(c.baseFragments, kPixels);
        EXPECT_EQ(c.shellFragments, kPixels * shells);
        EXPECT_EQ(c.finFragments, 0u) << "both triangles face the eye";
        EXPECT_EQ(c.draws, 3u);
        EXPECT_EQ(c.triangles, 2 + 2 * shells);
        EXPECT_EQ(c.edges, 2u) << "the diagonal, from each side";
        EXPECT_EQ(c.skippedAnimals + c.skippedEdges + c.skippedShells, 0u);
      }
}

TEST_P(Counts, FourSamplesCountOneFragmentForEachPixel) {
  RenderSettings settings = Settings(16);
  settings.samples = 4;
  const FrameCounts c = Render(*device_, FullScreen(), settings, CameraAt(3, 30, 0)).counts;
  EXPECT_EQ(c.baseFragments, kPixels);
  EXPECT_EQ(c.shellFragments, kPixels * 16);
}

TEST_P(Counts, NumberOfShellsComesFromTheCoatUnlessGiven) {
  Model model = FullScreen();
  const auto shells = [&](uint32_t setting) {
    return Render(*device_, model, Settings(setting), CameraAt(3, 0, 0)).counts.shellFragments / kPixels;
  };
  EXPECT_EQ(shells(0), 16u) << "sixteen slices";
  model.materials[0].fur->params.shells = 5;
  EXPECT_EQ(shells(0), 5u);
  EXPECT_EQ(shells(9), 9u);
  model.volumes[0].layers = 2;
  model.volumes[0].pixels.resize(size_t{4} * 4 * 4 * 2);
  model.materials[0].fur->params.shells = 0;
  EXPECT_EQ(shells(0), 16u) << "sixteen at least";
}

// Animals at one place: the second base fails the depth test, its shells pass.
TEST_P(Counts, AnimalsAreAddedUp) {
  const std::vector<glm::dmat4> placements(3, glm::dmat4(1));
  const FrameCounts c = Render(*device_, FullScreen(), Settings(16), CameraAt(3, 0, 0), placements).counts;
  EXPECT_EQ(c.baseFragments, kPixels);
  EXPECT_EQ(c.shellFragments, 3 * 16 * kPixels);
  EXPECT_EQ(c.draws, 9u);
  EXPECT_EQ(c.triangles, 3u * (2 + 2 * 16));
  EXPECT_EQ(c.edges, 6u);
}

TEST_P(Counts, PassesThatAreSwitchedOffCostNothing) {
  RenderSettings settings = Settings(16);
  settings.drawFins = false;
  const FrameCounts noFins = Render(*device_, Tetrahedron(UniformCoat(16, 128)), settings, CameraAt(6, 20, 10)).counts;
  EXPECT_EQ(noFins.edges, 0u);
  EXPECT_EQ(noFins.finFragments, 0u);
  EXPECT_GT(noFins.shellFragments, 0u);
  EXPECT_EQ(noFins.draws, 2u);
  settings.drawFins = true;
  settings.drawShells = false;
  const FrameCounts noShells =
      Render(*device_, Tetrahedron(UniformCoat(16, 128)), settings, CameraAt(6, 20, 10)).counts;
  EXPECT_EQ(noShells.edges, 12u);
  EXPECT_EQ(noShells.shellFragments, 0u);
  EXPECT_EQ(noShells.draws, 2u);
  EXPECT_EQ(noShells.triangles, 4u);
}

TEST_P(Counts, BaldModelHasNeitherFinsNorShells) {
  const FrameCounts c = Render(*device_, BaldSquare(40, {9, 9, 9, 255}), Settings(16), CameraAt(3, 0, 0)).counts;
  EXPECT_EQ(c.baseFragments, kPixels);
  EXPECT_EQ(c.finFragments + c.shellFragments + c.edges, 0u);
  EXPECT_EQ(c.draws, 1u);
  EXPECT_EQ(c.triangles, 2u);
}

TEST_P(Counts, SwitchedOffFurIsBald) {
  Model model = FullScreen();
  model.materials[0].fur->params.enabled = false;
  const FrameCounts c = Render(*device_, model, Settings(16), CameraAt(3, 0, 0)).counts;
  EXPECT_EQ(c.draws, 1u);
  EXPECT_EQ(c.shellFragments, 0u);
}

TEST_P(Counts, OffScreenAnimalShadesNothingButIsSubmitted) {
  const glm::dmat4 behind = glm::translate(glm::dmat4(1), glm::dvec3(0, 0, 100));
  const FrameCounts c = Render(*device_, FullScreen(), Settings(16), CameraAt(3, 0, 0), {behind}).counts;
  EXPECT_EQ(c.baseFragments + c.finFragments + c.shellFragments, 0u);
  EXPECT_EQ(c.draws, 3u) << "the seed culls nothing";
}

// The counting pass shades what the frame shades: counting does not change the next frame, nor the frame the count.
TEST_P(Counts, CountingLeavesTheFrameAlone) {
  const Model model = Tetrahedron(UniformCoat(16, 128));
  const Camera camera = CameraAt(6, 20, 10);
  const std::vector<glm::dmat4> placements{glm::dmat4(1)};
  Result<std::unique_ptr<Renderer>> made = MakeRenderer(**device_, model, Settings(16));
  ASSERT_TRUE(made) << made.error().message;
  Renderer& renderer = **made;
  renderer.Draw(camera, placements);
  const Result<Image> before = renderer.ReadImage();
  const Result<FrameCounts> first = renderer.Count(camera, placements), second = renderer.Count(camera, placements);
  ASSERT_TRUE(before && first && second);
  EXPECT_EQ(first->shellFragments, second->shellFragments);
  EXPECT_EQ(first->finFragments, second->finFragments);
  const Result<Image> kept = renderer.ReadImage();
  renderer.Draw(camera, placements);
  const Result<Image> after = renderer.ReadImage();
  ASSERT_TRUE(kept && after);
  EXPECT_EQ(DifferingPixels(*before, *kept), 0u);
  EXPECT_EQ(DifferingPixels(*before, *after), 0u);
}

}  // namespace
}  // namespace fur::test

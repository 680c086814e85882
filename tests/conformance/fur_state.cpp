// A frame is the same whatever was drawn before it, and whatever the driver remembers; and a fault of one backend
// shows.
#include <algorithm>

#include "../fur_render/frames.h"
#include "../fur_render/models.h"
#include "child_run.h"
#include "fur_scenes.h"

namespace conformance {
namespace {

using namespace fur;
using rhi_test::BothTest;
using rhi_test::Gpu;
using rhi_test::RhiTest;

constexpr RenderSettings kSmall{.width = kFurWidth, .height = kFurHeight};

class FurStateTest : public RhiTest {
 protected:
  // A frame of each technique, all bytes one after the other.
  std::vector<uint8_t> FrameOfEachTechnique() {
    RenderSettings seed = kSmall;
    seed.technique = Technique::Seed;
    seed.look = Look::Seed;
    seed.drawFins = Caps().geometryShader;
    std::vector<uint8_t> bytes;
    for (const RenderSettings& settings : {kSmall, seed}) {
      const FurShot shot = CloseShot(Animal(), settings);
      const fur::Image frame = test::Draw(device, Animal(), settings, shot.camera, shot.placements);
      EXPECT_GT(test::Colors(frame), 100u) << "there is hardly anything to compare";
      bytes.insert(bytes.end(), frame.pixels.begin(), frame.pixels.end());
    }
    TheRecorder().ReadBack(PictureOfBytes(bytes));
    return bytes;
  }
  // Frames one below the other.
  static Image PictureOfBytes(const std::vector<uint8_t>& bytes) {
    return FromRgba8(kFurWidth, uint32_t(bytes.size() / 4 / kFurWidth), bytes);
  }
};

// Of the 100 frames, 20 have each of these.
std::vector<RenderSettings> OtherSettings(bool geometryShader) {
  std::vector<RenderSettings> all{
      {.width = 64, .height = 48, .samples = 4},
      {.width = 50, .height = 70, .semantics = Semantics::Sheet, .shellMode = ShellMode::Instanced},
      {.width = 64, .height = 48, .look = Look::Seed, .finMode = FinMode::Pulled},
      {.width = 33, .height = 9, .target = TargetFormat::Float32, .shells = 40, .shellMode = ShellMode::Draws}};
  if (geometryShader)
    all.push_back(
        {.width = 64, .height = 48, .technique = Technique::Seed, .look = Look::Seed, .preset = Preset::GsShells});
  else
    all.push_back({.width = 64, .height = 48, .drawFins = false});
  return all;
}

TEST_P(FurStateTest, AFrameIsTheSameAfter100Others) {
  const FurShot shot = CloseShot(Animal());
  Result<std::unique_ptr<Renderer>> renderer = MakeRenderer(device, Animal(), shot.settings);
  ASSERT_TRUE(renderer) << renderer.error().message;
  const auto frame = [&]() -> fur::Image {
    (*renderer)->Draw(shot.camera, shot.placements);
    const Result<fur::Image> image = (*renderer)->ReadImage();
    if (!image) throw std::runtime_error(image.error().message);
    TheRecorder().ReadBack(PictureOf(*image));
    return *image;
  };
  const fur::Image first = frame();
  EXPECT_GT(test::Colors(first), 100u);
  test::Coat rough = test::UniformCoat(8, 120, {150, 110, 230});
  rough.length = 0.4;
  const Model cube = test::Cube(rough);
  for (const RenderSettings& settings : OtherSettings(Caps().geometryShader)) {
    Result<std::unique_ptr<Renderer>> animals = MakeRenderer(device, Animal(), settings),
                                      cubes = MakeRenderer(device, cube, settings);
    ASSERT_TRUE(animals && cubes);
    Renderer* const others[] = {animals->get(), cubes->get(), cubes->get(), cubes->get(), renderer->get()};
    for (uint32_t i = 0; i < 20; ++i)
      others[i % 5]->Draw(TurnCamera(shot.camera, 18 * i), PlaceAnimals(1 + i / 4 % 3, 0.5));
  }
  EXPECT_TRUE(SameImage(PictureOf(frame()), PictureOf(first))) << "the same renderer";
  EXPECT_TRUE(SameImage(PictureOf(Draw(gpu, Animal(), shot)), PictureOf(first))) << "another renderer of the device";
}

// What the processes of the next case draw.
TEST_P(FurStateTest, FramesOfACache) { EXPECT_FALSE(FrameOfEachTechnique().empty()); }

// Two processes with a shader cache of their own: an empty one, and what the first left in it.
TEST_P(FurStateTest, AWarmCacheEqualsACold) {
  const CacheFolder cache;
  const ChildRun cold = RunInChild("fur.frames_of_a_cache", backend, cache);
  ASSERT_EQ(cold.problem, "");
  const size_t files = cache.Files();
  const bool mesa = TheRecorder().Driver().ends_with("pipe");  // lavapipe, llvmpipe: theirs are on the disk
  EXPECT_TRUE(files > 0 || !mesa) << "the first process left no cache";
  const ChildRun warm = RunInChild("fur.frames_of_a_cache", backend, cache);
  ASSERT_EQ(warm.problem, "");
  EXPECT_LE(cache.Files(), files + files / 4) << "the second process compiled again";  // llvmpipe adds up to 3 of 29
  EXPECT_TRUE(SameImage(PictureOfBytes(warm.bytes), PictureOfBytes(cold.bytes)));
  EXPECT_TRUE(SameImage(PictureOfBytes(FrameOfEachTechnique()), PictureOfBytes(cold.bytes))) << "this process";
}
RHI_ON_EVERY_BACKEND(FurStateTest);

// ------------------------------------------------------------------------------------------------- planted differences
class FurFaultTest : public BothTest {
 protected:
  // The texel of the base colour under the furred vertex that is nearest to the eye.
  static Model WithOneTexelChanged(const Model& original, const Camera& camera) {
    Model model = original;
    const Primitive& skin = model.primitives[model.parts[0].primitive];
    const auto distance = [&](const Vertex& v) {
      return glm::distance(glm::dvec3(PlaceAnimals(1, 1)[0] * model.parts[0].transform * glm::dvec4(v.position, 1)),
                           camera.eye);
    };
    const Vertex& nearest =
        *std::min_element(skin.vertices.begin(), skin.vertices.end(),
                          [&](const Vertex& a, const Vertex& b) { return distance(a) < distance(b); });
    fur::Image& texture = model.images[size_t(model.materials[skin.material].baseColorTexture.image)];
    const auto x = uint32_t(nearest.uv.x * float(texture.width)), y = uint32_t(nearest.uv.y * float(texture.height));
    uint8_t& red = texture.pixels[(size_t{y} * texture.width + x) * 4];
    red = red ? red - 1 : 1;
    return model;
  }
};

// On GL, and on Vulkan.
TEST_P(FurFaultTest, OneTexelByOneStepIsCaught) {
  const RenderSettings settings{.width = kFurWidth, .height = kFurHeight, .target = TargetFormat::Float32};
  const FurShot shot = CloseShot(Animal(), settings);
  const Model changed = WithOneTexelChanged(Animal(), shot.camera);
  const Image right = PictureOf(DrawFloats(vulkan, Animal(), shot));
  EXPECT_FALSE(SameImage(PictureOf(DrawFloats(gl, changed, shot)), right));
  EXPECT_FALSE(SameImage(PictureOf(DrawFloats(vulkan, changed, shot)), right));
}

TEST_P(FurFaultTest, OneShellFewerIsCaught) {
  FurShot shot = CloseShot(Animal());
  shot.settings.shells = 16;
  const Image right = PictureOf(Draw(vulkan, Animal(), shot));
  shot.settings.shells = 15;
  EXPECT_FALSE(SameImage(PictureOf(Draw(gl, Animal(), shot)), right));
  EXPECT_FALSE(SameImage(PictureOf(Draw(vulkan, Animal(), shot)), right));
}
RHI_ON_BOTH(FurFaultTest);

}  // namespace
}  // namespace conformance

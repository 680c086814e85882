// The published systems: each one's shells against closed forms, its textures and its limits. docs/presets.md states
// what is computed here.
#include "presets.h"

#include <algorithm>
#include <cmath>
#include <ostream>

#include "emitted.h"
#include "fur/builtin.h"
#include "fur/fur_mesh.h"
#include "models.h"
#include "oracle.h"
#include "preset_textures.h"
#include "support.h"

namespace fur::test {
namespace {

using glm::dvec3;

class Presets : public OnEachBackend {};
INSTANTIATE_TEST_SUITE_P(Backends, Presets, testing::ValuesIn(Backends()), BackendName);

constexpr Preset kAll[] = {Preset::DemoFur, Preset::NvidiaD3d10, Preset::GsShells, Preset::FourCoats};
constexpr double kDrift = 2;  // of 255: rounding the target at each shell, and a filter's eight bits

const Light kSide{.direction = {0.7, -0.4, -0.5}, .diffuse = dvec3(0.6), .ambient = dvec3(0.3), .specular = dvec3(0.2)};

RenderSettings Settings(Preset preset, uint32_t shells = 0) {
  return {.width = 33,
          .height = 25,
          .technique = Technique::Seed,
          .look = Look::Seed,
          .preset = preset,
          .shells = shells,
          .drawFins = false,
          .light = kSide};
}

const Model& Animal() {
  static const Model animal = MakeBuiltinAnimal();
  return animal;
}
Camera AnimalCamera() { return FrameBounds(ComputeBounds(Animal()), PlaceAnimals(1, 1), 40, 160 / 120.0); }
RenderSettings AnimalSettings(Preset preset) {
  RenderSettings s = Settings(preset);
  s.width = 160;
  s.height = 120;
  s.drawFins = true;
  s.light = PresetLight(preset);
  return s;
}

// ---------------------------------------------------------------------------------------------------------- oracles
dvec3 Raw(const Texel& t) { return dvec3(t[0], t[1], t[2]) / 255.0; }
dvec3 Over(const dvec3& under, const dvec3& color, double alpha) {
  return glm::mix(under, glm::clamp(color, 0.0, 1.0), alpha);
}
dvec3 Lambert(const dvec3& albedo) {  // of the square, whose normal is +Z
  return albedo * (kSide.ambient + kSide.diffuse * std::max(0.0, -glm::normalize(kSide.direction).z));
}

// ka, kd, ks in the light's colours, power 20, ramp from .8: (T.L)(T.E) + sin sin = cos(a - b), L and E on one side.
dvec3 NvidiaColor(const Texel& color, const Texel& strand, const dvec3& ray, double height) {
  const dvec3 t = glm::normalize(Raw(strand) * 2.0 - 1.0);
  const double toLight = std::acos(glm::dot(t, -glm::normalize(kSide.direction))), toEye = std::acos(glm::dot(t, -ray));
  const double lobe = std::pow(std::max(0.0, std::cos(toLight - toEye)), 20);
  const dvec3 lit = Raw(color) * (kSide.ambient + kSide.diffuse * std::sin(toLight)) + kSide.specular * lobe;
  return lit * (0.8 + 0.2 * height);
}

TEST_P(Presets, NvidiaShellsAreKajiyaKayOverTheSkin) {
  SquareScene scene{.look = Look::Seed, .light = kSide, .color = {180, 120, 60, 255}};
  for (uint8_t i = 0; i < 5; ++i)
    scene.coat.slices.push_back({uint8_t(128 + 25 * i), uint8_t(150 - 20 * i), 220, uint8_t(90 + 11 * i)});
  scene.coat.slices[2][3] = 2;  // below 0.01: not there
  for (const double yaw : {0.0, 50.0}) {
    const Camera camera = CameraAt(3, yaw, 0);
    const Frame frame =
        Render(*device_, FurredSquare(40, scene.color, scene.coat), Settings(Preset::NvidiaD3d10, 5), camera);
    const dvec3 ray = RayThrough(camera, 33, 25, 16, 12);
    dvec3 expected = SkinColor(scene, ray);
    for (size_t i = 0; i < 4; ++i) {  // the top slice is emptied
      const Texel& slice = scene.coat.slices[i];
      if (slice[3] > 2)
        expected = Over(expected, NvidiaColor(scene.color, slice, ray, double(i) / 5), slice[3] / 255.0);
    }
    ExpectColor(Center(frame.image), expected, kDrift, "yaw " + std::to_string(yaw));
  }
}

// An even coat's opacity map is 1: shell k of N has opacity 1 - k/N.
TEST_P(Presets, GsShellsAreLambertThinningOut) {
  const Texel color{180, 120, 60, 255};
  const Frame frame =
      Render(*device_, FurredSquare(40, color, UniformCoat(4, 128)), Settings(Preset::GsShells, 4), CameraAt(3, 20, 0));
  dvec3 expected = Lambert(Raw(color)) * 0.45;
  for (int k = 1; k <= 4; ++k)
    expected = Over(expected, Lambert(Raw(color)) * (0.4 + 0.6 * (0.75 + 0.25 * k / 4)), 1 - k / 4.0);
  ExpectColor(Center(frame.image), expected, kDrift, "gs-shells");
}

TEST_P(Presets, FourCoatsAreLambertInTheCoatsColour) {
  Coat coat = UniformCoat(5, 100);
  const Model model = FurredSquare(40, {1, 2, 3, 255}, coat);
  for (const FourCoat kind : {FourCoat::Bear, FourCoat::Panther, FourCoat::Snow, FourCoat::Tiger}) {
    RenderSettings settings = Settings(Preset::FourCoats, 5);
    settings.fourCoat = kind;
    const Frame frame = Render(*device_, model, settings, CameraAt(3, 0, 0));
    const dvec3 albedo(SampleBilinear(PaintCoat(model, 0, kind), {0.5, 0.5}, true, true));
    dvec3 expected = Lambert(albedo) * 0.5;
    for (int layer = 0; layer < 4; ++layer)
      expected = Over(expected, Lambert(albedo) * (0.5 + 0.5 * (0.75 + 0.25 * layer / 5)), 100 / 255.0);
    ExpectColor(Center(frame.image), expected, kDrift, "coat " + std::to_string(int(kind)));
  }
}

// ----------------------------------------------------------------------------------------- where nvidia's shells stand
RenderSettings OneShell() {  // a single opaque one, far out
  RenderSettings s = Settings(Preset::NvidiaD3d10, 1);
  s.width = s.height = 256;
  s.spacing = 1;
  return s;
}

int LastLitColumn(const Image& image, int from, int step) {
  int last = -1;
  for (int x = from; x >= 0 && x < int(image.width); x += step)
    if (PixelAt(image, uint32_t(x), image.height / 2) != Rgb{0, 0, 0}) last = x;
  return last;
}
double Column(const dvec3& p, const Camera& camera, uint32_t width) {
  const glm::dvec4 clip = ProjectionMatrix(camera, 1) * ViewMatrix(camera) * glm::dvec4(p, 1);
  return (clip.x / clip.w + 1) / 2 * width - 0.5;
}

// p + (n + s comb) d k max(a, 0.2).
TEST_P(Presets, NvidiaLengthIsTheAlphaWithAFloor) {
  const Camera camera = CameraAt(2, 0, 0);
  for (const auto& [alpha, height] : {std::pair{255, 1.0}, {128, 128 / 255.0}, {26, 0.2}, {5, 0.2}}) {
    if (height > 0.6) continue;  // would fill the picture
    const Model model = FurredSquare(0.5, {255, 255, 255, uint8_t(alpha)}, UniformCoat(2, 255));
    const Frame frame = Render(*device_, model, OneShell(), camera);
    EXPECT_NEAR(LastLitColumn(frame.image, 128, 1), Column({0.5, 0, height}, camera, 256), 1) << "alpha " << alpha;
  }
}

TEST_P(Presets, NvidiaCombMovesTheShells) {
  const Camera camera = CameraAt(5, 0, 0);
  const Model model = FurredSquare(0.5, {255, 255, 255, 255}, UniformCoat(2, 255));
  for (const double strength : {-0.6, 0.0, 0.3, 0.6}) {
    RenderSettings settings = OneShell();
    settings.comb = {strength, 0, 0};
    const Image image = Render(*device_, model, settings, camera).image;
    // The skin is there too, so the far edge is the shell's on the side it is combed to.
    const double right = std::max(Column({0.5 + strength, 0, 1}, camera, 256), Column({0.5, 0, 0}, camera, 256));
    const double left = std::min(Column({-0.5 + strength, 0, 1}, camera, 256), Column({-0.5, 0, 0}, camera, 256));
    EXPECT_NEAR(LastLitColumn(image, 128, 1), right, 1) << "strength " << strength;
    EXPECT_NEAR(LastLitColumn(image, 128, -1), left, 1) << "strength " << strength;
  }
}

TEST_P(Presets, NvidiaAlphaZeroIsNoFur) {
  RenderSettings settings = Settings(Preset::NvidiaD3d10);
  const Coat coat = UniformCoat(16, 200);
  const auto picture = [&](uint8_t alpha) {
    return Render(*device_, FurredSquare(40, {200, 150, 100, alpha}, coat), settings, CameraAt(3, 20, 0)).image;
  };
  const Image bald = picture(0), furred = picture(255);
  settings.drawShells = false;
  EXPECT_EQ(DifferingPixels(bald, picture(0)), 0u);
  EXPECT_GT(DifferingPixels(furred, bald), 500u);
}

// The length map becomes that alpha, whatever the colour's own.
TEST_P(Presets, NvidiaTakesTheLengthMapAsAlpha) {
  Model model = FurredSquare(40, {200, 150, 100, 255}, UniformCoat(16, 200));
  model.images.push_back(Plain("length", {0, 9, 9, 255}));
  model.materials[0].fur->lengthMap = 1;
  RenderSettings settings = Settings(Preset::NvidiaD3d10);
  const Image shells = Render(*device_, model, settings, CameraAt(3, 20, 0)).image;
  settings.drawShells = false;
  EXPECT_EQ(DifferingPixels(shells, Render(*device_, model, settings, CameraAt(3, 20, 0)).image), 0u);
}

TEST_P(Presets, NvidiaSpacingIsAThousandthOfTheDiameter) {
  Model model = FurredSquare(0.5, {200, 150, 100, 255}, UniformCoat(16, 200));
  const auto picture = [&](double spacing) {
    RenderSettings settings = Settings(Preset::NvidiaD3d10, 300);
    settings.width = settings.height = 128;
    settings.spacing = spacing;
    return Render(*device_, model, settings, CameraAt(2, 30, 20)).image;
  };
  const Image automatic = picture(0), stated = picture(std::sqrt(2.0) / 1000), twice = picture(std::sqrt(2.0) / 500);
  EXPECT_EQ(DifferingPixels(automatic, stated), 0u);
  EXPECT_GT(DifferingPixels(automatic, twice), 500u);
  model.primitives[0] = Square(0.25);  // the same body, placed by a transform
  model.parts[0].transform = glm::dmat4(2);
  model.parts[0].transform[3][3] = 1;
  EXPECT_LT(DifferingPixels(automatic, picture(0)), 50u) << "spacing is in the part's own units, but for rounding";
}

// ----------------------------------------------------------------------------------------------------- furless spots
TEST_P(Presets, GsShellsFurlessSpotsShowTheirOwnTexture) {
  const Texel color{40, 120, 200, 255};
  Model model = FurredSquare(1, color, UniformCoat(4, 128));
  Image lengths = Plain("length", {255, 255, 255, 255});
  for (size_t i = 0; i < 16; ++i)
    if (i % 4 < 2) lengths.pixels[i * 4] = 0;  // the left half is bare
  model.images.push_back(lengths);
  model.materials[0].fur->lengthMap = 1;
  const Camera camera = CameraAt(3, 0, 0);
  RenderSettings settings = Settings(Preset::GsShells);
  const Image image = Render(*device_, model, settings, camera).image;
  const dvec3 flesh = glm::mix(Raw(color), dvec3(0.86, 0.62, 0.55), 0.6);
  ExpectColor(PixelAt(image, 12, 12), Lambert(flesh), kDrift, "bare, in the open");
  settings.drawShells = false;
  const Image skin = Render(*device_, model, settings, camera).image;
  EXPECT_EQ(PixelAt(image, 12, 12), PixelAt(skin, 12, 12)) << "no shell on a spot";
  ExpectColor(PixelAt(skin, 21, 12), Lambert(Raw(color)) * 0.45, kDrift, "in the fur's shadow");
  EXPECT_NE(PixelAt(image, 21, 12), PixelAt(skin, 21, 12)) << "fur beside it";
}

// ---------------------------------------------------------------------------------------------------------- four coats
struct Mean {
  dvec3 color{0};
  double darkest = 1, brightest = 0;
};
Mean MeanOf(const Image& image) {
  Mean mean;
  for (size_t i = 0; i < image.pixels.size(); i += 4) {
    const dvec3 c(image.pixels[i], image.pixels[i + 1], image.pixels[i + 2]);
    mean.color += c / 255.0 / (double(image.pixels.size()) / 4);
    mean.darkest = std::min(mean.darkest, c.r / 255);
    mean.brightest = std::max(mean.brightest, c.r / 255);
  }
  return mean;
}

TEST(FourCoatsColors, AreThoseOfTheAnimals) {
  const auto mean = [](FourCoat coat) { return MeanOf(PaintCoat(Animal(), 0, coat)); };
  const Mean bear = mean(FourCoat::Bear), panther = mean(FourCoat::Panther), snow = mean(FourCoat::Snow),
             tiger = mean(FourCoat::Tiger);
  EXPECT_GT(bear.color.r, 1.2 * bear.color.g);
  EXPECT_GT(bear.color.g, 1.2 * bear.color.b) << "brown";
  EXPECT_LT(panther.brightest, 0.2) << "black";
  EXPECT_NEAR(snow.color.r, snow.color.b, 0.06) << "without a hue";
  EXPECT_GT(snow.color.g, 0.6);
  EXPECT_LT(snow.darkest, 0.6) << "with grey";
  EXPECT_GT(tiger.color.r, 2 * tiger.color.b) << "orange";
  EXPECT_LT(tiger.darkest, 0.1) << "with stripes";
  EXPECT_EQ(PaintCoat(Animal(), 0, FourCoat::Tiger).pixels, PaintCoat(Animal(), 0, FourCoat::Tiger).pixels);
}

TEST_P(Presets, FourCoatsAreFourPictures) {
  std::vector<Image> images;
  for (const FourCoat coat : {FourCoat::Bear, FourCoat::Panther, FourCoat::Snow, FourCoat::Tiger}) {
    RenderSettings settings = AnimalSettings(Preset::FourCoats);
    settings.fourCoat = coat;
    images.push_back(Render(*device_, Animal(), settings, AnimalCamera(), PlaceAnimals(1, 1)).image);
    for (size_t i = 0; i + 1 < images.size(); ++i) EXPECT_GT(DifferingPixels(images[i], images.back()), 2000u);
  }
}

// ------------------------------------------------------------------------------------------------- draws and limits
TEST_P(Presets, DrawsAsPublished) {
  const Model model = FurredSquare(1, {200, 150, 100, 255}, UniformCoat(16, 128));
  const auto draws = [&](Preset preset) {
    return Render(*device_, model, Settings(preset), CameraAt(3, 0, 0)).counts.draws;
  };
  EXPECT_EQ(draws(Preset::DemoFur), 2u) << "skin, and instances";
  EXPECT_EQ(draws(Preset::NvidiaD3d10), 1u + 16) << "skin, and a draw for each shell";
  EXPECT_EQ(draws(Preset::GsShells), 2u) << "skin, and a geometry shader";
  EXPECT_EQ(draws(Preset::FourCoats), 2u);
}

TEST_P(Presets, GeometryShadersMakeEveryShell) {
  if (!(*device_)->GetCaps().pipelineStatistics) GTEST_SKIP() << GetParam().name << " has no pipeline statistics";
  const Model model = FurredSquare(1, {200, 150, 100, 255}, UniformCoat(16, 128));
  const auto emitted = [&](Preset preset, uint32_t shells) {
    return EmittedTriangles(*device_, model, Settings(preset, shells), CameraAt(3, 0, 0), glm::dmat4(1));
  };
  EXPECT_EQ(emitted(Preset::GsShells, 0), 2u * 28);
  EXPECT_EQ(emitted(Preset::GsShells, 5), 2u * 5);
  EXPECT_EQ(emitted(Preset::FourCoats, 0), 2u * 30);
  EXPECT_EQ(emitted(Preset::FourCoats, 34), 2u * 34) << "1,020 scalars";
}

void ExpectUsage(rhi::IDevice& device, const RenderSettings& settings, std::vector<std::string> words) {
  const Result<std::unique_ptr<Renderer>> made = MakeRenderer(device, Animal(), settings);
  ASSERT_FALSE(made);
  EXPECT_EQ(made.error().code, ErrorCode::Usage);
  for (const std::string& word : words)
    EXPECT_NE(made.error().message.find(word), std::string::npos) << word << " is not in: " << made.error().message;
}

TEST_P(Presets, MoreShellsThanAGeometryShaderCanMakeAreRefused) {
  ExpectUsage(**device_, Settings(Preset::GsShells, 29), {"87 vertices", "12 scalars", "1044", "1024", "28 shells"});
  ExpectUsage(**device_, Settings(Preset::FourCoats, 35), {"105 vertices", "1050", "1024", "34 shells"});
  ExpectUsage(**device_, Settings(Preset::FourCoats, 40), {"120 vertices", "10 scalars", "1200", "1024"});
  EXPECT_TRUE(MakeRenderer(**device_, Animal(), Settings(Preset::NvidiaD3d10, 100))) << "draws have no such limit";
}

TEST(PresetLimits, TheDevicesOwnCapsCount) {
  rhi::Caps caps;
  caps.geometryShader = true;
  caps.maxGSOutputComponents = 1024;
  caps.maxGSOutputVertices = 64;
  const Result<Done> few = CheckPreset(caps, Settings(Preset::GsShells));
  ASSERT_FALSE(few);
  EXPECT_NE(few.error().message.find("64 vertices"), std::string::npos) << few.error().message;
  EXPECT_TRUE(CheckPreset(caps, Settings(Preset::GsShells, 21)));
  caps.maxGSOutputVertices = 1024;
  caps.maxGSOutputComponents = 512;
  EXPECT_FALSE(CheckPreset(caps, Settings(Preset::FourCoats, 18)));
  EXPECT_TRUE(CheckPreset(caps, Settings(Preset::FourCoats, 17)));
  caps.geometryShader = false;
  const Result<Done> none = CheckPreset(caps, Settings(Preset::FourCoats, 1));
  ASSERT_FALSE(none);
  EXPECT_EQ(none.error().code, ErrorCode::NoDevice);
}

TEST_P(Presets, OwnLookAndTechniqueOnly) {
  for (const Preset preset : kAll) {
    if (preset == Preset::DemoFur) continue;
    RenderSettings settings = Settings(preset);
    settings.look = Look::Correct;
    ExpectUsage(**device_, settings, {TraitsOf(preset).name, "look seed"});
    settings = Settings(preset);
    settings.technique = Technique::Shells;
    ExpectUsage(**device_, settings, {TraitsOf(preset).name, "technique seed"});
  }
  RenderSettings demo = Settings(Preset::DemoFur);
  demo.look = Look::Correct;
  EXPECT_TRUE(MakeRenderer(**device_, Animal(), demo));
}

}  // namespace
}  // namespace fur::test

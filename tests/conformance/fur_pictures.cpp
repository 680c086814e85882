// Every technique, preset, coat and model, Vulkan against GL.
#include "../fur_render/frames.h"
#include "fur/coat_file.h"
#include "fur/gltf.h"
#include "fur_scenes.h"

namespace conformance {
namespace {

using namespace fur;
using rhi_test::BothTest;
using rhi_test::BothTestOf;

constexpr RenderSettings kSmall{.width = kFurWidth, .height = kFurHeight};

// -------------------------------------------------------------------------------------------------------- techniques
struct Variant {
  Technique technique;
  Look look;
  Semantics semantics;
  uint32_t samples;
};
std::vector<Variant> Variants() {
  std::vector<Variant> all;
  for (const Technique technique : {Technique::Seed, Technique::Shells})
    for (const Look look : {Look::Seed, Look::Correct})
      for (const Semantics semantics : {Semantics::Sheet, Semantics::Volume})
        for (const uint32_t samples : {1u, 4u}) all.push_back({technique, look, semantics, samples});
  return all;
}
std::string NameOfVariant(const Variant& v) {
  return std::string(v.technique == Technique::Seed ? "seed_" : "shells_") +
         (v.look == Look::Seed ? "seed" : "correct") + (v.semantics == Semantics::Sheet ? "_sheet_" : "_volume_") +
         std::to_string(v.samples);
}
RenderSettings SettingsOf(const Variant& v) {
  RenderSettings s = kSmall;
  s.technique = v.technique;
  s.look = v.look;
  s.semantics = v.semantics;
  s.samples = v.samples;
  return s;
}
void PrintTo(const Variant& v, std::ostream* out) { *out << NameOfVariant(v); }

using FurTechniqueTest = BothTestOf<Variant>;
TEST_P(FurTechniqueTest, Technique) {
  ExpectAlikeAndCounted(vulkan, gl, Animal(), CloseShot(Animal(), SettingsOf(Parameter())));
}
RHI_MATRIX_ON_BOTH(FurTechniqueTest, Variants(), NameOfVariant);

// ----------------------------------------------------------------------------------------------------------- presets
struct Published {
  const char* name;
  Preset preset;
  FourCoat coat = FourCoat::Bear;
};
constexpr Published kPublished[] = {{"demo_fur", Preset::DemoFur},
                                    {"nvidia_d3d10", Preset::NvidiaD3d10},
                                    {"gs_shells", Preset::GsShells},
                                    {"four_coats_bear", Preset::FourCoats, FourCoat::Bear},
                                    {"four_coats_panther", Preset::FourCoats, FourCoat::Panther},
                                    {"four_coats_snow", Preset::FourCoats, FourCoat::Snow},
                                    {"four_coats_tiger", Preset::FourCoats, FourCoat::Tiger}};
void PrintTo(const Published& p, std::ostream* out) { *out << p.name; }
RenderSettings SettingsOf(const Published& p, uint32_t samples) {
  RenderSettings s = kSmall;
  s.technique = Technique::Seed;
  s.look = Look::Seed;
  s.preset = p.preset;
  s.fourCoat = p.coat;
  s.samples = samples;
  s.light = PresetLight(p.preset);
  return s;
}

using FurPresetTest = BothTestOf<Published>;
TEST_P(FurPresetTest, Preset) {
  RenderSettings settings = SettingsOf(Parameter(), 1);
  settings.comb = {0.2, -0.3, 0.1};
  ExpectAlikeAndCounted(vulkan, gl, Animal(), CloseShot(Animal(), settings));
}
TEST_P(FurPresetTest, PresetWithFourSamples) {
  ExpectAlike(vulkan, gl, Animal(), CloseShot(Animal(), SettingsOf(Parameter(), 4)));
}
// A coat that thins out in sixteenths: many opacities lie half way between two of a target's eight bits.
TEST_P(FurPresetTest, PresetBetweenTwoSteps) {
  Model model = Animal();
  model.materials[0].fur->params.heightFalloff = 1;
  RenderSettings settings = SettingsOf(Parameter(), 1);
  settings.shells = 8;
  ExpectAlike(vulkan, gl, model, CloseShot(model, settings));
}
RHI_MATRIX_ON_BOTH(FurPresetTest, kPublished, [](const Published& p) { return p.name; });

// ------------------------------------------------------------------------------------------------------------- coats
Model AnimalWearing(const std::string& name) {
  const Result<fur::Coat> coat = LoadCoat(name);
  if (!coat) throw std::runtime_error(coat.error().message);
  Model model = Animal();
  const Result<Done> groomed = GroomModel({.coat = &*coat}, &model);
  if (!groomed) throw std::runtime_error(groomed.error().message);
  return model;
}
std::vector<std::string> CoatNames() {
  std::vector<std::string> names;
  for (const EmbeddedCoat& coat : EmbeddedCoats()) names.emplace_back(coat.name);
  return names;
}

using FurCoatTest = BothTestOf<std::string>;
// And each is a picture of its own.
TEST_P(FurCoatTest, Coat) {
  static std::vector<fur::Image> before;
  const Model model = AnimalWearing(Parameter());
  fur::Image worn;
  ExpectAlike(vulkan, gl, model, CloseShot(model), &worn);
  for (const fur::Image& other : before) EXPECT_GT(test::DifferingPixels(worn, other), 2000u);
  before.push_back(worn);
}
RHI_MATRIX_ON_BOTH(FurCoatTest, CoatNames(), CaseWord);

// ------------------------------------------------------------------------------------------------------------ models
struct Asset {
  const char* name;
  const char* file;
};
constexpr Asset kAssets[] = {{"cat", "cat/cat.gltf"},
                             {"fox", "fox/fox.glb"},
                             {"husky", "husky/husky.glb"},
                             {"spot", "spot/spot.glb"},
                             {"plushy", "plushy_toy/plushy_toy.gltf"},
                             {"suzanne", "suzanne/suzanne.glb"},
                             {"torus", "torus/torus.gltf"}};
void PrintTo(const Asset& a, std::ostream* out) { *out << a.name; }

class FurModelTest : public BothTestOf<Asset> {
 protected:
  void SetUp() override {
    model_ = AssetModel(Parameter().file);
    if (!model_) GTEST_SKIP() << "no assets: " << Parameter().file;
  }
  const Model* model_ = nullptr;
};
TEST_P(FurModelTest, Model) { ExpectAlike(vulkan, gl, *model_, CloseShot(*model_)); }
TEST_P(FurModelTest, ModelAsPublished) {
  const RenderSettings settings = SettingsOf({Technique::Seed, Look::Seed, Semantics::Sheet, 4});
  ExpectAlike(vulkan, gl, *model_, CloseShot(*model_, settings));
}
RHI_MATRIX_ON_BOTH(FurModelTest, kAssets, [](const Asset& a) { return a.name; });

// ------------------------------------------------------------------------------------------------------------- groom
struct Groom {
  const char* name;
  void (*apply)(FurParams*);
};
constexpr Groom kGrooms[] = {
    {"clumped", [](FurParams* p) { p->clumping = 0.8; }},
    {"wet", [](FurParams* p) { p->wetness = 0.7; }},
    {"wind",
     [](FurParams* p) {
       p->windStrength = 0.9, p->wind = {1, 0, 0.4};
     }},
    {"combed",
     [](FurParams* p) {
       p->comb = {0.3, -1, 0.2}, p->combStrength = 0.6, p->gravity = 0.6;
     }},
    {"colored",
     [](FurParams* p) {
       p->rootColor = {0.4, 0.3, 0.2}, p->tipColor = {1.3, 1.1, 1}, p->colorFromBase = 0.7, p->thickness = 1.4;
     }},
};
void PrintTo(const Groom& g, std::ostream* out) { *out << g.name; }

Model AnimalWith(const std::vector<Groom>& grooms) {
  Model model = Animal();
  for (const Groom& groom : grooms) groom.apply(&model.materials[0].fur->params);
  return model;
}

using FurGroomTest = BothTestOf<Groom>;
TEST_P(FurGroomTest, Groom) {
  const Model model = AnimalWith({Parameter()});
  RenderSettings settings = kSmall;
  settings.time = 2.7;
  ExpectAlike(vulkan, gl, model, CloseShot(model, settings));
}
RHI_MATRIX_ON_BOTH(FurGroomTest, kGrooms, [](const Groom& g) { return g.name; });

// ------------------------------------------------------------------------------------------------------------- modes
// Each way of the shells beside each way of the fins, and each number of shells beside both.
struct Modes {
  const char* name;
  ShellMode shells;
  FinMode fins;
  uint32_t count;
};
constexpr Modes kModes[] = {{"sorted_geometry_5", ShellMode::Sorted, FinMode::Geometry, 5},
                            {"sorted_pulled_17", ShellMode::Sorted, FinMode::Pulled, 17},
                            {"sorted_compacted_40", ShellMode::Sorted, FinMode::Compacted, 40},
                            {"instanced_geometry_17", ShellMode::Instanced, FinMode::Geometry, 17},
                            {"instanced_pulled_40", ShellMode::Instanced, FinMode::Pulled, 40},
                            {"instanced_compacted_5", ShellMode::Instanced, FinMode::Compacted, 5},
                            {"draws_geometry_40", ShellMode::Draws, FinMode::Geometry, 40},
                            {"draws_pulled_5", ShellMode::Draws, FinMode::Pulled, 5},
                            {"draws_compacted_17", ShellMode::Draws, FinMode::Compacted, 17},
                            {"amplified_geometry_40", ShellMode::Amplified, FinMode::Geometry, 40},
                            {"amplified_pulled_17", ShellMode::Amplified, FinMode::Pulled, 17},
                            {"amplified_compacted_5", ShellMode::Amplified, FinMode::Compacted, 5}};
void PrintTo(const Modes& m, std::ostream* out) { *out << m.name; }

class FurWayTest : public BothTestOf<Modes> {
 protected:
  static RenderSettings Settings(const Modes& m) {
    RenderSettings s = kSmall;
    s.shellMode = m.shells;
    s.finMode = m.fins;
    s.shells = m.count;
    return s;
  }
};
TEST_P(FurWayTest, Mode) {
  RenderSettings settings = Settings(Parameter());
  settings.comb = {0.2, -0.5, 0.7};
  ExpectAlikeAndCounted(vulkan, gl, Animal(), CloseShot(Animal(), settings));
}
RHI_MATRIX_ON_BOTH(FurWayTest, kModes, [](const Modes& m) { return m.name; });

class FurWholeGroomTest : public FurWayTest {};
TEST_P(FurWholeGroomTest, WholeGroom) {
  const Model model = AnimalWith({std::begin(kGrooms), std::end(kGrooms)});
  RenderSettings settings = Settings(Parameter());
  settings.time = 2.7;
  if (settings.shells == 17) settings.look = Look::Seed;
  ExpectAlike(vulkan, gl, model, CloseShot(model, settings));
}
const Modes kWholeGroomModes[] = {kModes[1], kModes[5], kModes[8], kModes[9]};
RHI_MATRIX_ON_BOTH(FurWholeGroomTest, kWholeGroomModes, [](const Modes& m) { return m.name; });

// ----------------------------------------------------------------------------------------------------------- the rest
using FurSceneTest = BothTest;

TEST_P(FurSceneTest, FloatTextures) {
  RenderSettings settings = kSmall;
  settings.floatTextures = true;
  ExpectAlike(vulkan, gl, Animal(), CloseShot(Animal(), settings));
}

// Overlapping animals, some cut by the picture's edge, on the published camera.
TEST_P(FurSceneTest, FiveAnimals) {
  FurShot shot{.placements = PlaceAnimals(5, 0.25)};
  shot.settings.background = {0.1, 0.2, 0.3};
  ExpectAlike(vulkan, gl, Animal(), shot);
}

TEST_P(FurSceneTest, FiveAnimalsWithInertia) {
  FurShot shot{.camera = {.eye = {-2, 1.2, -3}}, .placements = PlaceAnimals(5, 0.25)};
  shot.offsets = {{0.9, 0, 0}, {0, 0, 0}, {0, 0, -0.9}, {0, 0.5, 0.5}, {-0.3, -0.3, 0.3}};
  fur::Image moved;
  ExpectAlike(vulkan, gl, Animal(), shot, &moved);
  shot.offsets.clear();
  EXPECT_GT(test::DifferingPixels(moved, Draw(vulkan, Animal(), shot)), 300u) << "inertia hardly shows";
}

// Slices that fall between shells must round alike.
TEST_P(FurSceneTest, MoreShellsThanSlices) {
  RenderSettings settings = SettingsOf({Technique::Seed, Look::Seed, Semantics::Sheet, 1});
  settings.shells = 32;
  ExpectAlike(vulkan, gl, Animal(), CloseShot(Animal(), settings));
}

// Eyes with four samples: another target, read sample by sample.
TEST_P(FurSceneTest, BareSkinWithFourSamples) {
  RenderSettings settings = kSmall;
  FurShot shot{.settings = settings, .camera = {.eye = {-2, 1.2, -3}}, .placements = PlaceAnimals(5, 0.25)};
  const fur::Image rough = Draw(vulkan, Animal(), shot);
  shot.settings.skinSamples = 4;
  fur::Image smooth;
  ExpectAlike(vulkan, gl, Animal(), shot, &smooth);
  EXPECT_GT(test::DifferingPixels(rough, smooth), 5u) << "no edge of bare skin in the picture";
  ExpectAlike(vulkan, gl, Animal(), CloseShot(Animal(), shot.settings));
}

// The frame before it is brought to 8 bits, as floats, and the means of 2 x 2 of its pixels.
TEST_P(FurSceneTest, SupersampledFloats) {
  RenderSettings settings{.width = 2 * kFurWidth, .height = 2 * kFurHeight, .target = TargetFormat::Float32};
  const FurShot shot = CloseShot(Animal(), settings);
  const FloatImage a = DrawFloats(vulkan, Animal(), shot), b = DrawFloats(gl, Animal(), shot);
  EXPECT_TRUE(test::AllFinite(a));
  EXPECT_TRUE(SameImage(PictureOf(b), PictureOf(a)));
  const FloatImage means = Reduced(a, 2);
  EXPECT_TRUE(SameImage(PictureOf(Reduced(b, 2)), PictureOf(means)));
  EXPECT_GT(test::Colors({"", means.width, means.height, ToBytes(means)}), 100u);
}
RHI_ON_BOTH(FurSceneTest);

}  // namespace
}  // namespace conformance

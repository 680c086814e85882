// The scenes and the configurations of fur bench.
#include <functional>
#include <sstream>

#include "fur/bench.h"

namespace fur {
namespace {

constexpr double kNear = 0.4;         // of the framing distance
constexpr double kNearInField = 0.6;  // nearer, and the eye would be among the animals
constexpr uint32_t kAngles = 4;
constexpr std::array<double, 4> kMiddle{0.25, 0.25, 0.5, 0.5};
constexpr std::array<double, 4> kStrip{0.4, 0, 0.4, 1};  // has the outline above and below

struct Subject {
  const char *name, *file;
  uint32_t animals;
  bool quick;
};
constexpr Subject kSubjects[] = {{"builtin", "", 1, true},
                                 {"cat", "cat/cat.gltf", 1, true},
                                 {"cat-25", "cat/cat.gltf", 25, false},
                                 {"cat-100", "cat/cat.gltf", 100, false},
                                 {"fox", "fox/fox.glb", 1, false},
                                 {"spot", "spot/spot.glb", 1, false},
                                 {"plushy", "plushy_toy/plushy_toy.gltf", 1, false}};

BenchScene MakeScene(const Subject& s, bool close, bool turns) {
  BenchScene scene{s.name + std::string(close ? "-near" : "-far") + (turns ? "-turntable" : ""), s.file, s.animals};
  if (close) scene.distance = s.animals > 1 ? kNearInField : kNear;
  if (turns) scene.angles = kAngles;
  // References of whole pictures full of fur, or of several of them, would take hours.
  if (close || turns) scene.crop = kStrip;
  if (s.animals > 1) scene.crop = kMiddle;
  scene.quick = s.quick && !turns;
  return scene;
}

RenderSettings Published() {
  RenderSettings s;
  s.technique = Technique::Seed;
  s.look = Look::Seed;
  s.semantics = Semantics::Sheet;
  return s;
}

// Without fins, which are opacity that sheets do not have (docs/shells.md).
RenderSettings SeedLook(uint32_t shells) {
  RenderSettings s = Published();
  s.technique = Technique::Shells;
  s.shells = shells;
  s.drawFins = false;
  return s;
}

BenchConfig BareFour(uint32_t shells, bool quick) {
  BenchConfig config{"seedlook-" + std::to_string(shells) + "-bare4",
                     std::to_string(shells) + " shells in the seed's look, bare skin with 4 samples", SeedLook(shells), quick};
  config.settings.skinSamples = 4;
  return config;
}

RenderSettings Shells(uint32_t count) {
  RenderSettings s;
  s.shells = count;
  return s;
}

// The default with one thing changed.
BenchConfig Changed(const std::string& what, const std::string& note,
                    const std::function<void(RenderSettings*)>& change, bool quick = false) {
  BenchConfig config{"shells-" + what, note, RenderSettings{}, quick};
  change(&config.settings);
  return config;
}

}  // namespace

std::vector<BenchScene> BenchScenes() {
  std::vector<BenchScene> scenes;
  for (const bool turns : {false, true})
    for (const bool close : {false, true})
      for (const Subject& s : kSubjects) scenes.push_back(MakeScene(s, close, turns));
  return scenes;
}

std::vector<BenchConfig> BenchConfigs() {
  std::vector<BenchConfig> configs{{"seed", "as published: the baseline", Published(), true}};
  for (const uint32_t n : {8u, 16u, 32u})
    configs.push_back(
        {"seedlook-" + std::to_string(n), std::to_string(n) + " shells in the seed's look", SeedLook(n), n < 32});
  for (const uint32_t n : {8u, 9u}) configs.push_back(BareFour(n, n == 8));
  configs.push_back({"shells", "the default: as many shells as the coat says", RenderSettings{}, true, true});
  for (const uint32_t n : {4u, 8u, 32u, 64u})
    configs.push_back({"shells-" + std::to_string(n), std::to_string(n) + " shells", Shells(n), n <= 32});
  configs.push_back(Changed(
      "no-fins", "without fins", [](RenderSettings* s) { s->drawFins = false; }, true));
  configs.push_back(Changed("no-back", "without back faces", [](RenderSettings* s) { s->backFaces = false; }));
  configs.push_back(Changed("no-sort", "animals unsorted", [](RenderSettings* s) { s->sortAnimals = false; }));
  configs.push_back(
      Changed("fins-gs", "fins by a geometry shader", [](RenderSettings* s) { s->finMode = FinMode::Geometry; }));
  configs.push_back(Changed("fins-pulled", "fins pulled", [](RenderSettings* s) { s->finMode = FinMode::Pulled; }));
  configs.push_back(
      Changed("instanced", "an instance for each shell", [](RenderSettings* s) { s->shellMode = ShellMode::Instanced; }));
  configs.push_back(
      Changed("draws", "a draw for each shell", [](RenderSettings* s) { s->shellMode = ShellMode::Draws; }));
  configs.push_back(
      Changed("gs", "shells by a geometry shader", [](RenderSettings* s) { s->shellMode = ShellMode::Amplified; }));
  configs.push_back(Changed("sheet", "as sheets", [](RenderSettings* s) { s->semantics = Semantics::Sheet; }));
  configs.push_back(Changed("msaa4", "4 samples a pixel", [](RenderSettings* s) { s->samples = 4; }));
  configs.push_back(
      Changed("bare4", "bare skin with 4 samples a pixel", [](RenderSettings* s) { s->skinSamples = 4; }));
  configs.push_back(
      Changed("unorm8", "blended in 8 bits", [](RenderSettings* s) { s->target = TargetFormat::Unorm8; }));
  configs.push_back(
      Changed("float32", "blended in 32-bit floats", [](RenderSettings* s) { s->target = TargetFormat::Float32; }));
  return configs;
}

bool MatchesAny(const std::string& name, const std::string& patterns) {
  if (patterns.empty()) return true;
  std::istringstream in(patterns);
  for (std::string pattern; std::getline(in, pattern, ',');) {
    const bool open = !pattern.empty() && pattern.back() == '*';
    if (open ? name.rfind(pattern.substr(0, pattern.size() - 1), 0) == 0 : name == pattern) return true;
  }
  return false;
}

}  // namespace fur

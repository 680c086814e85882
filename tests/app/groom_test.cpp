// The coat's parameters on the command line and in fur files.
#include <fstream>
#include <iterator>

#include "fur/params.h"
#include "program.h"

namespace app::test {
namespace {

struct Drawn {
  fur::Image picture;
  uint64_t shellFragments = 0;
};

Drawn With(const std::vector<std::string>& flags) {
  const Folder folder;
  std::vector<std::string> all{"render", "-o",        folder / "x.png", "--stats",     folder / "s.json",
                               "--size", "160x120", "--repeat",       "0",           "--eye",
                               "-1.5,1.6,2.6",      "--target",       "0,0.75,0.15", "--fov",
                               "40"};
  all.insert(all.end(), flags.begin(), flags.end());
  ExpectSuccess(RunFur(all));
  return {Picture(folder / "x.png"), ReadJson(folder / "s.json")["fragments"]["shells"].get<uint64_t>()};
}

const Drawn& Default() {
  static const Drawn run = With({});
  return run;
}

std::string Value(const fur::FurKey& key, const std::string& picture) {
  static const std::map<std::string, std::string> kValues{
      {"enabled", "false"},      {"length_scale", "0.12"}, {"layer_uv_scale", "9"},   {"self_shadow", "0.1"},
      {"specular_power", "3"},   {"specular_scale", "2"},  {"height_falloff", "1"},   {"density", "2"},
      {"thickness", "2"},        {"comb", "0,-1,0"},       {"comb_strength", "2"},    {"bend", "1"},
      {"gravity", "1"},          {"root_color", "0,0,1"},  {"tip_color", "2,0,0"},    {"color_from_base", "0.2"},
      {"tint", "0"},            {"clumping", "1"},       {"wetness", "1"},         {"wind", "0,0,-1"},
      {"wind_strength", "2"},   {"front", "0,0,-1"},
      {"wind_frequency", "1.7"}, {"wind_length", "0.3"},   {"inertia_stiffness", ""}, {"inertia_damping", ""}};
  const auto it = kValues.find(key.name);
  return it != kValues.end() ? it->second : key.kind == fur::FurKind::Files ? picture + "," + picture : picture;
}

// What a key needs beside it to show.
std::vector<std::string> Beside(const std::string& key) {
  if (key == "comb_strength" || key == "bend") return {"--comb", "0,-1,0"};
  if (key == "wind_frequency" || key == "wind_length" || key == "wind") return {"--wind-strength", "1", "--time", "0.4"};
  if (key == "front") return {"--coat", "tiger"};
  return {};
}

nlohmann::json AsJson(const fur::FurKey& key, const std::string& text) {
  if (key.kind == fur::FurKind::Switch) return text == "true";
  if (key.kind == fur::FurKind::Number) return std::stod(text);
  if (key.kind == fur::FurKind::Vector) return nlohmann::json::parse("[" + text + "]");
  if (key.kind == fur::FurKind::File) return text;
  return {text.substr(0, text.find(',')), text.substr(0, text.find(','))};
}

// Every key but the number of shells, which has a flag and tests of its own; inertia shows in motion only.
TEST(Groom, EveryFlagActsAndIsTheFilesKey) {
  const Folder folder;
  fur::Image half{"half", 2, 2, {}};
  for (const int red : {255, 0, 90, 200})
    half.pixels.insert(half.pixels.end(), {uint8_t(red), 140, 220, uint8_t(255 - red / 2)});
  ASSERT_TRUE(fur::WritePng(folder / "half.png", 2, 2, half.pixels));
  std::map<std::vector<std::string>, fur::Image> without;
  std::vector<std::string> allFlags{"--time", "0.4"};
  nlohmann::json allKeys;
  for (const fur::FurKey& key : fur::FurKeys()) {
    SCOPED_TRACE(key.flag);
    const std::string value = Value(key, folder / "half.png");
    if (std::string(key.name) == "shells" || value.empty()) continue;
    std::vector<std::string> flags = Beside(key.name);
    if (!without.contains(flags)) without[flags] = With(flags).picture;
    const fur::Image before = without[flags];
    flags.insert(flags.end(), {key.flag, value});
    EXPECT_GT(DifferingPixels(With(flags).picture, before), 200u);
    if (key.kind == fur::FurKind::Switch) continue;
    allFlags.insert(allFlags.end(), {key.flag, value});
    allKeys[key.name] = AsJson(key, value);
  }
  const std::string file = folder.Write("groom.json", nlohmann::json{{"materials", {{"fur", allKeys}}}}.dump());
  EXPECT_EQ(DifferingPixels(With(allFlags).picture, With({"--time", "0.4", "--groom", file}).picture), 0u);
}

TEST(Groom, FlagsWinOverFilesAndFilesOverTheCoat) {
  const Folder folder;
  const std::string file = folder.Write("g.json", R"({"default": {"wetness": 0.9}, "materials": {"fur": {"wetness": 0.5}}})");
  const fur::Image half = With({"--wetness", "0.5"}).picture, dry = Default().picture;
  EXPECT_EQ(DifferingPixels(With({"--groom", file}).picture, half), 0u);
  EXPECT_EQ(DifferingPixels(With({"--fur", file}).picture, half), 0u) << "--fur is another name of --groom";
  EXPECT_EQ(DifferingPixels(With({"--groom", file, "--wetness", "0"}).picture, dry), 0u);
  EXPECT_GT(DifferingPixels(half, dry), 1000u);
}

TEST(Groom, FurlessMapOpensTheFur) {
  const Folder folder;
  const std::vector<uint8_t> black{0, 0, 0, 255}, white{255, 255, 255, 255};
  ASSERT_TRUE(fur::WritePng(folder / "none.png", 1, 1, black));
  ASSERT_TRUE(fur::WritePng(folder / "all.png", 1, 1, white));
  EXPECT_EQ(With({"--furless-map", folder / "none.png"}).shellFragments, 0u);
  EXPECT_EQ(With({"--furless-map", folder / "all.png"}).shellFragments, Default().shellFragments);
}

TEST(Groom, WindMovesWithTime) {
  const fur::Image now = With({"--wind-strength", "1", "--time", "1"}).picture;
  EXPECT_GT(DifferingPixels(With({"--wind-strength", "1", "--time", "1.4"}).picture, now), 500u);
  EXPECT_EQ(DifferingPixels(With({"--wind-strength", "1", "--time", "6"}).picture, now), 0u)
      << "0.8 Hz, gusts of 4 waves: 5 s are a period";
  EXPECT_EQ(DifferingPixels(With({"--time", "1"}).picture, Default().picture), 0u) << "no wind";
}

TEST(Groom, RefusalsNameTheFlagOrTheKey) {
  for (const fur::FurKey& key : fur::FurKeys()) {
    SCOPED_TRACE(key.flag);
    if (std::string(key.name) == "shells" || key.max == 0) continue;
    const bool vector = key.kind == fur::FurKind::Vector;
    for (const std::string& bad : {std::string("nan"), std::string("much"), std::to_string(key.max * 2)})
      ExpectRenderFailure({key.flag, vector ? bad + ",0,0" : bad}, kUsage, {key.flag});
  }
  ExpectRenderFailure({"--comb", "1,2"}, kUsage, {"--comb", "X,Y,Z"});
  ExpectRenderFailure({"--enabled", "perhaps"}, kUsage, {"--enabled"});
  ExpectRenderFailure({"--time=-1"}, kUsage, {"--time"});
  const Folder folder;
  const std::string file = folder.Write("g.json", R"({"default": {"wettness": 1}})");
  ExpectRenderFailure({"--groom", file}, kInputMalformed, {"wettness", "wetness", "clumping", "g.json"});
  ExpectRenderFailure({"--groom", "no.json"}, kInputMissing, {"no.json"});
  ExpectRenderFailure({"--furless-map", "no.png"}, kInputMissing, {"no.png"});
}

TEST(Groom, SchemaInTheDocsIsThePrograms) {
  const Outcome printed = RunFur({"info", "--groom-schema"});
  ExpectSuccess(printed);
  std::ifstream file(FUR_DOCS_DIR "/groom.schema.json");
  const std::string text((std::istreambuf_iterator<char>(file)), std::istreambuf_iterator<char>());
  EXPECT_EQ(printed.out, text) << "run: fur info --groom-schema > docs/groom.schema.json";
}

// The table of docs/fur.md has every key.
TEST(Groom, DocsNameEveryKey) {
  std::ifstream file(FUR_DOCS_DIR "/fur.md");
  const std::string text((std::istreambuf_iterator<char>(file)), std::istreambuf_iterator<char>());
  for (const fur::FurKey& key : fur::FurKeys())
    EXPECT_NE(text.find(std::string("`") + key.name + "`"), std::string::npos) << key.name;
}

}  // namespace
}  // namespace app::test

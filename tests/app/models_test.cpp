// The real models on both backends: the same picture to the bit, and not a word from the drivers' validation.
#include "program.h"

namespace app::test {
namespace {

struct RealModel {
  const char* name;
  const char* file;
};
void PrintTo(const RealModel& m, std::ostream* out) { *out << m.name; }

class RealModels : public testing::TestWithParam<RealModel> {};

const RealModel kModels[] = {{"cat", "cat/cat.gltf"},      {"fox", "fox/fox.glb"},
                             {"spot", "spot/spot.glb"},    {"plushy_toy", "plushy_toy/plushy_toy.gltf"},
                             {"husky", "husky/husky.glb"}, {"suzanne", "suzanne/suzanne.glb"},
                             {"torus", "torus/torus.gltf"}};
std::string Name(const testing::TestParamInfo<RealModel>& model) { return model.param.name; }
INSTANTIATE_TEST_SUITE_P(Assets, RealModels, testing::ValuesIn(kModels), Name);

void ExpectBothAlike(const std::string& model, const std::vector<std::string>& flags, bool draws = true) {
  const Folder folder;
  std::vector<std::string> all{"render",         model,        "--backend", "both",           "--size", "320x240", "-o",
                               folder / "x.png", "--validate", "--stats",   folder / "s.json"};
  all.insert(all.end(), flags.begin(), flags.end());
  const Outcome o = RunFur(all, 200);
  EXPECT_EQ(o.exitCode, 0) << o.err;
  EXPECT_EQ(o.signal, 0);
  EXPECT_EQ(o.err.find("error"), std::string::npos) << o.err;
  EXPECT_NE(o.out.find("(0 of 76800 differ)"), std::string::npos) << o.out;
  const nlohmann::json stats = ReadJson(folder / "s.json");
  ASSERT_EQ(stats.value("runs", nlohmann::json::array()).size(), 2u);
  for (const nlohmann::json& run : stats["runs"]) EXPECT_EQ(run["messages"], nlohmann::json::array());
  const fur::Image vulkan = Picture(folder / "x.vulkan.png"), gl = Picture(folder / "x.gl.png");
  EXPECT_EQ(DifferingPixels(vulkan, gl), 0u);
  if (draws) ExpectDrawn(vulkan);
}

TEST_P(RealModels, BothBackendsDrawTheSame) {
  const std::string file = Asset(GetParam().file);
  if (!std::filesystem::exists(file))
    GTEST_SKIP() << file << " is absent; set FUR_ASSETS to the folder of the test models";
  ExpectBothAlike(file, {});
}

TEST_P(RealModels, BothBackendsDrawTheSameInLookSeed) {
  const std::string file = Asset(GetParam().file);
  if (!std::filesystem::exists(file))
    GTEST_SKIP() << file << " is absent; set FUR_ASSETS to the folder of the test models";
  ExpectBothAlike(file, {"--technique", "seed", "--look", "seed", "--samples", "4"});
}

// Field notes, section 6: the published camera sees nine of 25 cats.
TEST(PublishedCat, FieldOfTheDemo) {
  const std::string file = Asset("cat/cat.gltf");
  if (!std::filesystem::exists(file))
    GTEST_SKIP() << file << " is absent; set FUR_ASSETS to the folder of the test models";
  ExpectBothAlike(file, {"--technique", "seed", "--look", "seed", "--count", "25", "--eye", "-1,2,-3", "--target", "0,0,0"});
}

TEST(PublishedCat, SubmitsWhatTheDemoSubmits) {
  const std::string file = Asset("cat/cat.gltf");
  if (!std::filesystem::exists(file))
    GTEST_SKIP() << file << " is absent; set FUR_ASSETS to the folder of the test models";
  const Folder folder;
  const Outcome o = RunFur({"render", file, "--technique", "seed", "--look", "seed", "--shells", "16", "--size", "64x48", "-o",
                            folder / "x.png", "--stats", folder / "s.json"});
  ASSERT_EQ(o.exitCode, 0) << o.err;
  const nlohmann::json s = ReadJson(folder / "s.json");
  EXPECT_EQ(s["edges_submitted"], 9846);
  EXPECT_EQ(s["triangles_submitted"], 998 + 2956 + 16 * 2956);
}

}  // namespace
}  // namespace app::test

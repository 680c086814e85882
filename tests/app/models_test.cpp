// The published cat as the published demo draws it. Each model's picture: fur.model of the conformance suite.
#include "program.h"

namespace app::test {
namespace {

// Field notes, section 6: the published camera sees nine of 25 cats.
TEST(PublishedCat, FieldOfTheDemo) {
  const std::string file = Asset("cat/cat.gltf");
  if (!std::filesystem::exists(file))
    GTEST_SKIP() << file << " is absent; set FUR_ASSETS to the folder of the test models";
  const Folder folder;
  const Outcome o = RunFur({"render", file, "--technique", "seed", "--look", "seed", "--count", "25", "--eye", "-1,2,-3",
                            "--target", "0,0,0", "--backend", "both", "--size", "320x240", "-o", folder / "x.png",
                            "--validate", "--stats", folder / "s.json"}, 200);
  EXPECT_EQ(o.exitCode, 0) << o.err;
  EXPECT_EQ(o.err.find("error"), std::string::npos) << o.err;
  EXPECT_NE(o.out.find("(0 of 76800 differ)"), std::string::npos) << o.out;
  const nlohmann::json stats = ReadJson(folder / "s.json");
  ASSERT_EQ(stats.value("runs", nlohmann::json::array()).size(), 2u);
  for (const nlohmann::json& run : stats["runs"]) EXPECT_EQ(run["messages"], nlohmann::json::array());
  const fur::Image vulkan = Picture(folder / "x.vulkan.png"), gl = Picture(folder / "x.gl.png");
  EXPECT_EQ(DifferingPixels(vulkan, gl), 0u);
  ExpectDrawn(vulkan);
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

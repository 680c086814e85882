// Pictures, differences and stats of the built-in animal.
#include "fur/exr_io.h"
#include "program.h"

namespace app::test {
namespace {

const char* const kBackends[] = {"vulkan", "gl"};

// Renders on both backends with validation: no message, no differing pixel; returns the picture.
fur::Image RenderBoth(std::vector<std::string> flags, bool mustBeDrawn = true) {
  const Folder folder;
  std::vector<std::string> all{"render", "-o",         folder / "x.png", "--backend",
                               "both",   "--validate", "--stats",        folder / "s.json"};
  if (std::find(flags.begin(), flags.end(), "--size") == flags.end()) flags.insert(flags.end(), {"--size", "320x240"});
  std::string shown;
  for (const std::string& f : flags) shown += " " + f;
  SCOPED_TRACE("flags:" + shown);
  all.insert(all.end(), flags.begin(), flags.end());
  const Outcome o = RunFur(all);
  ExpectSuccess(o);
  EXPECT_NE(o.out.find("(0 of "), std::string::npos) << o.out;
  EXPECT_NE(o.out.find("difference vulkan - gl"), std::string::npos) << o.out;
  EXPECT_EQ(folder.Content(), (std::set<std::string>{"s.json", "x.gl.png", "x.vulkan.png"}));
  const nlohmann::json stats = ReadJson(folder / "s.json");
  EXPECT_EQ(stats.value("/difference/differing"_json_pointer, -1), 0);
  const fur::Image vulkan = Picture(folder / "x.vulkan.png"), gl = Picture(folder / "x.gl.png");
  EXPECT_EQ(DifferingPixels(vulkan, gl), 0u);
  if (mustBeDrawn) ExpectDrawn(vulkan);
  return vulkan;
}

TEST(Render, BothBackendsDrawTheSame) {
  const fur::Image image = RenderBoth({});
  EXPECT_EQ(image.width, 320u);
  EXPECT_EQ(image.height, 240u);
}

TEST(Render, LooksAndSemanticsDiffer) {
  std::vector<fur::Image> images;
  for (const char* look : {"seed", "correct"})
    for (const char* semantics : {"sheet", "volume"})
      images.push_back(RenderBoth({"--look", look, "--semantics", semantics}));
  for (size_t i = 0; i < images.size(); ++i)
    for (size_t j = 0; j < i; ++j) EXPECT_GT(DifferingPixels(images[i], images[j]), 1000u) << i << " and " << j;
}

TEST(Render, FourSamples) {
  const fur::Image one = RenderBoth({}), four = RenderBoth({"--samples", "4"});
  EXPECT_GT(DifferingPixels(one, four), 100u);
}

TEST(Render, NumberOfShells) {
  const fur::Image eight = RenderBoth({"--shells", "8"}), many = RenderBoth({"--shells", "64"});
  EXPECT_GT(DifferingPixels(eight, many), 1000u);
}

TEST(Render, FinsAndShellsCanBeSwitchedOff) {
  const fur::Image all = RenderBoth({}), noFins = RenderBoth({"--no-fins"}), noShells = RenderBoth({"--no-shells"}),
                   bald = RenderBoth({"--no-fins", "--no-shells"});
  EXPECT_GT(DifferingPixels(all, noFins), 50u);
  EXPECT_GT(DifferingPixels(all, noShells), 1000u);
  EXPECT_GT(DifferingPixels(noShells, bald), 50u);
}

TEST(Render, SeveralAnimals) {
  const fur::Image one = RenderBoth({}), five = RenderBoth({"--count", "5"});
  EXPECT_GT(DifferingPixels(one, five), 1000u);
}

TEST(Render, CameraFlags) {
  const fur::Image published = RenderBoth({"--eye", "-0.8,1.2,-1.6", "--target", "0,0.5,0"});
  EXPECT_GT(DifferingPixels(published, RenderBoth({"--eye", "0.8,1.2,-1.6", "--target", "0,0.5,0"})), 1000u);
  EXPECT_GT(DifferingPixels(published, RenderBoth({"--eye", "-0.8,1.2,-1.6", "--target", "0,0.5,0", "--fov", "40"})),
            1000u);
  const fur::Image away = RenderBoth({"--eye", "0,1,-3", "--target", "0,1,-30"}, false);
  EXPECT_EQ(away.pixels, RenderBoth({"--eye", "0,1,-4", "--target", "0,1,-30"}, false).pixels) << "an empty view";
}

TEST(Render, OddSizes) {
  RenderBoth({"--size", "1x1"}, false);
  RenderBoth({"--size", "17x3"}, false);
  RenderBoth({"--size", "3x77", "--samples", "4"}, false);
}

TEST(Render, BackgroundIsLinearInLookCorrectAndRawInSeed) {
  const auto corner = [](const char* look) {
    const fur::Image image = RenderBoth({"--background", "0.5,0,1", "--look", look});
    return std::vector<int>{image.pixels[0], image.pixels[1], image.pixels[2]};
  };
  EXPECT_EQ(corner("correct"), (std::vector<int>{188, 0, 255}));
  const std::vector<int> seed = corner("seed");
  EXPECT_NEAR(seed[0], 127.5, 0.6);
  EXPECT_EQ(seed[2], 255);
}

TEST(Render, IsDeterministic) { EXPECT_EQ(RenderBoth({}).pixels, RenderBoth({}).pixels); }

TEST(Render, DefaultBackendIsVulkan) {
  const Folder folder;
  ExpectSuccess(RunFur({"render", "--size", "64x48", "-o", folder / "a.png", "--stats", folder / "a.json"}));
  EXPECT_EQ(ReadJson(folder / "a.json")["backend"], "vulkan");
}

// Every field that the issue asks for, of its type.
void ExpectStats(const nlohmann::json& s, const std::string& backend, size_t repeats) {
  EXPECT_EQ(s["backend"], backend);
  EXPECT_TRUE(s["driver"].is_string() && !s["driver"].get<std::string>().empty());
  EXPECT_EQ(s["technique"], "shells");
  EXPECT_EQ(s["look"], "correct");
  EXPECT_EQ(s["semantics"], "volume");
  EXPECT_EQ(s["width"], 96);
  EXPECT_EQ(s["height"], 64);
  EXPECT_EQ(s["samples"], 4);
  EXPECT_EQ(s["animals"], 2);
  ASSERT_TRUE(s["frame_ms"].is_array());
  EXPECT_EQ(s["frame_ms"].size(), repeats);
  for (const nlohmann::json& ms : s["frame_ms"]) EXPECT_GT(ms.get<double>(), 0);
  EXPECT_GT(s["first_frame_ms"].get<double>(), 0);
  for (const char* key : {"draws", "triangles_submitted", "fragments_shaded", "edges_submitted"})
    EXPECT_GT(s[key].get<uint64_t>(), 0u) << key;
  EXPECT_TRUE(s["skipped"].is_object());
  EXPECT_EQ(s["messages"], nlohmann::json::array());
  const nlohmann::json& parts = s["fragments"];
  EXPECT_EQ(s["fragments_shaded"].get<uint64_t>(),
            parts["base"].get<uint64_t>() + parts["fins"].get<uint64_t>() + parts["shells"].get<uint64_t>());
}

TEST(Stats, HaveAllFields) {
  for (const char* backend : kBackends)
    for (const size_t repeats : {0u, 1u, 5u}) {
      const Folder folder;
      ExpectSuccess(
          RunFur({"render", "--backend", backend, "--size", "96x64", "--samples", "4", "--count", "2", "--repeat",
                  std::to_string(repeats), "-o", folder / "x.png", "--stats", folder / "s.json", "--validate"}));
      const nlohmann::json s = ReadJson(folder / "s.json");
      ExpectStats(s, backend, repeats);
      std::vector<double> ms = s["frame_ms"].get<std::vector<double>>();
      std::sort(ms.begin(), ms.end());
      EXPECT_DOUBLE_EQ(s["frame_ms_median"].get<double>(), ms.empty() ? 0 : ms[ms.size() / 2]);
    }
}

TEST(Stats, BothBackendsSubmitAndShadeTheSame) {
  const Folder folder;
  ExpectSuccess(RunFur({"render", "--backend", "both", "--size", "96x64", "--samples", "4", "--count", "2", "-o",
                        folder / "x.png", "--stats", folder / "s.json", "--validate"}));
  const nlohmann::json s = ReadJson(folder / "s.json");
  ASSERT_EQ(s["runs"].size(), 2u);
  ExpectStats(s["runs"][0], "vulkan", 1);
  ExpectStats(s["runs"][1], "gl", 1);
  for (const char* key :
       {"draws", "triangles_submitted", "edges_submitted", "fragments_shaded", "fragments", "skipped"})
    EXPECT_EQ(s["runs"][0][key], s["runs"][1][key]) << key;
  EXPECT_EQ(s["difference"]["pixels"], 96 * 64);
  EXPECT_EQ(s["difference"]["differing"], 0);
  EXPECT_EQ(s["difference"]["largest"], 0);
  EXPECT_EQ(s["difference"]["equal_share"], 1.0);
}

// The mean of squares of a frame as large, made here by hand.
TEST(Render, SupersamplingIsTheMeanOfALargerFrame) {
  const Folder folder;
  // With 33 shells both frames are 32-bit floats; the mean always is.
  const std::vector<std::string> flags{"render", "--shells", "33", "--repeat", "0"};
  const auto render = [&](std::vector<std::string> more) {
    more.insert(more.begin(), flags.begin(), flags.end());
    ExpectSuccess(RunFur(more));
  };
  render({"-o", folder / "large.exr", "--size", "192x144"});
  render({"-o", folder / "mean.exr", "--size", "96x72", "--supersample", "2"});
  const auto large = fur::ReadExr(folder / "large.exr"), mean = fur::ReadExr(folder / "mean.exr");
  ASSERT_TRUE(large && mean);
  ASSERT_EQ(mean->image.width, 96u);
  ASSERT_EQ(mean->image.height, 72u);
  for (uint32_t y = 0; y < 72; ++y)
    for (uint32_t x = 0; x < 96; ++x) {
      const auto at = [&](uint32_t i, uint32_t j) { return large->image.pixels[size_t{y * 2 + j} * 192 + x * 2 + i]; };
      const glm::vec4 mine = (at(0, 0) + at(1, 0) + at(0, 1) + at(1, 1)) / 4.0f;
      for (int c = 0; c < 4; ++c) ASSERT_NEAR(mean->image.pixels[size_t{y} * 96 + x][c], mine[c], 1e-6);
    }
  const Outcome refused = RunFur({"render", "-o", folder / "x.png", "--technique", "seed", "--supersample", "2"});
  EXPECT_EQ(refused.exitCode, 2);
  EXPECT_NE(refused.err.find("--supersample"), std::string::npos) << refused.err;
}

TEST(Render, SkinSamples) {
  const Folder folder;
  const auto stats = [&](const std::string& name, std::vector<std::string> more) {
    std::vector<std::string> flags{"render", "--size",                  "96x72",   "--repeat",       "0",
                                   "-o",     folder / (name + ".png"), "--stats", folder / "s.json"};
    flags.insert(flags.end(), more.begin(), more.end());
    ExpectSuccess(RunFur(flags));
    return ReadJson(folder / "s.json");
  };
  EXPECT_EQ(stats("one", {})["skin_samples"], 1);
  EXPECT_EQ(stats("bare", {"--skin-samples", "4"})["skin_samples"], 4);
  EXPECT_EQ(stats("all", {"--samples", "4"})["skin_samples"], 4);
  EXPECT_NE(ReadText(folder / "one.png"), ReadText(folder / "bare.png"));
  for (const std::vector<std::string>& more : {std::vector<std::string>{"--technique", "seed", "--skin-samples", "4"},
                                               {"--samples", "4", "--skin-samples", "1"},
                                               {"--skin-samples", "2"}}) {
    std::vector<std::string> flags{"render", "-o", folder / "x.png"};
    flags.insert(flags.end(), more.begin(), more.end());
    const Outcome refused = RunFur(flags);
    EXPECT_EQ(refused.exitCode, 2) << refused.err;
    EXPECT_NE(refused.err.find("skin-samples"), std::string::npos) << refused.err;
    EXPECT_FALSE(std::filesystem::exists(folder / "x.png"));
  }
}

TEST(Stats, CountsFollowTheFlags) {
  const auto stats = [](std::vector<std::string> flags) {
    const Folder folder;
    std::vector<std::string> all{"render", "--size",         "64x48",   "--repeat",       "0",
                                 "-o",     folder / "x.png", "--stats", folder / "s.json"};
    all.insert(all.end(), flags.begin(), flags.end());
    ExpectSuccess(RunFur(all));
    return ReadJson(folder / "s.json");
  };
  const nlohmann::json one = stats({"--shells", "10"}), twenty = stats({"--shells", "20"}),
                       none = stats({"--no-shells", "--no-fins"});
  const auto triangles = [](const nlohmann::json& s) { return s["triangles_submitted"].get<uint64_t>(); };
  EXPECT_EQ(triangles(twenty) - triangles(one), triangles(one) - triangles(stats({"--no-shells"})))
      << "ten shells each";
  EXPECT_EQ(none["edges_submitted"], 0);
  EXPECT_EQ(none["fragments"]["shells"], 0);
  EXPECT_EQ(none["fragments"]["fins"], 0);
  EXPECT_GE(triangles(none), 2000u) << "the built-in animal has 2,000 triangles";
}

}  // namespace
}  // namespace app::test

// --preset: pictures on both backends, flags that act, and flags that are refused.
#include <map>

#include "program.h"

namespace app::test {
namespace {

fur::Image RenderBoth(const std::vector<std::string>& flags, nlohmann::json* stats = nullptr) {
  const Folder folder;
  std::vector<std::string> all{"render",     "-o",     folder / "x.png", "--backend", "both",
                               "--validate", "--size", "160x120",        "--stats",   folder / "s.json"};
  std::string shown;
  for (const std::string& f : flags) shown += " " + f;
  SCOPED_TRACE("flags:" + shown);
  all.insert(all.end(), flags.begin(), flags.end());
  ExpectSuccess(RunFur(all));
  const nlohmann::json j = ReadJson(folder / "s.json");
  EXPECT_EQ(j.value("/difference/differing"_json_pointer, -1), 0);
  if (stats) *stats = j.value("/runs/0"_json_pointer, nlohmann::json());
  fur::Image image = Picture(folder / "x.vulkan.png");
  ExpectDrawn(image);
  return image;
}

TEST(Preset, EachIsAPictureOfItsOwn) {
  std::vector<fur::Image> images;
  for (const char* preset : {"demo-fur", "nvidia-d3d10", "gs-shells", "four-coats"}) {
    nlohmann::json stats;
    images.push_back(RenderBoth({"--preset", preset}, &stats));
    EXPECT_EQ(stats.value("preset", ""), preset);
    EXPECT_EQ(stats.value("technique", ""), "seed");
    EXPECT_EQ(stats.value("look", ""), "seed");
    for (size_t i = 0; i + 1 < images.size(); ++i)
      EXPECT_GT(DifferingPixels(images[i], images.back()), 2000u) << preset;
  }
  EXPECT_EQ(DifferingPixels(images[0], RenderBoth({"--technique", "seed", "--look", "seed"})), 0u)
      << "demo-fur is technique seed with look seed";
  EXPECT_EQ(DifferingPixels(RenderBoth({"--preset", "demo-fur", "--look", "correct"}),
                            RenderBoth({"--technique", "seed", "--look", "correct"})),
            0u);
}

TEST(Preset, FourCoats) {
  std::vector<fur::Image> images;
  for (const char* coat : {"bear", "panther", "snow", "tiger"}) {
    nlohmann::json stats;
    images.push_back(RenderBoth({"--preset", "four-coats", "--coat", coat}, &stats));
    EXPECT_EQ(stats.value("coat", ""), coat);
    for (size_t i = 0; i + 1 < images.size(); ++i) EXPECT_GT(DifferingPixels(images[i], images.back()), 2000u) << coat;
  }
  EXPECT_EQ(DifferingPixels(images[0], RenderBoth({"--preset", "four-coats"})), 0u) << "a bear by default";
}

struct Switch {
  const char* preset;
  std::vector<std::string> flags;
};
TEST(Preset, SwitchesAct) {
  const Switch switches[] = {{"nvidia-d3d10", {"--comb", "0,-1,0"}},
                             {"nvidia-d3d10", {"--comb", "1,0,0", "--comb-strength", "0.3"}},
                             {"nvidia-d3d10", {"--fin-threshold", "0.8"}},
                             {"nvidia-d3d10", {"--fin-opacity", "0.2"}},
                             {"nvidia-d3d10", {"--spacing", "0.006"}},
                             {"nvidia-d3d10", {"--shells", "40"}},
                             {"gs-shells", {"--dead-zone", "0.6"}},
                             {"gs-shells", {"--spacing", "0.006"}},
                             {"gs-shells", {"--shells", "7"}},
                             {"four-coats", {"--dead-zone", "0"}},
                             {"four-coats", {"--shells", "34"}},
                             {"four-coats", {"--no-fins"}},
                             {"four-coats", {"--no-shells"}}};
  std::map<std::string, fur::Image> plain;
  for (const Switch& s : switches) {
    std::vector<std::string> flags{"--preset", s.preset};
    if (!plain.contains(s.preset)) plain[s.preset] = RenderBoth(flags);
    flags.insert(flags.end(), s.flags.begin(), s.flags.end());
    EXPECT_GT(DifferingPixels(plain[s.preset], RenderBoth(flags)), 50u) << s.preset << " " << s.flags[0];
  }
}

struct Refused {
  std::vector<std::string> flags;
  std::vector<std::string> words;
};
TEST(Preset, ContradictionsAreRefused) {
  const Refused refused[] = {{{"--preset", "magic"}, {"--preset", "magic"}},
                             {{"--preset", "gs-shells", "--technique", "shells"}, {"gs-shells", "--technique"}},
                             {{"--preset", "demo-fur", "--technique", "shells"}, {"demo-fur", "--technique"}},
                             {{"--preset", "nvidia-d3d10", "--look", "correct"}, {"nvidia-d3d10", "--look"}},
                             {{"--preset", "nvidia-d3d10", "--semantics", "volume"}, {"nvidia-d3d10", "--semantics"}},
                             {{"--dead-zone", "0.1"}, {"--dead-zone", "--preset"}},
                             {{"--preset", "gs-shells", "--coat", "bear"}, {"--coat", "gs-shells"}},
                             {{"--preset", "four-coats", "--coat", "zebra"}, {"zebra", "panther"}},
                             {{"--preset", "four-coats", "--coat", "husky"}, {"husky", "panther"}},
                             {{"--preset", "gs-shells", "--comb", "1,0,0"}, {"--comb", "gs-shells"}},
                             {{"--preset", "four-coats", "--fin-threshold", "0.1"}, {"--fin-threshold", "four-coats"}},
                             {{"--preset", "nvidia-d3d10", "--dead-zone", "0.1"}, {"--dead-zone", "nvidia-d3d10"}},
                             {{"--preset", "gs-shells", "--dead-zone", "nan"}, {"--dead-zone"}},
                             {{"--preset", "gs-shells", "--dead-zone", "1.5"}, {"--dead-zone"}},
                             {{"--preset", "nvidia-d3d10", "--fins", "pulled"}, {"--fins", "nvidia-d3d10"}},
                             {{"--preset", "four-coats", "--shells", "40"}, {"40 shells", "1200", "1024", "34"}},
                             {{"--preset", "gs-shells", "--shells", "29"}, {"29 shells", "1044", "1024", "28"}}};
  for (const Refused& r : refused) ExpectRenderFailure(r.flags, kUsage, r.words);
}

}  // namespace
}  // namespace app::test

// fur reference from the outside.
#include <algorithm>

#include "fur/compare.h"
#include "program.h"

namespace app::test {
namespace {

// `more`: flags and their values, in pairs as far as they stand for one of the first four.
std::vector<std::string> Arguments(const Folder& folder, const std::vector<std::string>& more = {}) {
  std::vector<std::string> arguments{"reference"};
  for (const std::pair<std::string, std::string>& usual : {std::pair<std::string, std::string>{"-o", folder / "x.png"},
                                                           {"--cache", folder / "cache"},
                                                           {"--size", "96x60"},
                                                           {"--spp", "2"}})
    if (std::find(more.begin(), more.end(), usual.first) == more.end())
      arguments.insert(arguments.end(), {usual.first, usual.second});
  arguments.insert(arguments.end(), more.begin(), more.end());
  return arguments;
}

// What fur compare makes of two files of the folder.
nlohmann::json Compared(const Folder& folder, const std::string& a, const std::string& b) {
  const Outcome o = RunFur(
      {"compare", folder / a, folder / b, "--json", "--mask", folder / "mask.png", "--band", folder / "band.png"});
  ExpectSuccess(o);
  return nlohmann::json::parse(o.out, nullptr, false);
}

TEST(ReferenceCommand, DrawsAndKeepsThePicture) {
  const Folder folder;
  const Outcome first = RunFur(Arguments(folder));
  ExpectSuccess(first);
  const fur::Image picture = Picture(folder / "x.png");
  ExpectDrawn(picture);
  const Outcome second = RunFur(Arguments(folder, {"--threads", "1"}));
  ExpectSuccess(second);
  EXPECT_NE(second.out.find("from the cache"), std::string::npos) << second.out;
  EXPECT_EQ(DifferingPixels(picture, Picture(folder / "x.png")), 0u);
  const Outcome other = RunFur(Arguments(folder, {"--seed", "1"}));
  ExpectSuccess(other);
  EXPECT_EQ(other.out.find("from the cache"), std::string::npos) << other.out;
  EXPECT_GT(DifferingPixels(picture, Picture(folder / "x.png")), 100u);
}

// The standard error of the mean of 16 samples is a quarter of a strand's contrast, and FLIP is steep near 0.
TEST(ReferenceCommand, TwoSeedsAgreeAndCompareGetsItsRegions) {
  const Folder folder;
  for (const char* seed : {"1", "7"})
    ExpectSuccess(RunFur(
        Arguments(folder, {"-o", folder / (std::string(seed) + ".exr"), "--seed", seed, "--size", "160x100", "--spp",
                           "16", "--no-cache", "--mask", folder / "mask.png", "--band", folder / "band.png"})));
  const nlohmann::json j = Compared(folder, "1.exr", "7.exr");
  EXPECT_LT(j["flip"]["mask_mean"].get<double>(), 0.03);
  EXPECT_GT(j["flip"]["mask_mean"].get<double>(), 0.0001) << "not the same samples";
  EXPECT_LT(j["mask"]["rmse"].get<double>(), 0.012);
  EXPECT_EQ(j["mask_source"], "file");
  EXPECT_EQ(j["band_source"], "file");
  EXPECT_GT(j["band"]["pixels"].get<int>(), 100);
  EXPECT_GT(j["mask"]["pixels"].get<int>(), 5 * j["band"]["pixels"].get<int>());
  EXPECT_FALSE(std::filesystem::exists(folder / "cache"));
}

// The threshold of compare is kept through eight bits.
TEST(ReferenceCommand, RegionsAreTheSameInBothFormats) {
  const Folder folder;
  ExpectSuccess(RunFur(Arguments(folder, {"--mask", folder / "m.png", "--band", folder / "b.png"})));
  ExpectSuccess(RunFur(Arguments(folder, {"--mask", folder / "m.exr", "--band", folder / "b.exr"})));
  for (const std::string name : {"m", "b"}) {
    const fur::Result<fur::Plane> bytes = fur::ReadOpacity(folder / (name + ".png")),
                                  floats = fur::ReadOpacity(folder / (name + ".exr"));
    ASSERT_TRUE(bytes && floats);
    for (size_t i = 0; i < floats->values.size(); ++i) {
      EXPECT_EQ(bytes->values[i] > 1 / 255.0f, floats->values[i] > 1 / 255.0f) << i;
      EXPECT_LE(floats->values[i], bytes->values[i] + 1e-6f) << "rounded up";
      EXPECT_LE(bytes->values[i], floats->values[i] + 1.001f / 255);
    }
  }
}

TEST(ReferenceCommand, ACropIsAPartOfThePicture) {
  const Folder folder;
  ExpectSuccess(RunFur(Arguments(folder)));
  const fur::Image whole = Picture(folder / "x.png");
  ExpectSuccess(RunFur(Arguments(folder, {"--crop", "30,20,24,16"})));
  const fur::Image part = Picture(folder / "x.png");
  ASSERT_EQ(part.width, 24u);
  ASSERT_EQ(part.height, 16u);
  for (uint32_t y = 0; y < 16; ++y)
    EXPECT_TRUE(std::equal(&part.pixels[size_t{y} * 24 * 4], &part.pixels[size_t{y} * 24 * 4] + 24 * 4,
                           &whole.pixels[(size_t{y + 20} * 96 + 30) * 4]))
        << y;
}

// What render makes of the same flags with many shells is closer to it than the plain coat is: in the opacity of the
// fringe, or in the colours of the mask.
void ExpectHonoured(const std::vector<std::string>& groom, bool inFringe) {
  SCOPED_TRACE(groom[0]);
  const Folder folder;
  const std::string length = inFringe ? "0.35" : "0.07";
  const auto with = [&](std::vector<std::string> flags) {
    flags.insert(flags.end(), groom.begin(), groom.end());
    return flags;
  };
  const auto flags = [&](const std::string& name) {
    return Arguments(folder, {"--spp", "4", "--mask", folder / "mask.png", "--band", folder / "band.png", "-o",
                              folder / name, "--fur-length", length});
  };
  ExpectSuccess(RunFur(flags("plain.exr")));
  ExpectSuccess(RunFur(with(flags("groomed.exr"))));
  ExpectSuccess(RunFur(with({"render", "-o", folder / "shells.exr", "--size", "96x60", "--shells", "96", "--samples",
                             "4", "--no-fins", "--fur-length", length})));
  const auto distance = [&](const std::string& name) {
    const nlohmann::json j = Compared(folder, name, "shells.exr");
    return (inFringe ? j["band"]["opacity_rmse"] : j["mask"]["rmse"]).get<double>();
  };
  EXPECT_LT(distance("groomed.exr") * (inFringe ? 2 : 1.3), distance("plain.exr"));
}

TEST(ReferenceCommand, HonoursWhereFurStands) {
  ExpectHonoured({"--wind-strength", "4", "--time", "1.3"}, true);
  ExpectHonoured({"--gravity", "1"}, true);
  ExpectHonoured({"--comb", "0,-1,0", "--comb-strength", "3", "--bend", "1.5"}, true);
}

TEST(ReferenceCommand, HonoursWhatFurIs) {
  ExpectHonoured({"--tip-color", "1.5,0.5,0.3", "--color-from-base", "0.5"}, false);
  ExpectHonoured({"--density", "0.2"}, false);
  ExpectHonoured({"--thickness", "0.3"}, false);
  ExpectHonoured({"--wetness", "1"}, false);
}

TEST(ReferenceCommand, RefusesInWords) {
  const Folder folder;
  for (const std::vector<std::string>& flags : std::vector<std::vector<std::string>>{{"--crop", "90,0,10,10"},
                                                                                     {"--crop", "1,2,3"},
                                                                                     {"--crop", "-1,0,5,5"},
                                                                                     {"--spp", "0"},
                                                                                     {"--tolerance", "nan"},
                                                                                     {"--threads", "-1"},
                                                                                     {"--mask", "m.jpg"},
                                                                                     {"--band", "b.bmp"},
                                                                                     {"--size", "0x3"},
                                                                                     {"--look", "nice"}})
    ExpectFailure(RunFur(Arguments(folder, flags)), kUsage, {flags[0]});
  ExpectFailure(RunFur({"reference", "-o", folder / "x.bmp"}), kUsage, {".png"});
  ExpectFailure(RunFur(Arguments(folder, {"--mask", folder / "x.png"})), kUsage, {"twice"});
  ExpectFailure(RunFur(Arguments(folder, {folder / "none.gltf"})), kInputMissing, {"none.gltf"});
  ExpectFailure(RunFur(Arguments(folder, {"--band", "/proc/b.png"})), kOutputFailed, {"/proc/b.png"});
  EXPECT_TRUE(folder.Content().empty());
}

}  // namespace
}  // namespace app::test

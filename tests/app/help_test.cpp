// What the program says about itself.
#include "program.h"

namespace app::test {
namespace {

TEST(Help, NamesTheCommands) {
  const Outcome o = RunFur({"--help"});
  ExpectSuccess(o);
  for (const char* word : {"render", "reference", "bench", "bake", "compare", "info", "--version", "Exit codes"})
    EXPECT_NE(o.out.find(word), std::string::npos) << word << " is not in:\n" << o.out;
}

TEST(Help, RenderNamesEveryFlag) {
  const Outcome o = RunFur({"render", "--help"});
  ExpectSuccess(o);
  for (const char* flag :
       {"-o",          "--output", "--backend",  "--size",    "--samples",   "--technique", "--look",
        "--semantics", "--shells", "--eye",      "--target",  "--fov",       "--count",     "--repeat",
        "--stats",     "--fur",    "--groom",    "--wetness", "--time",      "--validate",  "--preset",
        "--coat",      "--dead-zone", "--no-fins", "--no-shells", "MODEL"})
    EXPECT_NE(o.out.find(flag), std::string::npos) << flag << " is not in:\n" << o.out;
}

TEST(Help, CompareNamesEveryFlag) {
  const Outcome o = RunFur({"compare", "--help"});
  ExpectSuccess(o);
  for (const char* flag : {"--json", "--heat", "--heat-scale", "--mask", "--band", "--ppd", "--max-flip",
                           "--max-mask-flip", "--max-rmse", "--max-difference", "--min-ssim", "--min-psnr",
                           "--max-differing-share"})
    EXPECT_NE(o.out.find(flag), std::string::npos) << flag << " is not in:\n" << o.out;
}

TEST(Help, ReferenceNamesEveryFlag) {
  const Outcome o = RunFur({"reference", "--help"});
  ExpectSuccess(o);
  for (const char* flag : {"--output", "--mask", "--band", "--spp", "--seed", "--threads", "--tolerance", "--crop",
                           "--cache", "--no-cache", "--size", "--look", "--groom", "--time", "MODEL"})
    EXPECT_NE(o.out.find(flag), std::string::npos) << flag << " is not in:\n" << o.out;
}

TEST(Help, BenchNamesEveryFlag) {
  const Outcome o = RunFur({"bench", "--help"});
  ExpectSuccess(o);
  for (const char* flag : {"--quick", "--list", "--scenes", "--configs", "--techniques", "--backend", "--size", "--rounds",
                           "--spp", "--json", "--html", "--agree", "--assets", "--cache", "--no-cache"})
    EXPECT_NE(o.out.find(flag), std::string::npos) << flag << " is not in:\n" << o.out;
}

TEST(Help, VersionIsOneLine) {
  const Outcome o = RunFur({"--version"});
  ExpectSuccess(o);
  EXPECT_EQ(o.out.rfind("fur ", 0), 0u) << o.out;
  EXPECT_EQ(std::count(o.out.begin(), o.out.end(), '\n'), 1);
}

TEST(Help, InfoListsAdaptersOfBothBackends) {
  const Outcome o = RunFur({"info"});
  ExpectSuccess(o);
  for (const char* word : {"vulkan: ", "gl: ", "driver", "geometry shader"})
    EXPECT_NE(o.out.find(word), std::string::npos) << word << " is not in:\n" << o.out;
  EXPECT_EQ(o.out.find(": 0 adapters"), std::string::npos) << o.out;
}

TEST(Help, InfoTakesNoArguments) { ExpectFailure(RunFur({"info", "--nonsense"}), kUsage, {"--nonsense"}); }

}  // namespace
}  // namespace app::test

// --coat: pictures on both backends, names, files, messages.
#include "program.h"

namespace app::test {
namespace {

fur::Image RenderBoth(const std::vector<std::string>& flags) {
  const Folder folder;
  std::vector<std::string> all{"render", "-o",    folder / "x.png", "--backend", "both",
                               "--size", "96x80", "--repeat",       "0",         "--stats", folder / "s.json"};
  all.insert(all.end(), flags.begin(), flags.end());
  ExpectSuccess(RunFur(all));
  EXPECT_EQ(ReadJson(folder / "s.json").value("/difference/differing"_json_pointer, -1), 0);
  return Picture(folder / "x.vulkan.png");
}

std::vector<std::string> Names() {
  const Outcome o = RunFur({"info", "--coats"});
  EXPECT_EQ(o.exitCode, 0);
  std::vector<std::string> names;
  for (size_t at = 0; at < o.out.size(); at = o.out.find('\n', at) + 1)
    names.push_back(o.out.substr(at, o.out.find(' ', at) - at));
  return names;
}

// Each one's picture: fur.coat of the conformance suite.
TEST(Coats, ANameChoosesTheCoat) {
  const std::vector<std::string> names = Names();
  EXPECT_EQ(names.size(), 9u);
  const fur::Image plain = RenderBoth({}), first = RenderBoth({"--coat", names.front()}),
                   last = RenderBoth({"--coat", names.back()});
  EXPECT_GT(DifferingPixels(plain, first), 900u);
  EXPECT_GT(DifferingPixels(plain, last), 900u);
  EXPECT_GT(DifferingPixels(first, last), 900u);
}

TEST(Coats, FlagsWinOverTheCoat) {
  const fur::Image plain = RenderBoth({"--coat", "sheep"});
  EXPECT_GT(DifferingPixels(plain, RenderBoth({"--coat", "sheep", "--wetness", "1"})), 300u);
  EXPECT_GT(DifferingPixels(plain, RenderBoth({"--coat", "sheep", "--fur-length", "0.2"})), 300u);
}

TEST(Coats, FilesAreReadAndBakedOnesWritten) {
  const Folder folder;
  const std::string file =
      folder.Write("mine.json", R"({"strands": {"size": 16, "layers": 4}, "markings": {"base": [0.1, 0.2, 0.9]}})");
  RenderBoth({"--coat", file});
  ExpectSuccess(RunFur({"bake", "--coat", file, "-o", folder / "baked", "--seed", "5"}));
  EXPECT_EQ(ReadJson(folder / "baked" + "/coat.json")["strands"]["size"], 16);
  EXPECT_EQ(ReadJson(folder / "baked" + "/coat.json")["strands"]["seed"], 5);
  ExpectSuccess(RunFur({"bake", "--coat", "plush", "-o", folder / "plush", "--size", "16", "--no-mips"}));
  EXPECT_EQ(ReadJson(folder / "plush" + "/coat.json")["strands"]["tile"], 6);
}

TEST(Coats, BadOnesAreRefused) {
  const Folder folder;
  ExpectRenderFailure({"--coat", "zebra"}, kUsage, {"zebra", "house-cat", "snow-leopard", "husky"});
  ExpectRenderFailure({"--coat", folder / "no.json"}, kInputMissing, {"no.json"});
  for (const auto& [text, word] : {std::pair{R"({"fur": {}})", "\"fur\""},
                                   {R"({"markings": {"layers": [{"scale": "big"}]}})", "layers[0].scale"},
                                   {R"({"groom": {"wetness": -1}})", "wetness"},
                                   {R"({"length": 2})", "length"},
                                   {R"({"strands": {"size": 2048, "layers": 256}})", "texels"}}) {
    const std::string file = folder.Write("bad.json", text);
    ExpectRenderFailure({"--coat", file}, text[2] == 's' ? kUsage : kInputMalformed, {"bad.json", word});
  }
  ExpectFailure(RunFur({"bake", "--coat", "zebra", "-o", folder / "z"}), kUsage, {"zebra", "tiger"});
}

}  // namespace
}  // namespace app::test

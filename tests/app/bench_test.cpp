// fur bench from the outside: the plan, the JSON, the page in a browser, its time.
#include <algorithm>
#include <chrono>
#include <cstdlib>

#include "program.h"

namespace app::test {
namespace {

const std::vector<std::string> kTiny{"--size",    "96x54",    "--spp",       "2",         "--rounds",
                                     "3",         "--scenes", "builtin-far", "--configs", "shells-4,shells-no-fins",
                                     "--no-cache"};

std::vector<std::string> Bench(const std::vector<std::string>& more) {
  std::vector<std::string> arguments{"bench"};
  arguments.insert(arguments.end(), more.begin(), more.end());
  return arguments;
}

std::vector<std::string> Tiny(const std::vector<std::string>& more = {}) {
  std::vector<std::string> arguments = Bench(kTiny);
  arguments.insert(arguments.end(), more.begin(), more.end());
  return arguments;
}

TEST(BenchCommand, ListsItsPlan) {
  const Outcome all = RunFur(Bench({"--list"}));
  ExpectSuccess(all);
  for (const char* name :
       {"builtin-far", "cat-100-near-turntable", "plushy-near", "seed ", "shells ", "shells-64", "seedlook-8"})
    EXPECT_NE(all.out.find(name), std::string::npos) << name << "\n" << all.out;
  const Outcome few = RunFur(Bench({"--list", "--scenes", "fox*", "--configs", "shells-fins*", "--quick"}));
  ExpectSuccess(few);
  EXPECT_EQ(Count(few.out, "fox"), 3 * 4u) << few.out;  // name and file of each
  EXPECT_EQ(Count(few.out, "shells-fins"), 2u);
  EXPECT_NE(few.out.find("  seed "), std::string::npos) << "always there";
  EXPECT_EQ(few.out.find("cat"), std::string::npos);
  const Outcome seed = RunFur(Bench({"--list", "--techniques", "seed"}));
  ExpectSuccess(seed);
  EXPECT_EQ(seed.out.find("shells-"), std::string::npos);
}

TEST(BenchCommand, JsonHoldsEverything) {
  const Folder folder;
  const Outcome o = RunFur(Tiny({"--json", folder / "b.json"}));
  ExpectSuccess(o);
  const nlohmann::json j = ReadJson(folder / "b.json");
  EXPECT_EQ(j["fur_bench"], 1);
  for (const char* key : {"host", "system", "cpu", "cores", "build", "compiler", "version", "date", "command",
                          "load_at_start", "load_at_end", "seconds"})
    EXPECT_TRUE(j["context"].contains(key)) << key;
  EXPECT_NE(j["context"]["command"].get<std::string>().find("shells-no-fins"), std::string::npos);
  ASSERT_EQ(j["scenes"].size(), 1u);
  const nlohmann::json& scene = j["scenes"][0];
  EXPECT_EQ(scene["references"].size(), 2u) << "seed's look and ours";
  ASSERT_EQ(scene["results"].size(), 3 * 2u) << "the seed and two, on two backends";
  for (const nlohmann::json& r : scene["results"]) {
    SCOPED_TRACE(r["config"]);
    for (const char* key : {"backend", "driver", "technique", "look", "semantics", "shells", "samples", "note",
                            "pareto", "default", "first_frame_ms", "draws", "triangles"})
      EXPECT_TRUE(r.contains(key)) << key;
    EXPECT_EQ(r["frame_ms"]["rounds"].size(), 3u);
    EXPECT_GT(r["frame_ms"]["median"].get<double>(), 0);
    EXPECT_LE(r["frame_ms"]["q1"].get<double>(), r["frame_ms"]["q3"].get<double>());
    EXPECT_LE(r["ratio"]["low"].get<double>(), r["ratio"]["median"].get<double>());
    EXPECT_LE(r["ratio"]["median"].get<double>(), r["ratio"]["high"].get<double>());
    EXPECT_NEAR(r["ratio"]["coverage"].get<double>(), 0.75, 1e-9);
    for (const char* key : {"mask_flip", "mask_rmse", "rmse", "flip", "flip_p99"}) {
      EXPECT_GT(r["error"][key].get<double>(), 0) << key;
      EXPECT_LT(r["error"][key].get<double>(), 1) << key;
    }
    EXPECT_EQ(r["error"]["band_opacity_rmse"].is_null(), r["technique"] == "seed");
    EXPECT_GT(r["fragments"]["shells"].get<int>(), 0);
    if (r["config"] != "seed") continue;
    EXPECT_EQ(r["ratio"]["low"], 1.0);
    EXPECT_EQ(r["ratio"]["high"], 1.0);
  }
  const auto rounds = [&](size_t i) { return scene["results"][i]["frame_ms"]["rounds"].get<std::vector<double>>(); };
  for (const size_t seed : {0u, 3u})
    for (size_t i = seed; i < seed + 3; ++i) {
      std::vector<double> ratios;
      for (size_t k = 0; k < 3; ++k) ratios.push_back(rounds(i)[k] / rounds(seed)[k]);
      std::sort(ratios.begin(), ratios.end());
      EXPECT_DOUBLE_EQ(scene["results"][i]["ratio"]["median"].get<double>(), ratios[1]) << "paired by rounds";
    }
  // Both backends draw the same picture, so they have the same error.
  for (size_t i = 0; i < 3; ++i)
    EXPECT_EQ(scene["results"][i]["error"], scene["results"][i + 3]["error"]) << scene["results"][i]["config"];
}

TEST(BenchCommand, AgreesWithItselfAndNotWithAnother) {
  const Folder folder;
  ExpectSuccess(RunFur(Tiny({"--json", folder / "b.json", "--backend", "gl"})));
  nlohmann::json j = ReadJson(folder / "b.json");
  for (nlohmann::json& r : j["scenes"][0]["results"]) r["ratio"]["low"] = 0, r["ratio"]["high"] = 1e6;
  const std::string wide = folder.Write("wide.json", j.dump());
  const Outcome same = RunFur(Tiny({"--agree", wide, "--backend", "gl"}));
  ExpectSuccess(same);
  EXPECT_NE(same.out.find("3 of 3 ratios agree"), std::string::npos) << same.out;
  j["scenes"][0]["results"][1]["ratio"]["low"] = 1e5;
  const Outcome apart = RunFur(Tiny({"--agree", folder.Write("apart.json", j.dump()), "--backend", "gl"}));
  EXPECT_EQ(apart.exitCode, kComparisonFailed);
  EXPECT_NE(apart.out.find("apart: builtin-far gl"), std::string::npos) << apart.out;
}

TEST(BenchCommand, LeavesOutWhatIsNotThere) {
  const Folder folder;
  std::vector<std::string> arguments =
      Tiny({"--assets", folder / "none", "--backend", "gl", "--json", folder / "b.json"});
  *std::find(arguments.begin(), arguments.end(), "builtin-far") = "builtin-far,fox-far";
  const Outcome o = RunFur(arguments);
  EXPECT_EQ(o.exitCode, kSuccess);
  EXPECT_NE(o.err.find("fox-far"), std::string::npos) << o.err;
  EXPECT_EQ(ReadJson(folder / "b.json")["skipped"].size(), 1u);
}

TEST(BenchCommand, RefusesInWords) {
  const Folder folder;
  const std::vector<std::pair<std::vector<std::string>, std::string>> bad{{{"--scenes", "dog-far"}, "dog-far"},
                                                                          {{"--configs", "shell-4"}, "shell-4"},
                                                                          {{"--techniques", "slabs"}, "slabs"},
                                                                          {{"--rounds", "0"}, "--rounds"},
                                                                          {{"--spp", "1"}, "--spp"},
                                                                          {{"--backend", "d3d"}, "--backend"},
                                                                          {{"--size", "0x9"}, "--size"},
                                                                          {{"--scenes", "cat*,,fox*"}, "--scenes"}};
  for (const auto& [flags, word] : bad) ExpectFailure(RunFur(Bench(flags)), kUsage, {word});
  ExpectFailure(RunFur(Bench({"--json", folder / "x", "--html", folder / "x"})), kUsage, {"same file"});
  ExpectFailure(RunFur(Bench({"--html", "/proc/x.html"})), kOutputFailed, {"/proc/x.html"});
  ExpectFailure(RunFur(Tiny({"--agree", folder / "none.json"})), kInputMissing, {"none.json"});
  ExpectFailure(RunFur(Tiny({"--agree", folder.Write("no.json", "[1")})), kInputMalformed, {"no.json"});
  ExpectFailure(RunFur(Bench({"--scenes", "fox-far", "--assets", folder / "none"})), kInputMissing, {"fox.glb"});
}

// Looks at the page as its readers do. "" without Chromium.
std::string DomInChromium(const std::string& page, const Folder& folder) {
  if (std::system("command -v chromium > /dev/null 2>&1") != 0) return "";
  const std::string dom = folder / "dom.txt";
  const std::string command = "timeout 100 chromium --headless --no-sandbox --disable-gpu --user-data-dir='" +
                              (folder / "profile") + "' --window-size=1400,1000 --dump-dom 'file://" + page + "' > '" +
                              dom + "' 2> /dev/null";
  EXPECT_EQ(std::system(command.c_str()), 0);
  return ReadText(dom);
}

// Appended to a copy of the page: writes what it finds wrong into the document's title.
constexpr const char* kInspector = R"(<script>
addEventListener('load', () => {
  const wrong = [];
  const boxes = [...document.querySelectorAll('svg')].map(s =>
    [...s.querySelectorAll('text')].map(t => [t.textContent, t.getBoundingClientRect()]));
  for (const texts of boxes)
    for (let i = 0; i < texts.length; ++i)
      for (let k = 0; k < i; ++k) {
        const [a, b] = [texts[i][1], texts[k][1]];
        const over = Math.min(a.right, b.right) - Math.max(a.left, b.left),
              high = Math.min(a.bottom, b.bottom) - Math.max(a.top, b.top);
        if (over > 1 && high > 3)
          wrong.push('overlap of ' + texts[i][0] + ' and ' + texts[k][0]);
      }
  for (const image of document.images)
    if (!image.complete || image.naturalWidth < 90) wrong.push('broken ' + image.alt);
  for (const e of document.querySelectorAll('svg *'))
    for (const a of e.attributes) if (/NaN|inf/.test(a.value)) wrong.push('no number in ' + a.name);
  if (document.documentElement.scrollWidth > innerWidth) wrong.push('wider than the window');
  document.title = 'inspected: ' + (wrong.join('; ') || 'fine') + ', ' +
    document.querySelectorAll('tbody tr').length + ' rows';
});
</script>)";

TEST(BenchCommand, ThePageIsWholeInABrowser) {
  const Folder folder;
  // A name that would break a page that does not escape it.
  const std::string json = folder / "<i>&\"'.json", page = folder / "page.html";
  // Many configurations: their labels have to share the plot.
  std::vector<std::string> arguments = Tiny({"--json", json, "--html", page, "--backend", "gl"});
  *std::find(arguments.begin(), arguments.end(), "shells-4,shells-no-fins") = "shells*";
  ExpectSuccess(RunFur(arguments));
  const size_t rows = ReadJson(json)["scenes"][0]["results"].size();
  EXPECT_GT(rows, 12u);
  const std::string html = ReadText(page);
  EXPECT_EQ(html.find("<i>"), std::string::npos);
  EXPECT_NE(html.find("&lt;i&gt;&amp;&quot;&#39;.json"), std::string::npos);
  EXPECT_EQ(html.find("http"), std::string::npos) << "needs no network";
  EXPECT_EQ(Count(html, "<svg"), 1u);
  EXPECT_EQ(Count(html, "<img"), 3 + 2 * rows) << "references, pictures, error maps";
  const std::string dom = DomInChromium(folder.Write("inspected.html", html + kInspector), folder);
  if (dom.empty()) GTEST_SKIP() << "chromium is not installed: the page was not opened";
  EXPECT_NE(dom.find("<title>inspected: fine, " + std::to_string(7 + rows) + " rows</title>"), std::string::npos)
      << dom.substr(dom.find("<title>"), 600) << "\n7 rows of context";
}

// The promise is three minutes for everything; with the built-in animal alone and one backend it has ample room.
TEST(BenchCommand, QuickKeepsItsTime) {
  const Folder folder;
  const auto start = std::chrono::steady_clock::now();
  const Outcome o = RunFur(
      Bench({"--quick", "--no-cache", "--scenes", "builtin-far", "--backend", "gl", "--json", folder / "b.json"}), 200);
  ExpectSuccess(o);
  EXPECT_LT(std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count(), 180);
  EXPECT_GE(ReadJson(folder / "b.json")["scenes"][0]["results"].size(), 5u);
}

}  // namespace
}  // namespace app::test

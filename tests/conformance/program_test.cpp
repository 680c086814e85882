// fur_conformance from the outside: flags, exit codes, files, the page in a browser.
#include "../app/program.h"

#include <algorithm>
#include <cstdlib>
#include <regex>
#include <sstream>

namespace conformance {
namespace {

using app::test::Count;
using app::test::Folder;
using app::test::Outcome;
using app::test::ReadJson;
using app::test::ReadText;
using app::test::RunFur;  // runs fur_conformance here: FUR_PROGRAM

std::vector<std::string> Lines(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);) lines.push_back(line);
  return lines;
}

void ExpectRefused(const std::vector<std::string>& flags, int code, const std::string& word) {
  const Outcome o = RunFur(flags);
  EXPECT_EQ(o.exitCode, code) << o.err;
  EXPECT_EQ(o.err.rfind("fur_conformance: error: ", 0), 0u) << o.err;
  EXPECT_EQ(Lines(o.err).size(), 1u) << o.err;
  EXPECT_NE(o.err.find(word), std::string::npos) << o.err;
}

TEST(ConformanceProgram, ListsNamesByTheRule) {
  const Outcome o = RunFur({"--list"});
  ASSERT_EQ(o.exitCode, 0) << o.err;
  const std::vector<std::string> names = Lines(o.out);
  EXPECT_GT(names.size(), 500u);
  const std::regex rule("[a-z0-9]+\\.[a-z0-9_]+(/[A-Za-z0-9_]+)?\\.(vulkan|gl|both|cpu)");
  for (const std::string& name : names) EXPECT_TRUE(std::regex_match(name, rule)) << name;
  const Outcome few = RunFur({"--list", "--filter", "blend.factor_op/src_alpha_*.gl,-*min.gl,-*max.gl"});
  EXPECT_EQ(few.out,
            "blend.factor_op/src_alpha_add.gl\nblend.factor_op/src_alpha_subtract.gl\n"
            "blend.factor_op/src_alpha_rev_subtract.gl\nblend.factor_op/src_alpha_sat_add.gl\n"
            "blend.factor_op/src_alpha_sat_subtract.gl\nblend.factor_op/src_alpha_sat_rev_subtract.gl\n");
}

// Every case is in one shard, beside its twin.
TEST(ConformanceProgram, ShardsAreAPartition) {
  std::vector<std::string> together = Lines(RunFur({"--list"}).out), parts;
  for (const char* shard : {"1/3", "2/3", "3/3"}) {
    const std::vector<std::string> part = Lines(RunFur({"--list", "--shard", shard}).out);
    EXPECT_GT(part.size(), together.size() / 4);
    const auto on = [&](const char* end) {
      return std::count_if(part.begin(), part.end(), [&](const std::string& n) { return n.ends_with(end); });
    };
    EXPECT_EQ(on(".vulkan"), on(".gl"));
    parts.insert(parts.end(), part.begin(), part.end());
  }
  std::sort(together.begin(), together.end());
  std::sort(parts.begin(), parts.end());
  EXPECT_EQ(parts, together);
}

TEST(ConformanceProgram, RefusesInWords) {
  const Folder folder;
  ExpectRefused({"--filter", "no.such"}, 2, "no.such");
  ExpectRefused({"--shard", "3/2"}, 2, "--shard");
  ExpectRefused({"--shard", "1/2x"}, 2, "--shard");
  ExpectRefused({"--require", "metal:x"}, 2, "vulkan:NAME");
  ExpectRefused({"--colour"}, 2, "--colour");
  ExpectRefused({"--json", folder / "x", "--html", folder / "x"}, 2, "same file");
  ExpectRefused({"--assets", folder / "none"}, 3, "--assets");
  ExpectRefused({"--json", "/proc/x.json"}, 5, "/proc/x.json");
  ExpectRefused({"--require", "gl:no such driver"}, 6, "no such driver");
  ExpectRefused({"--require", "vulkan:lavapipe", "--adapter", "vulkan:no such adapter"}, 6, "no such adapter");
  EXPECT_EQ(folder.Content(), std::set<std::string>{});
}

TEST(ConformanceProgram, SoftpipeIsRefusedInWords) {
  setenv("GALLIUM_DRIVER", "softpipe", 1);
  const Outcome o = RunFur({"--require", "gl:softpipe"});
  unsetenv("GALLIUM_DRIVER");
  EXPECT_EQ(o.exitCode, 6);
  EXPECT_NE(o.err.find("OpenGL 4.5 core is needed"), std::string::npos) << o.err;
}

TEST(ConformanceProgram, RequiredDriversAreFoundByEitherName) {
  const Outcome o = RunFur(
      {"--require", "vulkan:lavapipe,gl:llvmpipe", "--require", "vulkan:llvmpipe", "--filter", "device.caps_sane.*"});
  EXPECT_EQ(o.exitCode, 0) << o.err << o.out;
  EXPECT_NE(o.out.find("2 cases: 2 passed"), std::string::npos) << o.out;
}

// Whatever the report, it says the same.
TEST(ConformanceProgram, ReportsAgree) {
  const Folder folder;
  const Outcome o = RunFur({"--filter", "blend.write_mask.*,sampler.border/*,device.message*", "--json",
                            folder / "r.json", "--junit", folder / "r.xml", "--html", folder / "r.html"});
  ASSERT_EQ(o.exitCode, 0) << o.out << o.err;
  const nlohmann::json j = ReadJson(folder / "r.json");
  EXPECT_EQ(j["cases"].size(), 9u);
  EXPECT_EQ(j["passed"], 9);
  EXPECT_EQ(j["drivers"][0]["key"], "vulkan:lavapipe");
  const std::string xml = ReadText(folder / "r.xml"), html = ReadText(folder / "r.html");
  EXPECT_EQ(Count(xml, "<testcase "), 9u + 1) << "and the run as a whole";
  EXPECT_NE(xml.find("tests=\"10\" failures=\"0\""), std::string::npos) << xml.substr(0, 300);
  EXPECT_EQ(Count(html, "<tr class="), 9u);
  EXPECT_EQ(Count(html, "alt=\"FLIP\""), 8u) << "the case without pictures has none";
  EXPECT_EQ(html.find("http"), std::string::npos) << "needs no network";
  for (const nlohmann::json& c : j["cases"]) {
    EXPECT_NE(xml.find("name=\"" + c["name"].get<std::string>() + "\""), std::string::npos);
    if (c["backend"] == "gl") {
      EXPECT_GE(c["vulkan_against_gl"]["pictures"], 1) << c["name"];
      EXPECT_EQ(c["vulkan_against_gl"]["differing"], 0) << c["name"];
    }
  }
}

TEST(ConformanceProgram, ReadBacksAreTheBytesOfThePictures) {
  const Folder folder;
  for (const char* backend : {"vulkan", "gl"})
    EXPECT_EQ(RunFur({"--filter", std::string("blend.write_mask.") + backend, "--read-backs", folder / backend}).exitCode, 0);
  const std::string bytes = ReadText(folder / "gl");
  EXPECT_GT(bytes.size(), 100u);
  EXPECT_TRUE(bytes == ReadText(folder / "vulkan"));
  ExpectRefused({"--read-backs", "/proc/x"}, 5, "/proc/x");
}

TEST(ConformanceProgram, APlantedDifferenceFails) {
  const Folder folder;
  const Outcome o =
      RunFur({"--plant", "--filter", "planted.*", "--json", folder / "r.json", "--junit", folder / "r.xml"});
  EXPECT_EQ(o.exitCode, 8) << o.out;
  std::map<std::string, std::string> results;
  const nlohmann::json j = ReadJson(folder / "r.json");
  for (const nlohmann::json& c : j["cases"]) results[c["name"]] = c["result"];
  const std::map<std::string, std::string> expected{
      {"planted.one_lsb.cpu", "FAILED"},  {"planted.message.vulkan", "FAILED"}, {"planted.skip.gl", "FAILED"},
      {"planted.bytes.vulkan", "passed"}, {"planted.bytes.gl", "FAILED"},       {"planted.pictures.both", "FAILED"}};
  EXPECT_EQ(results, expected);
  EXPECT_EQ(Count(ReadText(folder / "r.xml"), "<failure "), 5u);
}

// Looks at the page as its readers do. "" without Chromium.
std::string DomInChromium(const std::string& page, const std::string& hash, const Folder& folder) {
  if (std::system("command -v chromium > /dev/null 2>&1") != 0) return "";
  const std::string dom = folder / "dom.txt";
  const std::string command = "timeout 100 chromium --headless --no-sandbox --disable-gpu --user-data-dir='" +
                              (folder / "profile") + "' --window-size=1400,1000 --dump-dom 'file://" + page + "#" +
                              hash + "' > '" + dom + "' 2> /dev/null";
  EXPECT_EQ(std::system(command.c_str()), 0);
  return ReadText(dom);
}

// Appended to a copy of the page: uses its filters and writes what they show into the document's title.
constexpr const char* kInspector = R"(<script>
addEventListener('load', () => {
  const shown = () => rows.filter(r => r.offsetParent !== null).length;
  const set = (name, value) => { form.elements[name].value = value; form.dispatchEvent(new Event('input')); };
  const wrong = [], counts = [rows.length, shown()];
  for (const [name, value] of [['area', 'planted'], ['driver', 'gl:llvmpipe'], ['result', 'FAILED'], ['name', 'write_mask']]) {
    set(name, value);
    counts.push(shown());
    set(name, '');
  }
  set('area', 'planted'); set('driver', 'gl:llvmpipe'); set('result', 'passed');
  counts.push(shown());
  const bad = document.querySelector('tr[data-name="planted.one_lsb.cpu"]');
  if (bad.querySelector('.r').textContent != 'FAILED') wrong.push('the planted case is not shown as failed');
  const pictures = bad.querySelectorAll('img').length;
  if (pictures != 4) wrong.push('the planted case has ' + pictures + ' pictures');
  for (const i of document.images) if (!i.complete || !i.naturalWidth) wrong.push('broken ' + i.alt);
  const c = document.createElement('canvas').getContext('2d');
  const pixel = alt => {
    c.drawImage(bad.querySelector('img[alt="' + alt + '"]'), 0, 0);
    return [...c.getImageData(1, 0, 1, 1).data].slice(0, 3).join();
  };
  if (pixel('reference') != '128,128,128' || pixel('result') != '129,128,128') wrong.push('pictures ' + pixel('result'));
  if (pixel('difference x16') != '16,0,0') wrong.push('difference ' + pixel('difference x16'));
  if (document.documentElement.scrollWidth > innerWidth) wrong.push('wider than the window');
  document.title = 'inspected: ' + (wrong.join('; ') || 'fine') + ': ' + counts.join(' ');
});
</script>)";

TEST(ConformanceProgram, ThePageWorksInABrowser) {
  const Folder folder;
  const Outcome o = RunFur({"--plant", "--filter", "planted.*,blend.write_mask.*,sampler.border/*", "--html",
                            folder / "r.html", "--json", folder / "r.json"});
  ASSERT_EQ(o.exitCode, 8) << o.err;
  const nlohmann::json j = ReadJson(folder / "r.json");
  const auto count = [&](const char* key, const std::string& value) {
    return std::count_if(j["cases"].begin(), j["cases"].end(), [&](const nlohmann::json& c) {
      const std::string words = " " + c[key].get<std::string>() + " ";
      return words.find(" " + value + " ") != std::string::npos;
    });
  };
  // All pictures at once: the browser is looked at when they are there.
  const std::string page = std::regex_replace(ReadText(folder / "r.html"), std::regex("loading=\"lazy\" "), "");
  const std::string inspected = folder.Write("inspected.html", page + kInspector);
  const std::string dom = DomInChromium(inspected, "", folder);
  if (dom.empty()) GTEST_SKIP() << "chromium is not installed: the page was not opened";
  std::ostringstream expected;
  expected << "<title>inspected: fine: " << j["cases"].size() << ' ' << j["cases"].size() << ' '
           << count("area", "planted") << ' ' << count("driver", "gl:llvmpipe") << ' ' << j["failed"] << " 2 0</title>";
  EXPECT_NE(dom.find(expected.str()), std::string::npos)
      << expected.str() << "\nbut: " << dom.substr(dom.find("<title>"), 400);
  const std::string linked = DomInChromium(folder / "r.html", "area=blend&result=passed", folder);
  EXPECT_NE(linked.find(">2 of " + std::to_string(j["cases"].size()) + " cases<"), std::string::npos)
      << "a link with filters";
}

}  // namespace
}  // namespace conformance

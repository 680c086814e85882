// The suite about itself: its names, its tables of limits, its rule of skips.
#include <fstream>
#include <map>
#include <set>
#include <sstream>

#include "names.h"
#include "skips.h"
#include "tolerances.h"

namespace conformance {
namespace {

std::vector<std::string> Lines(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);) {
    line.resize(std::min(line.find('#'), line.size()));
    while (!line.empty() && line.back() == ' ') line.pop_back();
    if (!line.empty()) lines.push_back(line);
  }
  return lines;
}

const char* const kModelCases =
#include "conformance/model_cases.inc"
    ;
const char* const kCeilings =
#include "conformance/ceilings.inc"
    ;

TEST(Suite, EveryModelCaseExists) {
  std::map<std::string, std::set<std::string>> backends;  // by area.case
  for (const CaseName& c : RegisteredCases()) backends[c.area + "." + c.test].insert(c.backend);
  for (const std::string& name : Lines(kModelCases)) {
    ASSERT_TRUE(backends.contains(name)) << name;
    const std::set<std::string>& on = backends[name];
    EXPECT_TRUE(on.contains("both") || on.contains("cpu") || (on.contains("vulkan") && on.contains("gl"))) << name;
  }
}

TEST(Suite, HasEnoughCasesByArea) {
  std::set<std::string> cases;
  for (const CaseName& c : RegisteredCases()) cases.insert(c.area + "." + c.test);
  EXPECT_GE(cases.size(), 120u) << "parameters and backends not counted";
}

TEST(Suite, EveryCaseIsOnBothBackends) {
  std::map<std::string, int> twins;
  for (const CaseName& c : RegisteredCases()) {
    if (c.backend == "vulkan") ++twins[c.Base()];
    if (c.backend == "gl") --twins[c.Base()];
  }
  for (const auto& [name, missing] : twins) EXPECT_EQ(missing, 0) << name;
}

TEST(Suite, NamesFollowTheRule) {
  const CaseName plain = MakeCaseName("Rhi/BlendTest", "WriteMask/vulkan");
  EXPECT_EQ(plain.Full(), "blend.write_mask.vulkan");
  EXPECT_EQ(MakeCaseName("Rhi/BlendFactorTest", "FactorOp/src_alpha_add_gl").Full(),
            "blend.factor_op/src_alpha_add.gl");
  EXPECT_EQ(MakeCaseName("X/FurModelTest", "Picture/cat_both").Full(), "fur.picture/cat.both");
  EXPECT_EQ(MakeCaseName("X/FurModeTest", "Picture/both").Full(), "fur.picture.both");
  EXPECT_EQ(MakeCaseName("DeviceCodes", "MessageCodesStable").Full(), "device.message_codes_stable.cpu");
  EXPECT_EQ(SnakeCase("Update10kNoPassBreak"), "update_10k_no_pass_break");
  EXPECT_EQ(SnakeCase("DepthRange0_1"), "depth_range_0_1");
  EXPECT_EQ(SnakeCase("A2cCoverageBounds"), "a2c_coverage_bounds");
  EXPECT_EQ(SnakeCase("WithoutADraw"), "without_a_draw");
}

TEST(Suite, GlobsMatchWholeNames) {
  EXPECT_TRUE(MatchesGlob("blend.*", "blend.write_mask.gl"));
  EXPECT_TRUE(MatchesGlob("x,blend.*.gl", "blend.write_mask.gl"));
  EXPECT_TRUE(MatchesGlob("blend.write_mas?.gl", "blend.write_mask.gl"));
  EXPECT_FALSE(MatchesGlob("blend", "blend.write_mask.gl"));
  EXPECT_FALSE(MatchesGlob("blend.*.vulkan", "blend.write_mask.gl"));
  EXPECT_FALSE(MatchesGlob("", "blend.write_mask.gl"));
}

TEST(Tolerance, NoneIsWiderThanWhatWasMeasured) {
  for (const Tolerance& t : Tolerances()) {
    EXPECT_EQ(Slack(t, t.measured, t.measuredDiffering), "");
    EXPECT_LE(t.measuredDiffering, t.differing) << t.name;
    EXPECT_LE(t.measured, t.limit) << t.name;
    EXPECT_GT(std::string(t.cause).size(), 10u) << t.name << " has no cause";
  }
}

std::string Row(const std::string& name, const std::string& drivers) { return name + " " + drivers; }

// ceilings.txt: `NAME DRIVERS LIMIT PIXELS [DIFFERING]`. A number there may only be lowered.
TEST(Tolerance, NoneIsWiderThanItsCeiling) {
  struct Ceiling {
    double limit = 0;
    uint64_t pixels = 0;
    double differing = 1;
  };
  std::map<std::string, Ceiling> ceilings;
  for (const std::string& line : Lines(kCeilings)) {
    std::istringstream words(line);
    std::string name, drivers;
    Ceiling ceiling;
    ASSERT_TRUE(words >> name >> drivers >> ceiling.limit >> ceiling.pixels) << line;
    if (!(words >> ceiling.differing)) ceiling.differing = 1;
    ceilings[Row(name, drivers)] = ceiling;
  }
  for (const Tolerance& t : Tolerances()) {
    const auto found = ceilings.find(Row(t.name, t.drivers));
    ASSERT_NE(found, ceilings.end()) << t.name << " on " << t.drivers << " has no line in ceilings.txt";
    EXPECT_LE(t.limit, found->second.limit) << t.name << ": a tolerance only shrinks";
    EXPECT_LE(t.pixels, found->second.pixels) << t.name << ": a tolerance only shrinks";
    EXPECT_LE(t.differing, found->second.differing) << t.name << ": a tolerance only shrinks";
  }
  EXPECT_EQ(ceilings.size(), Tolerances().size()) << "a line of a tolerance that is gone is to go, too";
}

TEST(Tolerance, ALimitThatIsTooWideIsCaught) {
  Tolerance t{"planted", "*", "*", Unit::Lsb, 2, 0, 0, 1, "planted"};
  EXPECT_NE(Slack(t, 1), "");
  EXPECT_EQ(Slack(t, 1.5), "");
  t.unit = Unit::Value;
  EXPECT_NE(Slack(t, 1.9), "");
  EXPECT_EQ(Slack(t, 1.95), "");
  t.differing = 0.001;
  EXPECT_NE(Slack(t, 1.95, 0.0009), "");
  EXPECT_EQ(Slack(t, 1.95, 0.00096), "");
}

TEST(Tolerance, NoParityLimitIsWiderThanWhatWasMeasured) {
  for (const ParityLimit& p : ParityLimits()) {
    if (!p.Compared()) continue;
    EXPECT_LE(p.steps, p.measuredSteps) << p.cases;
    EXPECT_LE(p.differing, p.measuredDiffering) << p.cases;
    EXPECT_LE(p.beyond, p.measuredBeyond) << p.cases;
  }
}

// The required drivers: no difference, but for named cases, and these within 1 LSB on 0.1 % of the pixels.
TEST(Tolerance, RequiredDriversMayHardlyDiffer) {
  for (const ParityLimit& p : ParityLimits()) {
    EXPECT_GT(std::string(p.cause).size(), 10u) << p.cases << " has no cause";
    if (!MatchesGlob(p.drivers, "gl:llvmpipe") || !p.Compared()) continue;
    EXPECT_LE(p.steps, 1) << p.cases;
    EXPECT_LE(p.differing, 0.001) << p.cases;
    EXPECT_EQ(p.beyond, 0) << p.cases;
    EXPECT_EQ(std::string(p.cases).find('*'), std::string::npos) << "named one by one";
  }
}

TEST(Skip, NamesTheCapAndKeepsToTheList) {
  const std::string lacks = "this adapter lacks Caps::geometryShader";
  EXPECT_EQ(SkipProblem("geometry.passthrough", "vulkan:swiftshader", lacks), "");
  EXPECT_NE(SkipProblem("geometry.passthrough", "vulkan:lavapipe", lacks), "");
  EXPECT_NE(SkipProblem("geometry.passthrough", "gl:llvmpipe", lacks), "");
  EXPECT_NE(SkipProblem("buffer.init_readback", "vulkan:swiftshader", lacks), "");
  EXPECT_NE(SkipProblem("geometry.passthrough", "vulkan:swiftshader", "not today"), "") << "no reason from the caps";
  EXPECT_EQ(SkipProblem("fur.picture/cat", "gl:llvmpipe", "no assets: cat/cat.gltf"), "");
}

}  // namespace
}  // namespace conformance

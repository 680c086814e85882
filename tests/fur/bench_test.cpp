// fur/bench.h: the plan's rules, and the statistics against closed forms.
#include "fur/bench.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <set>

namespace fur::test {
namespace {

TEST(BenchPlan, TheSeedIsTheBaseline) {
  const std::vector<BenchConfig> configs = BenchConfigs();
  const RenderSettings& seed = configs.at(0).settings;
  EXPECT_EQ(configs[0].name, "seed");
  EXPECT_TRUE(seed.technique == Technique::Seed && seed.look == Look::Seed && seed.semantics == Semantics::Sheet);
  EXPECT_TRUE(seed.drawFins && seed.drawShells && seed.preset == Preset::DemoFur && seed.shells == 0 &&
              seed.samples == 1);
  EXPECT_TRUE(configs[0].quick) << "in every run";
}

TEST(BenchPlan, NamesAreUniqueAndOneIsTheDefault) {
  std::set<std::string> configs, scenes;
  int defaults = 0;
  for (const BenchConfig& c : BenchConfigs()) {
    EXPECT_TRUE(configs.insert(c.name).second) << c.name;
    EXPECT_EQ(c.name.find_first_of(",* "), std::string::npos) << "filters could not name it";
    EXPECT_FALSE(c.note.empty());
    defaults += c.isDefault;
    const RenderSettings plain, &s = c.settings;
    EXPECT_EQ(c.isDefault, s.technique == plain.technique && s.look == plain.look && s.semantics == plain.semantics &&
                               s.shells == 0 && s.drawFins && s.backFaces && s.sortAnimals && s.samples == 1 &&
                               s.skinSamples == 0 &&
                               s.target == TargetFormat::Auto && s.finMode == FinMode::Auto &&
                               s.shellMode == ShellMode::Sorted)
        << c.name << ": what differs in nothing is the default";
  }
  EXPECT_EQ(defaults, 1);
  for (const BenchScene& s : BenchScenes()) EXPECT_TRUE(scenes.insert(s.name).second) << s.name;
}

// 1, 25 and 100 cats, fox, spot, plushy toy, built-in; near and far; still and turning.
TEST(BenchPlan, HasEverySceneOfTheTask) {
  std::set<std::string> names;
  bool quickWithoutFiles = false;
  for (const BenchScene& s : BenchScenes()) {
    names.insert(s.name);
    quickWithoutFiles |= s.quick && s.file.empty();
    EXPECT_EQ(s.animals, s.name.find("-100") != std::string::npos  ? 100u
                         : s.name.find("-25") != std::string::npos ? 25u
                                                                   : 1u);
    EXPECT_EQ(s.distance < 1, s.name.find("near") != std::string::npos);
    EXPECT_EQ(s.angles > 1, s.name.find("turntable") != std::string::npos);
    EXPECT_TRUE(s.crop[0] + s.crop[2] <= 1 && s.crop[1] + s.crop[3] <= 1);
  }
  for (const std::string subject : {"builtin", "cat", "cat-25", "cat-100", "fox", "spot", "plushy"})
    for (const std::string view : {"-far", "-near", "-far-turntable", "-near-turntable"})
      EXPECT_TRUE(names.contains(subject + view)) << subject << view;
  EXPECT_TRUE(quickWithoutFiles);
}

TEST(BenchPlan, Patterns) {
  EXPECT_TRUE(MatchesAny("cat-far", ""));
  EXPECT_TRUE(MatchesAny("cat-far", "fox-far,cat-far"));
  EXPECT_TRUE(MatchesAny("cat-far", "cat*"));
  EXPECT_TRUE(MatchesAny("cat", "cat*"));
  EXPECT_TRUE(MatchesAny("cat", "*"));
  EXPECT_FALSE(MatchesAny("cat-far", "cat"));
  EXPECT_FALSE(MatchesAny("cat-far", "far*,*far"));
  EXPECT_FALSE(MatchesAny("cat-far", ","));
}

TEST(BenchStatistics, Quartiles) {
  const BenchSummary odd = Summarise({5, 1, 4, 2, 3});
  EXPECT_EQ(odd.median, 3);
  EXPECT_EQ(odd.q1, 2);
  EXPECT_EQ(odd.q3, 4);
  const BenchSummary even = Summarise({4, 1, 3, 2});
  EXPECT_DOUBLE_EQ(even.median, 2.5);
  EXPECT_DOUBLE_EQ(even.q1, 1.75);
  EXPECT_DOUBLE_EQ(even.q3, 3.25);
  EXPECT_EQ(Summarise({7}).q3, 7);
  EXPECT_EQ(Median({}), 0);
}

TEST(BenchStatistics, WhatSlowsARoundCancels) {
  std::vector<double> a, b;
  for (int i = 0; i < 9; ++i) {
    const double load = std::exp2(i % 4);  // up to eight times as slow
    a.push_back(3 * load);
    b.push_back(4 * load);
  }
  const BenchRatio r = PairedRatio(a, b);
  EXPECT_DOUBLE_EQ(r.median, 0.75);
  EXPECT_DOUBLE_EQ(r.low, 0.75);
  EXPECT_DOUBLE_EQ(r.high, 0.75);
}

// k of the table of the sign test (Conover, "Practical Nonparametric Statistics", A3 and 3.2): 1 - 2 sum_{i<k}
// C(n,i)/2^n.
TEST(BenchStatistics, TheIntervalIsOfOrderStatistics) {
  const auto interval = [](int n, double wanted) {
    std::vector<double> a, b(size_t(n), 1.0);
    for (int i = n; i >= 1; --i) a.push_back(i);
    return PairedRatio(a, b, wanted);
  };
  const auto expect = [&](int n, double wanted, double low, double high, double coverage) {
    const BenchRatio r = interval(n, wanted);
    EXPECT_EQ(r.low, low) << n;
    EXPECT_EQ(r.high, high) << n;
    EXPECT_NEAR(r.coverage, coverage, 1e-12) << n;
  };
  expect(8, 0.99, 1, 8, 1 - 2.0 / 256);
  expect(11, 0.99, 1, 11, 1 - 2.0 / 2048);
  expect(12, 0.99, 2, 11, 1 - 2.0 * (1 + 12) / 4096);
  expect(15, 0.99, 3, 13, 1 - 2.0 * (1 + 15 + 105) / 32768);
  expect(15, 0.95, 4, 12, 1 - 2.0 * (1 + 15 + 105 + 455) / 32768);
  expect(3, 0.99, 1, 3, 1 - 2.0 / 8);
  expect(1, 0.99, 1, 1, 0);
  EXPECT_EQ(PairedRatio({}, {}).median, 0);
}

// The interval holds the true median as often as it says, for a skewed distribution with a heavy tail.
TEST(BenchStatistics, TheIntervalHoldsTheMedian) {
  std::mt19937 random(7);
  const std::vector<double> ones(15, 1);
  int held = 0;
  constexpr int kRuns = 4000;
  for (int run = 0; run < kRuns; ++run) {
    std::vector<double> a;
    for (int i = 0; i < 15; ++i) a.push_back(1 / (1 - double(random()) / 4294967296.0));  // Pareto: the median is 2
    const BenchRatio r = PairedRatio(a, ones);
    held += r.low <= 2 && 2 <= r.high;
  }
  const double coverage = 1 - 2.0 * (1 + 15 + 105) / 32768;
  EXPECT_NEAR(double(held) / kRuns, coverage, 4 * std::sqrt(coverage * (1 - coverage) / kRuns));
}

TEST(BenchStatistics, ParetoFront) {
  const std::vector<BenchPoint> points{{1, 5}, {2, 4}, {3, 4}, {4, 1}, {5, 2}, {1, 6}, {1, 5}};
  EXPECT_EQ(ParetoFront(points), (std::vector<bool>{true, true, false, true, false, false, true}));
  EXPECT_TRUE(ParetoFront({}).empty());
}

}  // namespace
}  // namespace fur::test

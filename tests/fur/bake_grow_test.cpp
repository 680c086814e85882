// How strands grow, before anything is sampled.
#include <gtest/gtest.h>

#include <numbers>

#include "bake_helpers.h"
#include "bake_math.h"
#include "torus_points.h"

namespace fur::test {
namespace {

using glm::dvec2;
using glm::dvec3;

TEST(BakeMath, PowerIsPow) {
  for (double x = 0; x <= 1; x += 1.0 / 64)
    for (const double p : {0.0, 0.3, 0.75, 1.0, 2.0, 7.5})
      EXPECT_NEAR(Power(x, p), std::pow(x, p), 1e-10) << x << ' ' << p;
}

TEST(BakeMath, CosSinTurnsIsCosineAndSine) {
  for (double turns = -3; turns <= 3; turns += 1.0 / 128) {
    const dvec2 cs = CosSinTurns(turns);
    EXPECT_NEAR(cs.x, std::cos(turns * 2 * std::numbers::pi), 3e-15) << turns;
    EXPECT_NEAR(cs.y, std::sin(turns * 2 * std::numbers::pi), 3e-15) << turns;
  }
  EXPECT_EQ(CosSinTurns(0.25), dvec2(0, 1));
  EXPECT_EQ(CosSinTurns(100000.5), dvec2(-1, 0));
}

TEST(TorusPoints, NearestIsTheNearestAcrossTheBorder) {
  Pcg32 random(5);
  for (const uint32_t count : {1u, 2u, 7u, 200u}) {
    const TorusPoints points = ThrowRoots(count, 0, &random);
    ASSERT_EQ(points.all().size(), count);
    for (int k = 0; k < 50; ++k) {
      const dvec2 p{random.Uniform(), random.Uniform()};
      const auto distance = [&](dvec2 q) { return glm::length(Nearest(q - p)); };
      double least = 9;
      for (const dvec2 q : points.all()) least = std::min(least, distance(q));
      EXPECT_EQ(distance(points.all()[points.NearestTo(p)]), least);
    }
  }
}

double LeastDistance(const std::vector<dvec2>& points, size_t count) {
  double least = 9;
  for (size_t i = 0; i < count; ++i)
    for (size_t j = 0; j < i; ++j) least = std::min(least, glm::length(Nearest(points[i] - points[j])));
  return least;
}

// Independent points would come within 0.5 / n of one another; Poisson discs of n points keep about 0.6 / sqrt n.
TEST(TorusPoints, RootsKeepTheirDistance) {
  Pcg32 random(3);
  const TorusPoints points = ThrowRoots(400, 40, &random);
  EXPECT_GT(LeastDistance(points.all(), 400), 0.6 / std::sqrt(400.0));
  EXPECT_GT(LeastDistance(points.all(), 40), 0.6 / std::sqrt(40.0));
}

// One class, upright, without anything random.
CoatParams Plain() {
  CoatParams p = SmallCoat();
  p.dominants = 1;
  p.under.density = 0;
  p.over = {.density = 20,
            .length = 0.8,
            .lengthSpread = 0,
            .radius = 0.05,
            .radiusSpread = 0,
            .taper = 0,
            .spread = 0,
            .swirl = 0,
            .noise = 0,
            .clump = 0,
            .tintSpread = 0,
            .warmthSpread = 0};
  return p;
}

TEST(GrowStrandList, CountsAndClasses) {
  const std::vector<Strand> strands = GrowStrandList(SmallCoat());
  size_t over = 0;
  for (const Strand& s : strands) over += s.kind == StrandKind::Over;
  EXPECT_EQ(over, 45u * 4);
  EXPECT_EQ(strands.size(), (45u + 130u) * 4);
}

TEST(GrowStrandList, PlainStrandIsAnUprightCylinder) {
  for (const Strand& s : GrowStrandList(Plain())) {
    EXPECT_NEAR(glm::length(s.points.back().position - dvec3(0, 0, 0.8)), 0, 1e-12);
    for (const StrandPoint& p : s.points) EXPECT_EQ(p.radius, 0.05);
    EXPECT_EQ(s.tint, dvec3(1));
  }
}

TEST(GrowStrandList, TaperFollowsItsLaw) {
  CoatParams params = Plain();
  params.over.taper = 0.6;
  for (const Strand& s : GrowStrandList(params))
    for (const StrandPoint& p : s.points) EXPECT_NEAR(p.radius, 0.05 * std::pow(1 - p.position.z / 0.8, 0.6), 1e-9);
}

TEST(GrowStrandList, LengthsHaveTheirMeanAndDeviation) {
  CoatParams params = Plain();
  params.over.density = 500, params.over.lengthSpread = 0.1;
  double sum = 0, squares = 0;
  const std::vector<Strand> strands = GrowStrandList(params);
  for (const Strand& s : strands) {
    const double z = s.points.back().position.z;
    sum += z, squares += z * z;
  }
  const double n = double(strands.size()), mean = sum / n;
  EXPECT_NEAR(mean, 0.8, 3 * 0.08 / std::sqrt(n));
  EXPECT_NEAR(std::sqrt(squares / n - mean * mean), 0.08, 0.006);
}

// Leaning by b for each fur length, the direction after h is (b h, 1) normalised, step by step; the tip of a strand
// with t' = b x is an arc's: what counts is that it lies on the right side, by about b l^2 / 2.
TEST(GrowStrandList, BiasLeansItsWay) {
  CoatParams params = Plain();
  params.over.biasX = 0.3, params.over.biasY = -0.2;
  for (const Strand& s : GrowStrandList(params)) {
    const dvec3 tip = s.points.back().position;
    EXPECT_NEAR(tip.x, 0.3 * 0.32, 0.01);
    EXPECT_NEAR(tip.y, -0.2 * 0.32, 0.01);
  }
}

TEST(GrowStrandList, GravityBendsWhatLeans) {
  CoatParams params = Plain();
  params.over.biasX = 0.5;
  const double free = GrowStrandList(params)[0].points.back().position.z;
  params.over.gravity = 2;
  const dvec3 drooping = GrowStrandList(params)[0].points.back().position;
  EXPECT_LT(drooping.z, free);
  params.over.gravity = 8;
  for (const Strand& s : GrowStrandList(params))
    for (const StrandPoint& p : s.points) EXPECT_GE(p.position.z, 0);
}

TEST(GrowStrandList, CurlIsAHelix) {
  CoatParams params = Plain();
  params.over.curl = 0.1, params.over.curlTurns = 2.5, params.over.curlExponent = 1;
  for (const Strand& s : GrowStrandList(params)) {
    for (const StrandPoint& p : s.points) EXPECT_NEAR(glm::length(dvec2(p.position)), 0.1 * p.position.z / 0.8, 1e-9);
    // 2.5 turns in a fur length are two in 0.8: the curl ends in the direction that it started in.
    const size_t last = s.points.size() - 1;
    ASSERT_EQ(last % 2, 0u);
    const dvec2 half = dvec2(s.points[last / 2].position), tip = dvec2(s.points[last].position);
    EXPECT_NEAR(glm::length(half * 2.0 - tip), 0, 1e-9);
  }
}

// All the way: tips meet at the dominant strand's tip.
TEST(GrowStrandList, ClumpsMeetAtADominantStrand) {
  CoatParams params = Plain();
  params.dominants = 0.1, params.over.clump = 1;
  const std::vector<Strand> strands = GrowStrandList(params);
  const auto tip = [&](const Strand& s) { return s.root * params.tile + dvec2(s.points.back().position); };
  const size_t dominants = strands.size() / 10;
  for (size_t i = dominants; i < strands.size(); ++i) {
    double nearest = 9, root = 9;
    for (size_t d = 0; d < dominants; ++d) {
      nearest = std::min(nearest, glm::length(Nearest((tip(strands[i]) - tip(strands[d])) / params.tile)));
      root = std::min(root, glm::length(Nearest(strands[i].root - strands[d].root)));
    }
    EXPECT_NEAR(nearest, 0, 1e-9);
    EXPECT_GT(root, 0.01);
  }
}

TEST(GrowStrandList, TintVariesAroundItsMean) {
  CoatParams params = Plain();
  params.over.density = 400, params.over.tint = 0.8, params.over.tintSpread = 0.1, params.over.warmth = 0.2;
  dvec3 sum(0);
  const std::vector<Strand> strands = GrowStrandList(params);
  for (const Strand& s : strands) sum += s.tint / double(strands.size());
  EXPECT_NEAR(sum.g, 0.8, 0.01);
  EXPECT_NEAR(sum.r / sum.g, 1.2, 1e-9);
  EXPECT_NEAR(sum.b / sum.g, 0.8, 1e-9);
}

// What one class has of its own moves no strand of the other.
TEST(GrowStrandList, ClassesAreIndependent) {
  CoatParams params = SmallCoat();
  const auto overTips = [](const std::vector<Strand>& strands) {
    std::vector<dvec3> tips;
    for (const Strand& s : strands)
      if (s.kind == StrandKind::Over) tips.push_back(s.points.back().position);
    return tips;
  };
  const auto before = overTips(GrowStrandList(params));
  params.under.density = 20, params.under.curl = 0.2;
  EXPECT_EQ(overTips(GrowStrandList(params)), before);
}

}  // namespace
}  // namespace fur::test

// Coverage and tangents against closed forms and against counting points.
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <numbers>

#include "bake_helpers.h"
#include "bake_math.h"
#include "fur/bake_files.h"
#include "random.h"

namespace fur::test {
namespace {

using glm::dvec2;
using glm::dvec3;

// n independent upright cylinders of cross section s on a tile of area A cover 1 - (1 - s / A)^n of it on average: the
// texels' shares are independent, so the mean of a texel's product is the product of the means.
TEST(BakeCoverage, OfRandomCylindersIsTheClosedForm) {
  CoatParams params = SmallCoat();
  Pcg32 random(1);
  for (const auto& [count, radius] : {std::pair{60, 0.05}, {200, 0.06}, {900, 0.02}, {3000, 0.004}}) {
    double sum = 0, squares = 0;
    constexpr int kRuns = 24;
    for (int run = 0; run < kRuns; ++run) {
      std::vector<Strand> strands;
      for (int i = 0; i < count; ++i)
        strands.push_back(Straight({random.Uniform(), random.Uniform()}, {0, 0, 1}, radius));
      const double mean = MeanCoverage(BakeVolume(params, strands), 3);
      sum += mean / kRuns, squares += mean * mean / kRuns;
    }
    const double share = std::numbers::pi * radius * radius / (params.tile * params.tile);
    const double expected = 1 - std::pow(1 - share, count);
    const double sigma = std::sqrt(std::max(0.0, squares - sum * sum) / (kRuns - 1));
    // Bytes: rounding is unbiased but for texels that are nearly empty.
    EXPECT_NEAR(sum, expected, 3 * sigma + 0.0005 + 0.004 * expected) << count << " of radius " << radius;
  }
}

// Every texel of a few cylinders, by counting points on a fine grid; the strands overlap as 1 - prod (1 - c_i).
TEST(BakeCoverage, OfCylindersIsExactInEachTexel) {
  CoatParams params = SmallCoat();
  params.size = 16;
  const double scale = params.size / params.tile;
  const std::vector<Strand> strands{Straight({0.3, 0.4}, {0, 0, 1}, 0.2), Straight({0.35, 0.45}, {0, 0, 1}, 0.15),
                                    Straight({0.99, 0.01}, {0, 0, 1}, 0.25), Straight({0.6, 0.8}, {0, 0, 1}, 0.03)};
  const FurVolume v = BakeVolume(params, strands);
  constexpr int kFine = 64;
  for (uint32_t y = 0; y < v.height; ++y)
    for (uint32_t x = 0; x < v.width; ++x) {
      double open = 1;
      for (const Strand& s : strands) {
        int inside = 0;
        for (int k = 0; k < kFine * kFine; ++k) {
          const dvec2 p{(x + (k % kFine + 0.5) / kFine) / params.size,
                        1 - (y + (k / kFine + 0.5) / kFine) / params.size};
          inside += glm::length(Nearest(p - s.root)) * params.size < s.points[0].radius * scale;
        }
        open *= 1 - double(inside) / (kFine * kFine);
      }
      EXPECT_NEAR(Texel(v, x, y, 2)[3] / 255.0, 1 - open, 0.006) << x << ' ' << y;
    }
}

bool Covers(const Strand& s, dvec2 p, double low, double high, double tile) {
  const dvec2 q = Nearest(p - s.root) * tile;  // fur lengths from the root
  for (size_t i = 0; i + 1 < s.points.size(); ++i) {
    const StrandPoint &a = s.points[i], &b = s.points[i + 1];
    if (std::max(a.position.z, b.position.z) < low || std::min(a.position.z, b.position.z) >= high) continue;
    constexpr int kSteps = 48;
    for (int k = 0; k <= kSteps; ++k) {
      const double t = double(k) / kSteps;
      const dvec3 x = glm::mix(a.position, b.position, t);
      if (x.z < low || x.z >= high) continue;
      if (glm::length(dvec2(x) - q) < glm::mix(a.radius, b.radius, t)) return true;
    }
  }
  return false;
}

// One strand at a time: a slice's mean is the share of random points that have the strand above or below them.
TEST(BakeCoverage, OfCurledStrandsAgreesWithRandomPoints) {
  CoatParams params = SmallCoat();
  params.over.density = 0.5, params.under.density = 0;
  params.over.curl = 0.25, params.over.curlTurns = 3, params.over.radius = 0.06, params.over.noise = 2;
  Pcg32 random(9);
  for (uint32_t seed = 1; seed <= 3; ++seed) {
    params.seed = seed;
    for (const Strand& s : GrowStrandList(params)) {
      const FurVolume v = BakeVolume(params, {&s, 1});
      for (uint32_t j = 0; j + 1 < params.layers; ++j) {
        constexpr int kPoints = 4000;
        int inside = 0;
        const double low = double(j) / params.layers, high = double(j + 1) / params.layers;
        for (int k = 0; k < kPoints; ++k)
          inside += Covers(s, {random.Uniform(), random.Uniform()}, low, high, params.tile);
        const double share = double(inside) / kPoints;
        const double sigma = std::sqrt(std::max(share, 1.0 / kPoints) * (1 - share) / kPoints);
        EXPECT_NEAR(MeanCoverage(v, j), share, 3.5 * sigma + 0.0004) << "seed " << seed << ", slice " << j;
      }
    }
  }
}

// Moving all roots by half a tile, a whole number of texels, moves the picture and changes nothing else.
TEST(BakeCoverage, TilesToTheBit) {
  CoatParams params = SmallCoat();
  params.over.curl = 0.3;
  std::vector<Strand> strands = GrowStrandList(params);
  const FurVolume v = BakeVolume(params, strands);
  for (Strand& s : strands) s.root = s.root + 0.5 - glm::floor(s.root + 0.5);
  const FurVolume moved = BakeVolume(params, strands);
  for (uint32_t j = 0; j < v.layers; ++j)
    for (uint32_t y = 0; y < v.height; ++y)
      for (uint32_t x = 0; x < v.width; ++x) {
        const uint8_t *a = Texel(v, x, y, j), *b = Texel(moved, (x + 32) % 64, (y + 32) % 64, j);
        // Far from fur a texel has the slice's mean, which is summed in another order.
        if (a[3] == 0)
          ASSERT_EQ(b[3], 0);
        else
          ASSERT_TRUE(std::equal(a, a + 4, b)) << x << ' ' << y << ' ' << j;
      }
}

TEST(BakeVolume, TangentIsTheStrandsDirection) {
  const CoatParams params = SmallCoat();
  for (const dvec3 tip : {dvec3(0.4, 0, 0.9), dvec3(0, 0.5, 0.9), dvec3(0, -0.5, 0.9), dvec3(-0.3, 0.6, 0.8)}) {
    const Strand strand = Straight({0.5, 0.25}, tip, 0.05);
    const FurVolume v = BakeVolume(params, {&strand, 1});
    int covered = 0;
    for (size_t i = 0; i < v.pixels.size(); i += 4) {
      if (v.pixels[i + 3] == 0) continue;
      ++covered;
      EXPECT_LT(glm::length(Unpack(&v.pixels[i]) - glm::normalize(tip)), 0.01);
    }
    EXPECT_GT(covered, 50);
  }
}

// A strand that leans up the picture moves to smaller rows from slice to slice, and its tangent's y is positive.
TEST(BakeVolume, YIsUpThePicture) {
  const CoatParams params = SmallCoat();
  const Strand strand = Straight({0.5, 0.25}, {0.2, 0.5, 0.95}, 0.05);
  const FurVolume v = BakeVolume(params, {&strand, 1});
  const auto center = [&](uint32_t layer) {
    dvec2 sum(0);
    double weight = 0;
    for (uint32_t y = 0; y < v.height; ++y)
      for (uint32_t x = 0; x < v.width; ++x) {
        const double a = Texel(v, x, y, layer)[3];
        sum += dvec2(x + 0.5, y + 0.5) * a, weight += a;
      }
    return sum / weight;
  };
  // Texel (32, 48) is the root; 32 texels are a fur length.
  EXPECT_NEAR(center(0).x, 32 + 0.2 * 32 * (0.0625 / 0.95), 0.2);
  EXPECT_NEAR(center(0).y, 48 - 0.5 * 32 * (0.0625 / 0.95), 0.2);
  EXPECT_NEAR(center(6).x - center(1).x, 0.2 * 32 * (5.0 / 8 / 0.95), 0.1);
  EXPECT_NEAR(center(6).y - center(1).y, -0.5 * 32 * (5.0 / 8 / 0.95), 0.1);
}

TEST(BakeVolume, DirectionsAreUnitEverywhere) {
  CoatParams params = SmallCoat();
  params.over.curl = 0.3, params.over.density = 4, params.under.density = 4;
  const FurVolume v = BakeVolume(params, GrowStrandList(params));
  for (size_t i = 0; i < v.pixels.size(); i += 4) ASSERT_NEAR(glm::length(Unpack(&v.pixels[i])), 1, 0.012);
}

TEST(BakeVolume, TopSliceIsEmptyAndCoverageFallsWithHeight) {
  const FurVolume v = GrowCoat(1);
  EXPECT_EQ(MeanCoverage(v, v.layers - 1), 0);
  EXPECT_GT(MeanCoverage(v, 0), 0.05);
  for (uint32_t j = 1; j < v.layers; ++j) EXPECT_LE(MeanCoverage(v, j), MeanCoverage(v, j - 1) + 0.01) << "slice " << j;
  const Strand tall = Straight({0.5, 0.5}, {0, 0, 2}, 0.1);
  EXPECT_EQ(MeanCoverage(BakeVolume(SmallCoat(), {&tall, 1}), 7), 0);
}

TEST(BakeVolume, NoStrandsGiveStraightUpAndNoCoverage) {
  const FurVolume v = BakeVolume(SmallCoat(), {});
  for (size_t i = 0; i < v.pixels.size(); i += 4) {
    ASSERT_TRUE(v.pixels[i] == 128 && v.pixels[i + 1] == 128 && v.pixels[i + 2] == 255 && v.pixels[i + 3] == 0);
    ASSERT_TRUE(v.tint[i] == 128 && v.tint[i + 1] == 128 && v.tint[i + 2] == 128);
  }
}

TEST(BakeVolume, TintIsTheStrandsAndAlphaRunsToItsTip) {
  const CoatParams params = SmallCoat();
  Strand strand = Straight({0.5, 0.5}, {0, 0, 0.5}, 0.1);
  strand.tint = {1.25, 1, 0.5};
  const FurVolume v = BakeVolume(params, {&strand, 1});
  for (uint32_t j = 0; j < 4; ++j) {
    const uint8_t* tint = &v.tint[((size_t{j} * 64 + 32) * 64 + 32) * 4];
    EXPECT_EQ(tint[0], 160);
    EXPECT_EQ(tint[1], 128);
    EXPECT_EQ(tint[2], 64);
    EXPECT_NEAR(tint[3] / 255.0, (j + 0.5) / 4, 0.003) << "slice " << j;
  }
}

TEST(BakeVolume, SameBytesAtAnyNumberOfThreads) {
  const CoatParams params = SmallCoat();
  const FurVolume one = BakeVolume(params, GrowStrandList(params), 1);
  for (const uint32_t threads : {1u, 2u, 3u, 7u, 0u}) {
    const FurVolume again = BakeVolume(params, GrowStrandList(params), threads);
    EXPECT_EQ(again.pixels, one.pixels) << threads;
    EXPECT_EQ(again.tint, one.tint) << threads;
  }
}

TEST(BakeVolume, ProgressRisesToOne) {
  std::vector<double> shares;
  const CoatParams params = SmallCoat();
  BakeVolume(params, {}, 3, [&](double share) { shares.push_back(share); });
  EXPECT_EQ(shares.size(), params.layers);
  EXPECT_TRUE(std::is_sorted(shares.begin(), shares.end()));
  EXPECT_EQ(shares.back(), 1);
}

// From the side, a strand of radius r in the sheet is 2 r wide; rows run from the root to the tip.
TEST(BakeFinSlice, ShowsTheStrandsOfTheSheetFromTheSide) {
  const CoatParams params = SmallCoat();
  const std::vector<Strand> strands{Straight({0.25, 0.0}, {0.25, 0, 0.75}, 0.1), Straight({0.75, 0.5}, {0, 0, 1}, 0.1)};
  const Image fin = BakeFinSlice(params, strands);
  ASSERT_EQ(fin.width, 64u);
  ASSERT_EQ(fin.height, 32u);
  const auto rowCoverage = [&](uint32_t row, uint32_t from, uint32_t to) {
    double sum = 0;
    for (uint32_t x = from; x < to; ++x) sum += fin.pixels[(row * 64 + x) * 4 + 3] / 255.0;
    return sum;
  };
  const double width = 2 * 0.1 * 32 * std::sqrt(10.0) / 3;  // cut level, the strand leans 1 to 3
  for (const uint32_t row : {4u, 10u, 18u}) EXPECT_NEAR(rowCoverage(row, 0, 40), width, 0.05) << row;
  EXPECT_EQ(rowCoverage(29, 0, 40), 0);  // beyond the tip and its round end
  for (uint32_t row = 0; row < 32; ++row) EXPECT_EQ(rowCoverage(row, 40, 64), 0) << "not in the sheet";
  const uint8_t* texel = &fin.pixels[(10 * 64 + 16 + 3) * 4];
  EXPECT_LT(glm::length(Unpack(texel) - glm::normalize(dvec3(1, 0, 3))), 0.01);
}

TEST(BakeFinSlice, LastRowIsEmpty) {
  const Image fin = BakeFinSlice(CoatParams{}, GrowStrandList({}));
  double last = 0, first = 0;
  for (uint32_t x = 0; x < fin.width; ++x) {
    last += fin.pixels[((fin.height - 1) * fin.width + x) * 4 + 3];
    first += fin.pixels[x * 4 + 3];
  }
  EXPECT_EQ(last, 0);
  EXPECT_GT(first / fin.width, 64);
}

double SecondsToBake(const CoatParams& params) {
  const auto start = std::chrono::steady_clock::now();
  Bake(params);
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

// The program's promise; an idle machine takes a tenth of it.
TEST(BakeVolume, IsQuick) {
  EXPECT_LT(SecondsToBake({}), 2);
  CoatParams large;
  large.size = 512, large.layers = 32;
  EXPECT_LT(SecondsToBake(large), 60);
}

}  // namespace
}  // namespace fur::test

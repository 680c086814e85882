#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "fur/coat.h"

namespace fur {
namespace {

const uint8_t* Texel(const FurVolume& v, uint32_t x, uint32_t y, uint32_t layer) {
  return v.pixels.data() + ((size_t{layer} * v.height + y) * v.width + x) * 4;
}

double MeanCoverage(const FurVolume& v, uint32_t layer) {
  double sum = 0;
  for (uint32_t y = 0; y < v.height; ++y) {
    for (uint32_t x = 0; x < v.width; ++x) sum += Texel(v, x, y, layer)[3] / 255.0;
  }
  return sum / v.width / v.height;
}

StrandParams Cylinders(uint32_t count, double radius) {
  return {
      .size = 128, .layers = 8, .underStrands = 0, .overStrands = count, .overRadius = radius, .taper = 0, .bend = 0};
}

TEST(GrowStrands, FillsWhatItSays) {
  const FurVolume v = GrowStrands({.size = 64, .layers = 12, .underStrands = 100, .overStrands = 30});
  EXPECT_EQ(v.width, 64u);
  EXPECT_EQ(v.height, 64u);
  EXPECT_EQ(v.layers, 12u);
  EXPECT_EQ(v.pixels.size(), 64u * 64u * 12u * 4u);
}

TEST(GrowStrands, SameSeedSameBytesOtherSeedOthers) {
  StrandParams params{.size = 64, .underStrands = 200, .overStrands = 60};
  const FurVolume a = GrowStrands(params), b = GrowStrands(params);
  EXPECT_EQ(a.pixels, b.pixels);
  params.seed = 2;
  EXPECT_NE(GrowStrands(params).pixels, a.pixels);
}

TEST(GrowStrands, TopSliceIsEmptyAndCoverageFallsWithHeight) {
  const FurVolume v = GrowStrands({});
  EXPECT_EQ(MeanCoverage(v, v.layers - 1), 0);
  EXPECT_GT(MeanCoverage(v, 0), 0.05);
  for (uint32_t j = 1; j < v.layers; ++j) EXPECT_LT(MeanCoverage(v, j), MeanCoverage(v, j - 1)) << "slice " << j;
}

TEST(GrowStrands, DirectionsAreUnitAndPointUpEverywhere) {
  const FurVolume v = GrowStrands({.size = 64, .underStrands = 20, .overStrands = 10});
  for (size_t i = 0; i < v.pixels.size(); i += 4) {
    const glm::dvec3 t = glm::dvec3(v.pixels[i], v.pixels[i + 1], v.pixels[i + 2]) / 127.5 - 1.0;
    ASSERT_NEAR(glm::length(t), 1, 0.02);
    ASSERT_GT(t.z, 0);
  }
}

TEST(GrowStrands, NoStrandsGiveStraightUpAndNoCoverage) {
  const FurVolume v = GrowStrands({.size = 8, .layers = 3, .underStrands = 0, .overStrands = 0});
  for (size_t i = 0; i < v.pixels.size(); i += 4) {
    EXPECT_EQ(v.pixels[i], 128);
    EXPECT_EQ(v.pixels[i + 1], 128);
    EXPECT_EQ(v.pixels[i + 2], 255);
    EXPECT_EQ(v.pixels[i + 3], 0);
  }
}

// Sparse upright cylinders do not overlap: their coverage is n pi r^2 / A, with the radius's own deviation of 12 % in
// the mean square.
TEST(GrowStrands, CoverageOfCylindersIsTheClosedForm) {
  for (double radius : {1.3, 2.2, 3.1}) {
    double mean = 0;
    constexpr int kSeeds = 16;
    for (uint32_t seed = 1; seed <= kSeeds; ++seed) {
      StrandParams params = Cylinders(100, radius);
      params.seed = seed;
      mean += MeanCoverage(GrowStrands(params), 0) / kSeeds;
    }
    const double expected = 100 * std::numbers::pi * radius * radius * (1 + 0.12 * 0.12) / (128.0 * 128.0);
    EXPECT_NEAR(mean / expected, 1, 0.01) << "radius " << radius;
  }
}

// The tile has no visible border: the change across the wrap is that between any two neighbouring columns or rows.
TEST(GrowStrands, TilesSeamlessly) {
  double wrap = 0, inside = 0;
  for (uint32_t seed = 1; seed <= 8; ++seed) {
    const FurVolume v = GrowStrands({.seed = seed});
    const auto difference = [&](uint32_t x0, uint32_t x1) {
      double sum = 0;
      for (uint32_t j = 0; j < v.layers; ++j) {
        for (uint32_t k = 0; k < v.height; ++k) {
          sum += std::abs(Texel(v, x0, k, j)[3] - Texel(v, x1, k, j)[3]);
          sum += std::abs(Texel(v, k, x0, j)[3] - Texel(v, k, x1, j)[3]);
        }
      }
      return sum;
    };
    wrap += difference(v.width - 1, 0);
    for (uint32_t x = 0; x + 1 < v.width; ++x) inside += difference(x, x + 1) / (v.width - 1);
  }
  EXPECT_NEAR(wrap / inside, 1, 0.1);
}

// One strand that leans over the border continues on the other side.
TEST(GrowStrands, StrandsWrapAround) {
  for (uint32_t seed = 1; seed < 6; ++seed) {
    const FurVolume v = GrowStrands({.size = 16,
                                     .layers = 8,
                                     .underStrands = 0,
                                     .overStrands = 1,
                                     .overRadius = 2,
                                     .taper = 0,
                                     .bend = 1,
                                     .spread = 0,
                                     .seed = seed});
    double low = 1, high = 0;
    for (uint32_t j = 0; j < 5; ++j) {
      low = std::min(low, MeanCoverage(v, j));
      high = std::max(high, MeanCoverage(v, j));
    }
    EXPECT_GT(low, 0.03);
    EXPECT_LT(high, 0.25);
  }
}

}  // namespace
}  // namespace fur

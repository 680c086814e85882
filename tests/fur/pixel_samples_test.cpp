// The points of a pixel: nets, uniform, and the same whoever asks.
#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "reference/pixel_samples.h"

namespace fur::test {
namespace {

using reference::PixelSamples;

TEST(ReferenceSamples, EveryElementaryBoxHoldsOne) {
  for (const uint32_t levels : {0u, 1u, 4u, 6u, 9u}) {
    const uint32_t count = 1u << levels;
    PixelSamples samples(count);
    for (const uint32_t pixel : {0u, 7u, 1279u}) {
      const std::vector<glm::dvec2>& points = samples.Of(3, pixel, 2 * pixel);
      ASSERT_EQ(points.size(), count);
      for (uint32_t across = 0; across <= levels; ++across) {
        std::set<std::pair<uint32_t, uint32_t>> boxes;
        for (const glm::dvec2& p : points) {
          ASSERT_TRUE(p.x >= 0 && p.x < 1 && p.y >= 0 && p.y < 1);
          boxes.insert({uint32_t(std::ldexp(p.x, int(across))), uint32_t(std::ldexp(p.y, int(levels - across)))});
        }
        EXPECT_EQ(boxes.size(), count) << count << " points, " << (1u << across) << " boxes across";
      }
    }
  }
}

// Each point by itself, over many pixels.
TEST(ReferenceSamples, EachPointIsUniform) {
  constexpr uint32_t kPixels = 20000, kBins = 16;
  PixelSamples samples(5);
  std::vector<uint32_t> bins(5 * kBins * kBins);
  for (uint32_t i = 0; i < kPixels; ++i) {
    const std::vector<glm::dvec2>& points = samples.Of(1, i % 200, i / 200);
    for (size_t k = 0; k < 5; ++k) ++bins[(k * kBins + size_t(points[k].x * kBins)) * kBins + size_t(points[k].y * kBins)];
  }
  // Chi squared of 255 degrees of freedom: mean 255, deviation 22.6; five deviations.
  const double expected = double(kPixels) / (kBins * kBins);
  for (size_t k = 0; k < 5; ++k) {
    double chi = 0;
    for (size_t b = 0; b < kBins * kBins; ++b) chi += std::pow(bins[k * kBins * kBins + b] - expected, 2) / expected;
    EXPECT_NEAR(chi, 255, 5 * 22.6) << "point " << k;
  }
}

// The error of a smooth integral: N^-3/2 (Owen 1997), where jittered strata have 1/N.
TEST(ReferenceSamples, SmoothIntegralsConvergeFast) {
  const auto error = [](uint32_t count) {
    PixelSamples samples(count);
    double sum = 0;
    constexpr uint32_t kPixels = 400;
    for (uint32_t i = 0; i < kPixels; ++i) {
      double mean = 0;
      for (const glm::dvec2& p : samples.Of(2, i, 5)) mean += std::exp(p.x - 0.5 * p.y) * std::cos(p.y) / count;
      // The integral over the square: (e - 1) times that of exp(-y/2) cos y, in closed form.
      const double along = (std::exp(-0.5) * (std::sin(1.0) - 0.5 * std::cos(1.0)) + 0.5) / 1.25;
      sum += std::pow(mean - (std::exp(1.0) - 1) * along, 2);
    }
    return std::sqrt(sum / kPixels);
  };
  const double few = error(16), many = error(256);
  EXPECT_LT(many, few / 40) << few << " to " << many << ": 16 for strata, 64 for nets";
}

TEST(ReferenceSamples, SeedsAndPixelsDiffer) {
  PixelSamples samples(8);
  const std::vector<glm::dvec2> first = samples.Of(0, 3, 4);
  EXPECT_NE(first, samples.Of(1, 3, 4));
  EXPECT_NE(first, samples.Of(0, 4, 3));
  EXPECT_EQ(first, samples.Of(0, 3, 4));
}

}  // namespace
}  // namespace fur::test

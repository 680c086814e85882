// Mip chains, against means computed by hand.
#include "mips.h"

#include <gtest/gtest.h>

#include <cmath>

namespace fur::test {
namespace {

using Bytes = std::vector<uint8_t>;
constexpr MipFilter kFilters[] = {MipFilter::Raw, MipFilter::Srgb};

Bytes Last(const Bytes& rgba, uint32_t width, uint32_t height, MipFilter filter) {
  return MakeMips(rgba, width, height, filter).back();
}

TEST(Mips, LevelsHalveDownToOneTexel) {
  const auto levels = MakeMips(Bytes(13 * 4 * 4, 7), 13, 4, MipFilter::Raw);
  ASSERT_EQ(levels.size(), 4u);  // 13 x 4, 6 x 2, 3 x 1, 1 x 1
  EXPECT_EQ(levels[1].size(), 6u * 2 * 4);
  EXPECT_EQ(levels[2].size(), 3u * 1 * 4);
  EXPECT_EQ(levels[3].size(), 4u);
}

TEST(Mips, FirstLevelIsThePictureItself) {
  Bytes rgba;
  for (int i = 0; i < 64; ++i) rgba.push_back(uint8_t(i * 37));
  for (const MipFilter filter : kFilters) EXPECT_EQ(MakeMips(rgba, 4, 4, filter)[0], rgba);
}

TEST(Mips, RawIsTheMeanOfTheStoredValues) {
  const Bytes rgba{0, 10, 255, 0, 0, 20, 255, 255, 255, 30, 0, 255, 255, 41, 2, 254};
  // 127.5 -> 128, 25.25 -> 25, 128, 191
  EXPECT_EQ(Last(rgba, 2, 2, MipFilter::Raw), (Bytes{128, 25, 128, 191}));
}

TEST(Mips, BoxesDoNotOverlap) {
  Bytes rgba;
  for (const uint8_t v : Bytes{10, 20, 100, 200, 30, 40, 100, 200}) rgba.insert(rgba.end(), {v, v, v, v});  // 4 x 2
  const auto levels = MakeMips(rgba, 4, 2, MipFilter::Raw);
  ASSERT_EQ(levels.size(), 3u);
  EXPECT_EQ(levels[1], (Bytes{25, 25, 25, 25, 150, 150, 150, 150}));
}

TEST(Mips, SrgbIsAveragedInLinearLight) {
  const Bytes checker{0, 0, 0, 0, 255, 255, 255, 255, 255, 255, 255, 0, 0, 0, 0, 255};
  // Half the light is 188 encoded; alpha is not encoded.
  EXPECT_EQ(Last(checker, 2, 2, MipFilter::Srgb), (Bytes{188, 188, 188, 128}));
}

TEST(Mips, EveryByteSurvivesTheSrgbRoundTrip) {
  for (int v = 0; v < 256; ++v) {
    EXPECT_NEAR(LinearToSrgb(SrgbToLinear(v / 255.0)) * 255, v, 1e-9);
    const Bytes rgba(16, uint8_t(v));
    for (const MipFilter filter : kFilters) EXPECT_EQ(Last(rgba, 2, 2, filter), Bytes(4, uint8_t(v)));
  }
}

// IEC 61966-2-1: a linear piece, then a power; both meet.
TEST(Mips, SrgbCurve) {
  EXPECT_EQ(SrgbToLinear(0), 0);
  EXPECT_NEAR(SrgbToLinear(1), 1, 1e-12);
  EXPECT_NEAR(SrgbToLinear(0.04), 0.04 / 12.92, 1e-12);
  EXPECT_NEAR(SrgbToLinear(0.5), 0.21404114048, 1e-9);
  EXPECT_NEAR(LinearToSrgb(0.18), 0.46135612950, 1e-9);
  EXPECT_NEAR(SrgbToLinear(0.04045), SrgbToLinear(0.04045 + 1e-9), 1e-7);
}

TEST(Mips, OneColorStaysOneColorAtOddSizes) {
  for (const MipFilter filter : kFilters)
    for (const auto& [w, h] : {std::pair{1u, 7u}, {5u, 3u}, {9u, 1u}, {7u, 7u}}) {
      Bytes rgba;
      for (uint32_t i = 0; i < w * h; ++i) rgba.insert(rgba.end(), {12, 130, 251, 77});
      EXPECT_EQ(Last(rgba, w, h, filter), (Bytes{12, 130, 251, 77})) << w << " x " << h;
    }
}

}  // namespace
}  // namespace fur::test

// The measures beside FLIP, in closed form; the regions; what is not finite.
#include "fur/compare.h"

#include <cmath>

#include "compare_internal.h"
#include "compare_pictures.h"
#include "fur/exr_io.h"
#include "gltf_builder.h"

namespace fur::test {
namespace {

TEST(Compare, EqualPictures) {
  const Picture a = Pattern(30, 20, 4);
  const Comparison c = Compared(a, a);
  EXPECT_EQ(c.rmse, 0);
  EXPECT_EQ(*c.maskRmse, 0);
  EXPECT_EQ(*c.maskRelMse, 0);
  EXPECT_TRUE(std::isinf(c.psnr) && c.psnr > 0);
  EXPECT_NEAR(c.ssim, 1, 1e-6);
  EXPECT_EQ(c.largest, 0);
  EXPECT_EQ(c.equalShare, 1);
  EXPECT_EQ(c.pixels, 600u);
}

TEST(Compare, TwoColoursInClosedForm) {
  const Comparison c = Compared(Flat(20, 15, 100, 100, 100), Flat(20, 15, 110, 110, 90));
  EXPECT_NEAR(c.psnr, 20 * std::log10(255.0 / 10), 1e-5);
  EXPECT_NEAR(c.largest, 10 / 255.0, 1e-7);
  EXPECT_EQ(c.equalShare, 0);
  const double x = 100 / 255.0, y = (0.299 * 110 + 0.587 * 110 + 0.114 * 90) / 255;
  EXPECT_NEAR(c.ssim, (2 * x * y + 1e-4) / (x * x + y * y + 1e-4), 1e-6);
}

TEST(Compare, LinearLightInClosedForm) {
  const Comparison c = Compared(LinearFlat(8, 8, {0.5f, 0.2f, 0}), LinearFlat(8, 8, {0.6f, 0.2f, 0.3f}));
  EXPECT_NEAR(c.rmse, std::sqrt((0.01 + 0.09) / 3), 1e-7);
  EXPECT_NEAR(*c.maskRmse, c.rmse, 1e-12) << "no mask: everything";
  EXPECT_NEAR(*c.maskRelMse, (0.01 / 0.26 + 0.09 / 0.01) / 3, 1e-5);
  const double decoded = std::pow((0.5019607843 + 0.055) / 1.055, 2.4);
  EXPECT_NEAR(Compared(Flat(3, 3, 128, 128, 128), Flat(3, 3, 0, 0, 0)).rmse, decoded, 1e-6);
}

// One pixel of a flat picture: every window's sums are known.
TEST(Compare, SsimOfASinglePixel) {
  constexpr uint32_t kSide = 11;  // one window inside
  const Picture a = Flat(kSide, kSide, 51, 51, 51);
  Picture b = a;
  b.image.pixels[5 * kSide + 5] = glm::vec4(0.6f, 0.6f, 0.6f, 1);
  double sum = 0;
  for (int i = -5; i <= 5; ++i) sum += std::exp(-i * i / 4.5);
  const double w = 1 / (sum * sum), d = 0.4, mean = 0.2 + w * d, variance = w * d * d - w * w * d * d;
  const double expected = (0.4 * mean + 1e-4) * 9e-4 / ((0.04 + mean * mean + 1e-4) * (variance + 9e-4));
  EXPECT_NEAR(Compared(a, b).ssim, expected, 1e-5);
}

TEST(Compare, SsimOfOppositePatternsIsNegative) {
  const auto checker = [](uint32_t x, uint32_t y) { return glm::vec4(glm::vec3((x + y) % 2 ? 1.0f : 0.0f), 1); };
  const auto inverse = [&](uint32_t x, uint32_t y) { return checker(x + 1, y); };
  EXPECT_NEAR(Compared(MakePicture(30, 30, true, false, checker), MakePicture(30, 30, true, false, inverse)).ssim,
              (0.0009 - 0.5) / (0.5 + 0.0009), 1e-3);
}

TEST(Compare, CountsEqualPixels) {
  Picture a = LinearFlat(10, 10, {0.5f, 0.5f, 0.5f}), b = a;
  b.image.pixels[3].g = std::nextafter(0.5f, 1.0f);
  b.image.pixels[7].a = 0.25f;
  EXPECT_DOUBLE_EQ(Compared(a, b).equalShare, 0.99) << "alpha is no part of these";
  a.hasAlpha = b.hasAlpha = true;
  EXPECT_DOUBLE_EQ(Compared(a, b).equalShare, 0.98);
}

TEST(Compare, SizesMustAgree) {
  const Result<Comparison> c = ComparePictures(Flat(4, 5, 0, 0, 0), Flat(5, 4, 0, 0, 0), {});
  ASSERT_FALSE(c);
  EXPECT_EQ(c.error().code, ErrorCode::Usage);
  EXPECT_NE(c.error().message.find("5 x 4"), std::string::npos) << c.error().message;
  const Picture a = Flat(4, 5, 0, 0, 0);
  const Plane row = MakePlane(4, {0, 0, 0, 0});
  EXPECT_EQ(ComparePictures(a, a, {.mask = row, .band = {}}).error().code, ErrorCode::Usage);
  EXPECT_EQ(ComparePictures(a, a, {.mask = {}, .band = row}).error().code, ErrorCode::Usage);
  EXPECT_FALSE(ComparePictures(Picture{}, Picture{}, {}));
}

TEST(CompareRegions, DilationIsASquare) {
  for (const uint32_t width : {1u, 7u, 13u, 20u})
    for (const uint32_t radius : {0u, 1u, 4u, 30u}) {
      constexpr uint32_t kHeight = 11;
      std::vector<uint8_t> in(width * kHeight), expected(in.size());
      in[(5 * width + 3) % in.size()] = in[0] = in[in.size() - 1] = 1;
      const auto near = [&](uint32_t p, uint32_t q) {
        const auto apart = [](uint32_t i, uint32_t j) { return i > j ? i - j : j - i; };
        return apart(p % width, q % width) <= radius && apart(p / width, q / width) <= radius;
      };
      for (uint32_t p = 0; p < in.size(); ++p)
        for (uint32_t q = 0; q < in.size(); ++q) expected[p] |= uint8_t(in[q] && near(p, q));
      EXPECT_EQ(Dilate(in, width, kHeight, radius), expected) << width << " wide, radius " << radius;
    }
}

TEST(CompareRegions, ThresholdsAreExclusive) {
  const float step = 1.0f / 255;
  const Plane opacity = MakePlane(7, {0, step, std::nextafter(step, 1.0f), 0.5f, 0.99989f, 0.99991f, kNan});
  EXPECT_EQ(FurPixels(opacity), (std::vector<uint8_t>{0, 0, 1, 1, 1, 1, 1}));
  EXPECT_EQ(TranslucentPixels(opacity), (std::vector<uint8_t>{0, 0, 1, 1, 1, 0, 0}));
}

// Fur in the middle only; an error at its edge and another far away.
TEST(CompareRegions, MaskComesFromTheReferencesAlpha) {
  const auto color = [](uint32_t x, uint32_t) { return glm::vec4(0.2f, 0.2f, 0.2f, x == 20 ? 0.5f : 0.0f); };
  const Picture a = MakePicture(41, 41, false, true, color);
  Picture b = a;
  b.image.pixels[20 * 41 + 24].r = 0.3f;  // four away: inside
  b.image.pixels[20 * 41 + 25].r = 0.9f;  // outside
  const Comparison c = Compared(a, b);
  EXPECT_EQ(c.maskSource, RegionSource::Alpha);
  EXPECT_EQ(c.maskPixels, 9u * 41);
  EXPECT_NEAR(*c.maskRmse, std::sqrt(0.01 / (3 * 9 * 41)), 1e-6);
  EXPECT_NEAR(c.rmse, std::sqrt((0.01 + 0.49) / (3 * 41 * 41)), 1e-6);
  EXPECT_EQ(Compared(b, LinearFlat(41, 41, {0, 0, 0})).maskPixels, 9u * 41);
  EXPECT_EQ(Compared(LinearFlat(41, 41, {0, 0, 0}), a).maskSource, RegionSource::Whole)
      << "never from the test picture";
}

TEST(CompareRegions, GivenOnesWin) {
  const auto half = [](uint32_t, uint32_t) { return glm::vec4(0, 0, 0, 0.5f); };
  const Picture a = MakePicture(30, 1, false, true, half);
  std::vector<float> opacity(30, 0);
  opacity[0] = 1;
  const Comparison c = Compared(a, a, {.mask = MakePlane(30, opacity), .band = MakePlane(30, opacity)});
  EXPECT_EQ(c.maskSource, RegionSource::Given);
  EXPECT_EQ(c.bandSource, RegionSource::Given);
  EXPECT_EQ(c.maskPixels, 5u);
  EXPECT_EQ(c.bandPixels, 1u) << "a band is not dilated";
  const Comparison empty = Compared(a, a, {.mask = MakePlane(30, std::vector<float>(30, 0)), .band = {}});
  EXPECT_FALSE(empty.flip.maskMean || empty.maskRmse || empty.maskRelMse);
}

TEST(CompareRegions, OpacityOfTheBand) {
  const auto alpha = [](float edge) {
    const float alphas[] = {0, edge, edge, 1};
    return MakePicture(4, 1, false, true, [&](uint32_t x, uint32_t) { return glm::vec4(0, 0, 0, alphas[x]); });
  };
  Picture a = alpha(0.5f), b = alpha(0.7f);
  b.image.pixels[0].a = b.image.pixels[3].a = 0.9f;  // not in the band
  EXPECT_NEAR(*Compared(a, b).bandOpacityRmse, 0.2, 1e-6);
  EXPECT_EQ(Compared(a, b).bandPixels, 2u);
  b.image.pixels[1].a = kNan;
  EXPECT_NEAR(*Compared(a, b).bandOpacityRmse, std::sqrt((1 + 0.04) / 2), 1e-6);
  b.hasAlpha = false;
  EXPECT_FALSE(Compared(a, b).bandOpacityRmse);
  EXPECT_FALSE(Compared(alpha(1), alpha(0)).bandOpacityRmse) << "an empty band";
}

TEST(CompareNotFinite, CountsAsOne) {
  const Picture a = LinearFlat(20, 20, {0.5f, 0.5f, 0.5f});
  for (const float bad : {kNan, std::numeric_limits<float>::infinity(), -std::numeric_limits<float>::infinity()}) {
    Picture b = a;
    b.image.pixels[210].g = bad;
    const Picture *const p = &a, *const q = &b;
    for (const auto& [first, second] : {std::pair{p, q}, {q, p}, {q, q}}) {
      const Comparison c = Compared(*first, *second);
      EXPECT_EQ(c.nonFinite, 1u);
      EXPECT_NEAR(c.flip.mean, 1 / 400.0, 1e-9);
      EXPECT_EQ(c.flip.max, 1);
      EXPECT_EQ(c.flipMap.values[210], 1);
      EXPECT_NEAR(c.rmse, std::sqrt(1 / 400.0), 1e-9);
      EXPECT_NEAR(*c.maskRelMse, 1 / 400.0, 1e-9);
      EXPECT_EQ(c.largest, 1);
      EXPECT_NEAR(c.psnr, 10 * std::log10(400.0), 1e-6);
      EXPECT_NEAR(c.ssim, 1 - 1 / 100.0, 1e-6) << "one of the 10 x 10 windows";
      EXPECT_DOUBLE_EQ(c.equalShare, 399 / 400.0);
    }
  }
}

TEST(ComparePercentiles, AreExactOnSmallCases) {
  std::vector<float> hundred;
  for (int i = 1; i <= 100; ++i) hundred.push_back(float(i));
  EXPECT_EQ(Percentile(hundred, 0.99), 99);
  EXPECT_EQ(Percentile(hundred, 1), 100);
  EXPECT_EQ(Percentile(hundred, 0), 1);
  EXPECT_EQ(Percentile(std::vector<float>{7}, 0.99), 7);
  EXPECT_EQ(Percentile(std::vector<float>{1, 2}, 0.5), 1);
  EXPECT_EQ(Percentile(std::vector<float>{1, 2, 3}, 0.5), 2);
  const std::vector<float> weights{0, 1, 1, 2, 4};  // sums 0, 1, 2, 4, 8
  EXPECT_EQ(WeightedPercentile(weights, 0.125), 1);
  EXPECT_EQ(WeightedPercentile(weights, 0.25), 1);
  EXPECT_EQ(WeightedPercentile(weights, 0.5), 2);
  EXPECT_EQ(WeightedPercentile(weights, 0.51), 4);
  EXPECT_EQ(WeightedPercentile(std::vector<float>{0, 0}, 0.5), 0);
}

TEST(CompareFiles, OpacityIsAlphaOrRed) {
  const Folder folder;
  const Bytes red{255, 0, 0, 255, 0, 9, 9, 255}, alpha{255, 0, 0, 0, 0, 0, 0, 51};
  ASSERT_TRUE(WritePng(folder / "red.png", 2, 1, red));
  ASSERT_TRUE(WritePng(folder / "alpha.png", 2, 1, alpha));
  ASSERT_TRUE(WriteExr(folder / "a.exr", {2, 1, {{0.5f, 0, 0, 1}, {0, 0, 0, 1}}}));
  EXPECT_EQ(ReadOpacity(folder / "red.png")->values, (std::vector<float>{1, 0}));
  EXPECT_EQ(ReadOpacity(folder / "alpha.png")->values, (std::vector<float>{0, 0.2f}));
  EXPECT_EQ(ReadOpacity(folder / "a.exr")->values, (std::vector<float>{1, 1})) << "an EXR's alpha, even if opaque";
  EXPECT_FALSE(ReadPicture(folder / "red.png")->hasAlpha);
  EXPECT_TRUE(ReadPicture(folder / "red.png")->encoded);
  EXPECT_TRUE(ReadPicture(folder / "a.exr")->hasAlpha);
  EXPECT_EQ(ReadOpacity(folder / "none.exr").error().code, ErrorCode::InputMissing);
}

}  // namespace
}  // namespace fur::test

// FLIP against the published tool's figures, and against closed forms.
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <sstream>

#include "compare_internal.h"
#include "compare_pictures.h"

namespace fur::test {
namespace {

namespace fs = std::filesystem;

struct Published {
  std::string reference, test;
  double mean, median, q1, q3, min, max;
};

// Beside the models; FUR_ASSETS in the environment wins.
fs::path FlipFolder() {
  const char* assets = std::getenv("FUR_ASSETS");
  return fs::path(assets && *assets ? assets : FUR_ASSETS_DIR) / ".." / "flip";
}

std::vector<Published> ReadTable(const fs::path& file) {
  std::ifstream in(file);
  std::string line;
  std::getline(in, line);  // names of the columns
  std::vector<Published> rows;
  while (std::getline(in, line)) {
    std::istringstream fields(line);
    Published p;
    if (fields >> p.reference >> p.test >> p.mean >> p.median >> p.q1 >> p.q3 >> p.min >> p.max) rows.push_back(p);
  }
  return rows;
}

TEST(Flip, AgreesWithThePublishedTool) {
  const fs::path folder = FlipFolder();
  if (!fs::exists(folder / "expected.tsv"))
    GTEST_SKIP() << "no pictures with published values: " << folder << " is absent";
  const std::vector<Published> rows = ReadTable(folder / "expected.tsv");
  EXPECT_GE(rows.size(), 9u);
  for (const Published& row : rows) {
    SCOPED_TRACE(row.reference + " " + row.test);
    const Result<Picture> a = ReadPicture(folder / row.reference), b = ReadPicture(folder / row.test);
    ASSERT_TRUE(a && b);
    const Comparison::Flip flip = Compared(*a, *b).flip;
    EXPECT_NEAR(flip.mean, row.mean, 1e-4);
    EXPECT_NEAR(flip.weightedMedian, row.median, 1e-4);
    EXPECT_NEAR(flip.q1, row.q1, 1e-4);
    EXPECT_NEAR(flip.q3, row.q3, 1e-4);
    EXPECT_NEAR(flip.min, row.min, 1e-4);
    EXPECT_NEAR(flip.max, row.max, 1e-4);
  }
}

double Lightness(int grey) {
  const double e = grey / 255.0, y = e <= 0.04045 ? e / 12.92 : std::pow((e + 0.055) / 1.055, 2.4);
  return y > 216.0 / 24389 ? 116 * std::cbrt(y) - 16 : y * 24389 / 27;
}

// Greys without features: the error is the stretched difference in lightness. sRGB's green and blue in Lab are
// (87.735, -86.183, 83.179) and (32.297, 79.188, -107.860).
double ExpectedOfGreys(int a, int b) {
  const double green[] = {87.735, -86.183 * 0.87735, 83.179 * 0.87735};
  const double blue[] = {32.297, 79.188 * 0.32297, -107.860 * 0.32297};
  const double largest = std::pow(green[0] - blue[0] + std::hypot(green[1] - blue[1], green[2] - blue[2]), 0.7);
  const double error = std::pow(std::abs(Lightness(a) - Lightness(b)), 0.7);
  return error < 0.4 * largest ? error / largest * 0.95 / 0.4 : 0.95 + (error / largest - 0.4) / 0.6 * 0.05;
}

TEST(Flip, OfTwoGreysIsTheDifferenceInLightness) {
  for (const auto& [a, b] : {std::pair{0, 255}, {255, 0}, {128, 129}, {10, 60}, {200, 90}, {3, 5}}) {
    const Comparison c = Compared(Flat(33, 17, a, a, a), Flat(33, 17, b, b, b));
    const double expected = ExpectedOfGreys(a, b);
    const Comparison::Flip& f = c.flip;
    for (const double value : {f.mean, f.min, f.max, f.weightedMedian, f.p99, *f.maskMean})
      EXPECT_NEAR(value, expected, 2e-5) << a << " " << b;
  }
}

TEST(Flip, IsSymmetricAndZeroForEqualPictures) {
  const Picture a = Pattern(40, 31, 1), b = Pattern(40, 31, 2);
  EXPECT_EQ(Compared(a, a).flip.max, 0);
  EXPECT_EQ(Compared(a, b).flipMap.values, Compared(b, a).flipMap.values);
  EXPECT_GT(Compared(a, b).flip.mean, 0.05);
}

constexpr uint32_t kSide = 24;
using Color = std::function<glm::vec4(uint32_t, uint32_t)>;

Picture Square(const Color& color) { return MakePicture(kSide, kSide, true, false, color); }

Picture Turned(const Color& color) {
  return Square([&](uint32_t x, uint32_t y) { return color(y, kSide - 1 - x); });
}

// Each way must give the same map: nothing prefers x to y, or left to right.
TEST(Flip, TurnsWithThePicture) {
  const auto color = [](uint32_t x, uint32_t y) {
    return glm::vec4(float(x * x % 23) / 23, float(x * y % 17) / 17, float(y % 5) / 5, 1);
  };
  const auto other = [&](uint32_t x, uint32_t y) { return color(x + 1, y + 2); };
  const Plane map = Compared(Square(color), Square(other)).flipMap;
  const Plane turnedMap = Compared(Turned(color), Turned(other)).flipMap;
  for (uint32_t y = 0; y < kSide; ++y)
    for (uint32_t x = 0; x < kSide; ++x)
      EXPECT_NEAR(turnedMap.values[y * kSide + x], map.values[(kSide - 1 - x) * kSide + y], 2e-4) << x << " " << y;
}

// Detail that the eye cannot resolve does not count; from near it does.
TEST(Flip, FallsWithThePixelsPerDegree) {
  const auto checker = [](uint32_t x, uint32_t y) { return glm::vec4(glm::vec3((x + y) % 2 ? 0.8f : 0.5f), 1); };
  const auto inverse = [&](uint32_t x, uint32_t y) { return checker(x + 1, y); };
  const Picture a = MakePicture(64, 64, true, false, checker), b = MakePicture(64, 64, true, false, inverse);
  EXPECT_GT(Compared(a, b, {.pixelsPerDegree = 10}).flip.mean, 3 * Compared(a, b, {.pixelsPerDegree = 100}).flip.mean);
}

TEST(Flip, TinyPicturesAndNarrowOnes) {
  for (const auto& [w, h] : {std::pair{1u, 1u}, {1u, 40u}, {50u, 1u}, {2u, 3u}}) {
    const Comparison c = Compared(Flat(w, h, 0, 0, 0), Flat(w, h, 255, 255, 255));
    EXPECT_NEAR(c.flip.mean, ExpectedOfGreys(0, 255), 1e-4) << w << " x " << h;
  }
}

TEST(Flip, LinearValuesAreClampedAndEncodedFirst) {
  const Comparison bright = Compared(LinearFlat(20, 20, {4, 4, 4}), LinearFlat(20, 20, {1, 1, 1}));
  EXPECT_EQ(bright.flip.max, 0);
  EXPECT_EQ(bright.largest, 0);
  EXPECT_NEAR(bright.rmse, 3, 1e-6) << "linear light is not clamped";
  EXPECT_EQ(bright.equalShare, 0);
  EXPECT_NEAR(Compared(LinearFlat(20, 20, {0, 0, 0}), LinearFlat(20, 20, glm::vec3(0.21586050f))).flip.mean,
              Compared(Flat(20, 20, 0, 0, 0), Flat(20, 20, 128, 128, 128)).flip.mean, 1e-5);
  EXPECT_EQ(Compared(LinearFlat(20, 20, {-1, 0, 0}), LinearFlat(20, 20, {0, 0, 0})).flip.max, 0);
}

TEST(HeatMap, HasTheColoursOfMagma) {
  const std::vector<uint8_t> rgba = HeatMap(MakePlane(5, {0, 0.5f, 1, 0.125f, 7}), 1);
  const std::vector<uint8_t> expected{0,   0,   4,  255, 182, 54,  121, 255, 252, 253,
                                      191, 255, 29, 17,  71,  255, 252, 253, 191, 255};
  EXPECT_EQ(rgba, expected);
  EXPECT_EQ(HeatMap(MakePlane(1, {0.25f}), 2), HeatMap(MakePlane(1, {0.5f}), 1));
}

}  // namespace
}  // namespace fur::test

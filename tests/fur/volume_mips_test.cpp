// Which law makes the best mips of a fur volume: candidates and the shipped one against the filtered mip 0 stack.
#include "volume_mips.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <random>

#include "fur/bake.h"
#include "fur/coat.h"
#include "mip_laws.h"

namespace fur::test {
namespace {

constexpr uint32_t kLevels = 5;
// Texels of mip 0 per slice. The first three choose the law, the others only show that it holds elsewhere.
constexpr std::array kShears = {0.0, 2.0, 8.0, 0.5, 1.0, 4.0, 16.0};
constexpr size_t kChoosing = 3;

struct TestVolume {
  std::string name;
  FurVolume volume;
  double falloff = 0;
};

void EmptyTop(FurVolume* v) {
  const size_t texels = size_t(v->width) * v->height;
  for (size_t i = texels * (v->layers - 1); i < texels * v->layers; ++i) v->pixels[i * 4 + 3] = 0;
}

// The default coat with more or fewer strands.
FurVolume Grown(double density, uint32_t seed) {
  CoatParams params;
  params.seed = seed;
  params.under.density *= density, params.over.density *= density;
  return BakeVolume(params, GrowStrandList(params));
}

std::vector<TestVolume> TestVolumes() {
  std::vector<std::filesystem::path> files;
  for (int i = 0; i < 16; ++i)
    files.push_back(std::filesystem::path(FUR_ASSETS_DIR) / "cat/fur_layers" /
                    ((i < 10 ? "0" : "") + std::to_string(i) + ".png"));
  const Result<FurVolume> cat = LoadFurLayers(files);
  EXPECT_TRUE(cat) << "the cat's layers";
  std::vector<TestVolume> all;
  if (cat) all.push_back({"cat", *cat, 1});
  all.push_back({"strands", Grown(1, 1), 0});
  all.push_back({"dense", Grown(2, 2), 0});
  all.push_back({"sparse", Grown(0.4, 3), 0});
  for (TestVolume& v : all) EmptyTop(&v.volume);
  return all;
}

Stack LevelOf(const FurVolume& v, const std::vector<MipChain>& mips, uint32_t level, double falloff) {
  FurVolume mip{.width = v.width >> level, .height = v.height >> level, .layers = v.layers};
  for (const auto& slice : mips) mip.pixels.insert(mip.pixels.end(), slice[level].begin(), slice[level].end());
  return CompositedStack(mip, falloff);
}

// Mean squares over the texels; of the weights, the sum over the slices.
struct Squares {
  double transmittance = 0, weights = 0;
  double Both() const { return (transmittance + weights) / 2; }
};

Squares Compare(const std::vector<Profile>& a, const std::vector<Profile>& b) {
  Squares s;
  for (size_t i = 0; i < a.size(); ++i) {
    s.transmittance += std::pow(a[i].transmittance - b[i].transmittance, 2) / double(a.size());
    for (size_t j = 0; j < a[i].weights.size(); ++j)
      s.weights += std::pow(a[i].weights[j] - b[i].weights[j], 2) / double(a.size());
  }
  return s;
}

struct Score {
  std::string law;
  std::array<Squares, kShears.size()> byShear;  // means over volumes, mips, directions
  std::vector<double> byVolume;                 // of Both() over the choosing shears
  double Overall() const {
    double sum = 0;
    for (size_t i = 0; i < kChoosing; ++i) sum += byShear[i].Both() / kChoosing;
    return std::sqrt(sum);
  }
  // Weighted by how much of a ball's picture shows each shear. On a tile of kTileOverLength fur lengths that is
  // 128 texels wide with 16 slices, shear = 2 tan(angle), and sin^2(angle) of the picture lies below an angle.
  double Ball() const {
    const auto below = [](double shear) { return shear * shear / (shear * shear + 4); };
    constexpr std::array kUpTo = {0.25, 3.0, 12.0, 0.75, 1.5, 6.0, 1e9}, kFrom = {0.0, 1.5, 6.0, 0.25, 0.75, 3.0, 12.0};
    double sum = 0;
    for (size_t i = 0; i < kShears.size(); ++i) sum += byShear[i].Both() * (below(kUpTo[i]) - below(kFrom[i]));
    return std::sqrt(sum);
  }
};

void Judge(const TestVolume& v, const std::vector<MipLaw>& laws, double share, std::vector<Score>* scores) {
  const Stack mip0 = CompositedStack(v.volume, v.falloff);
  for (Score& s : *scores) s.byVolume.push_back(0);
  for (uint32_t level = 1; level <= kLevels; ++level) {
    std::vector<Stack> mips;
    for (const MipLaw& law : laws) mips.push_back(Quantized(law.make(mip0, level), v.falloff));
    for (size_t i = 0; i < kShears.size(); ++i)
      for (const Shear& shear : Turned(kShears[i])) {
        const std::vector<Profile> truth = TrueProfiles(mip0, level, shear);
        const double part = 1.0 / double(kLevels * Turned(kShears[i]).size());
        for (size_t l = 0; l < laws.size(); ++l) {
          const Squares e = Compare(MipProfiles(mips[l], level, shear), truth);
          (*scores)[l].byShear[i].transmittance += e.transmittance * part * share;
          (*scores)[l].byShear[i].weights += e.weights * part * share;
          if (i < kChoosing) (*scores)[l].byVolume.back() += e.Both() * part / kChoosing;
        }
      }
  }
}

void Print(const std::vector<Score>& scores, const std::vector<TestVolume>& volumes) {
  std::printf("RMSE x 1000 over %zu volumes, mips 1..%u; T: transmittance, w: visible weights of the slices\n| law |",
              volumes.size(), kLevels);
  for (size_t i = 0; i < kChoosing; ++i) std::printf(" T, shear %g | w, shear %g |", kShears[i], kShears[i]);
  for (const TestVolume& v : volumes) std::printf(" %s |", v.name.c_str());
  std::printf(" **overall** | ball |\n|---|");
  for (size_t i = 0; i < 2 * kChoosing + volumes.size() + 2; ++i) std::printf("---|");
  for (const Score& s : scores) {
    std::printf("\n| %s |", s.law.c_str());
    for (size_t i = 0; i < kChoosing; ++i)
      std::printf(" %.1f | %.1f |", 1000 * std::sqrt(s.byShear[i].transmittance),
                  1000 * std::sqrt(s.byShear[i].weights));
    for (const double square : s.byVolume) std::printf(" %.1f |", 1000 * std::sqrt(square));
    std::printf(" %.1f | %.1f |", 1000 * s.Overall(), 1000 * s.Ball());
  }
  std::printf("\n");
}

TEST(VolumeMips, ShippedLawIsAmongTheBest) {
  const std::vector<TestVolume> volumes = TestVolumes();
  std::vector<MipLaw> laws = CandidateLaws();
  const FurVolume* current = nullptr;
  double falloff = 0;
  std::vector<MipChain> shipped;
  laws.push_back({"shipped: visible from 0 1 2 8",
                  [&](const Stack&, uint32_t level) { return LevelOf(*current, shipped, level, falloff); }});
  std::vector<Score> scores;
  for (const MipLaw& law : laws) scores.push_back({law.name, {}, {}});
  for (const TestVolume& v : volumes) {
    current = &v.volume, falloff = v.falloff, shipped = MakeVolumeMips(v.volume, v.falloff);
    Judge(v, laws, 1.0 / double(volumes.size()), &scores);
  }
  Print(scores, volumes);
  double best = 1;
  for (const Score& s : scores) best = std::min(best, s.Overall());
  EXPECT_LE(scores.back().Overall(), 1.02 * best);
  EXPECT_LT(scores.back().Overall(), 0.9 * scores[0].Overall()) << "no better than the mean";
}

FurVolume Volume(uint32_t width, uint32_t height, uint32_t layers, auto coverage) {
  FurVolume v{.width = width, .height = height, .layers = layers};
  for (uint32_t j = 0; j < layers; ++j)
    for (uint32_t y = 0; y < height; ++y)
      for (uint32_t x = 0; x < width; ++x) v.pixels.insert(v.pixels.end(), {128, 128, 255, uint8_t(coverage(x, y, j))});
  return v;
}

TEST(VolumeMips, ConstantCoverageStays) {
  for (const double falloff : {0.0, 0.5, 1.0})
    for (const int a : {0, 1, 77, 254, 255})
      for (const auto& [w, h] : {std::pair{16u, 16u}, {13u, 5u}, {1u, 7u}})
        for (const auto& slice : MakeVolumeMips(Volume(w, h, 5, [&](auto...) { return a; }), falloff))
          for (const auto& level : slice)
            for (size_t i = 3; i < level.size(); i += 4) ASSERT_EQ(level[i], a) << w << " x " << h << ", " << falloff;
}

TEST(VolumeMips, LevelsHalveAndLevelZeroIsTheVolume) {
  const FurVolume v = Volume(13, 4, 3, [](uint32_t x, uint32_t y, uint32_t j) { return x * 17 + y * 5 + j; });
  const auto mips = MakeVolumeMips(v, 0.5);
  ASSERT_EQ(mips.size(), 3u);
  for (size_t j = 0; j < 3; ++j) {
    ASSERT_EQ(mips[j].size(), 4u);  // 13 x 4, 6 x 2, 3 x 1, 1 x 1
    EXPECT_TRUE(std::equal(mips[j][0].begin(), mips[j][0].end(), v.pixels.begin() + std::ptrdiff_t(j * 13 * 4 * 4)));
    EXPECT_EQ(mips[j][1].size(), 6u * 2 * 4);
    EXPECT_EQ(mips[j][3].size(), 4u);
  }
}

// One opaque slice over half of the texels, empty slices around it: half of the light comes through at every level.
TEST(VolumeMips, OpaqueCheckerboardLetsHalfThrough) {
  const FurVolume v =
      Volume(16, 16, 4, [](uint32_t x, uint32_t y, uint32_t j) { return j == 2 && (x + y) % 2 ? 255 : 0; });
  const Stack mip0 = CompositedStack(v, 0);
  const auto mips = MakeVolumeMips(v, 0);
  for (uint32_t level = 1; level <= 4; ++level) {
    for (const Profile& p : MipProfiles(CumulativeMip(mip0, level), level, {})) EXPECT_EQ(p.transmittance, 0.5);
    for (const Profile& p : MipProfiles(LevelOf(v, mips, level, 0), level, {}))
      EXPECT_NEAR(p.transmittance, 0.5, 0.5 / 255 + 1e-9);
  }
}

// 1 - M_j / M_(j+1) by its definition: the cumulative transmittance of the mip is the mean of mip 0's, to the digit.
TEST(VolumeMips, CumulativeLawIsExactAtShearZero) {
  for (const TestVolume& v : TestVolumes()) {
    const Stack mip0 = CompositedStack(v.volume, v.falloff);
    for (uint32_t level = 1; level <= kLevels; ++level) {
      const Squares e = Compare(MipProfiles(CumulativeMip(mip0, level), level, {}), TrueProfiles(mip0, level, {}));
      EXPECT_LT(std::sqrt(e.transmittance), 1e-9) << v.name << ", mip " << level;
      EXPECT_LT(std::sqrt(e.weights), 1e-9) << v.name << ", mip " << level;
    }
  }
}

// The highest slice is seen whole from everywhere: its mips are plain means.
TEST(VolumeMips, HighestSliceIsTheMean) {
  const auto mips =
      MakeVolumeMips(Volume(2, 2, 3, [](uint32_t x, uint32_t y, uint32_t) { return 40 * x + 100 * y; }), 1);
  EXPECT_EQ(mips[2][1][3], 70);
}

// Two hairs that stand straight on a wide tile: from above only their tops can be seen, so a lower slice loses
// coverage, but aslant it does not, so it keeps most of it. One hair in 4 x 4 texels.
TEST(VolumeMips, WhatIsHiddenCountsLess) {
  const auto hair = [](uint32_t x, uint32_t y, uint32_t j) { return j < 3 && x % 4 == 1 && y % 4 == 1 ? 255 : 0; };
  const auto mips = MakeVolumeMips(Volume(64, 64, 4, hair), 0);
  EXPECT_EQ(mips[2][2][3], 16);  // 255 / 16
  EXPECT_LT(mips[0][2][3], 15);
  EXPECT_GT(mips[0][2][3], 0);
  // Coverage that is composited with less above hides less.
  EXPECT_GT(MakeVolumeMips(Volume(64, 64, 4, hair), 1)[0][2][3], mips[0][2][3]);
}

// What is hidden from everywhere has nothing to be weighed with; the mean serves.
TEST(VolumeMips, BuriedSliceIsTheMean) {
  const auto buried = [](uint32_t x, uint32_t y, uint32_t j) { return j == 1 ? 255u : 40 * x + 100 * y; };
  const auto mips = MakeVolumeMips(Volume(2, 2, 2, buried), 0);
  EXPECT_EQ(mips[0][1][3], 70);
  EXPECT_EQ(mips[1][1][3], 255);
}

std::vector<uint8_t> OneTexel(std::vector<uint8_t> rgba, uint32_t width, uint32_t height) {
  return MakeVolumeMips({.width = width, .height = height, .layers = 1, .pixels = std::move(rgba)}, 0)[0].back();
}

// An empty texel has no direction to contribute.
TEST(VolumeMips, CoverageWeighsDirections) {
  EXPECT_EQ(OneTexel({200, 100, 50, 255, 0, 255, 0, 0, 0, 255, 0, 0, 0, 255, 0, 0}, 2, 2),
            (std::vector<uint8_t>{200, 100, 50, 64}));
  EXPECT_EQ(OneTexel({200, 100, 50, 150, 0, 0, 0, 0, 100, 200, 50, 50, 255, 255, 255, 0}, 2, 2),
            (std::vector<uint8_t>{175, 125, 50, 50}));
}

TEST(VolumeMips, NoCoverageAtAllGivesThePlainMean) {
  EXPECT_EQ(OneTexel({0, 10, 20, 0, 100, 10, 20, 0, 0, 10, 20, 0, 100, 10, 20, 0}, 2, 2),
            (std::vector<uint8_t>{50, 10, 20, 0}));
}

// At odd sizes every texel counts.
TEST(VolumeMips, OddSizesLoseNothing) {
  EXPECT_EQ(OneTexel({0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 255}, 3, 1)[3], 85);
  EXPECT_EQ(OneTexel({0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 100}, 1, 5)[3], 20);
}

// ------------------------------------------------------------------------------------------------- slices for shells
// Slices of noise, of which level 1 is other noise.
std::vector<MipChain> Noise(uint32_t slices) {
  std::mt19937 random(slices);
  std::vector<MipChain> all;
  for (uint32_t i = 0; i < slices; ++i) {
    MipChain& chain = all.emplace_back();
    for (const size_t texels : {4096u, 1024u})
      for (auto& level = chain.emplace_back(); level.size() < texels * 4;) level.push_back(uint8_t(random()));
  }
  return all;
}

// Height (i + 1/2) / N is a slice's middle where N0 / N is odd.
TEST(SlicesAtShells, AreTheSlicesThatShellsLieOn) {
  const std::vector<MipChain> slices = Noise(9), three = SlicesAtShells(slices, 3), one = SlicesAtShells(slices, 1);
  ASSERT_EQ(three.size(), 3u);
  for (size_t i = 0; i < 3; ++i) EXPECT_EQ(three[i], slices[3 * i + 1]) << i;
  EXPECT_EQ(one, std::vector<MipChain>{slices[4]});
}

// The formula of docs/accuracy.md in double, level by level; and what is rounded is right in the mean.
TEST(SlicesAtShells, AreLinearBetweenSlices) {
  const std::vector<MipChain> slices = Noise(16);
  for (const uint32_t n : {2u, 5u, 7u, 8u, 15u}) {
    const std::vector<MipChain> own = SlicesAtShells(slices, n);
    ASSERT_EQ(own.size(), n);
    double sum = 0, values = 0;
    for (uint32_t i = 0; i < n; ++i) {
      const double z = (i + 0.5) / n * 16 - 0.5;
      const auto below = size_t(std::floor(z));
      for (size_t level = 0; level < 2; ++level)
        for (size_t b = 0; b < own[i][level].size(); ++b) {
          const int lower = slices[below][level][b], upper = slices[below + 1][level][b];
          const double exact = lower + (upper - lower) * (z - double(below));
          ASSERT_NEAR(own[i][level][b], exact, 0.5 + 1e-9) << n << " shells, shell " << i;
          sum += own[i][level][b] - exact;
          ++values;
        }
    }
    EXPECT_NEAR(sum / values, 0, 0.01) << n << " shells: 0.25 with halves rounded up";
  }
}

// One slice of coverage among empty ones, within one slab: the integral of ln(1 - a t) over 0 <= t <= 1 is
// -((1 - a) ln(1 - a) + a) / a, once on each side of the slice.
TEST(VolumeAtShells, HoldTheSlabsWholeDepth) {
  for (const uint32_t shells : {1u, 2u, 4u})
    for (const uint8_t coverage : std::initializer_list<uint8_t>{20, 128, 250}) {
      std::vector<MipChain> slices(16, MipChain{{10, 20, 30, 0}});
      const uint32_t slab = shells / 2, middle = slab * 16 / shells + 8 / shells;
      slices[middle][0][3] = coverage;
      const double a = coverage / 255.0, depth = 2 * ((1 - a) * std::log(1 - a) + a) / a;
      const std::vector<MipChain> own = VolumeAtShells(slices, shells, 0);
      EXPECT_NEAR(own[slab][0][3], 255 * -std::expm1(-depth * shells / 16), 0.6) << shells << " shells, " << int(coverage);
      EXPECT_EQ(own[slab][0][0], 10);
    }
}

// Even fur stays as it is; and of fur that thins towards the tip the shader, which takes the falloff off, gets the slab's mean.
TEST(VolumeAtShells, EvenFurStays) {
  for (const uint8_t coverage : std::initializer_list<uint8_t>{0, 1, 77, 254})
    for (const uint32_t shells : {1u, 3u, 7u, 8u})
      for (const MipChain& own : VolumeAtShells(std::vector<MipChain>(16, MipChain{{1, 2, 3, coverage}}), shells, 0))
        EXPECT_EQ(own, (MipChain{{1, 2, 3, coverage}})) << shells;
  const std::vector<MipChain> own = VolumeAtShells(std::vector<MipChain>(16, MipChain{{1, 2, 3, 60}}), 4, 1);
  for (uint32_t i = 0; i < 4; ++i) {
    double depth = 0;
    for (int k = 0; k < 4000; ++k) {
      const double z = std::clamp(i * 4 - 0.5 + (k + 0.5) / 1000, 0.0, 15.0);
      depth -= std::log(1 - 60 / 255.0 * (1 - z / 16));
    }
    EXPECT_NEAR(own[i][0][3] / 255.0 * (1 - (i * 4 + 1.5) / 16), -std::expm1(-depth / 4000), 0.6 / 255) << i;
  }
}

}  // namespace
}  // namespace fur::test

// Mips of the strands' own colours.
#include <gtest/gtest.h>

#include <cmath>

#include "fur/bake.h"
#include "volume_mips.h"

namespace fur::test {
namespace {

// Weighted by coverage over the texels of mip 0 below a texel; their plain mean where nothing is covered.
double Expected(const FurVolume& v, size_t slice, uint32_t level, uint32_t x, uint32_t y, size_t channel) {
  double covered = 0, coverage = 0, plain = 0;
  const uint32_t side = 1u << level;
  for (uint32_t j = y * side; j < (y + 1) * side; ++j)
    for (uint32_t i = x * side; i < (x + 1) * side; ++i) {
      const size_t at = ((slice * v.height + j) * v.width + i) * 4;
      covered += double(v.tint[at + channel]) * v.pixels[at + 3];
      coverage += v.pixels[at + 3];
      plain += v.tint[at + channel];
    }
  return coverage > 0 ? covered / coverage : plain / (side * side);
}

TEST(TintMips, AreMeansWeightedByCoverage) {
  CoatParams params;
  params.size = 32, params.layers = 6;
  params.over.tintSpread = params.under.tintSpread = 0.3;
  const FurVolume v = BakeVolume(params, GrowStrandList(params));
  const std::vector<MipChain> mips = MakeTintMips(v);
  ASSERT_EQ(mips.size(), v.layers);
  for (size_t slice = 0; slice < v.layers; ++slice) {
    ASSERT_EQ(mips[slice].size(), 6u);
    for (uint32_t level = 0; level < 6; ++level) {
      const uint32_t side = 32u >> level;
      ASSERT_EQ(mips[slice][level].size(), size_t{4} * side * side);
      for (size_t i = 0; i < mips[slice][level].size(); ++i) {
        const auto texel = uint32_t(i / 4);
        ASSERT_NEAR(mips[slice][level][i], Expected(v, slice, level, texel % side, texel / side, i % 4), 0.5 + 1e-9)
            << "slice " << slice << ", level " << level;
      }
    }
  }
}

// One red strand among white nothing.
TEST(TintMips, NothingBleedsFromTexelsWithoutFur) {
  FurVolume v{.width = 4, .height = 4, .layers = 1, .pixels = std::vector<uint8_t>(64), .tint = std::vector<uint8_t>(64, 255)};
  v.pixels[4 * 6 + 3] = 9;
  for (size_t c = 0; c < 3; ++c) v.tint[4 * 6 + c] = c == 0 ? 200 : 10;
  const MipChain mips = MakeTintMips(v)[0];
  EXPECT_EQ(mips[2], (std::vector<uint8_t>{200, 10, 10, 255}));
  EXPECT_EQ(mips[1][0], 255) << "no fur at all: the plain mean";
}

}  // namespace
}  // namespace fur::test

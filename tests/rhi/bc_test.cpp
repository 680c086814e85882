// Block-compressed textures, against blocks decoded by hand.
#include "rhi_fixture.h"

namespace rhi_test {
namespace {

using namespace rhi;

using Block = std::vector<uint8_t>;

uint16_t To565(uint32_t r, uint32_t g, uint32_t b) { return uint16_t(r << 11 | g << 5 | b); }

void Append(Block* out, uint64_t value, int bytes) {
  for (int i = 0; i < bytes; ++i) out->push_back(uint8_t(value >> (8 * i)));
}

// Two colours, the first for the even columns: index 0 or 1 for each texel.
Block Bc1(uint16_t even, uint16_t odd) {
  Block b;
  Append(&b, even, 2);
  Append(&b, odd, 2);
  Append(&b, 0x44444444u, 4);
  return b;
}
// The same for one channel of 8 bits: 16 indices of 3 bits, 0 1 0 1 ...
Block Bc4(uint8_t even, uint8_t odd) {
  Block b{even, odd};
  uint64_t indices = 0;
  for (int i = 1; i < 16; i += 2) indices |= uint64_t(1) << (3 * i);
  Append(&b, indices, 6);
  return b;
}
Block Join(const Block& a, const Block& b) {
  Block all = a;
  all.insert(all.end(), b.begin(), b.end());
  return all;
}
// Mode 6 with both end points equal: 7 bits of each channel and a common lowest bit.
Block Bc7(const Rgba8& color) {
  uint64_t low = 1u << 6;
  for (size_t c = 0; c < 4; ++c)
    low |= uint64_t(color[c] >> 1) << (7 + 14 * c) | uint64_t(color[c] >> 1) << (14 + 14 * c);
  const uint64_t p = color[3] & 1;
  low |= p << 63;
  Block b;
  Append(&b, low, 8);
  Append(&b, p, 8);
  return b;
}

class BcTest : public RhiTest {
 protected:
  // width x height texels of one block over and over; the last row and column of blocks may be cut.
  static Block Repeat(const Block& block, uint32_t width, uint32_t height) {
    Block all;
    for (uint32_t i = 0; i < (width + 3) / 4 * ((height + 3) / 4); ++i)
      all.insert(all.end(), block.begin(), block.end());
    return all;
  }
  Image Show(ITexture* t, uint32_t width, uint32_t height) {
    const Target target = gpu.MakeTarget({.width = width, .height = height});
    gpu.SetTarget(target);
    gpu.SetTexture(Stage::Pixel, 0, t);
    gpu.DrawRect(test_shaders::sample_PSLoad);
    return gpu.Read(target);
  }
  struct Case {
    Format format;
    Block block;
    Rgba8 even, odd;
  };
  static std::vector<Case> Cases() {
    const Block colors = Bc1(To565(31, 0, 0), To565(0, 0, 31));
    const Rgba8 red{255, 0, 0, 255}, blue{0, 0, 255, 255}, gray{41, 121, 201, 81};
    return {{Format::BC1_UNorm, colors, red, blue},
            {Format::BC3_UNorm, Join(Bc4(200, 50), colors), {255, 0, 0, 200}, {0, 0, 255, 50}},
            {Format::BC5_UNorm, Join(Bc4(240, 10), Bc4(90, 30)), {240, 90, 0, 255}, {10, 30, 0, 255}},
            {Format::BC7_UNorm, Bc7(gray), gray, gray}};
  }
};

TEST_P(BcTest, EachFormatIsDecoded) {
  RHI_NEEDS_CAP(textureCompressionBC);
  for (const Case& c : Cases())
    for (const auto& [width, height] : {std::pair{8u, 8u}, std::pair{10u, 6u}}) {
      const Block data = Repeat(c.block, width, height);
      const SubresourceData init{data.data(), (width + 3) / 4 * uint32_t(c.block.size()), 0};
      const Ref<ITexture> t = gpu.Texture({.width = width, .height = height, .format = c.format}, &init);
      EXPECT_TRUE(Matches(Show(t.get(), width, height), [&](uint32_t x, auto) { return x % 2 ? c.odd : c.even; }))
          << ToString(c.format) << width;
      std::vector<uint8_t> back(data.size());
      ASSERT_EQ(device.ReadBack(t.get(), 0, back.data(), back.size()), Status::Ok);
      EXPECT_EQ(back, data) << ToString(c.format) << width;
    }
}

// A box of blocks, from rows with padding; copies of blocks; each slice and mip.
TEST_P(BcTest, BoxesCopiesAndMips) {
  RHI_NEEDS_CAP(textureCompressionBC);
  for (const Case& c : Cases()) {
    const TextureDesc desc{.dim = TextureDim::Tex2DArray,
                           .width = 16,
                           .height = 16,
                           .depthOrArray = 2,
                           .mipLevels = 3,
                           .format = c.format};
    const Ref<ITexture> t = gpu.Texture(desc), copy = gpu.Texture(desc);
    const uint32_t size = uint32_t(c.block.size());
    const Block zeros(size * 16), filled = Repeat(c.block, 16, 16);
    for (uint32_t i = 0; i < 6; ++i) {
      context.UpdateSubresource(t.get(), i, nullptr, zeros.data(), 0, 0);
      context.UpdateSubresource(copy.get(), i, nullptr, zeros.data(), 0, 0);
    }
    const Box box{4, 8, 0, 12, 16, 1};
    context.UpdateSubresource(t.get(), Subresource(0, 1, 3), &box, filled.data(), 3 * size, 0);
    context.CopySubresourceRegion(copy.get(), Subresource(0, 0, 3), 8, 0, 0, t.get(), Subresource(0, 1, 3), &box);
    context.UpdateSubresource(copy.get(), Subresource(2, 1, 3), nullptr, filled.data(), 0, 0);
    const auto blockIs = [&](ITexture* texture, uint32_t subresource, uint32_t blocks, auto inside) {
      std::vector<uint8_t> back(size_t(blocks) * blocks * size);
      ASSERT_EQ(device.ReadBack(texture, subresource, back.data(), back.size()), Status::Ok);
      for (uint32_t i = 0; i < blocks * blocks; ++i) {
        const bool set = std::equal(c.block.begin(), c.block.end(), back.begin() + ptrdiff_t(i) * size);
        EXPECT_EQ(set, inside(i % blocks, i / blocks)) << ToString(c.format) << i;
      }
    };
    blockIs(t.get(), Subresource(0, 1, 3), 4, [](auto x, auto y) { return (x == 1 || x == 2) && y >= 2; });
    blockIs(copy.get(), Subresource(0, 0, 3), 4, [](auto x, auto y) { return x >= 2 && y < 2; });
    blockIs(copy.get(), Subresource(2, 1, 3), 1, [](auto, auto) { return true; });
  }
}

TEST_P(BcTest, BoxesThatCutBlocksAreRefused) {
  RHI_NEEDS_CAP(textureCompressionBC);
  sink.Expect(MsgCode::OutOfBounds, "the box cuts blocks");
  const Ref<ITexture> t = gpu.Texture({.width = 16, .height = 16, .format = Format::BC1_UNorm});
  const Box box{2, 0, 0, 8, 4, 1};
  const Block data(64);
  context.UpdateSubresource(t.get(), 0, &box, data.data(), 0, 0);
  EXPECT_EQ(sink.Count(MsgCode::OutOfBounds), 1);
}

RHI_ON_EVERY_BACKEND(BcTest);

}  // namespace
}  // namespace rhi_test

// Multisampling: resolve, coverage at edges, alpha to coverage, the sample mask.
#include "rhi_fixture.h"

namespace rhi_test {
namespace {

using namespace rhi;

class MsaaTest : public RhiTest {
 protected:
  Target Start(uint32_t width) {
    const Target target = gpu.MakeTarget({.width = width, .height = 4, .samples = 4});
    gpu.Clear(target, {0, 0, 0, 0});
    gpu.SetTarget(target);
    context.RSSetState(gpu.Rasterizer({.multisample = true}).get());
    return target;
  }
};

TEST_P(MsaaTest, ResolveOfWholePixelsIsExact) {
  const Target target = Start(16);
  gpu.DrawRect(test_shaders::rect_PSTint, {.tint = {0.2f, 0.4f, 0.6f, 0.8f}, .rectangle = {-1, 1, 0, -1}});
  EXPECT_TRUE(Matches(gpu.Read(target), [](uint32_t x, auto) {
    return x < 8 ? Rgba8{51, 102, 153, 204} : Rgba8{0, 0, 0, 0};
  }));
}

TEST_P(MsaaTest, MsaaResolve) {
  const Target target = Start(16);
  gpu.DrawRect(test_shaders::rect_PSTint, {.rectangle = {-1, 1, 1 / 16.f, -1}});  // to the middle of pixel 8
  EXPECT_TRUE(Matches(
      gpu.Read(target),
      [](uint32_t x, auto) {
        const uint8_t v = x < 8 ? 255 : x == 8 ? 128 : 0;
        return Rgba8{v, v, v, v};
      },
      Within("resolve_average")));
}

TEST_P(MsaaTest, ResolveIntoALayer) {
  const Target target = Start(16);
  gpu.DrawRect(test_shaders::rect_PSTint, {.tint = {1, 0, 1, 1}});
  const Ref<ITexture> array = gpu.TextureOf<Rgba8>({.dim = TextureDim::Tex2DArray,
                                                    .width = 16,
                                                    .height = 4,
                                                    .depthOrArray = 3,
                                                    .format = Format::RGBA8_UNorm,
                                                    .bind = Bind::RenderTarget | Bind::ShaderResource},
                                                   [](auto, auto, auto, auto) {
                                                     return Rgba8{1, 2, 3, 4};
                                                   });
  context.ResolveSubresource(array.get(), 1, target.color.get(), 0, Format::RGBA8_UNorm);
  for (uint32_t slice = 0; slice < 3; ++slice)
    EXPECT_TRUE(Matches(gpu.Read(array.get(), 0, slice), [&](auto, auto) {
      return slice == 1 ? Rgba8{255, 0, 255, 255} : Rgba8{1, 2, 3, 4};
    })) << slice;
}

TEST_P(MsaaTest, SrgbResolveIsLinear) {
  const Target target = gpu.MakeTarget({.width = 4, .height = 4, .format = Format::RGBA8_UNorm_sRGB, .samples = 4});
  gpu.Clear(target, {0, 0, 0, 0});
  gpu.SetTarget(target);
  context.RSSetState(gpu.Rasterizer({.multisample = true}).get());
  gpu.DrawRect(test_shaders::rect_PSTint, {.rectangle = {-1, 1, -0.75f, -1}});  // half of pixel 0
  const Image image = gpu.Read(target);
  EXPECT_TRUE(Agrees(image.At<Rgba8>(0, 0)[0], ToUnorm8(LinearToSrgb(0.5)), Within("linear_to_srgb")));
}

// Alpha a covers between a * 4 - 1 and a * 4 + 1 samples, and never fewer than a smaller alpha does.
TEST_P(MsaaTest, A2cCoverageBounds) {
  RHI_NEEDS_CAP(alphaToCoverage);
  const Target target = Start(256);
  BlendDesc a2c;
  a2c.alphaToCoverage = true;
  context.OMSetBlendState(gpu.Blend(a2c).get());
  gpu.DrawRect(test_shaders::rect_PSAlphaRamp, {.tint = {1, 1, 1, 1}});
  const Image image = gpu.Read(target);
  double last = 0;
  for (uint32_t x = 0; x < 256; ++x) {
    double covered = 0;  // of four pixels of the column: drivers may dither
    for (uint32_t y = 0; y < 4; ++y) covered += image.At<Rgba8>(x, y)[0] / 255.0 / 4;
    EXPECT_TRUE(Agrees(covered, x / 255.0, Within("alpha_to_coverage"))) << x;
    EXPECT_GE(covered, last - 0.01) << x;
    last = covered;
  }
  EXPECT_EQ(image.At<Rgba8>(0, 0)[0], 0);
  EXPECT_EQ(image.At<Rgba8>(255, 0)[0], 255);
}

TEST_P(MsaaTest, SampleMask) {
  const Target target = Start(16);
  const uint32_t masks[] = {0x0, 0x1, 0x3, 0x7, 0xF, 0x8, 0xA, 0xFFFFFFF0};
  for (uint32_t i = 0; i < 8; ++i) {
    context.OMSetBlendState(nullptr, nullptr, masks[i]);
    const float left = float(i) / 4 - 1;
    gpu.DrawRect(test_shaders::rect_PSTint, {.rectangle = {left, 1, left + 0.25f, -1}});
  }
  const int samples[] = {0, 1, 2, 3, 4, 1, 2, 0};
  EXPECT_TRUE(Matches(
      gpu.Read(target),
      [&](uint32_t x, auto) {
        const uint8_t v = ToUnorm8(samples[x / 2] / 4.0);
        return Rgba8{v, v, v, v};
      },
      Within("resolve_average")));
}

TEST_P(MsaaTest, DepthOfEachSample) {
  const Target target = gpu.MakeTarget({.width = 16, .height = 4, .depthFormat = Format::D32_Float, .samples = 4});
  gpu.Clear(target, {0, 0, 0, 0}, 1);
  gpu.SetTarget(target);
  context.RSSetState(gpu.Rasterizer({.multisample = true}).get());
  gpu.DrawRect(test_shaders::rect_PSTint,
               {.tint = {1, 0, 0, 1}, .rectangle = {-1, 1, 1 / 16.f, -1}, .extra = {0.25f, 0, 0, 0}});
  gpu.DrawRect(test_shaders::rect_PSTint, {.tint = {0, 1, 0, 1}, .extra = {0.5f, 0, 0, 0}});
  EXPECT_TRUE(Matches(
      gpu.Read(target),
      [](uint32_t x, auto) {
        return x < 8 ? Rgba8{255, 0, 0, 255} : x == 8 ? Rgba8{128, 128, 0, 255} : Rgba8{0, 255, 0, 255};
      },
      Within("resolve_average")));
}

// Shaders read single samples; their sum is what a resolve gives.
TEST_P(MsaaTest, SamplesAreReadByShaders) {
  const Target target = Start(4);
  const uint32_t masks[] = {0x1, 0x2, 0x4, 0x8};
  for (uint32_t i = 0; i < 4; ++i) {
    context.OMSetBlendState(nullptr, nullptr, masks[i]);
    gpu.DrawRect(test_shaders::rect_PSTint, {.tint = {float(i + 1) / 255, 0, 0, 1}});
  }
  context.OMSetBlendState(nullptr);
  context.RSSetState(nullptr);
  const Target row = gpu.MakeTarget({.width = 4, .height = 1});
  gpu.SetTarget(row);
  gpu.SetTexture(Stage::Pixel, 1, target.color.get());
  gpu.DrawRect(test_shaders::formats_PSLoadSample);
  EXPECT_TRUE(Matches(gpu.Read(row), [](uint32_t x, auto) { return Rgba8{uint8_t(x + 1), 0, 0, 255}; }));
}

// A target of one sample has a sample mask, too: its lowest bit.
TEST_P(MsaaTest, SampleMaskOfOneSample) {
  const Target target = gpu.MakeTarget({.width = 4, .height = 1});
  gpu.Clear(target, {0, 0, 0, 0});
  gpu.SetTarget(target);
  const uint32_t masks[] = {0x1, 0x0, 0x2, ~0u};
  for (uint32_t i = 0; i < 4; ++i) {
    context.OMSetBlendState(nullptr, nullptr, masks[i]);
    const float left = float(i) / 2 - 1;
    gpu.DrawRect(test_shaders::rect_PSTint, {.rectangle = {left, 1, left + 0.5f, -1}});
  }
  EXPECT_TRUE(Matches(gpu.Read(target), [&](uint32_t x, auto) {
    return masks[x] & 1 ? Rgba8{255, 255, 255, 255} : Rgba8{0, 0, 0, 0};
  }));
}

TEST_P(MsaaTest, WrongResolvesAreReported) {
  const Target target = Start(16);
  const Ref<ITexture> small =
      gpu.Texture({.width = 8, .height = 4, .format = Format::RGBA8_UNorm, .bind = Bind::RenderTarget});
  const Ref<ITexture> other =
      gpu.Texture({.width = 16, .height = 4, .format = Format::RGBA16_Float, .bind = Bind::RenderTarget});
  sink.Allow(MsgCode::FormatMismatch, "formats differ");
  sink.Allow(MsgCode::InvalidDesc, "sizes differ");
  sink.Allow(MsgCode::OutOfBounds, "sizes differ");
  sink.Allow(MsgCode::SubresourceOutOfRange, "no such subresource");
  context.ResolveSubresource(other.get(), 0, target.color.get(), 0, Format::RGBA8_UNorm);
  context.ResolveSubresource(small.get(), 3, target.color.get(), 0, Format::RGBA8_UNorm);
  EXPECT_NE(sink.Dump(), "");
}

RHI_ON_EVERY_BACKEND(MsaaTest);

}  // namespace
}  // namespace rhi_test

// GenerateMips, and the sRGB formats: sampled, drawn to, blended, averaged.
#include "rhi_fixture.h"

namespace rhi_test {
namespace {

using namespace rhi;
using MipsTest = RhiTest;
using SrgbTest = RhiTest;

// A cheap hash, so that no two texels are alike.
Rgba8 Noise(uint32_t x, uint32_t y, uint32_t slice) {
  uint32_t h = x * 374761393u + y * 668265263u + slice * 2246822519u;
  h = (h ^ (h >> 13)) * 1274126177u;
  h ^= h >> 16;
  return {uint8_t(h), uint8_t(h >> 8), uint8_t(h >> 16), uint8_t(h >> 24)};
}

double Decode(uint8_t byte, bool srgb) { return srgb ? SrgbToLinear(byte / 255.0) : byte / 255.0; }
uint8_t Encode(double v, bool srgb) { return ToUnorm8(srgb ? LinearToSrgb(v) : v); }

// The box filter of four texels of the level above, as bytes.
Rgba8 BoxFilter(const Image& above, uint32_t x, uint32_t y, bool srgb) {
  Rgba8 result;
  for (size_t c = 0; c < 4; ++c) {
    double sum = 0;
    for (uint32_t i = 0; i < 4; ++i)
      sum += Decode(above.At<Rgba8>(2 * x + (i & 1), 2 * y + (i >> 1))[c], srgb && c < 3);
    result[c] = Encode(sum / 4, srgb && c < 3);
  }
  return result;
}

TextureDesc MipsDesc(Format format) {
  return {.dim = TextureDim::Tex2DArray,
          .width = 64,
          .height = 64,
          .depthOrArray = 3,
          .mipLevels = 0,
          .format = format,
          .bind = Bind::ShaderResource | Bind::RenderTarget,
          .name = "mips"};
}

void ExpectBoxFiltered(Gpu& gpu, Format format, bool srgb) {
  const Ref<ITexture> t = gpu.TextureOf<Rgba8>(
      MipsDesc(format),
      [](uint32_t x, uint32_t y, uint32_t mip, uint32_t slice) { return mip == 0 ? Noise(x, y, slice) : Rgba8{}; });
  gpu.context->GenerateMips(gpu.View(t.get()).get());
  for (uint32_t slice = 0; slice < 3; ++slice) {
    EXPECT_TRUE(Matches(gpu.Read(t.get(), 0, slice), [slice](uint32_t x, uint32_t y) { return Noise(x, y, slice); }));
    for (uint32_t mip = 1; mip < 7; ++mip) {
      const Image above = gpu.Read(t.get(), mip - 1, slice);
      const auto oracle = [&](uint32_t x, uint32_t y) { return BoxFilter(above, x, y, srgb); };
      EXPECT_TRUE(Matches(gpu.Read(t.get(), mip, slice), oracle, Within("mip_average")))
          << "mip " << mip << " slice " << slice;
    }
  }
}

TEST_P(MipsTest, GenMipsArray) { ExpectBoxFiltered(gpu, Format::RGBA8_UNorm, false); }
TEST_P(MipsTest, GenMipsArraySrgbAveragesLinearly) { ExpectBoxFiltered(gpu, Format::RGBA8_UNorm_sRGB, true); }

TEST_P(MipsTest, GenMipsOfAViewLeavesTheRest) {
  const Ref<ITexture> t =
      gpu.TextureOf<Rgba8>(MipsDesc(Format::RGBA8_UNorm), [](auto, auto, uint32_t mip, uint32_t slice) {
        return Rgba8{uint8_t(mip * 10), uint8_t(slice), 0, 255};
      });
  const ViewDesc some{.firstMip = 1, .mipCount = 3, .firstSlice = 1, .sliceCount = 1};
  context.GenerateMips(gpu.View(t.get(), &some).get());
  for (uint32_t slice = 0; slice < 3; ++slice)
    for (uint32_t mip = 0; mip < 7; ++mip) {
      const bool made = slice == 1 && mip >= 1 && mip <= 3;
      const Rgba8 expected{uint8_t(made ? 10 : mip * 10), uint8_t(slice), 0, 255};
      EXPECT_TRUE(Matches(gpu.Read(t.get(), mip, slice), [&](auto, auto) { return expected; })) << mip << ' ' << slice;
    }
}

TEST_P(MipsTest, GenMipsKeepsTheBoundState) {
  const Ref<ITexture> t = gpu.TextureOf<Rgba8>(MipsDesc(Format::RGBA8_UNorm), [](auto, auto, auto, auto) {
    return Rgba8{8, 8, 8, 8};
  });
  const Target target = gpu.MakeTarget({});
  gpu.SetTarget(target);
  gpu.DrawRect(test_shaders::rect_PSTint, {.tint = {1, 0, 0, 1}, .rectangle = {-1, 1, 0, -1}});
  context.GenerateMips(gpu.View(t.get()).get());
  gpu.SetDraw({.tint = {0, 1, 0, 1}, .rectangle = {0, 1, 1, -1}});
  context.Draw(4, 0);
  EXPECT_TRUE(Matches(gpu.Read(target), [](uint32_t x, auto) {
    return x < 8 ? Rgba8{255, 0, 0, 255} : Rgba8{0, 255, 0, 255};
  }));
}

TEST_P(MipsTest, GenMipsWithoutTheFlagsIsReported) {
  sink.Expect(MsgCode::WrongBindFlag, "GenerateMips needs RenderTarget");
  TextureDesc desc = MipsDesc(Format::RGBA8_UNorm);
  desc.bind = Bind::ShaderResource;
  context.GenerateMips(gpu.View(gpu.Texture(desc).get()).get());
}

// Row 0: bytes 0..255 as sRGB texels.
Ref<ITexture> Ramp(Gpu& gpu, Format format) {
  return gpu.TextureOf<Rgba8>({.width = 256, .height = 1, .format = format}, [](uint32_t x, auto, auto, auto) {
    return Rgba8{uint8_t(x), uint8_t(255 - x), uint8_t(x / 2), uint8_t(x)};
  });
}
Rgba8 RampTexel(uint32_t x, uint32_t) { return {uint8_t(x), uint8_t(255 - x), uint8_t(x / 2), uint8_t(x)}; }

// Drivers decode by an approximation. Direct3D allows half a step of the encoded byte.
TEST_P(SrgbTest, SampledTexelsAreLinear) {
  const Target target = gpu.MakeTarget({.width = 256, .height = 1, .format = Format::RGBA32_Float});
  gpu.SetTarget(target);
  gpu.SetTexture(Stage::Pixel, 0, Ramp(gpu, Format::RGBA8_UNorm_sRGB).get());
  gpu.DrawRect(test_shaders::sample_PSLoad);
  const Image image = gpu.Read(target);
  for (uint32_t x = 0; x < 256; ++x) {
    const Rgba32F linear = image.At<Rgba32F>(x, 0);
    for (size_t c = 0; c < 3; ++c)
      EXPECT_TRUE(Agrees(LinearToSrgb(linear[c]) * 255, RampTexel(x, 0)[c], Within("srgb_decoding"))) << x << ' ' << c;
    EXPECT_TRUE(Agrees(linear[3], float(RampTexel(x, 0)[3]) / 255, Within("unorm_to_float"))) << "alpha is not encoded";
  }
}

TEST_P(SrgbTest, SrgbRoundtrip) {
  const Target target = gpu.MakeTarget({.width = 256, .height = 1, .format = Format::RGBA8_UNorm_sRGB});
  gpu.SetTarget(target);
  gpu.SetTexture(Stage::Pixel, 0, Ramp(gpu, Format::RGBA8_UNorm_sRGB).get());
  gpu.DrawRect(test_shaders::sample_PSLoad);
  EXPECT_TRUE(Matches(gpu.Read(target), RampTexel));
}

TEST_P(SrgbTest, ViewsOfTheTwinFormat) {
  const Ref<ITexture> t = Ramp(gpu, Format::RGBA8_UNorm);
  const ViewDesc twin{.format = Format::RGBA8_UNorm_sRGB};
  const Ref<IShaderResourceView> view = gpu.View(t.get(), &twin);
  IShaderResourceView* raw = view.get();
  const Target target = gpu.MakeTarget({.width = 256, .height = 1, .format = Format::RGBA8_UNorm});
  IRenderTargetView* rtv = nullptr;
  const Ref<IRenderTargetView> encoded = gpu.TargetView(target.color.get(), &twin);
  rtv = encoded.get();
  context.PSSetShaderResources(0, 1, &raw);
  context.OMSetRenderTargets(1, &rtv, nullptr);
  gpu.SetViewport(0, 0, 256, 1);
  gpu.DrawRect(test_shaders::sample_PSLoad);
  EXPECT_TRUE(Matches(gpu.Read(target), RampTexel)) << "decoded and encoded";
  gpu.SetTarget(target);
  gpu.DrawRect(test_shaders::sample_PSLoad);
  EXPECT_TRUE(Matches(
      gpu.Read(target),
      [](uint32_t x, uint32_t y) {
        const Rgba8 t8 = RampTexel(x, y);
        return Rgba8{ToUnorm8(SrgbToLinear(t8[0] / 255.0)), ToUnorm8(SrgbToLinear(t8[1] / 255.0)),
                     ToUnorm8(SrgbToLinear(t8[2] / 255.0)), t8[3]};
      },
      Within("srgb_to_linear")))
      << "decoded only";
}

TEST_P(SrgbTest, ClearAndShaderOutputAreEncoded) {
  const Target target = gpu.MakeTarget({.format = Format::RGBA8_UNorm_sRGB});
  gpu.Clear(target, {0.5f, 0.2f, 0.0025f, 0.5f});
  gpu.SetTarget(target);
  gpu.DrawRect(test_shaders::rect_PSTint, {.tint = {0.5f, 0.2f, 0.0025f, 0.5f}, .rectangle = {-1, 1, 0, -1}});
  const Rgba8 expected{ToUnorm8(LinearToSrgb(0.5)), ToUnorm8(LinearToSrgb(0.2)), ToUnorm8(LinearToSrgb(0.0025)), 128};
  EXPECT_TRUE(Matches(
      gpu.Read(target), [&](auto, auto) { return expected; }, Within("linear_to_srgb")));
}

// Half of white over black is 0.5 of the light: 188, not 128.
TEST_P(SrgbTest, BlendingIsLinear) {
  const Target target = gpu.MakeTarget({.format = Format::RGBA8_UNorm_sRGB});
  gpu.Clear(target, {0.1f, 0.1f, 0.1f, 1});
  gpu.SetTarget(target);
  BlendDesc over;
  over.rt[0] = {.enable = true,
                .src = rhi::Blend::SrcAlpha,
                .dest = rhi::Blend::InvSrcAlpha,
                .srcAlpha = rhi::Blend::One,
                .destAlpha = rhi::Blend::Zero};
  context.OMSetBlendState(gpu.Blend(over).get());
  gpu.DrawRect(test_shaders::rect_PSTint, {.tint = {1, 0.5f, 0, 0.5f}});
  const Rgba8 expected{ToUnorm8(LinearToSrgb(0.55)), ToUnorm8(LinearToSrgb(0.3)), ToUnorm8(LinearToSrgb(0.05)), 128};
  EXPECT_TRUE(Matches(
      gpu.Read(target), [&](auto, auto) { return expected; }, Within("linear_to_srgb")));
}

RHI_ON_EVERY_BACKEND(MipsTest);
INSTANTIATE_TEST_SUITE_P(Rhi, SrgbTest, testing::ValuesIn(Backends()), NameOfBackend);

}  // namespace
}  // namespace rhi_test

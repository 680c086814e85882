// Slices of arrays, cubes and volumes as targets, and their mips: each by itself, and all in one draw.
#include "rhi_fixture.h"

namespace rhi_test {
namespace {

using namespace rhi;

// No two texels are alike.
Rgba8 Noise(uint32_t x, uint32_t y, uint32_t slice) {
  uint32_t h = x * 374761393u + y * 668265263u + slice * 2246822519u;
  h = (h ^ (h >> 13)) * 1274126177u;
  h ^= h >> 16;
  return {uint8_t(h), uint8_t(h >> 8), uint8_t(h >> 16), uint8_t(h >> 24)};
}

class SliceTest : public RhiTest {
 protected:
  static TextureDesc Desc(TextureDim dim, uint32_t slices, uint32_t mips, Bind bind, Format f = Format::RGBA8_UNorm) {
    return {.dim = dim,
            .width = 16,
            .height = 16,
            .depthOrArray = slices,
            .mipLevels = mips,
            .format = f,
            .bind = bind,
            .name = "slices"};
  }
  void SetColor(IRenderTargetView* rtv, uint32_t size) {
    context.OMSetRenderTargets(1, &rtv, nullptr);
    gpu.SetViewport(0, 0, float(size), float(size));
  }
  static auto All(const Rgba8& value) {
    return [=](uint32_t, uint32_t) { return value; };
  }
  // One draw whose geometry shader sends it to every slice; slice i becomes i + 1.
  void DrawEverySlice(const ShaderBlob& geometry) {
    gpu.SetShaders(test_shaders::rect_VSRect, test_shaders::geometry_PSUvX);
    gpu.SetGeometryShader(geometry);
    gpu.SetDraw({});
    context.IASetPrimitiveTopology(PrimitiveTopology::TriangleStrip);
    context.Draw(4, 0);
    context.GSSetShader(nullptr);
  }
  static Rgba8 Sent(uint32_t slice) { return {uint8_t(slice + 1), uint8_t(slice + 1), uint8_t(slice + 1), 255}; }
};

// Each slice of each mip is drawn by a view of its own; all others keep what they have.
TEST_P(SliceTest, EverySliceAndMipIsATarget) {
  const std::pair<TextureDim, uint32_t> kinds[] = {{TextureDim::Tex2DArray, 4}, {TextureDim::TexCube, 6}};
  for (const auto& [dim, slices] : kinds) {
    const Ref<ITexture> t = gpu.Texture(Desc(dim, slices, 3, Bind::RenderTarget | Bind::ShaderResource));
    const auto value = [](uint32_t mip, uint32_t s) { return Rgba8{uint8_t(10 * mip + s + 1), 0, 0, 255}; };
    for (uint32_t mip = 0; mip < 3; ++mip)
      for (uint32_t s = 0; s < slices; ++s) {
        const ViewDesc one{.firstMip = mip, .mipCount = 1, .firstSlice = s, .sliceCount = 1};
        const Ref<IRenderTargetView> rtv = gpu.TargetView(t.get(), &one);
        SetColor(rtv.get(), 16u >> mip);
        gpu.DrawRect(test_shaders::rect_PSTint, {.tint = {float(value(mip, s)[0]) / 255, 0, 0, 1}});
      }
    for (uint32_t mip = 0; mip < 3; ++mip)
      for (uint32_t s = 0; s < slices; ++s)
        EXPECT_TRUE(Matches(gpu.Read(t.get(), mip, s), All(value(mip, s)))) << int(dim) << mip << s;
  }
}

TEST_P(SliceTest, EverySliceOfADepthArray) {
  const Ref<ITexture> t = gpu.Texture(Desc(TextureDim::Tex2DArray, 4, 1, Bind::DepthStencil, Format::D32_Float));
  for (uint32_t s = 0; s < 4; ++s) {
    const ViewDesc one{.firstSlice = s, .sliceCount = 1};
    const Ref<IDepthStencilView> dsv = gpu.DepthView(t.get(), &one);
    context.ClearDepthStencilView(dsv.get(), true, 1, false, 0);
    context.OMSetRenderTargets(0, nullptr, dsv.get());
    gpu.SetViewport(0, 0, 16, 16);
    gpu.DrawRect(test_shaders::rect_PSTint, {.rectangle = {-1, 1, 0, -1}, .extra = {0.125f * float(s + 1), 0, 0, 0}});
  }
  for (uint32_t s = 0; s < 4; ++s)
    EXPECT_TRUE(Matches(gpu.Read(t.get(), 0, s), [s](uint32_t x, auto) {
      return std::array<float, 1>{x < 8 ? 0.125f * float(s + 1) : 1};
    })) << s;
}

TEST_P(SliceTest, OneDrawReachesEveryFaceOfACube) {
  RHI_NEEDS_CAP(layeredRendering);
  const Ref<ITexture> t = gpu.Texture(Desc(TextureDim::TexCube, 6, 1, Bind::RenderTarget));
  const Ref<IRenderTargetView> rtv = gpu.TargetView(t.get());
  SetColor(rtv.get(), 16);
  DrawEverySlice(test_shaders::geometry_GSMainSix);
  for (uint32_t s = 0; s < 6; ++s) EXPECT_TRUE(Matches(gpu.Read(t.get(), 0, s), All(Sent(s)))) << s;
}

// A Tex3D's target view shows all depth slices of its mip; a clear clears them all.
TEST_P(SliceTest, OneDrawReachesEverySliceOfAVolume) {
  RHI_NEEDS_CAP(layeredRendering);
  const Ref<ITexture> t = gpu.Texture(Desc(TextureDim::Tex3D, 4, 1, Bind::RenderTarget));
  const Ref<IRenderTargetView> rtv = gpu.TargetView(t.get());
  context.ClearRenderTargetView(rtv.get(), Rgba32F{1, 0, 0, 1}.data());
  EXPECT_TRUE(Matches(gpu.Read(t.get()), All({255, 0, 0, 255})));
  SetColor(rtv.get(), 16);
  DrawEverySlice(test_shaders::geometry_GSMainLayers);
  EXPECT_TRUE(Matches(gpu.Read(t.get()), [](uint32_t, uint32_t y) { return Sent(y / 16); }));
}

// The geometry shader's slice 0 is the view's first; what it sends beyond the view's slices is dropped.
TEST_P(SliceTest, LayersCountFromTheViewsFirst) {
  RHI_NEEDS_CAP(layeredRendering);
  const Ref<ITexture> t = gpu.Texture(Desc(TextureDim::Tex2DArray, 8, 1, Bind::RenderTarget));
  context.ClearRenderTargetView(gpu.TargetView(t.get()).get(), Rgba32F{0, 0, 0, 0}.data());
  const ViewDesc some{.firstSlice = 2, .sliceCount = 4};
  const Ref<IRenderTargetView> rtv = gpu.TargetView(t.get(), &some);
  SetColor(rtv.get(), 16);
  DrawEverySlice(test_shaders::geometry_GSMainLayers);
  for (uint32_t s = 0; s < 8; ++s)
    EXPECT_TRUE(Matches(gpu.Read(t.get(), 0, s), All(s >= 2 && s < 6 ? Sent(s - 2) : Rgba8{}))) << s;
}

// ---------------------------------------------------------------------------------------------------------------- mips
Rgba8 Average(const Image& above, uint32_t x, uint32_t y, uint32_t slices, uint32_t z, uint32_t height) {
  Rgba8 result;
  for (size_t c = 0; c < 4; ++c) {
    double sum = 0;
    for (uint32_t k = 0; k < slices; ++k)
      for (uint32_t i = 0; i < 4; ++i)
        sum += above.At<Rgba8>(2 * x + (i & 1), (slices * z + k) * height + 2 * y + (i >> 1))[c];
    result[c] = ToUnorm8(sum / (4 * slices) / 255);
  }
  return result;
}

TEST_P(SliceTest, GenMipsOfEveryFaceOfACube) {
  const Ref<ITexture> t = gpu.TextureOf<Rgba8>(
      Desc(TextureDim::TexCube, 6, 0, Bind::RenderTarget | Bind::ShaderResource),
      [](uint32_t x, uint32_t y, uint32_t mip, uint32_t s) { return mip == 0 ? Noise(x, y, s) : Rgba8{}; });
  context.GenerateMips(gpu.View(t.get()).get());
  for (uint32_t s = 0; s < 6; ++s)
    for (uint32_t mip = 1; mip < 5; ++mip) {
      const Image above = gpu.Read(t.get(), mip - 1, s);
      const auto oracle = [&](uint32_t x, uint32_t y) { return Average(above, x, y, 1, 0, 0); };
      EXPECT_TRUE(Matches(gpu.Read(t.get(), mip, s), oracle, Within("mip_average"))) << s << mip;
    }
}

// Two depth slices become one.
TEST_P(SliceTest, GenMipsOfAVolume) {
  TextureDesc desc = Desc(TextureDim::Tex3D, 16, 0, Bind::RenderTarget | Bind::ShaderResource);
  const Ref<ITexture> t = gpu.Texture(desc);
  std::vector<Rgba8> texels;
  for (uint32_t i = 0; i < 16 * 16 * 16; ++i) texels.push_back(Noise(i % 16, i / 16 % 16, i / 256));
  context.UpdateSubresource(t.get(), 0, nullptr, texels.data(), 64, 1024);
  context.GenerateMips(gpu.View(t.get()).get());
  for (uint32_t mip = 1; mip < 5; ++mip) {
    const Image above = gpu.Read(t.get(), mip - 1);
    const uint32_t size = 16u >> mip;
    const auto oracle = [&](uint32_t x, uint32_t y) { return Average(above, x, y % size, 2, y / size, 2 * size); };
    EXPECT_TRUE(Matches(gpu.Read(t.get(), mip), oracle, Within("mip_average"))) << mip;
  }
}

// A view of the twin format would be averaged as light; copies and blits know the texture's own format alone.
TEST_P(SliceTest, GenMipsOfATwinViewAreRefused) {
  gpu.sink.Expect(MsgCode::FormatMismatch, "the twin's mips are refused");
  TextureDesc desc = Desc(TextureDim::Tex2DArray, 2, 2, Bind::RenderTarget | Bind::ShaderResource);
  const Ref<ITexture> t = gpu.TextureOf<Rgba8>(desc, [](auto, auto, auto, auto) { return Rgba8{9, 9, 9, 9}; });
  const ViewDesc twin{.format = Format::RGBA8_UNorm_sRGB};
  context.GenerateMips(gpu.View(t.get(), &twin).get());
}

// Odd sizes: every mip is made, and stays within what its parent holds.
TEST_P(SliceTest, GenMipsOfOddSizes) {
  TextureDesc desc = Desc(TextureDim::Tex2DArray, 2, 0, Bind::RenderTarget | Bind::ShaderResource);
  desc.width = 13;
  desc.height = 7;
  const Ref<ITexture> t = gpu.TextureOf<Rgba8>(desc, [](auto, auto, uint32_t mip, uint32_t s) {
    return mip == 0 ? Rgba8{uint8_t(40 + 100 * s), 7, 200, 255} : Rgba8{};
  });
  context.GenerateMips(gpu.View(t.get()).get());
  for (uint32_t s = 0; s < 2; ++s)
    for (uint32_t mip = 1; mip < 4; ++mip)
      EXPECT_TRUE(Matches(gpu.Read(t.get(), mip, s), All({uint8_t(40 + 100 * s), 7, 200, 255}))) << s << mip;
}

// -------------------------------------------------------------------------------------------------------------- cubes
// Part of a cube is an array to shaders.
TEST_P(SliceTest, FacesOfACubeAsAnArray) {
  const Ref<ITexture> t = gpu.TextureOf<Rgba8>(Desc(TextureDim::TexCube, 6, 1, Bind::ShaderResource),
                                               [](uint32_t x, uint32_t y, auto, uint32_t s) { return Noise(x, y, s); });
  const ViewDesc some{.firstSlice = 2, .sliceCount = 3};
  const Ref<IShaderResourceView> view = gpu.View(t.get(), &some);
  IShaderResourceView* raw = view.get();
  const Target target = gpu.MakeTarget({});
  gpu.SetTarget(target);
  context.PSSetShaderResources(2, 1, &raw);
  gpu.SetSampler(Stage::Pixel, 0, {.min = Filter::Point, .mag = Filter::Point, .mip = Filter::Point});
  gpu.DrawRect(test_shaders::sample_PSLayer, {.extra = {0, 1, 0, 0}});
  EXPECT_TRUE(Matches(gpu.Read(target), [](uint32_t x, uint32_t y) { return Noise(x, y, 3); }));
}

// Copies between slices of an array, faces of a cube and depth slices of a volume, by boxes.
TEST_P(SliceTest, CopiesBetweenTheKinds) {
  const auto texel = [](uint32_t x, uint32_t y, auto, uint32_t s) { return Noise(x, y, s); };
  const Ref<ITexture> array = gpu.TextureOf<Rgba8>(Desc(TextureDim::Tex2DArray, 4, 1, Bind::ShaderResource), texel);
  const Ref<ITexture> cube = gpu.Texture(Desc(TextureDim::TexCube, 6, 1, Bind::ShaderResource));
  const Ref<ITexture> volume = gpu.Texture(Desc(TextureDim::Tex3D, 4, 1, Bind::ShaderResource));
  const Ref<ITexture> back = gpu.Texture(Desc(TextureDim::Tex2DArray, 4, 1, Bind::ShaderResource));
  context.CopySubresourceRegion(cube.get(), 5, 0, 0, 0, array.get(), 2, nullptr);
  EXPECT_TRUE(Matches(gpu.Read(cube.get(), 0, 5), [](uint32_t x, uint32_t y) { return Noise(x, y, 2); }));
  context.CopySubresourceRegion(volume.get(), 0, 0, 0, 3, cube.get(), 5, nullptr);
  const Box slice{0, 0, 3, 16, 16, 4};
  context.CopySubresourceRegion(back.get(), 1, 0, 0, 0, volume.get(), 0, &slice);
  EXPECT_TRUE(Matches(gpu.Read(back.get(), 0, 1), [](uint32_t x, uint32_t y) { return Noise(x, y, 2); }));
}

RHI_ON_EVERY_BACKEND(SliceTest);

}  // namespace
}  // namespace rhi_test

// Textures: every layer and mip, boxes, copies, arrays as targets, views, formats.
#include "rhi_fixture.h"

namespace rhi_test {
namespace {

using namespace rhi;
using TextureTest = RhiTest;

// A value that differs for each texel, mip and slice.
Rgba8 Mark(uint32_t x, uint32_t y, uint32_t mip, uint32_t slice) {
  return {uint8_t(x * 7 + 1), uint8_t(y * 11 + 2), uint8_t(mip * 40 + slice), uint8_t(200 + slice)};
}
auto MarkOf(uint32_t mip, uint32_t slice) {
  return [=](uint32_t x, uint32_t y) { return Mark(x, y, mip, slice); };
}
constexpr TextureDesc kArray{.dim = TextureDim::Tex2DArray,
                             .width = 16,
                             .height = 8,
                             .depthOrArray = 5,
                             .mipLevels = 0,
                             .format = Format::RGBA8_UNorm,
                             .bind = Bind::ShaderResource,
                             .name = "array"};

TEST_P(TextureTest, ArrayInitOfEachLayerAndMip) {
  const Ref<ITexture> t = gpu.TextureOf<Rgba8>(kArray, Mark);
  EXPECT_EQ(t->Desc().mipLevels, 5u);
  for (uint32_t slice = 0; slice < 5; ++slice)
    for (uint32_t mip = 0; mip < 5; ++mip)
      EXPECT_TRUE(Matches(gpu.Read(t.get(), mip, slice), MarkOf(mip, slice))) << mip << ' ' << slice;
}

TEST_P(TextureTest, ArrayUploadEachLayerMip) {
  const Ref<ITexture> t = gpu.Texture(kArray);
  for (uint32_t slice = 0; slice < 5; ++slice)
    for (uint32_t mip = 0; mip < 5; ++mip) {
      const uint32_t w = std::max(1u, 16u >> mip), h = std::max(1u, 8u >> mip);
      std::vector<Rgba8> data;
      for (uint32_t i = 0; i < w * h; ++i) data.push_back(Mark(i % w, i / w, mip, slice));
      context.UpdateSubresource(t.get(), Subresource(mip, slice, 5), nullptr, data.data(), w * 4, 0);
    }
  for (uint32_t slice = 0; slice < 5; ++slice)
    for (uint32_t mip = 0; mip < 5; ++mip)
      EXPECT_TRUE(Matches(gpu.Read(t.get(), mip, slice), MarkOf(mip, slice))) << mip << ' ' << slice;
}

TEST_P(TextureTest, UpdateOfABoxWithRowPitch) {
  const Ref<ITexture> t = gpu.TextureOf<Rgba8>(kArray, Mark);
  std::vector<Rgba8> rows(3 * 10, Rgba8{9, 9, 9, 9});
  for (uint32_t i = 0; i < 30; ++i) rows[i][0] = uint8_t(100 + i);
  const Box box{2, 3, 0, 6, 6, 1};
  context.UpdateSubresource(t.get(), Subresource(0, 3, 5), &box, rows.data(), 10 * 4, 0);
  EXPECT_TRUE(Matches(gpu.Read(t.get(), 0, 3), [](uint32_t x, uint32_t y) {
    const bool inside = x >= 2 && x < 6 && y >= 3 && y < 6;
    return inside ? Rgba8{uint8_t(100 + (y - 3) * 10 + x - 2), 9, 9, 9} : Mark(x, y, 0, 3);
  }));
  EXPECT_TRUE(Matches(gpu.Read(t.get(), 0, 2), MarkOf(0, 2)));
}

// Sizes that are no powers of two, one byte a texel: rows whose length is no multiple of 4.
TEST_P(TextureTest, NpotRowpitch) {
  const auto one = [](uint32_t x, uint32_t y) { return std::array<uint8_t, 1>{uint8_t(x * 5 + y * 3)}; };
  const auto two = [](uint32_t x, uint32_t y) { return std::array<uint8_t, 2>{uint8_t(x), uint8_t(y)}; };
  for (const uint32_t width : {1u, 3u, 5u, 7u, 13u}) {
    const TextureDesc desc{.width = width, .height = 3, .format = Format::R8_UNorm};
    const Ref<ITexture> t =
        gpu.TextureOf<std::array<uint8_t, 1>>(desc, [&](auto x, auto y, auto, auto) { return one(x, y); });
    EXPECT_TRUE(Matches(gpu.Read(t.get()), one)) << width;
    const Ref<ITexture> u =
        gpu.TextureOf<std::array<uint8_t, 2>>({.width = width, .height = 3, .format = Format::RG8_UNorm},
                                              [&](auto x, auto y, auto, auto) { return two(x, y); });
    EXPECT_TRUE(Matches(gpu.Read(u.get()), two)) << width;
  }
}

TEST_P(TextureTest, ArrayReadbackLayer) {
  const Ref<ITexture> t = gpu.TextureOf<Rgba8>(kArray, Mark);
  std::vector<uint8_t> out(100 * 8, 77);
  ASSERT_EQ(device.ReadBack(t.get(), Subresource(0, 1, 5), out.data(), out.size(), 100), Status::Ok);
  for (uint32_t y = 0; y < 8; ++y) {
    Rgba8 texel;
    std::memcpy(&texel, &out[y * 100 + 15 * 4], 4);
    EXPECT_EQ(texel, Mark(15, y, 0, 1));
    if (y < 7) {
      EXPECT_EQ(out[y * 100 + 64], 77) << "the padding between rows was written";
    }
  }
}

TEST_P(TextureTest, CopyBetweenLayers) {
  const Ref<ITexture> a = gpu.TextureOf<Rgba8>(kArray, Mark), b = gpu.Texture(kArray);
  context.CopySubresourceRegion(b.get(), Subresource(0, 4, 5), 0, 0, 0, a.get(), Subresource(0, 1, 5), nullptr);
  context.CopySubresourceRegion(b.get(), Subresource(1, 4, 5), 0, 0, 0, a.get(), Subresource(1, 2, 5), nullptr);
  const Box box{4, 2, 0, 8, 6, 1};
  context.CopySubresourceRegion(b.get(), Subresource(0, 4, 5), 1, 1, 0, a.get(), Subresource(0, 3, 5), &box);
  EXPECT_TRUE(Matches(gpu.Read(b.get(), 0, 4), [](uint32_t x, uint32_t y) {
    const bool inside = x >= 1 && x < 5 && y >= 1 && y < 5;
    return inside ? Mark(x + 3, y + 1, 0, 3) : Mark(x, y, 0, 1);
  }));
  EXPECT_TRUE(Matches(gpu.Read(b.get(), 1, 4), MarkOf(1, 2)));
}

TEST_P(TextureTest, CopyWithinOneTexture) {
  const Ref<ITexture> a = gpu.TextureOf<Rgba8>(kArray, Mark);
  context.CopySubresourceRegion(a.get(), Subresource(0, 4, 5), 0, 0, 0, a.get(), Subresource(0, 1, 5), nullptr);
  EXPECT_TRUE(Matches(gpu.Read(a.get(), 0, 4), MarkOf(0, 1)));
  EXPECT_TRUE(Matches(gpu.Read(a.get(), 0, 1), MarkOf(0, 1)));
}

TEST_P(TextureTest, CopyResourceOfAllSubresources) {
  const Ref<ITexture> a = gpu.TextureOf<Rgba8>(kArray, Mark);
  TextureDesc desc = kArray;
  desc.usage = Usage::Staging;
  desc.bind = Bind::None;
  const Ref<ITexture> staging = gpu.Texture(desc), b = gpu.Texture(kArray);
  context.CopyResource(staging.get(), a.get());
  context.CopyResource(b.get(), staging.get());
  EXPECT_TRUE(Matches(gpu.Read(b.get(), 2, 3), MarkOf(2, 3)));
  Mapped m;
  ASSERT_EQ(context.Map(staging.get(), Subresource(1, 2, 5), MapMode::Read, &m), Status::Ok);
  EXPECT_GE(m.rowPitch, 32u);
  for (uint32_t y = 0; y < 4; ++y) {
    Rgba8 texel;
    std::memcpy(&texel, static_cast<const uint8_t*>(m.data) + y * m.rowPitch + 4 * 5, 4);
    EXPECT_EQ(texel, Mark(5, y, 1, 2));
  }
  context.Unmap(staging.get(), Subresource(1, 2, 5));
}

TEST_P(TextureTest, StagingWriteThenCopy) {
  const Ref<ITexture> staging = gpu.Texture(
      {.width = 5, .height = 3, .format = Format::RGBA8_UNorm, .usage = Usage::Staging, .bind = Bind::None});
  const Ref<ITexture> t = gpu.Texture({.width = 5, .height = 3, .format = Format::RGBA8_UNorm});
  Mapped m;
  ASSERT_EQ(context.Map(staging.get(), 0, MapMode::Write, &m), Status::Ok);
  for (uint32_t y = 0; y < 3; ++y)
    for (uint32_t x = 0; x < 5; ++x) {
      const Rgba8 texel = Mark(x, y, 0, 0);
      std::memcpy(static_cast<uint8_t*>(m.data) + y * m.rowPitch + x * 4, &texel, 4);
    }
  context.Unmap(staging.get(), 0);
  context.CopyResource(t.get(), staging.get());
  EXPECT_TRUE(Matches(gpu.Read(t.get()), MarkOf(0, 0)));
}

TEST_P(TextureTest, ArrayRenderToLayer) {
  TextureDesc desc = kArray;
  desc.bind = Bind::RenderTarget | Bind::ShaderResource;
  const Ref<ITexture> t = gpu.TextureOf<Rgba8>(desc, Mark);
  const ViewDesc one{.firstMip = 1, .mipCount = 1, .firstSlice = 3, .sliceCount = 1};
  const Ref<IRenderTargetView> rtv = gpu.TargetView(t.get(), &one);
  IRenderTargetView* raw = rtv.get();
  context.OMSetRenderTargets(1, &raw, nullptr);
  gpu.SetViewport(0, 0, 8, 4);
  gpu.DrawRect(test_shaders::rect_PSTint, {.tint = {1, 0, 1, 0}, .rectangle = {-1, 1, 0, -1}});
  for (uint32_t slice = 0; slice < 5; ++slice)
    EXPECT_TRUE(Matches(gpu.Read(t.get(), 1, slice), [slice](uint32_t x, uint32_t y) {
      return slice == 3 && x < 4 ? Rgba8{255, 0, 255, 0} : Mark(x, y, 1, slice);
    })) << slice;
  EXPECT_TRUE(Matches(gpu.Read(t.get(), 0, 3), MarkOf(0, 3)));
}

TEST_P(TextureTest, ClearOfOneSliceLeavesTheOthers) {
  TextureDesc desc = kArray;
  desc.bind = Bind::RenderTarget;
  const Ref<ITexture> t = gpu.TextureOf<Rgba8>(desc, Mark);
  const ViewDesc two{.firstSlice = 2, .sliceCount = 2};
  const float color[4] = {0, 1, 0, 1};
  context.ClearRenderTargetView(gpu.TargetView(t.get(), &two).get(), color);
  for (uint32_t slice = 0; slice < 5; ++slice)
    EXPECT_TRUE(Matches(gpu.Read(t.get(), 0, slice), [slice](uint32_t x, uint32_t y) {
      return slice == 2 || slice == 3 ? Rgba8{0, 255, 0, 255} : Mark(x, y, 0, slice);
    })) << slice;
}

// A view that starts at a slice: layer 0 of the shader is that slice, and GetDimensions shows the view.
TEST_P(TextureTest, ViewOfSomeLayersAndMips) {
  const Ref<ITexture> t = gpu.TextureOf<Rgba8>(kArray, Mark);
  const ViewDesc some{.firstMip = 1, .mipCount = 2, .firstSlice = 2, .sliceCount = 3};
  const Ref<IShaderResourceView> view = gpu.View(t.get(), &some);
  IShaderResourceView* raw = view.get();
  const Target target = gpu.MakeTarget({.width = 8, .height = 4});
  gpu.SetTarget(target);
  context.PSSetShaderResources(2, 1, &raw);
  gpu.SetSampler(Stage::Pixel, 0, {.min = Filter::Point, .mag = Filter::Point, .mip = Filter::Point});
  gpu.DrawRect(test_shaders::sample_PSLayer, {.extra = {0, 1, 0, 0}});
  EXPECT_TRUE(Matches(gpu.Read(target), MarkOf(1, 3)));
  gpu.DrawRect(test_shaders::sample_PSSize);
  EXPECT_TRUE(Matches(gpu.Read(target), [](uint32_t, uint32_t) { return Rgba8{8, 4, 3, 2}; }));
}

TEST_P(TextureTest, CubeFacesAndVolumeSlices) {
  const TextureDesc cubeDesc{
      .dim = TextureDim::TexCube, .width = 4, .height = 4, .depthOrArray = 6, .format = Format::RGBA8_UNorm};
  const Ref<ITexture> cube = gpu.TextureOf<Rgba8>(cubeDesc, [](auto, auto, auto, uint32_t face) {
    return Rgba8{uint8_t(face + 1), 0, 0, 255};
  });
  const Target target = gpu.MakeTarget({.width = 2, .height = 2});
  gpu.SetTarget(target);
  gpu.SetTexture(Stage::Pixel, 3, cube.get());
  gpu.SetSampler(Stage::Pixel, 0, {.min = Filter::Point, .mag = Filter::Point, .mip = Filter::Point});
  const float axes[6][3] = {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
  for (uint8_t face = 0; face < 6; ++face) {
    gpu.DrawRect(test_shaders::sample_PSCube, {.extra = {0, axes[face][0], axes[face][1], axes[face][2]}});
    EXPECT_TRUE(Matches(gpu.Read(target), [face](auto, auto) { return Rgba8{uint8_t(face + 1), 0, 0, 255}; })) << +face;
  }
  std::vector<Rgba8> voxels;
  for (uint32_t i = 0; i < 2 * 2 * 4; ++i) voxels.push_back({uint8_t(i), uint8_t(i / 4), 0, 255});
  const SubresourceData init{voxels.data(), 8, 16};
  const Ref<ITexture> volume = gpu.Texture(
      {.dim = TextureDim::Tex3D, .width = 2, .height = 2, .depthOrArray = 4, .format = Format::RGBA8_UNorm}, &init);
  EXPECT_EQ(gpu.Read(volume.get()).bytes[4 * 15], 15);
  gpu.SetTexture(Stage::Pixel, 4, volume.get());
  gpu.DrawRect(test_shaders::sample_PSVolume, {.extra = {0, 0.625f, 0, 0}});
  EXPECT_TRUE(Matches(gpu.Read(target), [](uint32_t x, uint32_t y) {
    return Rgba8{uint8_t(8 + y * 2 + x), 2, 0, 255};
  }));
}

// Direct3D and Vulkan round the layer to the nearest, ties to even, and clamp it.
TEST_P(TextureTest, ArraySampleLayerRounding) {
  const Ref<ITexture> t = gpu.TextureOf<Rgba8>(kArray, [](auto, auto, auto, uint32_t slice) {
    return Rgba8{uint8_t(slice), 0, 0, 255};
  });
  const Target target = gpu.MakeTarget({.width = 64, .height = 1});
  gpu.SetTarget(target);
  gpu.SetTexture(Stage::Pixel, 2, t.get());
  gpu.SetSampler(Stage::Pixel, 0, {});
  // From -1 by eighths plus 1/16: no ties.
  gpu.DrawRect(test_shaders::sample_PSLayerRamp, {.extra = {0, -0.9375f, 0.125f, 0}});
  EXPECT_TRUE(Matches(gpu.Read(target), [](uint32_t x, uint32_t) {
    const double layer = std::floor(-0.9375 + x * 0.125 + 0.5);
    return Rgba8{uint8_t(std::min(4.0, std::max(0.0, layer))), 0, 0, 255};
  }));
}

TEST_P(TextureTest, FloatFormatsKeepTheirBits) {
  const auto value = [](uint32_t x, uint32_t y) { return Rgba32F{float(x) * 1e10f, -float(y) / 3, 1e-20f, 65504.f}; };
  const Ref<ITexture> t = gpu.TextureOf<Rgba32F>({.width = 5, .height = 4, .format = Format::RGBA32_Float},
                                                 [&](auto x, auto y, auto, auto) { return value(x, y); });
  EXPECT_TRUE(Matches(gpu.Read(t.get()), value));
  const Target target = gpu.MakeTarget({.width = 5, .height = 4, .format = Format::RGBA32_Float});
  gpu.SetTarget(target);
  gpu.SetTexture(Stage::Pixel, 0, t.get());
  gpu.DrawRect(test_shaders::sample_PSLoad);
  EXPECT_TRUE(Matches(gpu.Read(target), value));
}

TEST_P(TextureTest, BgraIsSwizzledInMemoryOnly) {
  const Ref<ITexture> t =
      gpu.TextureOf<Rgba8>({.width = 2, .height = 2, .format = Format::BGRA8_UNorm}, [](auto, auto, auto, auto) {
        return Rgba8{10, 20, 30, 40};
      });
  const Target target = gpu.MakeTarget({.width = 2, .height = 2}),
               same = gpu.MakeTarget({.width = 2, .height = 2, .format = Format::BGRA8_UNorm});
  gpu.SetTexture(Stage::Pixel, 0, t.get());
  gpu.SetTarget(target);
  gpu.DrawRect(test_shaders::sample_PSLoad);
  EXPECT_TRUE(Matches(gpu.Read(target), [](auto, auto) { return Rgba8{30, 20, 10, 40}; }));
  gpu.SetTarget(same);
  gpu.DrawRect(test_shaders::sample_PSLoad);
  EXPECT_TRUE(Matches(gpu.Read(same), [](auto, auto) { return Rgba8{10, 20, 30, 40}; }));
}

RHI_ON_EVERY_BACKEND(TextureTest);

}  // namespace
}  // namespace rhi_test

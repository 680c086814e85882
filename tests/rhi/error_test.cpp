// Wrong arguments: a status and a message, never a crash; draws with an unusable state are reported and skipped.
#include "rhi_fixture.h"

namespace rhi_test {
namespace {

using namespace rhi;

class ErrorTest : public RhiTest {
 protected:
  // Every message of these tests is wanted; each test looks at the ones that it causes.
  void Wanted(MsgCode code) { sink.Expect(code, "the argument is wrong"); }
  void ExpectUntouched(const Target& target) {
    EXPECT_TRUE(Matches(gpu.Read(target), [](auto, auto) { return Rgba8{0, 0, 255, 255}; }));
  }
  Target BlueTarget() {
    const Target target = gpu.MakeTarget({});
    gpu.Clear(target, {0, 0, 1, 1});
    return target;
  }
};

TEST_P(ErrorTest, BadBuffers) {
  Wanted(MsgCode::InvalidDesc);
  const BufferDesc bad[] = {
      {.byteWidth = 0, .bind = Bind::VertexBuffer},
      {.byteWidth = 64, .usage = Usage::Immutable, .bind = Bind::VertexBuffer},
      {.byteWidth = 64, .usage = Usage::Staging, .bind = Bind::VertexBuffer},
      {.byteWidth = 64, .bind = Bind::ConstantBuffer | Bind::VertexBuffer},
      {.byteWidth = 64, .bind = Bind::ShaderResource},
      {.byteWidth = 64, .bind = Bind::ShaderResource, .structureStride = 20},
      {.byteWidth = 64, .bind = Bind::ShaderResource, .structureStride = 6},
      {.byteWidth = 64, .usage = Usage::Dynamic, .bind = Bind::UnorderedAccess, .structureStride = 16}};
  int count = 0;
  for (const BufferDesc& desc : bad) {
    Ref<IBuffer> none;
    EXPECT_EQ(device.CreateBuffer(desc, nullptr, &none), Status::InvalidArg) << count;
    EXPECT_FALSE(none);
    EXPECT_EQ(sink.Count(MsgCode::InvalidDesc), ++count) << sink.Dump();
  }
}

TEST_P(ErrorTest, BadTextures) {
  Wanted(MsgCode::InvalidDesc);
  constexpr Format f = Format::RGBA8_UNorm;
  const TextureDesc bad[] = {{.width = 4, .height = 4, .format = Format::Unknown},
                             {.width = 0, .height = 4, .format = f},
                             {.width = 4, .height = 4, .depthOrArray = 2, .format = f},
                             {.dim = TextureDim::TexCube, .width = 4, .height = 4, .depthOrArray = 5, .format = f},
                             {.dim = TextureDim::TexCube, .width = 4, .height = 2, .depthOrArray = 6, .format = f},
                             {.width = 4, .height = 4, .mipLevels = 4, .format = f},
                             {.width = 4, .height = 4, .sampleCount = 4, .format = f},
                             {.width = 4, .height = 4, .format = f, .bind = Bind::DepthStencil},
                             {.width = 4, .height = 4, .format = Format::D32_Float, .bind = Bind::RenderTarget},
                             {.width = 4, .height = 4, .format = f, .usage = Usage::Immutable},
                             {.width = 4, .height = 4, .format = f, .usage = Usage::Dynamic},
                             {.width = 4, .height = 4, .format = f, .usage = Usage::Staging}};
  int count = 0;
  for (const TextureDesc& desc : bad) {
    Ref<ITexture> none;
    EXPECT_EQ(device.CreateTexture(desc, nullptr, &none), Status::InvalidArg) << count;
    EXPECT_FALSE(none);
    EXPECT_EQ(sink.Count(MsgCode::InvalidDesc), ++count) << sink.Dump();
  }
}

TEST_P(ErrorTest, TooLargeIsUnsupported) {
  Wanted(MsgCode::CapMissing);
  Ref<ITexture> none;
  EXPECT_EQ(device.CreateTexture({.width = 1u << 20, .height = 1, .format = Format::RGBA8_UNorm}, nullptr, &none),
            Status::Unsupported);
  EXPECT_EQ(device.CreateTexture({.dim = TextureDim::Tex2DMS,
                                  .width = 4,
                                  .height = 4,
                                  .sampleCount = 64,
                                  .format = Format::RGBA8_UNorm,
                                  .bind = Bind::RenderTarget},
                                 nullptr, &none),
            Status::Unsupported);
  EXPECT_FALSE(none);
}

TEST_P(ErrorTest, BadViews) {
  Wanted(MsgCode::SubresourceOutOfRange);
  Wanted(MsgCode::FormatMismatch);
  Wanted(MsgCode::WrongBindFlag);
  const Ref<ITexture> t = gpu.Texture({.width = 8, .height = 8, .mipLevels = 2, .format = Format::RGBA8_UNorm});
  const auto view = [&](const ViewDesc& desc) {
    Ref<IShaderResourceView> none;
    return device.CreateShaderResourceView(t.get(), &desc, &none);
  };
  EXPECT_EQ(view({.firstMip = 2}), Status::InvalidArg);
  EXPECT_EQ(view({.firstMip = 1, .mipCount = 2}), Status::InvalidArg);
  EXPECT_EQ(view({.firstSlice = 1}), Status::InvalidArg);
  EXPECT_EQ(view({.format = Format::R32_Float}), Status::InvalidArg);
  Ref<IRenderTargetView> none;
  EXPECT_EQ(device.CreateRenderTargetView(t.get(), nullptr, &none), Status::InvalidArg);
  EXPECT_EQ(view({.format = Format::RGBA8_UNorm_sRGB}), Status::Ok);
}

TEST_P(ErrorTest, BadShaders) {
  Wanted(MsgCode::ShaderRejected);
  ShaderBlob empty;
  Ref<IShader> none;
  EXPECT_NE(device.CreateShader(empty, &none), Status::Ok);
  EXPECT_FALSE(none);
}

TEST_P(ErrorTest, SubresourceOutOfRange) {
  Wanted(MsgCode::SubresourceOutOfRange);
  const Ref<ITexture> t = gpu.Texture({.width = 4, .height = 4, .format = Format::RGBA8_UNorm});
  std::vector<uint8_t> data(64);
  context.UpdateSubresource(t.get(), 1, nullptr, data.data(), 16, 64);
  EXPECT_EQ(device.ReadBack(t.get(), 1, data.data(), data.size()), Status::InvalidArg);
  context.CopySubresourceRegion(t.get(), 0, 0, 0, 0, t.get(), 7, nullptr);
  EXPECT_GE(sink.Count(MsgCode::SubresourceOutOfRange), 3) << sink.Dump();
}

TEST_P(ErrorTest, BoxesBeyondTheTexture) {
  Wanted(MsgCode::OutOfBounds);
  const Ref<ITexture> t = gpu.Texture({.width = 4, .height = 4, .format = Format::RGBA8_UNorm});
  const Ref<ITexture> u = gpu.Texture({.width = 8, .height = 8, .format = Format::RGBA8_UNorm});
  std::vector<uint8_t> data(256);
  const Box beyond{2, 2, 0, 6, 4, 1};
  context.UpdateSubresource(t.get(), 0, &beyond, data.data(), 16, 64);
  context.CopySubresourceRegion(t.get(), 0, 1, 1, 0, u.get(), 0, nullptr);
  context.CopySubresourceRegion(u.get(), 0, 0, 0, 0, t.get(), 0, &beyond);
  EXPECT_GE(sink.Count(MsgCode::OutOfBounds), 3) << sink.Dump();
}

TEST_P(ErrorTest, ReadBackIntoTooLittle) {
  const Ref<ITexture> t = gpu.Texture({.width = 4, .height = 4, .format = Format::RGBA8_UNorm});
  sink.Allow(MsgCode::OutOfBounds, "the memory is too small");
  sink.Allow(MsgCode::InvalidDesc, "the memory is too small");
  std::vector<uint8_t> data(63);
  EXPECT_EQ(device.ReadBack(t.get(), 0, data.data(), data.size()), Status::InvalidArg);
}

TEST_P(ErrorTest, CopyOfOtherFormats) {
  Wanted(MsgCode::FormatMismatch);
  const Ref<ITexture> a = gpu.Texture({.width = 4, .height = 4, .format = Format::RGBA8_UNorm}),
                      b = gpu.Texture({.width = 4, .height = 4, .format = Format::RGBA16_Float});
  context.CopyResource(a.get(), b.get());
}

TEST_P(ErrorTest, DrawWithoutVertexShader) {
  Wanted(MsgCode::NoVertexShader);
  const Target target = BlueTarget();
  gpu.SetTarget(target);
  context.PSSetShader(gpu.Shader(test_shaders::rect_PSTint).get());
  context.Draw(3, 0);
  ExpectUntouched(target);
}

TEST_P(ErrorTest, DrawWithoutTarget) {
  Wanted(MsgCode::NoTarget);
  gpu.SetViewport(0, 0, 16, 16);
  gpu.DrawRect(test_shaders::rect_PSTint);
}

TEST_P(ErrorTest, DrawWithoutIndexBuffer) {
  Wanted(MsgCode::IndexBufferMissing);
  const Target target = BlueTarget();
  gpu.SetTarget(target);
  gpu.SetShaders(test_shaders::rect_VSRect, test_shaders::rect_PSTint);
  gpu.SetDraw({});
  context.DrawIndexed(3, 0, 0);
  ExpectUntouched(target);
}

TEST_P(ErrorTest, DrawWithoutLayout) {
  Wanted(MsgCode::LayoutMismatch);
  const Target target = BlueTarget();
  gpu.SetTarget(target);
  gpu.SetShaders(test_shaders::mesh_VSMesh, test_shaders::mesh_PSMesh);
  context.Draw(3, 0);
  ExpectUntouched(target);
}

// A layout that was made for a shader with fewer inputs.
TEST_P(ErrorTest, DrawWithALayoutThatLacksAnInput) {
  Wanted(MsgCode::LayoutMismatch);
  const Target target = BlueTarget();
  gpu.SetTarget(target);
  const InputElement elements[] = {{.semantic = "POSITION", .format = Format::RGB32_Float},
                                   {.semantic = "COLOR", .format = Format::RGBA32_Float, .offset = 12}};
  const Ref<IShader> fewer = gpu.Shader(test_shaders::mesh_VSMesh);
  const Ref<IBuffer> vertices = gpu.BufferOf(Bind::VertexBuffer, std::vector<float>(3 * 7, 0.5f));
  gpu.SetVertices(vertices.get(), 28);
  gpu.SetShaders(test_shaders::mesh_VSMesh, test_shaders::mesh_PSMesh);
  context.IASetInputLayout(gpu.Layout(elements, fewer.get()).get());
  context.Draw(3, 0);
  EXPECT_EQ(sink.Count(MsgCode::LayoutMismatch), 0) << sink.Dump();
  context.VSSetShader(gpu.Shader(test_shaders::mesh_VSInstanced).get());
  context.Draw(3, 0);
  EXPECT_EQ(sink.Count(MsgCode::LayoutMismatch), 1) << sink.Dump();
  ExpectUntouched(target);
}

// Boxes of nothing are no mistake, and change nothing.
TEST_P(ErrorTest, EmptyBoxesDoNothing) {
  const auto texel = [](uint32_t x, uint32_t y, auto, auto) { return Rgba8{uint8_t(x), uint8_t(y), 1, 1}; };
  const TextureDesc desc{.width = 4, .height = 4, .format = Format::RGBA8_UNorm};
  const Ref<ITexture> t = gpu.TextureOf<Rgba8>(desc, texel), u = gpu.TextureOf<Rgba8>(desc, texel);
  const Ref<IBuffer> a = gpu.BufferOf(Bind::VertexBuffer, std::vector<uint32_t>(4, 1)),
                     b = gpu.BufferOf(Bind::VertexBuffer, std::vector<uint32_t>(4, 2));
  const std::vector<uint8_t> data(64, 99);
  const Box none{2, 2, 0, 2, 4, 1};
  context.UpdateSubresource(t.get(), 0, &none, data.data(), 16, 64);
  context.CopySubresourceRegion(t.get(), 0, 1, 1, 0, u.get(), 0, &none);
  context.UpdateSubresource(a.get(), 0, &none, data.data(), 0, 0);
  context.CopySubresourceRegion(a.get(), 0, 0, 0, 0, b.get(), 0, &none);
  EXPECT_TRUE(Matches(gpu.Read(t.get()), [&](uint32_t x, uint32_t y) { return texel(x, y, 0, 0); }));
  EXPECT_EQ(gpu.ReadAs<uint32_t>(a.get(), 0, 4), std::vector<uint32_t>(4, 1));
}

TEST_P(ErrorTest, DrawWithTargetsOfOtherSizes) {
  Wanted(MsgCode::TargetsDiffer);
  const Target a = BlueTarget(), b = gpu.MakeTarget({.width = 8, .height = 8});
  IRenderTargetView* views[2] = {a.rtv.get(), b.rtv.get()};
  context.OMSetRenderTargets(2, views, nullptr);
  gpu.SetViewport(0, 0, 8, 8);
  gpu.DrawRect(test_shaders::rect_PSTwoTargets);
  context.OMSetRenderTargets(0, nullptr, nullptr);
  ExpectUntouched(a);
}

TEST_P(ErrorTest, DrawWithoutViewportDrawsNothing) {
  sink.Allow(MsgCode::NothingBound, "no viewport");
  const Target target = BlueTarget();
  IRenderTargetView* rtv = target.rtv.get();
  context.OMSetRenderTargets(1, &rtv, nullptr);
  gpu.DrawRect(test_shaders::rect_PSTint);
  ExpectUntouched(target);
}

TEST_P(ErrorTest, DrawOfNothing) {
  const Target target = BlueTarget();
  gpu.SetTarget(target);
  gpu.SetShaders(test_shaders::rect_VSRect, test_shaders::rect_PSTint);
  gpu.SetDraw({});
  context.Draw(0, 0);
  context.DrawInstanced(4, 0, 0, 0);
  ExpectUntouched(target);
}

// Without a pixel shader only depth is drawn.
TEST_P(ErrorTest, NoPixelShaderDrawsDepthOnly) {
  const Target target = gpu.MakeTarget({.depthFormat = Format::D32_Float});
  gpu.Clear(target, {0, 0, 1, 1}, 1);
  gpu.SetTarget(target);
  context.VSSetShader(gpu.Shader(test_shaders::rect_VSRect).get());
  gpu.SetDraw({.extra = {0.5f, 0, 0, 0}});
  context.IASetPrimitiveTopology(PrimitiveTopology::TriangleStrip);
  context.OMSetRenderTargets(0, nullptr, target.dsv.get());
  context.Draw(4, 0);
  EXPECT_TRUE(Matches(gpu.Read(target.depth.get()), [](auto, auto) { return std::array<float, 1>{0.5f}; }));
  ExpectUntouched(target);
}

TEST_P(ErrorTest, DrawsAfterAnErrorAreFine) {
  Wanted(MsgCode::NoVertexShader);
  const Target target = BlueTarget();
  gpu.SetTarget(target);
  context.Draw(3, 0);
  gpu.DrawRect(test_shaders::rect_PSTint, {.tint = {1, 0, 0, 1}});
  EXPECT_TRUE(Matches(gpu.Read(target), [](auto, auto) { return Rgba8{255, 0, 0, 255}; }));
}

TEST_P(ErrorTest, NullsAreNoCrash) {
  sink.Allow(MsgCode::InvalidDesc, "null arguments");
  sink.Allow(MsgCode::NothingBound, "null arguments");
  sink.Allow(MsgCode::MapMode, "null arguments");
  Mapped m;
  EXPECT_EQ(context.Map(nullptr, 0, MapMode::Read, &m), Status::InvalidArg);
  context.Unmap(nullptr, 0);
  context.UpdateConstants(nullptr, &m, sizeof m);
  context.UpdateSubresource(nullptr, 0, nullptr, &m, 0, 0);
  context.CopyResource(nullptr, nullptr);
  context.ClearRenderTargetView(nullptr, Rgba32F{}.data());
  context.ClearDepthStencilView(nullptr, true, 1, false, 0);
  context.GenerateMips(nullptr);
  Ref<IShaderResourceView> none;
  EXPECT_EQ(device.CreateShaderResourceView(nullptr, nullptr, &none), Status::InvalidArg);
}

RHI_ON_EVERY_BACKEND(ErrorTest);

}  // namespace
}  // namespace rhi_test

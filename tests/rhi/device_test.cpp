// Devices: creation, caps, independence, order of destruction, stable codes.
#include "rhi_fixture.h"

namespace rhi_test {
namespace {

using namespace rhi;
using DeviceTest = RhiTest;

TEST_P(DeviceTest, CreateHeadless) {
  EXPECT_EQ(Caps().backend, GetParam());
  EXPECT_EQ(context.Device(), &device);
  EXPECT_EQ(device.ImmediateContext(), &context);
}

TEST_P(DeviceTest, CapsSane) {
  const rhi::Caps& c = Caps();
  EXPECT_STRNE(c.adapter.data(), "");
  EXPECT_STRNE(c.driver.data(), "");
  EXPECT_GE(c.apiMajor * 10 + c.apiMinor, GetParam() == Backend::Vulkan ? 13u : 45u);
  EXPECT_GE(c.maxTexture2D, 4096u);
  EXPECT_GE(c.maxTexture3D, 256u);
  EXPECT_GE(c.maxArrayLayers, 256u);
  EXPECT_GE(c.maxColorSamples, 4u);
  EXPECT_TRUE(c.compute && c.drawIndirect && c.independentBlend);
  if (c.geometryShader) {
    EXPECT_GE(c.maxGSOutputVertices, 256u);
    EXPECT_GE(c.maxGSOutputComponents, 1024u);
  }
  EXPECT_NE(c.constantBufferAlignment, 0u);
  EXPECT_EQ(c.constantBufferAlignment & (c.constantBufferAlignment - 1), 0u);
  if (c.timestamp) {
    EXPECT_GT(c.timestampPeriodNs, 0);
  }
}

// The required drivers may skip nothing (tests/conformance/never_skip.txt), so they have all of these.
TEST_P(DeviceTest, HasEveryCap) {
  RHI_NEEDS_CAP(geometryShader);
  RHI_NEEDS_CAP(layeredRendering);
  RHI_NEEDS_CAP(alphaToCoverage);
  RHI_NEEDS_CAP(dualSourceBlend);
  RHI_NEEDS_CAP(wireframe);
  RHI_NEEDS_CAP(instanceStepRate);
  RHI_NEEDS_CAP(pipelineStatistics);
  RHI_NEEDS_CAP(occlusionPrecise);
}

TEST_P(DeviceTest, FormatSupportOfRequiredFormats) {
  const FormatSupport color =
      FormatSupport::Texture2D | FormatSupport::SampleLinear | FormatSupport::RenderTarget | FormatSupport::Blendable;
  for (const Format f : {Format::RGBA8_UNorm, Format::RGBA8_UNorm_sRGB, Format::RGBA16_Float})
    EXPECT_EQ(uint32_t(device.CheckFormatSupport(f)) & uint32_t(color), uint32_t(color)) << ToString(f);
  EXPECT_TRUE(device.CheckFormatSupport(Format::D32_Float) & FormatSupport::DepthStencil);
  EXPECT_TRUE(device.CheckFormatSupport(Format::RGB32_Float) & FormatSupport::VertexBuffer);
  EXPECT_FALSE(device.CheckFormatSupport(Format::D32_Float) & FormatSupport::RenderTarget);
  EXPECT_FALSE(device.CheckFormatSupport(Format::RGBA8_UNorm) & FormatSupport::DepthStencil);
  EXPECT_FALSE(device.CheckFormatSupport(Format::Unknown) & FormatSupport::Texture2D);
  EXPECT_EQ(device.CheckMultisample(Format::RGBA8_UNorm, 4), 1u);
  EXPECT_EQ(device.CheckMultisample(Format::RGBA8_UNorm, 3), 0u);
  EXPECT_EQ(device.CheckMultisample(Format::RGBA8_UNorm, 1u << 20), 0u);
}

TEST_P(DeviceTest, TwoDevices) {
  Gpu second(GetParam());
  const Target a = gpu.MakeTarget({}), b = second.MakeTarget({});
  gpu.Clear(a, {1, 0, 0, 1});
  second.Clear(b, {0, 1, 0, 1});
  gpu.SetTarget(a);
  second.SetTarget(b);
  gpu.DrawRect(test_shaders::rect_PSTint, {.tint = {0, 0, 1, 1}, .rectangle = {-1, 1, 0, -1}});
  second.DrawRect(test_shaders::rect_PSTint, {.tint = {1, 1, 1, 1}, .rectangle = {0, 1, 1, -1}});
  const Image first = gpu.Read(a);
  EXPECT_TRUE(Matches(first, [](uint32_t x, uint32_t) {
    return x < 8 ? Rgba8{0, 0, 255, 255} : Rgba8{255, 0, 0, 255};
  }));
  EXPECT_TRUE(Matches(second.Read(b), [](uint32_t x, uint32_t) {
    return x < 8 ? Rgba8{0, 255, 0, 255} : Rgba8{255, 255, 255, 255};
  }));
  second.Finish();
  second.sink.Verify();
}

TEST_P(DeviceTest, UnsupportedReturnsStatus) {
  TestSink own;
  own.Expect(MsgCode::DeviceUnavailable, "no such adapter");
  DeviceDesc desc = TestDeviceDesc(GetParam(), &own);
  desc.adapter = "no adapter has this name";
  Ref<IDevice> none;
  EXPECT_EQ(CreateDevice(GetParam(), desc, &none), Status::Unsupported);
  EXPECT_FALSE(none);
  own.Verify();
}

TEST_P(DeviceTest, SwapChainOfAHeadlessDeviceIsRefused) {
  sink.Allow(MsgCode::CapMissing, "headless");
  sink.Allow(MsgCode::InvalidDesc, "headless");
  sink.Allow(MsgCode::DeviceUnavailable, "headless");
  Ref<ISwapChain> none;
  EXPECT_NE(device.CreateSwapChain({.width = 16, .height = 16}, &none), Status::Ok);
  EXPECT_FALSE(none);
  EXPECT_NE(sink.Dump(), "");
}

// Objects of every kind outlive the caller's reference of the device, and a bound one its own last reference.
TEST_P(DeviceTest, DestroyOrder) {
  TestSink own;
  for (const bool deviceFirst : {true, false}) {
    Ref<IDevice> d;
    ASSERT_EQ(CreateDevice(GetParam(), TestDeviceDesc(GetParam(), &own), &d), Status::Ok) << own.Dump();
    Ref<ITexture> texture;
    Ref<IShaderResourceView> view;
    Ref<IRenderTargetView> target;
    Ref<ISamplerState> sampler;
    Ref<IShader> shader;
    Ref<IQuery> query;
    const TextureDesc desc{
        .width = 4, .height = 4, .format = Format::RGBA8_UNorm, .bind = Bind::RenderTarget | Bind::ShaderResource};
    ASSERT_EQ(d->CreateTexture(desc, nullptr, &texture), Status::Ok);
    ASSERT_EQ(d->CreateShaderResourceView(texture.get(), nullptr, &view), Status::Ok);
    ASSERT_EQ(d->CreateRenderTargetView(texture.get(), nullptr, &target), Status::Ok);
    ASSERT_EQ(d->CreateSamplerState({}, &sampler), Status::Ok);
    ASSERT_EQ(d->CreateShader(test_shaders::rect_PSTint, &shader), Status::Ok);
    ASSERT_EQ(d->CreateQuery({QueryType::Occlusion}, &query), Status::Ok);
    const float red[4] = {1, 0, 0, 1};
    d->ImmediateContext()->ClearRenderTargetView(target.get(), red);
    if (deviceFirst) d = nullptr;
    texture = nullptr;  // the views still hold it
    target = nullptr;
    view = nullptr;
    sampler = nullptr;
    shader = nullptr;
    query = nullptr;
    d = nullptr;
  }
  own.Verify();
}

TEST_P(DeviceTest, ReleasedResourcesLiveUntilTheGpuIsDone) {
  const Target target = gpu.MakeTarget({});
  gpu.SetTarget(target);
  for (uint8_t i = 1; i <= 16; ++i) {
    const Ref<ITexture> picture =
        gpu.TextureOf<Rgba8>({.width = 1, .height = 1, .format = Format::RGBA8_UNorm}, [i](auto, auto, auto, auto) {
          return Rgba8{i, 0, 0, 255};
        });
    gpu.SetTexture(Stage::Pixel, 0, picture.get());
    gpu.SetSampler(Stage::Pixel, 0, {});
    const float left = float(i - 1) / 8 - 1;
    gpu.DrawRect(test_shaders::sample_PSSample, {.rectangle = {left, 1, left + 0.125f, -1}});
  }
  EXPECT_TRUE(Matches(gpu.Read(target), [](uint32_t x, uint32_t) { return Rgba8{uint8_t(x + 1), 0, 0, 255}; }));
}

TEST(DeviceCodes, MessageCodesStable) {
  const std::pair<MsgCode, int> codes[] = {{MsgCode::None, 0},
                                           {MsgCode::DeviceUnavailable, 100},
                                           {MsgCode::CapMissing, 101},
                                           {MsgCode::InvalidDesc, 102},
                                           {MsgCode::OutOfMemory, 103},
                                           {MsgCode::ShaderRejected, 104},
                                           {MsgCode::LayoutMismatch, 105},
                                           {MsgCode::ImmutableWrite, 106},
                                           {MsgCode::PipelineCacheRefused, 108},
                                           {MsgCode::TargetStillBoundAsInput, 200},
                                           {MsgCode::InputStillBoundAsTarget, 201},
                                           {MsgCode::SlotOutOfRange, 202},
                                           {MsgCode::WrongBindFlag, 203},
                                           {MsgCode::WrongStage, 204},
                                           {MsgCode::NoVertexShader, 300},
                                           {MsgCode::NoTarget, 301},
                                           {MsgCode::TargetsDiffer, 302},
                                           {MsgCode::NothingBound, 303},
                                           {MsgCode::TopologyMismatch, 304},
                                           {MsgCode::IndexBufferMissing, 305},
                                           {MsgCode::MapMode, 400},
                                           {MsgCode::MapTwice, 401},
                                           {MsgCode::OutOfBounds, 402},
                                           {MsgCode::SubresourceOutOfRange, 403},
                                           {MsgCode::FormatMismatch, 404},
                                           {MsgCode::QueryOrder, 500},
                                           {MsgCode::SurfaceLost, 600},
                                           {MsgCode::ApiValidation, 900},
                                           {MsgCode::DeviceLost, 901}};
  std::vector<std::string> names;
  for (const auto& [code, number] : codes) {
    EXPECT_EQ(int(code), number);
    const std::string name = ToString(code);
    EXPECT_NE(name, "");
    EXPECT_EQ(std::count(names.begin(), names.end(), name), 0) << name;
    names.push_back(name);
  }
}

RHI_ON_EVERY_BACKEND(DeviceTest);

}  // namespace
}  // namespace rhi_test

// State objects and the caches behind them.
#include "rhi_fixture.h"

namespace rhi_test {
namespace {

using namespace rhi;

class StateTest : public RhiTest {
 protected:
  // A few draws with other states, in the order of `order`.
  Image DrawInOrder(const std::vector<uint32_t>& order) {
    const Target target = gpu.MakeTarget({.depthFormat = Format::D32_Float});
    gpu.Clear(target, {0, 0, 0, 0}, 1);
    gpu.SetTarget(target);
    for (const uint32_t i : order) {
      BlendDesc blend;
      blend.rt[0].writeMask = uint8_t(i % 2 ? 0xF : 0x3);
      context.OMSetBlendState(gpu.Blend(blend).get());
      context.OMSetDepthStencilState(
          gpu.DepthStencil({.depthFunc = i % 4 < 2 ? Comparison::Less : Comparison::Always}).get());
      context.RSSetState(gpu.Rasterizer({.cull = i % 8 < 4 ? CullMode::Back : CullMode::None}).get());
      const float left = float(i) / 4 - 1;
      gpu.DrawRect(
          i % 3 ? test_shaders::rect_PSTint : test_shaders::rect_PSUv,
          {.tint = {0.1f * float(i), 0.5f, 1, 1}, .rectangle = {left, 1, left + 0.25f, -1}, .extra = {0.5f, 0, 0, 0}});
    }
    return gpu.Read(target);
  }
};

TEST_P(StateTest, EqualDescSameObject) {
  BlendDesc blend;
  blend.rt[0].enable = true;
  EXPECT_EQ(gpu.Blend(blend), gpu.Blend(blend));
  EXPECT_EQ(gpu.DepthStencil({.depthWrite = false}), gpu.DepthStencil({.depthWrite = false}));
  EXPECT_EQ(gpu.Rasterizer({.depthBias = 3}), gpu.Rasterizer({.depthBias = 3}));
  EXPECT_EQ(gpu.Sampler({.maxLod = 3}), gpu.Sampler({.maxLod = 3}));
  const Ref<IBlendState> kept = gpu.Blend(blend);
  EXPECT_EQ(gpu.Blend(blend), kept);
  blend.rt[0].writeMask = 1;
  EXPECT_NE(gpu.Blend(blend), kept);
  const Ref<ISamplerState> sampler = gpu.Sampler({.maxLod = 3});
  EXPECT_NE(gpu.Sampler({.maxLod = 4}), sampler);
}

TEST_P(StateTest, DescIsKept) {
  EXPECT_EQ(gpu.Rasterizer({.cull = CullMode::Front, .frontCCW = true, .depthBias = -4})->Desc().depthBias, -4);
  EXPECT_EQ(gpu.Sampler({.u = AddressMode::Mirror, .maxLod = 2})->Desc(),
            (SamplerDesc{.u = AddressMode::Mirror, .maxLod = 2}));
}

TEST_P(StateTest, SwitchOrderIndependent) {
  const Image forwards = DrawInOrder({0, 1, 2, 3, 4, 5, 6, 7}), backwards = DrawInOrder({7, 6, 5, 4, 3, 2, 1, 0}),
              mixed = DrawInOrder({3, 6, 0, 5, 1, 7, 2, 4});
  EXPECT_TRUE(SameImage(forwards, backwards));
  EXPECT_TRUE(SameImage(forwards, mixed));
}

TEST_P(StateTest, ColdEqualsWarm) {
  Gpu fresh(GetParam());
  const auto draw = [](Gpu& g) {
    const Target target = g.MakeTarget({.width = 32, .height = 32});
    g.SetTarget(target);
    g.DrawRect(test_shaders::rect_PSPattern, {.tint = {0.3f, 0.1f, 0, 0}});
    return g.Read(target);
  };
  const Image cold = draw(fresh);
  fresh.device->GetStats(true);
  const Image warm = draw(fresh);
  EXPECT_EQ(fresh.device->GetStats(false).pipelineMisses, 0u);
  EXPECT_TRUE(SameImage(cold, warm));
  EXPECT_TRUE(SameImage(cold, draw(gpu)));
  fresh.Finish();
  fresh.sink.Verify();
}

TEST_P(StateTest, SettingWhatIsSetIsCounted) {
  const Ref<IRasterizerState> state = gpu.Rasterizer({.cull = CullMode::None});
  context.RSSetState(state.get());
  device.GetStats(true);
  for (int i = 0; i < 5; ++i) context.RSSetState(state.get());
  EXPECT_EQ(device.GetStats(false).redundantSets, 5u);
}

TEST_P(StateTest, PrecachedPipelineIsNoMiss) {
  Gpu fresh(GetParam());
  const Target target = fresh.MakeTarget({});
  const Ref<IShader> vs = fresh.Shader(test_shaders::rect_VSRect), ps = fresh.Shader(test_shaders::rect_PSTint);
  PipelineKeyDesc key{.vs = vs.get(), .ps = ps.get(), .topology = PrimitiveTopology::TriangleStrip, .rtvCount = 1};
  key.rtv[0] = Format::RGBA8_UNorm;
  ASSERT_EQ(fresh.device->PrecachePipeline(key), Status::Ok) << fresh.sink.Dump();
  fresh.device->GetStats(true);
  fresh.SetTarget(target);
  fresh.SetDraw({.tint = {0, 1, 0, 1}});
  fresh.context->VSSetShader(vs.get());
  fresh.context->PSSetShader(ps.get());
  fresh.context->IASetPrimitiveTopology(PrimitiveTopology::TriangleStrip);
  fresh.context->Draw(4, 0);
  EXPECT_EQ(fresh.device->GetStats(false).pipelineMisses, 0u);
  EXPECT_TRUE(Matches(fresh.Read(target), [](auto, auto) { return Rgba8{0, 255, 0, 255}; }));
  fresh.Finish();
  fresh.sink.Verify();
}

TEST_P(StateTest, PipelineCacheBlobRoundtrip) {
  const size_t size = device.GetPipelineCacheBlob(nullptr, 0);
  if (!Caps().pipelineCacheBlob) {
    EXPECT_EQ(size, 0u);
    return;
  }
  std::vector<uint8_t> blob(size);
  EXPECT_EQ(device.GetPipelineCacheBlob(blob.data(), blob.size()), size);
  TestSink own;
  for (const bool broken : {false, true}) {
    if (broken)
      for (uint8_t& byte : blob) byte = uint8_t(~byte);
    DeviceDesc desc = TestDeviceDesc(GetParam(), &own);
    desc.pipelineCache = blob.data();
    desc.pipelineCacheSize = blob.size();
    Ref<IDevice> d;
    EXPECT_EQ(CreateDevice(GetParam(), desc, &d), Status::Ok) << (broken ? "a broken blob is ignored" : "");
  }
  own.TakeProblems();
}

TEST_P(StateTest, ClearStateIsTheDefault) {
  const Target target = gpu.MakeTarget({});
  gpu.Clear(target, {0, 0, 0, 0});
  BlendDesc blend;
  blend.rt[0].writeMask = 1;
  context.OMSetBlendState(gpu.Blend(blend).get());
  context.RSSetState(gpu.Rasterizer({.cull = CullMode::Front}).get());
  gpu.SetTarget(target);
  gpu.DrawRect(test_shaders::rect_PSTint);
  context.ClearState();
  gpu.SetTarget(target);
  gpu.DrawRect(test_shaders::rect_PSTint, {.tint = {0, 1, 0, 1}});
  EXPECT_TRUE(Matches(gpu.Read(target), [](auto, auto) { return Rgba8{0, 255, 0, 255}; }));
}

RHI_ON_EVERY_BACKEND(StateTest);

}  // namespace
}  // namespace rhi_test

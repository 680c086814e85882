// Clears reach the whole view whatever the state is, and nothing beyond it. Read-back of depth and stencil.
#include "rhi_fixture.h"

namespace rhi_test {
namespace {

using namespace rhi;

class ClearTest : public RhiTest {
 protected:
  // All that could keep a draw from a pixel: masks, tests, scissor, viewport, the sample mask, culling.
  void CloseEveryGate(const Target& target) {
    gpu.SetTarget(target);
    BlendDesc blend;
    blend.alphaToCoverage = target.color->Desc().sampleCount > 1;
    blend.rt[0].writeMask = 0;
    context.OMSetBlendState(gpu.Blend(blend).get(), nullptr, 0);
    DepthStencilDesc depth{.depthWrite = false, .depthFunc = Comparison::Never, .stencilEnable = true, .writeMask = 0};
    depth.front.func = depth.back.func = Comparison::Never;
    context.OMSetDepthStencilState(gpu.DepthStencil(depth).get(), 99);
    context.RSSetState(gpu.Rasterizer({.cull = CullMode::Front, .scissor = true}).get());
    const Rect scissor{1, 1, 2, 2};
    context.RSSetScissorRects(1, &scissor);
    gpu.SetViewport(2, 2, 1, 1);
    gpu.DrawRect(test_shaders::rect_PSTint);  // so that the state reaches the driver
  }
  std::vector<Format> StencilFormats() const {
    std::vector<Format> formats;
    for (const Format f : {Format::D24_UNorm_S8_UInt, Format::D32_Float_S8_UInt})
      if (device.CheckFormatSupport(f) & FormatSupport::DepthStencil) formats.push_back(f);
    return formats;
  }
  // Depth 0..1 and stencil of one texel of a read-back.
  static std::pair<double, uint32_t> Texel(const Image& image, Format format, uint32_t x, uint32_t y) {
    if (format == Format::D24_UNorm_S8_UInt) {
      const uint32_t w = image.At<uint32_t>(x, y);
      return {(w & 0xFFFFFFu) / double(0xFFFFFF), w >> 24};
    }
    const auto words = image.At<std::array<uint32_t, 2>>(x, y);
    float depth;
    std::memcpy(&depth, words.data(), 4);
    return {double(depth), words[1] & 0xFFu};
  }
  void ExpectEverywhere(const Target& target, double depth, uint32_t stencil) {
    const Format f = target.depth->Desc().format;
    const Image image = gpu.Read(target.depth.get());
    for (uint32_t y = 0; y < image.height; ++y)
      for (uint32_t x = 0; x < image.width; ++x) {
        const auto [d, s] = Texel(image, f, x, y);
        EXPECT_EQ(std::round(d * 0xFFFFFF), std::round(depth * 0xFFFFFF)) << ToString(f) << x << ' ' << y;
        EXPECT_EQ(s, stencil) << ToString(f) << x << ' ' << y;
      }
  }
};

TEST_P(ClearTest, ReachesTheWholeViewWhateverTheState) {
  ASSERT_FALSE(StencilFormats().empty());
  for (const Format f : StencilFormats()) {
    const Target target = gpu.MakeTarget({.width = 9, .height = 5, .depthFormat = f});
    gpu.Clear(target, {0, 0, 0, 0}, 0.5f, 7);
    CloseEveryGate(target);
    gpu.Clear(target, {0.2f, 0.4f, 0.6f, 0.8f}, 0.25f, 201);
    EXPECT_TRUE(Matches(gpu.Read(target), [](auto, auto) { return Rgba8{51, 102, 153, 204}; })) << ToString(f);
    ExpectEverywhere(target, 0.25, 201);
    CloseEveryGate(target);
    context.ClearDepthStencilView(target.dsv.get(), true, 0.75f, false, 13);
    ExpectEverywhere(target, 0.75, 201);
    CloseEveryGate(target);
    context.ClearDepthStencilView(target.dsv.get(), false, 0.1f, true, 13);
    ExpectEverywhere(target, 0.75, 13);
  }
}

// The state is as it was: what the gates kept out stays out after the clear.
TEST_P(ClearTest, LeavesTheStateAsItWas) {
  const Target target = gpu.MakeTarget({.depthFormat = StencilFormats().front()});
  CloseEveryGate(target);
  gpu.Clear(target, {0, 1, 0, 1}, 0.25f, 5);
  gpu.SetDraw({.tint = {1, 0, 0, 1}});
  context.Draw(4, 0);
  EXPECT_TRUE(Matches(gpu.Read(target), [](auto, auto) { return Rgba8{0, 255, 0, 255}; }));
  ExpectEverywhere(target, 0.25, 5);
}

TEST_P(ClearTest, ReachesEverySample) {
  const Target target = gpu.MakeTarget({.width = 4, .height = 4, .samples = 4});
  gpu.SetTarget(target);
  CloseEveryGate(target);
  gpu.Clear(target, {0.2f, 0.4f, 0.6f, 0.8f});
  EXPECT_TRUE(Matches(gpu.Read(target), [](auto, auto) { return Rgba8{51, 102, 153, 204}; }));
}

// Of several targets in one pass only the one that is named.
TEST_P(ClearTest, ReachesOnlyItsTarget) {
  const Target a = gpu.MakeTarget({}), b = gpu.MakeTarget({});
  IRenderTargetView* views[2] = {a.rtv.get(), b.rtv.get()};
  context.OMSetRenderTargets(2, views, nullptr);
  gpu.SetViewport(0, 0, 16, 16);
  gpu.DrawRect(test_shaders::rect_PSTwoTargets, {.tint = {1, 0, 0, 1}});
  gpu.Clear(b, {0, 1, 0, 1});
  EXPECT_TRUE(Matches(gpu.Read(a), [](auto, auto) { return Rgba8{255, 0, 0, 255}; }));
  EXPECT_TRUE(Matches(gpu.Read(b), [](auto, auto) { return Rgba8{0, 255, 0, 255}; }));
}

// The stencil that draws wrote comes back, beside the depth, in the layout of DXGI: depth first.
TEST_P(ClearTest, StencilIsReadBack) {
  for (const Format f : StencilFormats()) {
    const Target target = gpu.MakeTarget({.width = 16, .height = 3, .depthFormat = f});
    gpu.Clear(target, {0, 0, 0, 0}, 1, 0);
    gpu.SetTarget(target);
    for (uint32_t i = 0; i < 16; ++i) {
      DepthStencilDesc d{.depthFunc = Comparison::Always, .stencilEnable = true};
      d.front.pass = StencilOp::Replace;
      context.OMSetDepthStencilState(gpu.DepthStencil(d).get(), 17 * i);
      const float left = float(i) / 8 - 1;
      gpu.DrawRect(test_shaders::rect_PSTint,
                   {.rectangle = {left, 1, left + 0.125f, -1}, .extra = {float(i) / 16, 0, 0, 0}});
    }
    const Image image = gpu.Read(target.depth.get());
    for (uint32_t y = 0; y < 3; ++y)
      for (uint32_t x = 0; x < 16; ++x) {
        const auto [depth, stencil] = Texel(image, f, x, y);
        EXPECT_EQ(depth, f == Format::D24_UNorm_S8_UInt ? std::round(x / 16.0 * 0xFFFFFF) / 0xFFFFFF : x / 16.0)
            << ToString(f) << x;
        EXPECT_EQ(stencil, 17 * x) << ToString(f) << x;
      }
  }
}

TEST_P(ClearTest, EveryDepthFormatIsReadBack) {
  for (const Format f : {Format::D16_UNorm, Format::D32_Float}) {
    const Target target = gpu.MakeTarget({.width = 5, .height = 3, .depthFormat = f});
    gpu.Clear(target, {0, 0, 0, 0}, 0.25f);
    const Image image = gpu.Read(target.depth.get());
    if (f == Format::D16_UNorm) {
      EXPECT_EQ(image.At<uint16_t>(4, 2), 16384) << "0.25 * 65535, rounded";
    } else {
      EXPECT_EQ(image.At<float>(4, 2), 0.25f);
    }
  }
}

TEST_P(ClearTest, OfNoViewIsReported) {
  sink.Expect(MsgCode::InvalidDesc, "no view");
  context.ClearRenderTargetView(nullptr, Rgba32F{}.data());
  context.ClearDepthStencilView(nullptr, true, 1, true, 0);
  EXPECT_EQ(sink.Count(MsgCode::InvalidDesc), 2);
}

RHI_ON_EVERY_BACKEND(ClearTest);

}  // namespace
}  // namespace rhi_test

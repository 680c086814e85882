// Binding rules: hazards between inputs and targets, registers of each stage, what is not bound reads 0.
#include "rhi_fixture.h"

namespace rhi_test {
namespace {

using namespace rhi;

class BindingTest : public RhiTest {
 protected:
  Ref<ITexture> Solid(const Rgba8& value) {
    return gpu.TextureOf<Rgba8>({.width = 2, .height = 2, .format = Format::RGBA8_UNorm},
                                [=](auto, auto, auto, auto) { return value; });
  }
  static auto All(const Rgba8& value) {
    return [=](uint32_t, uint32_t) { return value; };
  }
};

TEST_P(BindingTest, TargetUnbindsItsShaderView) {
  sink.Expect(MsgCode::TargetStillBoundAsInput, "the target is bound as a texture");
  sink.Allow(MsgCode::NothingBound, "the view was unbound");
  const Target a = gpu.MakeTarget({}), b = gpu.MakeTarget({});
  gpu.Clear(a, {1, 1, 1, 1});
  gpu.SetTexture(Stage::Pixel, 0, a.color.get());
  gpu.SetTarget(a);
  EXPECT_EQ(sink.Count(MsgCode::TargetStillBoundAsInput), 1);
  gpu.SetTarget(b);  // the view stays unbound
  gpu.DrawRect(test_shaders::sample_PSLoad);
  EXPECT_TRUE(Matches(gpu.Read(b), All({0, 0, 0, 0})));
}

TEST_P(BindingTest, BoundTargetCannotBecomeAnInput) {
  sink.Expect(MsgCode::InputStillBoundAsTarget, "the texture is bound as a target");
  sink.Allow(MsgCode::NothingBound, "the view was not bound");
  const Target a = gpu.MakeTarget({});
  gpu.SetTarget(a);
  gpu.SetTexture(Stage::Pixel, 0, a.color.get());
  gpu.DrawRect(test_shaders::sample_PSLoad);
  EXPECT_TRUE(Matches(gpu.Read(a), All({0, 0, 0, 0})));
}

TEST_P(BindingTest, OtherSubresourcesAreNoHazard) {
  const Ref<ITexture> t = gpu.TextureOf<Rgba8>({.dim = TextureDim::Tex2DArray,
                                                .width = 4,
                                                .height = 4,
                                                .depthOrArray = 2,
                                                .format = Format::RGBA8_UNorm,
                                                .bind = Bind::RenderTarget | Bind::ShaderResource},
                                               [](auto, auto, auto, uint32_t s) {
                                                 return Rgba8{uint8_t(50 + s), 0, 0, 255};
                                               });
  const ViewDesc one{.firstSlice = 0, .sliceCount = 1}, two{.firstSlice = 1, .sliceCount = 1};
  const Ref<IRenderTargetView> rtv = gpu.TargetView(t.get(), &one);
  const Ref<IShaderResourceView> srv = gpu.View(t.get(), &two);
  IRenderTargetView* target = rtv.get();
  IShaderResourceView* view = srv.get();
  context.OMSetRenderTargets(1, &target, nullptr);
  context.PSSetShaderResources(2, 1, &view);
  gpu.SetViewport(0, 0, 4, 4);
  gpu.SetSampler(Stage::Pixel, 0, {});
  gpu.DrawRect(test_shaders::sample_PSLayer);
  EXPECT_TRUE(Matches(gpu.Read(t.get(), 0, 0), All({51, 0, 0, 255})));
}

// Ping-pong between two textures: each draw adds what the one before drew.
TEST_P(BindingTest, PingPong) {
  const Target a = gpu.MakeTarget({}), b = gpu.MakeTarget({});
  gpu.Clear(a, {0.2f, 0, 0, 1});
  for (int i = 0; i < 6; ++i) {
    gpu.SetTexture(Stage::Pixel, 0, nullptr);
    gpu.SetTarget(i % 2 ? a : b);
    gpu.SetTexture(Stage::Pixel, 0, (i % 2 ? b : a).color.get());
    gpu.DrawRect(test_shaders::sample_PSLoad);
    BlendDesc add;
    add.rt[0] = {.enable = true,
                 .src = rhi::Blend::One,
                 .dest = rhi::Blend::One,
                 .srcAlpha = rhi::Blend::One,
                 .destAlpha = rhi::Blend::One};
    context.OMSetBlendState(gpu.Blend(add).get());
    gpu.DrawRect(test_shaders::rect_PSTint, {.tint = {0, 0.1f, 0, 0}});
    context.OMSetBlendState(nullptr);
  }
  EXPECT_TRUE(Matches(gpu.Read(a), All({51, 153, 0, 255}), Within("repeated_blend")));
}

TEST_P(BindingTest, UnboundTextureReadsZero) {
  sink.Allow(MsgCode::NothingBound, "that is the point");
  const Target target = gpu.MakeTarget({});
  gpu.Clear(target, {1, 1, 1, 1});
  gpu.SetTarget(target);
  gpu.SetSampler(Stage::Pixel, 0, {});
  gpu.DrawRect(test_shaders::sample_PSSample);
  EXPECT_TRUE(Matches(gpu.Read(target), All({0, 0, 0, 0})));
  gpu.DrawRect(test_shaders::sample_PSLayer);
  EXPECT_TRUE(Matches(gpu.Read(target), All({0, 0, 0, 0})));
  gpu.DrawRect(test_shaders::buffers_PSItem);
  EXPECT_TRUE(Matches(gpu.Read(target), All({0, 0, 0, 0})));
}

TEST_P(BindingTest, UnboundSamplerAndConstantsAreNoCrash) {
  sink.Allow(MsgCode::NothingBound, "that is the point");
  const Target target = gpu.MakeTarget({});
  gpu.Clear(target, {1, 1, 1, 1});
  gpu.SetTarget(target);
  gpu.SetTexture(Stage::Pixel, 0, Solid({10, 20, 30, 40}).get());
  gpu.DrawRect(test_shaders::sample_PSSample);  // Direct3D's default sampler
  EXPECT_TRUE(Matches(gpu.Read(target), All({10, 20, 30, 40})));
  gpu.SetShaders(test_shaders::buffers_VSStage, test_shaders::rect_PSTint);
  IBuffer* none = nullptr;
  context.SetConstantBuffers(3, 1, &none);
  context.Draw(4, 0);
  EXPECT_TRUE(Matches(gpu.Read(target), All({0, 0, 0, 0})));
}

TEST_P(BindingTest, OutOfBoundsReadsZero) {
  const std::vector<Rgba32F> items(4, Rgba32F{1, 1, 1, 1});
  const Ref<IBuffer> b = gpu.BufferOf(Bind::ShaderResource, items, 16);
  const Target target = gpu.MakeTarget({});
  gpu.SetTarget(target);
  gpu.SetTexture(Stage::Pixel, 0, b.get());
  gpu.DrawRect(test_shaders::buffers_PSItem);
  EXPECT_TRUE(Matches(gpu.Read(target), [](uint32_t x, auto) {
    return x < 4 ? Rgba8{255, 255, 255, 255} : Rgba8{0, 0, 0, 0};
  }));
}

TEST_P(BindingTest, ViewOfSomeElements) {
  std::vector<Rgba32F> items;
  for (int i = 0; i < 64; ++i) items.push_back({float(i) / 255, 0, 0, 1});
  const Ref<IBuffer> b = gpu.BufferOf(Bind::ShaderResource, items, 16);
  const ViewDesc some{.firstElement = 16, .elementCount = 8};
  const Ref<IShaderResourceView> view = gpu.View(b.get(), &some);
  IShaderResourceView* raw = view.get();
  const Target target = gpu.MakeTarget({});
  gpu.SetTarget(target);
  context.PSSetShaderResources(0, 1, &raw);
  gpu.DrawRect(test_shaders::buffers_PSItem);
  EXPECT_TRUE(Matches(gpu.Read(target), [](uint32_t x, auto) {
    return x < 8 ? Rgba8{uint8_t(16 + x), 0, 0, 255} : Rgba8{0, 0, 0, 0};
  }));
}

TEST_P(BindingTest, TwoBuffersOfOneShader) {
  const Ref<IBuffer> a = gpu.BufferOf(Bind::ShaderResource, std::vector<Rgba32F>(4, Rgba32F{1, 0, 0, 1}), 16),
                     b = gpu.BufferOf(Bind::ShaderResource, std::vector<Rgba32F>(4, Rgba32F{0, 1, 0, 1}), 16);
  const Target target = gpu.MakeTarget({.width = 4, .height = 2});
  gpu.SetTarget(target);
  gpu.SetTexture(Stage::Pixel, 0, a.get());
  gpu.SetTexture(Stage::Pixel, 5, b.get());
  gpu.DrawRect(test_shaders::buffers_PSTwoBuffers);
  EXPECT_TRUE(Matches(gpu.Read(target), [](auto, uint32_t y) {
    return y == 0 ? Rgba8{255, 0, 0, 255} : Rgba8{0, 255, 0, 255};
  }));
}

// t1 and s1 of the vertex shader are others than t1 and s1 of the pixel shader.
TEST_P(BindingTest, RegistersAreOfEachStage) {
  const auto halves = [&](uint8_t left, uint8_t right) {
    return gpu.TextureOf<Rgba8>({.width = 2, .height = 1, .format = Format::RGBA8_UNorm},
                                [=](uint32_t x, auto, auto, auto) {
                                  const uint8_t v = x ? right : left;
                                  return Rgba8{v, v, v, v};
                                });
  };
  const Target target = gpu.MakeTarget({});
  gpu.SetTarget(target);
  gpu.SetTexture(Stage::Vertex, 1, halves(0, 80).get());
  gpu.SetTexture(Stage::Pixel, 1, halves(100, 200).get());
  const SamplerDesc point{.min = Filter::Point, .mag = Filter::Point, .mip = Filter::Point};
  gpu.SetSampler(Stage::Vertex, 1, point);
  gpu.SetSampler(Stage::Pixel, 1, point);
  gpu.SetShaders(test_shaders::buffers_VSStage, test_shaders::buffers_PSStage);
  context.IASetPrimitiveTopology(PrimitiveTopology::TriangleStrip);
  context.Draw(4, 0);
  EXPECT_TRUE(Matches(gpu.Read(target), All({140, 140, 140, 140})));
  gpu.SetTexture(Stage::Vertex, 1, halves(0, 20).get());
  context.Draw(4, 0);
  EXPECT_TRUE(Matches(gpu.Read(target), All({110, 110, 110, 110})));
}

// A view of another kind, dimension or type of texels is as none: it reads 0, and the next draw is fine.
TEST_P(BindingTest, ViewOfAnotherKindReadsZero) {
  const Rgba8 white{255, 255, 255, 255};
  const auto filled = [&](auto, auto, auto, auto) { return white; };
  const Ref<ITexture> array = gpu.TextureOf<Rgba8>(
      {.dim = TextureDim::Tex2DArray, .width = 2, .height = 2, .depthOrArray = 2, .format = Format::RGBA8_UNorm},
      filled);
  const Ref<ITexture> integers = gpu.TextureOf<Rgba8>({.width = 2, .height = 2, .format = Format::RGBA8_UInt}, filled);
  const Ref<IBuffer> buffer = gpu.BufferOf(Bind::ShaderResource, std::vector<Rgba32F>(4, Rgba32F{1, 1, 1, 1}), 16);
  const Target target = gpu.MakeTarget({.width = 2, .height = 2});
  gpu.SetTarget(target);
  sink.Expect(MsgCode::ViewMismatch, "a view of another kind");
  int count = 0;
  for (IResource* other : {static_cast<IResource*>(array.get()), static_cast<IResource*>(integers.get()),
                           static_cast<IResource*>(buffer.get())}) {
    gpu.Clear(target, {0, 1, 0, 1});
    gpu.SetTexture(Stage::Pixel, 0, other);
    gpu.DrawRect(test_shaders::sample_PSLoad);
    EXPECT_EQ(sink.Count(MsgCode::ViewMismatch), ++count) << sink.Dump();
    EXPECT_TRUE(Matches(gpu.Read(target), All({0, 0, 0, 0})));
    context.EndFrame();
  }
  gpu.Clear(target, {0, 1, 0, 1});
  gpu.SetTexture(Stage::Pixel, 0, array.get());
  gpu.DrawRect(test_shaders::buffers_PSItem);
  EXPECT_EQ(sink.Count(MsgCode::ViewMismatch), ++count) << sink.Dump();
  EXPECT_TRUE(Matches(gpu.Read(target), All({0, 0, 0, 0})));
  gpu.SetTexture(Stage::Pixel, 0, Solid(white).get());
  gpu.DrawRect(test_shaders::sample_PSLoad);
  EXPECT_TRUE(Matches(gpu.Read(target), All(white)));
}

TEST_P(BindingTest, SlotOutOfRangeIsReported) {
  sink.Expect(MsgCode::SlotOutOfRange, "slots beyond the last");
  IShaderResourceView* none[2] = {};
  context.PSSetShaderResources(15, 2, none);
  ISamplerState* noSampler = nullptr;
  context.PSSetSamplers(16, 1, &noSampler);
  IBuffer* noBuffer = nullptr;
  context.SetConstantBuffers(4, 1, &noBuffer);
  EXPECT_EQ(sink.Count(MsgCode::SlotOutOfRange), 3);
}

TEST_P(BindingTest, WrongStageIsReported) {
  sink.Expect(MsgCode::WrongStage, "a pixel shader as vertex shader");
  context.VSSetShader(gpu.Shader(test_shaders::rect_PSTint).get());
}

RHI_ON_EVERY_BACKEND(BindingTest);

}  // namespace
}  // namespace rhi_test

// Compute, and draws whose data and arguments are written on the GPU.
#include "rhi_fixture.h"

namespace rhi_test {
namespace {

using namespace rhi;

class ComputeTest : public RhiTest {
 protected:
  Ref<IBuffer> Items(uint32_t count, Bind more = Bind::None) {
    const std::vector<Rgba32F> zero(count);
    return gpu.BufferOf(Bind::ShaderResource | Bind::UnorderedAccess | more, zero, 16);
  }
  Ref<IBuffer> Words(uint32_t count, Bind more) {
    return gpu.BufferOf(Bind::UnorderedAccess | more, std::vector<uint32_t>(count), 4);
  }
  void SetWrite(uint32_t slot, IResource* r) {
    const Ref<IUnorderedAccessView> view = r ? gpu.WriteView(r) : Ref<IUnorderedAccessView>();
    IUnorderedAccessView* raw = view.get();
    context.CSSetUnorderedAccessViews(slot, 1, &raw);
  }
  void SetCompute(const ShaderBlob& blob) { context.CSSetShader(gpu.Shader(blob).get()); }
  // The grid of compute.hlsl: even columns of two pixels.
  static Rgba8 Grid(uint32_t x, uint32_t) { return (x / 2) % 2 == 0 ? Rgba8{255, 255, 255, 255} : Rgba8{0, 0, 0, 0}; }
  void DrawStart(const Target& target, IBuffer* items) {
    gpu.Clear(target, {0, 0, 0, 0});
    gpu.SetTarget(target);
    gpu.SetShaders(test_shaders::buffers_VSPulled, test_shaders::rect_PSTint);
    gpu.SetDraw({});
    gpu.SetTexture(Stage::Vertex, 0, items);
    context.IASetPrimitiveTopology(PrimitiveTopology::TriangleStrip);
  }
};

TEST_P(ComputeTest, WritesThenVertexShaderReads) {
  RHI_NEEDS_CAP(compute);
  const Ref<IBuffer> items = Items(64);
  const Target target = gpu.MakeTarget({});
  for (int round = 0; round < 2; ++round) {
    SetCompute(test_shaders::compute_CSGrid);
    SetWrite(0, items.get());
    context.Dispatch(1, 1, 1);
    SetWrite(0, nullptr);
    DrawStart(target, items.get());
    context.DrawInstanced(4, 64, 0, 0);
    EXPECT_TRUE(Matches(gpu.Read(target), Grid)) << round;
    gpu.SetTexture(Stage::Vertex, 0, nullptr);
  }
}

TEST_P(ComputeTest, IndirectEqualsDirect) {
  RHI_NEEDS_CAP(compute);
  RHI_NEEDS_CAP(drawIndirect);
  const Ref<IBuffer> items = Items(64), args = Words(8, Bind::IndirectArgs);
  const Target direct = gpu.MakeTarget({}), indirect = gpu.MakeTarget({});
  SetCompute(test_shaders::compute_CSGrid);
  SetWrite(0, items.get());
  context.Dispatch(1, 1, 1);
  SetWrite(0, nullptr);
  gpu.SetDraw({.extra = {0, 37, 0, 0}});
  SetCompute(test_shaders::compute_CSArguments);
  SetWrite(1, args.get());
  context.Dispatch(1, 1, 1);
  SetWrite(1, nullptr);
  DrawStart(direct, items.get());
  context.DrawInstanced(4, 37, 0, 0);
  DrawStart(indirect, items.get());
  context.DrawInstancedIndirect(args.get(), 0);
  const Image expected = gpu.Read(direct);
  EXPECT_TRUE(SameImage(gpu.Read(indirect), expected));
  EXPECT_TRUE(Matches(expected, [](uint32_t x, uint32_t y) {
    const bool drawn = (x / 2) + 8 * (y / 2) < 37 && (x / 2) % 2 == 0;
    return drawn ? Rgba8{255, 255, 255, 255} : Rgba8{0, 0, 0, 0};
  }));
}

TEST_P(ComputeTest, DispatchIndirect) {
  RHI_NEEDS_CAP(compute);
  const Ref<IBuffer> args = Words(8, Bind::IndirectArgs), count = Words(1, Bind::None);
  gpu.SetDraw({.extra = {0, 1, 77, 0}});
  SetCompute(test_shaders::compute_CSArguments);
  SetWrite(1, args.get());
  context.Dispatch(1, 1, 1);
  SetWrite(1, count.get());
  SetCompute(test_shaders::compute_CSCount);
  context.DispatchIndirect(args.get(), 16);
  EXPECT_EQ(gpu.ReadAs<uint32_t>(count.get(), 0, 1)[0], 77u);
}

// Each dispatch reads what the one before wrote.
TEST_P(ComputeTest, ChainOfDispatches) {
  RHI_NEEDS_CAP(compute);
  const Ref<IBuffer> a = Items(4), b = Items(4);
  SetCompute(test_shaders::compute_CSAdd);
  for (uint32_t i = 0; i < 20; ++i) {
    SetWrite(0, nullptr);
    gpu.SetTexture(Stage::Compute, 0, (i % 2 ? b : a).get());
    SetWrite(0, (i % 2 ? a : b).get());
    gpu.SetDraw({.tint = {1, 2, float(i), 0.5f}});
    context.Dispatch(1, 1, 1);
  }
  for (const Rgba32F& value : gpu.ReadAs<Rgba32F>(a.get(), 0, 4)) EXPECT_EQ(value, (Rgba32F{20, 40, 190, 10}));
}

TEST_P(ComputeTest, ManyDispatchesToOneBuffer) {
  RHI_NEEDS_CAP(compute);
  const Ref<IBuffer> count = Words(1, Bind::None);
  SetCompute(test_shaders::compute_CSCount);
  SetWrite(1, count.get());
  for (int i = 0; i < 10; ++i) context.Dispatch(3, 2, 1);
  EXPECT_EQ(gpu.ReadAs<uint32_t>(count.get(), 0, 1)[0], 60u);
}

TEST_P(ComputeTest, TextureWriteThenPixelShaderReads) {
  RHI_NEEDS_CAP(compute);
  const Ref<ITexture> t = gpu.Texture(
      {.width = 16, .height = 16, .format = Format::RGBA8_UNorm, .bind = Bind::ShaderResource | Bind::UnorderedAccess});
  const auto mark = [](uint32_t x, uint32_t y) { return Rgba8{uint8_t(x), uint8_t(y), 0, 255}; };
  SetCompute(test_shaders::compute_CSPicture);
  SetWrite(2, t.get());
  context.Dispatch(2, 2, 1);
  SetWrite(2, nullptr);
  const Target target = gpu.MakeTarget({});
  gpu.SetTarget(target);
  gpu.SetTexture(Stage::Pixel, 0, t.get());
  gpu.DrawRect(test_shaders::sample_PSLoad);
  EXPECT_TRUE(Matches(gpu.Read(target), mark));
  EXPECT_TRUE(Matches(gpu.Read(t.get()), mark));
}

// A dispatch between two draws of one target ends the pass, and the picture is whole.
TEST_P(ComputeTest, DispatchBetweenDraws) {
  RHI_NEEDS_CAP(compute);
  const Target target = gpu.MakeTarget({});
  const Ref<IBuffer> items = Items(64);
  gpu.Clear(target, {0, 0, 1, 1});
  gpu.SetTarget(target);
  gpu.DrawRect(test_shaders::rect_PSTint, {.tint = {1, 0, 0, 1}, .rectangle = {-1, 1, 1, 0}});
  SetCompute(test_shaders::compute_CSGrid);
  SetWrite(0, items.get());
  context.Dispatch(1, 1, 1);
  SetWrite(0, nullptr);
  gpu.SetShaders(test_shaders::buffers_VSPulled, test_shaders::rect_PSTint);
  gpu.SetDraw({.tint = {0, 1, 0, 1}});
  gpu.SetTexture(Stage::Vertex, 0, items.get());
  context.DrawInstanced(4, 64, 0, 0);
  EXPECT_TRUE(Matches(gpu.Read(target), [](uint32_t x, uint32_t y) {
    return (x / 2) % 2 == 0 ? Rgba8{0, 255, 0, 255} : y < 8 ? Rgba8{255, 0, 0, 255} : Rgba8{0, 0, 255, 255};
  }));
}

RHI_ON_EVERY_BACKEND(ComputeTest);

}  // namespace
}  // namespace rhi_test

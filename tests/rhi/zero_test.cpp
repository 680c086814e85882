// What is not bound reads 0, and so does what lies beyond the end of a buffer or a view: in every stage.
#include "rhi_fixture.h"

namespace rhi_test {
namespace {

using namespace rhi;

constexpr Stage kStages[] = {Stage::Vertex, Stage::Geometry, Stage::Pixel, Stage::Compute};
// What rules.hlsl shows where all is bound: five textures of 20 (the integers are 20, too), items of 40, rows of 60.
constexpr Rgba8 kAll{100, 40, 60, 255}, kNothing{0, 0, 0, 255};

class ZeroTest : public RhiTest {
 protected:
  Ref<ITexture> Solid(TextureDim dim, Format format) {
    return gpu.TextureOf<Rgba8>(
        {.dim = dim, .width = 2, .height = 2, .depthOrArray = dim == TextureDim::TexCube ? 6u : 1u, .format = format},
        [](auto, auto, auto, auto) {
          return Rgba8{20, 20, 20, 20};
        });
  }
  // Eight elements, so that what lies behind a view of four is not 0.
  Ref<IBuffer> Items(Usage usage, uint32_t count = 8) {
    const std::vector<Rgba32F> data(count, Rgba32F{40 / 255.f, 40 / 255.f, 40 / 255.f, 40 / 255.f});
    return gpu.Buffer({.byteWidth = count * 16, .usage = usage, .bind = Bind::ShaderResource, .structureStride = 16},
                      data.data());
  }
  Ref<IBuffer> Rows(Usage usage, uint32_t count) {
    const std::vector<Rgba32F> data(count, Rgba32F{60 / 255.f, 60 / 255.f, 60 / 255.f, 60 / 255.f});
    return gpu.Buffer({.byteWidth = count * 16, .usage = usage, .bind = Bind::ConstantBuffer}, data.data());
  }
  void BindTextures(Stage stage) {
    gpu.SetTexture(stage, 0, Solid(TextureDim::Tex2D, Format::RGBA8_UNorm).get());
    gpu.SetTexture(stage, 1, Solid(TextureDim::Tex2DArray, Format::RGBA8_UNorm).get());
    gpu.SetTexture(stage, 2, Solid(TextureDim::TexCube, Format::RGBA8_UNorm).get());
    gpu.SetTexture(stage, 3, Solid(TextureDim::Tex3D, Format::RGBA8_UNorm).get());
    gpu.SetTexture(stage, 4, Solid(TextureDim::Tex2D, Format::RGBA8_UInt).get());
  }
  void BindRows(IBuffer* rows) { context.SetConstantBuffers(0, 1, &rows); }
  void BindAll(Stage stage) {
    BindTextures(stage);
    gpu.SetTexture(stage, 5, Items(Usage::Default).get());
    gpu.SetSampler(stage, 0, {});
    BindRows(Rows(Usage::Default, 4).get());
  }
  // What `stage` sees, with element `element` of the items.
  Rgba8 See(Stage stage, float element) {
    gpu.SetDraw({.extra = {0, element, 0, 0}});
    return stage == Stage::Compute ? Dispatch() : Draw(stage);
  }
  // Those that the driver has.
  std::vector<Stage> Stages() const {
    std::vector<Stage> stages(std::begin(kStages), std::end(kStages));
    if (!Caps().geometryShader) std::erase(stages, Stage::Geometry);
    return stages;
  }
  void Reset() {
    context.ClearState();
    gpu.SetDraw({});
  }

 private:
  Rgba8 Draw(Stage stage) {
    using namespace test_shaders;
    const Target target = gpu.MakeTarget({.width = 1, .height = 1});
    gpu.SetTarget(target);
    gpu.SetShaders(stage == Stage::Vertex ? rules_VSSees : rules_VSBlind,
                   stage == Stage::Pixel ? rules_PSSees : rules_PSShows);
    if (stage == Stage::Geometry) gpu.SetGeometryShader(rules_GSSees);
    context.IASetPrimitiveTopology(PrimitiveTopology::TriangleStrip);
    context.Draw(4, 0);
    context.GSSetShader(nullptr);
    return gpu.Read(target).At<Rgba8>(0, 0);
  }
  Rgba8 Dispatch() {
    const Ref<IBuffer> out = gpu.Buffer({.byteWidth = 16, .bind = Bind::UnorderedAccess, .structureStride = 16});
    const Ref<IUnorderedAccessView> view = gpu.WriteView(out.get());
    IUnorderedAccessView* raw = view.get();
    context.CSSetUnorderedAccessViews(0, 1, &raw);
    context.CSSetShader(gpu.Shader(test_shaders::rules_CSSees).get());
    context.Dispatch(1, 1, 1);
    const Rgba32F seen = gpu.ReadAs<Rgba32F>(out.get(), 0, 1)[0];
    return {ToUnorm8(seen[0]), ToUnorm8(seen[1]), ToUnorm8(seen[2]), ToUnorm8(seen[3])};
  }
};

// Without this the other tests would show nothing.
TEST_P(ZeroTest, WhatIsBoundIsSeenInEveryStage) {
  for (const Stage stage : Stages()) {
    Reset();
    BindAll(stage);
    EXPECT_EQ(See(stage, 3), kAll) << ToString(stage);
  }
}

TEST_P(ZeroTest, UnboundRegistersReadZeroInEveryStage) {
  sink.Expect(MsgCode::NothingBound, "that is the point");
  for (const Stage stage : Stages()) {
    Reset();
    EXPECT_EQ(See(stage, 3), kNothing) << ToString(stage);
    // Also after something was bound there.
    BindAll(stage);
    EXPECT_EQ(See(stage, 3), kAll) << ToString(stage);
    IShaderResourceView* none[6] = {};
    context.SetShaderResources(stage, 0, 6, none);
    BindRows(nullptr);
    EXPECT_EQ(See(stage, 3), kNothing) << ToString(stage);
  }
}

TEST_P(ZeroTest, ElementsBeyondTheBufferReadZeroInEveryStage) {
  for (const Stage stage : Stages())
    for (const Usage usage : {Usage::Default, Usage::Immutable, Usage::Dynamic}) {
      Reset();
      BindAll(stage);
      const Ref<IBuffer> items = Items(usage), behind = Items(usage);
      gpu.SetTexture(stage, 5, items.get());
      EXPECT_EQ(See(stage, 7), kAll) << ToString(stage) << int(usage);
      for (const float element : {8.f, 9.f, 100.f, 65536.f, 16777216.f, 134217728.f})
        EXPECT_EQ(See(stage, element), (Rgba8{100, 0, 60, 255})) << ToString(stage) << int(usage) << ' ' << element;
    }
}

TEST_P(ZeroTest, ElementsBeyondTheViewReadZeroInEveryStage) {
  for (const Stage stage : Stages()) {
    Reset();
    BindAll(stage);
    const Ref<IBuffer> items = Items(Usage::Default, 64);
    const ViewDesc some{.firstElement = 16, .elementCount = 4};
    const Ref<IShaderResourceView> view = gpu.View(items.get(), &some);
    IShaderResourceView* raw = view.get();
    context.SetShaderResources(stage, 5, 1, &raw);
    EXPECT_EQ(See(stage, 3), kAll) << ToString(stage);
    for (const float element : {4.f, 5.f, 47.f, 48.f, 1000.f})
      EXPECT_EQ(See(stage, element), (Rgba8{100, 0, 60, 255})) << ToString(stage) << ' ' << element;
  }
}

TEST_P(ZeroTest, ConstantsBeyondTheBufferReadZeroInEveryStage) {
  for (const Stage stage : Stages())
    for (const Usage usage : {Usage::Default, Usage::Immutable, Usage::Dynamic}) {
      Reset();
      BindAll(stage);
      const Ref<IBuffer> rows = Rows(usage, 1), behind = Rows(usage, 4);
      BindRows(rows.get());
      EXPECT_EQ(See(stage, 3), (Rgba8{100, 40, 0, 255})) << ToString(stage) << int(usage);
    }
}

RHI_ON_EVERY_BACKEND(ZeroTest);

}  // namespace
}  // namespace rhi_test

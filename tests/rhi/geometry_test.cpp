// Geometry shaders: what they pass on, layers, the most that they may emit.
#include "rhi_fixture.h"

namespace rhi_test {
namespace {

using namespace rhi;

class GeometryTest : public RhiTest {
 protected:
  void DrawRectWith(const ShaderBlob& gs, const ShaderBlob& ps) {
    gpu.SetShaders(test_shaders::rect_VSRect, ps);
    gpu.SetGeometryShader(gs);
    gpu.SetDraw({.tint = {0.3f, 0.7f, 0, 0}});
    context.IASetPrimitiveTopology(PrimitiveTopology::TriangleStrip);
    context.Draw(4, 0);
  }
};

TEST_P(GeometryTest, Passthrough) {
  RHI_NEEDS_CAP(geometryShader);
  const Target with = gpu.MakeTarget({.width = 31, .height = 19}),
               without = gpu.MakeTarget({.width = 31, .height = 19});
  gpu.SetTarget(without);
  gpu.DrawRect(test_shaders::rect_PSPattern, {.tint = {0.3f, 0.7f, 0, 0}});
  gpu.SetTarget(with);
  DrawRectWith(test_shaders::geometry_GSMainPassThrough, test_shaders::rect_PSPattern);
  EXPECT_TRUE(SameImage(gpu.Read(with), gpu.Read(without)));
}

TEST_P(GeometryTest, LayerOutput) {
  RHI_NEEDS_CAP(geometryShader);
  RHI_NEEDS_CAP(layeredRendering);
  const Ref<ITexture> t = gpu.TextureOf<Rgba8>({.dim = TextureDim::Tex2DArray,
                                                .width = 4,
                                                .height = 4,
                                                .depthOrArray = 6,
                                                .format = Format::RGBA8_UNorm,
                                                .bind = Bind::RenderTarget},
                                               [](auto, auto, auto, auto) {
                                                 return Rgba8{9, 9, 9, 9};
                                               });
  const ViewDesc four{.firstSlice = 1, .sliceCount = 4};
  const Ref<IRenderTargetView> rtv = gpu.TargetView(t.get(), &four);
  IRenderTargetView* raw = rtv.get();
  context.OMSetRenderTargets(1, &raw, nullptr);
  gpu.SetViewport(0, 0, 4, 4);
  DrawRectWith(test_shaders::geometry_GSMainLayers, test_shaders::geometry_PSUvX);
  for (uint8_t slice = 0; slice < 6; ++slice) {
    const Rgba8 expected = slice >= 1 && slice <= 4 ? Rgba8{slice, slice, slice, 255} : Rgba8{9, 9, 9, 9};
    EXPECT_TRUE(Matches(gpu.Read(t.get(), 0, slice), [&](auto, auto) { return expected; })) << +slice;
  }
}

// Each viewport with its own scissor; what the geometry shader sends to one stays within both.
TEST_P(GeometryTest, ViewportOutput) {
  RHI_NEEDS_CAP(geometryShader);
  const Target target = gpu.MakeTarget({});
  gpu.Clear(target, {0, 0, 0, 0});
  gpu.SetTarget(target);
  const Viewport views[4] = {{0, 0, 8, 8}, {8, 0, 8, 8}, {0, 8, 8, 8}, {8, 8, 8, 8}};
  const Rect scissors[4] = {{0, 0, 16, 16}, {0, 0, 16, 4}, {4, 0, 16, 16}, {9, 9, 11, 11}};
  context.RSSetViewports(4, views);
  context.RSSetScissorRects(4, scissors);
  context.RSSetState(gpu.Rasterizer({.scissor = true}).get());
  gpu.SetGeometryShader(test_shaders::geometry_GSMainViewports);
  gpu.DrawRect(test_shaders::geometry_PSUvX);
  EXPECT_TRUE(Matches(gpu.Read(target), [&](uint32_t x, uint32_t y) {
    const uint32_t i = x / 8 + 2 * (y / 8);
    const Rect& r = scissors[i];
    const bool inside = int(x) >= r.left && int(x) < r.right && int(y) >= r.top && int(y) < r.bottom;
    const uint8_t v = uint8_t(i + 1);
    return inside ? Rgba8{v, v, v, 255} : Rgba8{0, 0, 0, 0};
  }));
}

TEST_P(GeometryTest, MaxVertexCount) {
  RHI_NEEDS_CAP(geometryShader);
  const Target target = gpu.MakeTarget({.width = 64, .height = 1});
  gpu.Clear(target, {0, 0, 0, 0});
  gpu.SetTarget(target);
  DrawRectWith(test_shaders::geometry_GSMainMany, test_shaders::geometry_PSUvX);
  EXPECT_TRUE(Matches(gpu.Read(target), [](uint32_t x, auto) {
    const uint8_t v = uint8_t(x + 1);
    return x < 42 ? Rgba8{v, v, v, 255} : Rgba8{0, 0, 0, 0};
  }));
}

TEST_P(GeometryTest, UnboundGeometryShaderIsGone) {
  RHI_NEEDS_CAP(geometryShader);
  const Target target = gpu.MakeTarget({.width = 64, .height = 1});
  gpu.SetTarget(target);
  DrawRectWith(test_shaders::geometry_GSMainMany, test_shaders::geometry_PSUvX);
  context.GSSetShader(nullptr);
  gpu.DrawRect(test_shaders::rect_PSTint, {.tint = {0, 1, 0, 1}});
  EXPECT_TRUE(Matches(gpu.Read(target), [](auto, auto) { return Rgba8{0, 255, 0, 255}; }));
}

TEST_P(GeometryTest, WrongTopologyIsReportedAndSkipped) {
  RHI_NEEDS_CAP(geometryShader);
  sink.Expect(MsgCode::TopologyMismatch, "a geometry shader of triangles gets lines");
  const Target target = gpu.MakeTarget({});
  gpu.Clear(target, {0, 0, 0, 0});
  gpu.SetTarget(target);
  gpu.SetShaders(test_shaders::rect_VSRect, test_shaders::rect_PSTint);
  gpu.SetGeometryShader(test_shaders::geometry_GSMainPassThrough);
  gpu.SetDraw({});
  context.IASetPrimitiveTopology(PrimitiveTopology::LineList);
  context.Draw(4, 0);
  EXPECT_TRUE(Matches(gpu.Read(target), [](auto, auto) { return Rgba8{0, 0, 0, 0}; }));
}

RHI_ON_EVERY_BACKEND(GeometryTest);

}  // namespace
}  // namespace rhi_test

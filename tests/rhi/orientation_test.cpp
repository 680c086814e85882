// One orientation for every backend: row 0 on top, depth 0..1, clockwise front faces, the top-left rule.
#include "rhi_fixture.h"

namespace rhi_test {
namespace {

using namespace rhi;

constexpr Rgba8 kBlack{0, 0, 0, 0}, kWhite{255, 255, 255, 255};

class OrientationTest : public RhiTest {
 protected:
  // White where covered, black elsewhere.
  Image Coverage(const Target& target, const Rgba32F& rectangle) {
    gpu.Clear(target, {0, 0, 0, 0});
    gpu.DrawRect(test_shaders::rect_PSTint, {.rectangle = rectangle});
    return gpu.Read(target);
  }
  static auto Inside(uint32_t left, uint32_t top, uint32_t right, uint32_t bottom) {
    return [=](uint32_t x, uint32_t y) { return x >= left && x < right && y >= top && y < bottom ? kWhite : kBlack; };
  }
};

// A picture that is its own function: pixel centres at .5, row 0 on top.
TEST_P(OrientationTest, GradientFxy) {
  const Target target = gpu.MakeTarget({.width = 33, .height = 17, .format = Format::RGBA32_Float});
  gpu.SetTarget(target);
  gpu.DrawRect(test_shaders::rect_PSPosition, {.extra = {0.25f, 0, 0, 0}});
  EXPECT_TRUE(Matches(gpu.Read(target), [](uint32_t x, uint32_t y) {
    return Rgba32F{float(x) + 0.5f, float(y) + 0.5f, 0.25f, 1};
  }));
}

TEST_P(OrientationTest, UvRunsFromTheTopLeft) {
  const Target target = gpu.MakeTarget({.width = 16, .height = 16, .format = Format::RGBA32_Float});
  gpu.SetTarget(target);
  gpu.DrawRect(test_shaders::rect_PSUv);
  EXPECT_TRUE(Matches(gpu.Read(target), [](uint32_t x, uint32_t y) {
    return Rgba32F{(float(x) + 0.5f) / 16, (float(y) + 0.5f) / 16, 0, 1};
  }));
}

TEST_P(OrientationTest, TextureRowsAreKept) {
  const auto mark = [](uint32_t x, uint32_t y) { return Rgba8{uint8_t(x), uint8_t(y), 7, 255}; };
  const Ref<ITexture> t = gpu.TextureOf<Rgba8>({.width = 9, .height = 6, .format = Format::RGBA8_UNorm},
                                               [&](auto x, auto y, auto, auto) { return mark(x, y); });
  const Target a = gpu.MakeTarget({.width = 9, .height = 6}), b = gpu.MakeTarget({.width = 9, .height = 6});
  gpu.SetSampler(Stage::Pixel, 0, {.min = Filter::Point, .mag = Filter::Point, .mip = Filter::Point});
  gpu.SetTarget(a);
  gpu.SetTexture(Stage::Pixel, 0, t.get());
  gpu.DrawRect(test_shaders::sample_PSSample, {.extra = {0, 1, 0, 0}});
  gpu.SetTarget(b);
  gpu.SetTexture(Stage::Pixel, 0, a.color.get());  // a picture that was drawn, drawn again
  gpu.DrawRect(test_shaders::sample_PSSample, {.extra = {0, 1, 0, 0}});
  EXPECT_TRUE(Matches(gpu.Read(a), mark));
  EXPECT_TRUE(Matches(gpu.Read(b), mark));
}

TEST_P(OrientationTest, ViewportOrigin) {
  const Target target = gpu.MakeTarget({});
  gpu.SetTarget(target);
  gpu.SetViewport(3, 1, 8, 4);
  EXPECT_TRUE(Matches(Coverage(target, {-1, 1, 1, -1}), Inside(3, 1, 11, 5)));
  EXPECT_TRUE(Matches(Coverage(target, {-1, 1, 0, 0}), Inside(3, 1, 7, 3)));
  gpu.SetViewport(-4, -4, 8, 8);
  EXPECT_TRUE(Matches(Coverage(target, {-1, 1, 1, -1}), Inside(0, 0, 4, 4)));
}

TEST_P(OrientationTest, ScissorOrigin) {
  const Target target = gpu.MakeTarget({});
  gpu.SetTarget(target);
  const Rect r{2, 1, 7, 5};
  context.RSSetScissorRects(1, &r);
  EXPECT_TRUE(Matches(Coverage(target, {-1, 1, 1, -1}), Inside(0, 0, 16, 16))) << "scissor is off by default";
  context.RSSetState(gpu.Rasterizer({.scissor = true}).get());
  EXPECT_TRUE(Matches(Coverage(target, {-1, 1, 1, -1}), Inside(2, 1, 7, 5)));
  const Rect beyond{10, 12, 100, 100};
  context.RSSetScissorRects(1, &beyond);
  EXPECT_TRUE(Matches(Coverage(target, {-1, 1, 1, -1}), Inside(10, 12, 16, 16)));
  const Rect empty{5, 5, 5, 9};
  context.RSSetScissorRects(1, &empty);
  EXPECT_TRUE(Matches(Coverage(target, {-1, 1, 1, -1}), Inside(0, 0, 0, 0)));
}

TEST_P(OrientationTest, DepthRange0_1) {
  const Target target =
      gpu.MakeTarget({.width = 4, .height = 4, .format = Format::RGBA32_Float, .depthFormat = Format::D32_Float});
  gpu.Clear(target, {9, 9, 9, 9}, 1);
  gpu.SetTarget(target);
  for (const float z : {0.f, 0.25f, 0.5f, 0.999f}) {
    context.OMSetDepthStencilState(gpu.DepthStencil({.depthFunc = Comparison::Always}).get());
    gpu.DrawRect(test_shaders::rect_PSPosition, {.extra = {z, 0, 0, 0}});
    EXPECT_TRUE(Matches(gpu.Read(target), [z](uint32_t x, uint32_t y) {
      return Rgba32F{float(x) + 0.5f, float(y) + 0.5f, z, 1};
    })) << z;
    EXPECT_TRUE(Matches(gpu.Read(target.depth.get()), [z](auto, auto) { return std::array<float, 1>{z}; })) << z;
  }
  const Viewport part{0, 0, 4, 4, 0.25f, 0.75f};
  context.RSSetViewports(1, &part);
  gpu.DrawRect(test_shaders::rect_PSPosition, {.extra = {0.5f, 0, 0, 0}});
  EXPECT_TRUE(Matches(gpu.Read(target.depth.get()), [](auto, auto) { return std::array<float, 1>{0.5f}; }));
  gpu.DrawRect(test_shaders::rect_PSPosition, {.extra = {0, 0, 0, 0}});
  EXPECT_TRUE(Matches(gpu.Read(target.depth.get()), [](auto, auto) { return std::array<float, 1>{0.25f}; }));
}

TEST_P(OrientationTest, DepthClipAtZeroAndOne) {
  const Target target = gpu.MakeTarget({});
  gpu.SetTarget(target);
  for (const float z : {-0.01f, 0.f, 0.5f, 1.f, 1.01f}) {
    gpu.Clear(target, {0, 0, 0, 0});
    gpu.DrawRect(test_shaders::rect_PSTint, {.extra = {z, 0, 0, 0}});
    const Rgba8 expected = z < 0 || z > 1 ? kBlack : kWhite;
    EXPECT_TRUE(Matches(gpu.Read(target), [&](auto, auto) { return expected; })) << z;
  }
}

TEST_P(OrientationTest, WithoutDepthClipDepthIsClamped) {
  RHI_NEEDS_CAP(depthClipDisable);
  const Target target = gpu.MakeTarget({.depthFormat = Format::D32_Float});
  gpu.Clear(target, {0, 0, 0, 0}, 0.5f);
  gpu.SetTarget(target);
  context.RSSetState(gpu.Rasterizer({.depthClip = false}).get());
  context.OMSetDepthStencilState(gpu.DepthStencil({.depthFunc = Comparison::Always}).get());
  gpu.DrawRect(test_shaders::rect_PSTint, {.extra = {1.5f, 0, 0, 0}});
  EXPECT_TRUE(Matches(gpu.Read(target), Inside(0, 0, 16, 16)));
  EXPECT_TRUE(Matches(gpu.Read(target.depth.get()), [](auto, auto) { return std::array<float, 1>{1}; }));
}

TEST_P(OrientationTest, FrontFaceCull) {
  const Target target = gpu.MakeTarget({});
  gpu.SetTarget(target);
  const Rgba32F clockwise{-1, 1, 1, -1}, counter{1, 1, -1, -1};
  for (const CullMode cull : {CullMode::None, CullMode::Front, CullMode::Back})
    for (const bool frontCCW : {false, true})
      for (const bool isClockwise : {true, false}) {
        context.RSSetState(gpu.Rasterizer({.cull = cull, .frontCCW = frontCCW}).get());
        gpu.Clear(target, {0, 0, 0, 0});
        gpu.DrawRect(test_shaders::rect_PSFace, {.rectangle = isClockwise ? clockwise : counter});
        const bool front = isClockwise != frontCCW;
        const bool culled = (cull == CullMode::Front && front) || (cull == CullMode::Back && !front);
        const Rgba8 expected = culled ? kBlack : front ? Rgba8{255, 0, 0, 255} : Rgba8{0, 255, 0, 255};
        EXPECT_TRUE(Matches(gpu.Read(target), [&](auto, auto) { return expected; }))
            << int(cull) << frontCCW << isClockwise;
      }
}

// Edges through pixel centres: left and top belong to the shape, right and bottom do not.
TEST_P(OrientationTest, TopLeftRule) {
  const Target target = gpu.MakeTarget({});
  gpu.SetTarget(target);
  const auto clip = [](float pixel) { return pixel / 8 - 1; };
  const Rgba32F rectangle{clip(2.5f), -clip(3.5f), clip(6.5f), -clip(9.5f)};
  EXPECT_TRUE(Matches(Coverage(target, rectangle), Inside(2, 3, 6, 9)));
}

// A fan around an odd point with additive blending: no pixel twice, none left out.
TEST_P(OrientationTest, SharedEdgesCoverEachPixelOnce) {
  struct Vertex {
    float position[3], color[4];
  };
  const Target target = gpu.MakeTarget({.width = 64, .height = 64});
  const Rgba32F one{1 / 255.f, 1 / 255.f, 1 / 255.f, 1 / 255.f};
  std::vector<Vertex> vertices;
  const auto add = [&](double x, double y) {
    vertices.push_back({{float(x), float(y), 0.5f}, {one[0], one[1], one[2], one[3]}});
  };
  const int corners = 24;
  const auto rim = [&](int i, bool isX) {
    const double angle = -2 * 3.14159265358979 * i / corners;
    return 1.6 * (isX ? std::cos(angle) : std::sin(angle));
  };
  for (int i = 0; i < corners; ++i) {
    add(1.0 / 64, -1.0 / 64);  // a pixel's centre
    add(rim(i, true), rim(i, false));
    add(rim(i + 1, true), rim(i + 1, false));
  }
  const Ref<IBuffer> buffer = gpu.BufferOf(Bind::VertexBuffer, vertices);
  const InputElement layout[] = {{.semantic = "POSITION", .format = Format::RGB32_Float},
                                 {.semantic = "COLOR", .format = Format::RGBA32_Float, .offset = 12}};
  BlendDesc add1;
  add1.rt[0] = {.enable = true,
                .src = rhi::Blend::One,
                .dest = rhi::Blend::One,
                .srcAlpha = rhi::Blend::One,
                .destAlpha = rhi::Blend::One};
  gpu.Clear(target, {0, 0, 0, 0});
  gpu.SetTarget(target);
  gpu.SetShaders(test_shaders::mesh_VSMesh, test_shaders::mesh_PSMesh);
  context.IASetInputLayout(gpu.Layout(layout, gpu.Shader(test_shaders::mesh_VSMesh).get()).get());
  context.OMSetBlendState(gpu.Blend(add1).get());
  gpu.SetVertices(buffer.get(), sizeof(Vertex));
  context.Draw(uint32_t(vertices.size()), 0);
  EXPECT_TRUE(Matches(gpu.Read(target), [](auto, auto) { return Rgba8{1, 1, 1, 1}; }));
}

TEST_P(OrientationTest, WireframeLeavesTheInsideOpen) {
  RHI_NEEDS_CAP(wireframe);
  const Target target = gpu.MakeTarget({});
  gpu.SetTarget(target);
  context.RSSetState(gpu.Rasterizer({.fill = FillMode::Wireframe, .cull = CullMode::None}).get());
  const Image image = Coverage(target, {-0.9f, 0.9f, 0.9f, -0.9f});
  EXPECT_EQ(image.At<Rgba8>(4, 6), kBlack);
  EXPECT_EQ(image.At<Rgba8>(8, 0), kWhite);
}

RHI_ON_EVERY_BACKEND(OrientationTest);

}  // namespace
}  // namespace rhi_test

// Depth functions, depth writes, stencil operations and masks.
#include <algorithm>

#include "rhi_fixture.h"

namespace rhi_test {
namespace {

using namespace rhi;

constexpr Rgba8 kWhite{255, 255, 255, 255}, kBlack{0, 0, 0, 0};

// The depth-and-stencil format that this adapter has.
Format StencilFormat(IDevice& device) {
  const bool d24 = device.CheckFormatSupport(Format::D24_UNorm_S8_UInt) & FormatSupport::DepthStencil;
  return d24 ? Format::D24_UNorm_S8_UInt : Format::D32_Float_S8_UInt;
}

bool Passes(Comparison f, double a, double b) {
  switch (f) {
    case Comparison::Never: return false;
    case Comparison::Less: return a < b;
    case Comparison::Equal: return a == b;
    case Comparison::LessEqual: return a <= b;
    case Comparison::Greater: return a > b;
    case Comparison::NotEqual: return a != b;
    case Comparison::GreaterEqual: return a >= b;
    case Comparison::Always: return true;
  }
  return false;
}
constexpr Comparison kFunctions[] = {Comparison::Never,        Comparison::Less,    Comparison::Equal,
                                     Comparison::LessEqual,    Comparison::Greater, Comparison::NotEqual,
                                     Comparison::GreaterEqual, Comparison::Always};

// Draws column `x` of a target of 32 pixels.
void DrawColumnOf(Gpu& gpu, uint32_t x, float depth, const Rgba32F& tint = {1, 1, 1, 1}) {
  const float left = float(x) / 16 - 1;
  gpu.DrawRect(test_shaders::rect_PSTint,
               {.tint = tint, .rectangle = {left, 1, left + 1 / 16.f, -1}, .extra = {depth, 0, 0, 0}});
}

class DepthTest : public RhiTest {
 protected:
  void DrawColumn(uint32_t x, float depth, const Rgba32F& tint = {1, 1, 1, 1}) { DrawColumnOf(gpu, x, depth, tint); }
};

std::string NameOf(Comparison f) {
  static constexpr const char* kNames[] = {"never",   "less",      "equal",         "less_equal",
                                           "greater", "not_equal", "greater_equal", "always"};
  return kNames[std::find(std::begin(kFunctions), std::end(kFunctions), f) - kFunctions];
}
using DepthFunctionTest = RhiTestOf<Comparison>;

// Column 0 is nearer than what is there, column 1 as near, column 2 farther.
TEST_P(DepthFunctionTest, DepthFunc) {
  const float depths[3] = {0.25f, 0.5f, 0.75f};
  const Target target = gpu.MakeTarget({.width = 32, .height = 1, .depthFormat = Format::D32_Float});
  gpu.Clear(target, {0, 0, 0, 0}, 0.5f);
  gpu.SetTarget(target);
  context.OMSetDepthStencilState(gpu.DepthStencil({.depthFunc = Parameter()}).get());
  for (uint32_t i = 0; i < 3; ++i) DrawColumnOf(gpu, i, depths[i]);
  const auto passes = [&](uint32_t x) { return x < 3 && Passes(Parameter(), depths[x], 0.5); };
  EXPECT_TRUE(Matches(gpu.Read(target), [&](uint32_t x, auto) { return passes(x) ? kWhite : kBlack; }));
  EXPECT_TRUE(Matches(gpu.Read(target.depth.get()),
                      [&](uint32_t x, auto) { return std::array<float, 1>{passes(x) ? depths[x] : 0.5f}; }));
}

TEST_P(DepthTest, DefaultStateIsLessAndWrites) {
  const Target target = gpu.MakeTarget({.width = 32, .height = 1, .depthFormat = Format::D32_Float});
  gpu.Clear(target, {0, 0, 0, 0}, 1);
  gpu.SetTarget(target);
  DrawColumn(0, 0.5f, {1, 0, 0, 1});
  DrawColumn(0, 0.6f, {0, 1, 0, 1});
  DrawColumn(1, 0.6f, {0, 1, 0, 1});
  DrawColumn(1, 0.5f, {1, 0, 0, 1});
  EXPECT_TRUE(Matches(gpu.Read(target), [](uint32_t x, auto) { return x < 2 ? Rgba8{255, 0, 0, 255} : kBlack; }));
}

TEST_P(DepthTest, NoWriteAndNoTest) {
  const Target target = gpu.MakeTarget({.width = 32, .height = 1, .depthFormat = Format::D32_Float});
  gpu.Clear(target, {0, 0, 0, 0}, 0.5f);
  gpu.SetTarget(target);
  context.OMSetDepthStencilState(gpu.DepthStencil({.depthWrite = false}).get());
  DrawColumn(0, 0.25f);
  context.OMSetDepthStencilState(gpu.DepthStencil({.depthEnable = false}).get());
  DrawColumn(1, 0.75f);
  EXPECT_TRUE(Matches(gpu.Read(target), [](uint32_t x, auto) { return x < 2 ? kWhite : kBlack; }));
  EXPECT_TRUE(Matches(gpu.Read(target.depth.get()), [](auto, auto) { return std::array<float, 1>{0.5f}; }));
}

TEST_P(DepthTest, ShaderDepth) {
  const Target target = gpu.MakeTarget({.width = 32, .height = 1, .depthFormat = Format::D32_Float});
  gpu.Clear(target, {0, 0, 0, 0}, 0.5f);
  gpu.SetTarget(target);
  gpu.DrawRect(test_shaders::rect_PSDepth);
  EXPECT_TRUE(Matches(gpu.Read(target), [](uint32_t x, auto) { return x < 16 ? kWhite : kBlack; }));
}

TEST_P(DepthTest, DepthBiasMovesAwayAndSlopes) {
  const Target target = gpu.MakeTarget({.width = 32, .height = 1, .depthFormat = Format::D32_Float});
  gpu.Clear(target, {0, 0, 0, 0}, 1);
  gpu.SetTarget(target);
  context.RSSetState(gpu.Rasterizer({.depthBias = 1000}).get());
  DrawColumn(0, 0.5f);
  context.RSSetState(gpu.Rasterizer({.depthBias = -1000}).get());
  DrawColumn(1, 0.5f);
  const Image depth = gpu.Read(target.depth.get());
  EXPECT_GT(depth.At<float>(0, 0), 0.5f);
  EXPECT_LT(depth.At<float>(0, 0), 0.501f);
  EXPECT_LT(depth.At<float>(1, 0), 0.5f);
}

// bias = depthBias * step + slopeScaledBias * slope, clamped. A step is the smallest difference of the format near the
// primitive's greatest depth; the slope is the greater of its changes across and down a pixel.
TEST_P(DepthTest, DepthBiasFollowsTheFormula) {
  RHI_NEEDS_CAP(depthBiasClamp);
  struct Vertex {
    float position[3], color[4];
  };
  const Ref<IBuffer> slanted =
      gpu.BufferOf(Bind::VertexBuffer,
                   std::vector<Vertex>{{{-1, 1, 0.25f}}, {{1, 1, 0.375f}}, {{-1, -1, 0.25f}}, {{1, -1, 0.375f}}});
  const InputElement layout[] = {{.semantic = "POSITION", .format = Format::RGB32_Float},
                                 {.semantic = "COLOR", .format = Format::RGBA32_Float, .offset = 12}};
  const double slope = 0.125 / 32, step = std::ldexp(1.0, -2 - 23);  // the greatest depth is in [1/4, 1/2)
  struct Case {
    int32_t bias;
    float scale, clamp;
    double expected;
  };
  const Case cases[] = {{0, 0, 0, 0},
                        {100000, 0, 0, 100000 * step},
                        {-100000, 0, 0, -100000 * step},
                        {0, 2, 0, 2 * slope},
                        {0, -1, 0, -slope},
                        {100000, 2, 0, 100000 * step + 2 * slope},
                        {0, 2, 0.001f, 0.001},
                        {0, -2, -0.001f, -0.001},
                        {0, 2, 0.5f, 2 * slope}};
  for (const Case& c : cases) {
    const Target target = gpu.MakeTarget({.width = 32, .height = 4, .depthFormat = Format::D32_Float});
    gpu.Clear(target, {0, 0, 0, 0}, 1);
    gpu.SetTarget(target);
    const RasterizerDesc raster{.depthBias = c.bias, .depthBiasClamp = c.clamp, .slopeScaledBias = c.scale};
    context.RSSetState(gpu.Rasterizer(raster).get());
    gpu.SetShaders(test_shaders::mesh_VSMesh, test_shaders::mesh_PSMesh);
    context.IASetInputLayout(gpu.Layout(layout, gpu.Shader(test_shaders::mesh_VSMesh).get()).get());
    context.IASetPrimitiveTopology(PrimitiveTopology::TriangleStrip);
    gpu.SetVertices(slanted.get(), sizeof(Vertex));
    context.Draw(4, 0);
    EXPECT_TRUE(
        Matches(gpu.Read(target.depth.get()),
                [&](uint32_t x, auto) { return std::array<float, 1>{float(0.25 + (x + 0.5) * slope + c.expected)}; }))
        << c.bias << ' ' << c.scale << ' ' << c.clamp;
  }
}

TEST_P(DepthTest, ClearOfDepthOnlyAndStencilOnly) {
  const Target target = gpu.MakeTarget({.width = 32, .height = 1, .depthFormat = StencilFormat(device)});
  gpu.Clear(target, {0, 0, 0, 0}, 0.25f, 7);
  context.ClearDepthStencilView(target.dsv.get(), true, 0.75f, false, 99);
  gpu.SetTarget(target);
  const DepthStencilDesc is7{.stencilEnable = true, .front = {.func = Comparison::Equal}};
  context.OMSetDepthStencilState(gpu.DepthStencil(is7).get(), 7);
  DrawColumn(0, 0.5f);
  context.ClearDepthStencilView(target.dsv.get(), false, 0, true, 9);
  DrawColumn(1, 0.6f);
  context.OMSetDepthStencilState(gpu.DepthStencil(is7).get(), 9);
  DrawColumn(2, 0.6f);
  EXPECT_TRUE(Matches(gpu.Read(target), [](uint32_t x, auto) { return x == 0 || x == 2 ? kWhite : kBlack; }));
}

uint8_t Apply(StencilOp op, uint8_t old, uint8_t reference) {
  switch (op) {
    case StencilOp::Keep: return old;
    case StencilOp::Zero: return 0;
    case StencilOp::Replace: return reference;
    case StencilOp::IncrSat: return old == 255 ? old : uint8_t(old + 1);
    case StencilOp::DecrSat: return old == 0 ? old : uint8_t(old - 1);
    case StencilOp::Invert: return uint8_t(~old);
    case StencilOp::Incr: return uint8_t(old + 1);
    case StencilOp::Decr: return uint8_t(old - 1);
  }
  return old;
}
constexpr StencilOp kOps[] = {StencilOp::Keep,    StencilOp::Zero,   StencilOp::Replace, StencilOp::IncrSat,
                              StencilOp::DecrSat, StencilOp::Invert, StencilOp::Incr,    StencilOp::Decr};

std::string NameOf(StencilOp op) {
  static constexpr const char* kNames[] = {"keep", "zero", "replace", "incr_sat", "decr_sat", "invert", "incr", "decr"};
  return kNames[std::find(std::begin(kOps), std::end(kOps), op) - kOps];
}

// The operation in each of its three places, on three values; then every column is drawn where the stencil is what it
// should be.
using StencilOpTest = RhiTestOf<StencilOp>;
TEST_P(StencilOpTest, StencilOps) {
  for (const uint8_t start : {uint8_t(0), uint8_t(100), uint8_t(255)}) {
    const Target target = gpu.MakeTarget({.width = 32, .height = 1, .depthFormat = StencilFormat(device)});
    gpu.Clear(target, {0, 0, 0, 0}, 0.5f, start);
    gpu.SetTarget(target);
    BlendDesc noColor;
    noColor.rt[0].writeMask = 0;
    context.OMSetBlendState(gpu.Blend(noColor).get());
    for (uint32_t place = 0; place < 3; ++place) {
      DepthStencilDesc d{.depthWrite = false, .stencilEnable = true};
      if (place == 0) d.front.pass = Parameter();
      if (place == 1) d.front.depthFail = Parameter();
      if (place == 2) d.front.fail = Parameter(), d.front.func = Comparison::Never;
      context.OMSetDepthStencilState(gpu.DepthStencil(d).get(), 42);
      DrawColumnOf(gpu, place, place == 1 ? 0.75f : 0.25f);
    }
    context.OMSetBlendState(nullptr);
    const DepthStencilDesc equal{.depthEnable = false, .stencilEnable = true, .front = {.func = Comparison::Equal}};
    context.OMSetDepthStencilState(gpu.DepthStencil(equal).get(), Apply(Parameter(), start, 42));
    for (uint32_t place = 0; place < 3; ++place) DrawColumnOf(gpu, place, 0.5f);
    EXPECT_TRUE(Matches(gpu.Read(target), [](uint32_t x, auto) { return x < 3 ? kWhite : kBlack; })) << +start;
  }
}

using StencilFunctionTest = RhiTestOf<Comparison>;
TEST_P(StencilFunctionTest, StencilFunc) {
  const Target target = gpu.MakeTarget({.width = 32, .height = 1, .depthFormat = StencilFormat(device)});
  gpu.Clear(target, {0, 0, 0, 0}, 1, 5);
  gpu.SetTarget(target);
  for (uint32_t i = 0; i < 3; ++i) {
    context.OMSetDepthStencilState(gpu.DepthStencil({.stencilEnable = true, .front = {.func = Parameter()}}).get(),
                                   4 + i);
    DrawColumnOf(gpu, i, 0.5f);
  }
  EXPECT_TRUE(Matches(gpu.Read(target),
                      [this](uint32_t x, auto) { return x < 3 && Passes(Parameter(), 4 + x, 5) ? kWhite : kBlack; }));
}

TEST_P(DepthTest, StencilMasksAndFaces) {
  const Target target = gpu.MakeTarget({.width = 32, .height = 1, .depthFormat = StencilFormat(device)});
  gpu.Clear(target, {0, 0, 0, 0}, 1, 0xF0);
  gpu.SetTarget(target);
  context.RSSetState(gpu.Rasterizer({.cull = CullMode::None}).get());
  DepthStencilDesc write{.depthWrite = false, .stencilEnable = true, .writeMask = 0x3C};
  write.front.pass = StencilOp::Replace;
  write.back.pass = StencilOp::Zero;
  context.OMSetDepthStencilState(gpu.DepthStencil(write).get(), 0x0F);
  gpu.DrawRect(test_shaders::rect_PSTint, {.rectangle = {-1, 1, 0, -1}});  // front: 0xCC
  gpu.DrawRect(test_shaders::rect_PSTint, {.rectangle = {1, 1, 0, -1}});   // back: 0xC0
  gpu.Clear(target, {0, 0, 0, 0}, 1, 0xF0);
  gpu.DrawRect(test_shaders::rect_PSTint, {.rectangle = {-1, 1, 0, -1}});
  gpu.DrawRect(test_shaders::rect_PSTint, {.rectangle = {1, 1, 0, -1}});
  context.ClearRenderTargetView(target.rtv.get(), Rgba32F{0, 0, 0, 0}.data());
  const auto show = [&](uint8_t readMask, uint32_t reference, const Rgba32F& tint) {
    context.OMSetDepthStencilState(gpu.DepthStencil({.depthEnable = false,
                                                     .stencilEnable = true,
                                                     .readMask = readMask,
                                                     .front = {.func = Comparison::Equal}})
                                       .get(),
                                   reference);
    gpu.DrawRect(test_shaders::rect_PSTint, {.tint = tint});
  };
  show(0xFF, 0xCC, {1, 0, 0, 1});
  show(0xF3, 0xC0, {0, 0, 0, 0});  // the masked bits are ignored on both sides: all
  show(0xFF, 0xCC, {1, 0, 0, 1});
  show(0xFF, 0xC0, {0, 1, 0, 1});
  EXPECT_TRUE(Matches(gpu.Read(target), [](uint32_t x, auto) {
    return x < 16 ? Rgba8{255, 0, 0, 255} : Rgba8{0, 255, 0, 255};
  }));
}

RHI_ON_EVERY_BACKEND(DepthTest);
RHI_MATRIX(DepthFunctionTest, kFunctions, [](Comparison f) { return NameOf(f); });
RHI_MATRIX(StencilOpTest, kOps, [](StencilOp op) { return NameOf(op); });
RHI_MATRIX(StencilFunctionTest, kFunctions, [](Comparison f) { return NameOf(f); });

}  // namespace
}  // namespace rhi_test

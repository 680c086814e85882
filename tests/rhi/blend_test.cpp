// The output merger's blending and write masks, against Direct3D's formulas.
#include <algorithm>
#include <span>

#include "rhi_fixture.h"

namespace rhi_test {
namespace {

using namespace rhi;
using B = rhi::Blend;

using Color = std::array<double, 4>;
constexpr Color kSource{0.8, 0.35, 0.15, 0.6}, kFactor{0.25, 0.5, 0.75, 0.4};
constexpr std::array<uint8_t, 4> kDest{51, 204, 102, 178};

double FactorOf(B f, size_t c, const Color& s, const Color& d) {
  switch (f) {
    case B::Zero: return 0;
    case B::One: return 1;
    case B::SrcColor: return s[c];
    case B::InvSrcColor: return 1 - s[c];
    case B::SrcAlpha: return s[3];
    case B::InvSrcAlpha: return 1 - s[3];
    case B::DestAlpha: return d[3];
    case B::InvDestAlpha: return 1 - d[3];
    case B::DestColor: return d[c];
    case B::InvDestColor: return 1 - d[c];
    case B::SrcAlphaSat: return c == 3 ? 1 : std::min(s[3], 1 - d[3]);
    case B::BlendFactor: return kFactor[c];
    case B::InvBlendFactor: return 1 - kFactor[c];
    default: return 0;
  }
}

double Apply(BlendOp op, double s, double d, double fs, double fd) {
  switch (op) {
    case BlendOp::Add: return s * fs + d * fd;
    case BlendOp::Subtract: return s * fs - d * fd;
    case BlendOp::RevSubtract: return d * fd - s * fs;
    case BlendOp::Min: return std::min(s, d);
    case BlendOp::Max: return std::max(s, d);
  }
  return 0;
}

Rgba8 Oracle(const RenderTargetBlend& b) {
  Color d;
  for (size_t c = 0; c < 4; ++c) d[c] = kDest[c] / 255.0;
  Rgba8 result;
  for (size_t c = 0; c < 4; ++c) {
    const bool alpha = c == 3;
    const double fs = FactorOf(alpha ? b.srcAlpha : b.src, c, kSource, d),
                 fd = FactorOf(alpha ? b.destAlpha : b.dest, c, kSource, d);
    result[c] = ToUnorm8(Apply(alpha ? b.opAlpha : b.op, kSource[c], d[c], fs, fd));
  }
  return result;
}

// Factors that an alpha channel may use in Direct3D: none of the colors.
B AlphaTwin(B f) {
  switch (f) {
    case B::SrcColor: return B::SrcAlpha;
    case B::InvSrcColor: return B::InvSrcAlpha;
    case B::DestColor: return B::DestAlpha;
    case B::InvDestColor: return B::InvDestAlpha;
    default: return f;
  }
}

// Draws pixel after pixel with one blending each.
class BlendRow {
 public:
  BlendRow(Gpu& g, uint32_t width) : gpu(g), target(g.MakeTarget({.width = width, .height = 1})) {
    gpu.Clear(target, {kDest[0] / 255.f, kDest[1] / 255.f, kDest[2] / 255.f, kDest[3] / 255.f});
    gpu.SetTarget(target);
  }
  void DrawNext(const RenderTargetBlend& b) {
    BlendDesc desc;
    desc.rt[0] = b;
    desc.rt[0].enable = true;
    const float factor[4] = {float(kFactor[0]), float(kFactor[1]), float(kFactor[2]), float(kFactor[3])};
    gpu.context->OMSetBlendState(gpu.Blend(desc).get(), factor);
    const float pixel = 2 / float(target.width), left = float(cases.size()) * pixel - 1;
    gpu.DrawRect(test_shaders::rect_PSTint,
                 {.tint = {float(kSource[0]), float(kSource[1]), float(kSource[2]), float(kSource[3])},
                  .rectangle = {left, 1, left + pixel, -1}});
    cases.push_back(b);
  }
  void ExpectAll() {
    EXPECT_TRUE(Matches(
        gpu.Read(target), [this](uint32_t x, auto) { return x < cases.size() ? Oracle(cases[x]) : Rgba8{kDest}; },
        Within("blend_rounding")));
  }
  Gpu& gpu;
  Target target;
  std::vector<RenderTargetBlend> cases;
};

class BlendTest : public RhiTest {
 protected:
  void Start() { target = BlendRow(gpu, 64).target; }
  Target target;
};

constexpr B kFactors[] = {B::Zero,        B::One,         B::SrcColor,      B::InvSrcColor, B::SrcAlpha,
                          B::InvSrcAlpha, B::DestAlpha,   B::InvDestAlpha,  B::DestColor,   B::InvDestColor,
                          B::SrcAlphaSat, B::BlendFactor, B::InvBlendFactor};
constexpr BlendOp kOps[] = {BlendOp::Add, BlendOp::Subtract, BlendOp::RevSubtract, BlendOp::Min, BlendOp::Max};

struct FactorAndOp {
  B factor;
  BlendOp op;
};
std::string NameOf(const FactorAndOp& p) {
  static constexpr const char* kFactorNames[] = {
      "zero",          "one",          "src_color",       "inv_src_color", "src_alpha",
      "inv_src_alpha", "dest_alpha",   "inv_dest_alpha",  "dest_color",    "inv_dest_color",
      "src_alpha_sat", "blend_factor", "inv_blend_factor"};
  static constexpr const char* kOpNames[] = {"add", "subtract", "rev_subtract", "min", "max"};
  const auto index = [](const auto& list, auto value) {
    return std::find(std::begin(list), std::end(list), value) - list;
  };
  return std::string(kFactorNames[index(kFactors, p.factor)]) + "_" + kOpNames[index(kOps, p.op)];
}
std::vector<FactorAndOp> FactorsAndOps() {
  std::vector<FactorAndOp> all;
  for (const B factor : kFactors)
    for (const BlendOp op : kOps) all.push_back({factor, op});
  return all;
}

// The parameter is the source's factor and the operation; each is met by every destination factor (SRC_ALPHA_SAT is
// one of a source only), a pixel each, with the operations of alpha in turn. Each state costs a driver a compilation,
// so MIN and MAX, which know no factors, meet only two.
using BlendFactorTest = RhiTestOf<FactorAndOp>;
TEST_P(BlendFactorTest, FactorOp) {
  const auto& [src, op] = Parameter();
  const bool noFactors = op == BlendOp::Min || op == BlendOp::Max;
  size_t turn = size_t(src);
  BlendRow row(gpu, 16);
  for (const B dest : noFactors ? std::span(kFactors).first(2) : std::span(kFactors))
    if (dest != B::SrcAlphaSat)
      row.DrawNext({.src = src,
                    .dest = dest,
                    .op = op,
                    .srcAlpha = AlphaTwin(src),
                    .destAlpha = AlphaTwin(dest),
                    .opAlpha = kOps[turn++ % 5]});
  row.ExpectAll();
}

// The pixel shader's second colour as a factor.
TEST_P(BlendTest, SecondSourceFactors) {
  RHI_NEEDS_CAP(dualSourceBlend);
  const Color second{0.5, 0.25, 0.75, 0.4};
  struct Case {
    B color, alpha;
    bool inverse, useAlpha;
  };
  const Case all[] = {{B::Src1Color, B::Src1Alpha, false, false},
                      {B::InvSrc1Color, B::InvSrc1Alpha, true, false},
                      {B::Src1Alpha, B::Src1Alpha, false, true},
                      {B::InvSrc1Alpha, B::InvSrc1Alpha, true, true}};
  for (const Case& k : all)
    for (const bool asDest : {false, true}) {
      Start();
      BlendDesc desc;
      desc.rt[0] = {.enable = true,
                    .src = asDest ? B::One : k.color,
                    .dest = asDest ? k.color : B::Zero,
                    .srcAlpha = asDest ? B::Zero : k.alpha,
                    .destAlpha = asDest ? k.alpha : B::Zero};
      context.OMSetBlendState(gpu.Blend(desc).get());
      gpu.DrawRect(test_shaders::rect_PSTwoSources,
                   {.tint = {0.2f, 0.3f, 0.1f, 0.6f},
                    .extra = {float(second[3]), float(second[0]), float(second[1]), float(second[2])}});
      const Color source{0.2, 0.3, 0.1, 0.6};
      Rgba8 expected;
      for (size_t c = 0; c < 4; ++c) {
        double f = k.useAlpha || c == 3 ? second[3] : second[c];
        if (k.inverse) f = 1 - f;
        const double d = kDest[c] / 255.0;
        expected[c] = ToUnorm8(!asDest ? source[c] * f : c == 3 ? d * f : source[c] + d * f);
      }
      EXPECT_TRUE(Matches(
          gpu.Read(target), [&](auto, auto) { return expected; }, Within("blend_rounding")))
          << int(k.color) << asDest;
    }
}

TEST_P(BlendTest, DisabledBlendingReplaces) {
  Start();
  BlendDesc off;
  off.rt[0] = {.enable = false, .src = B::Zero, .dest = B::One};
  context.OMSetBlendState(gpu.Blend(off).get());
  gpu.DrawRect(test_shaders::rect_PSTint, {.tint = {0.2f, 0.4f, 0.6f, 0.8f}});
  EXPECT_TRUE(Matches(gpu.Read(target), [](auto, auto) { return Rgba8{51, 102, 153, 204}; }));
}

TEST_P(BlendTest, WriteMask) {
  Start();
  for (uint8_t mask = 0; mask < 16; ++mask) {
    BlendDesc desc;
    desc.rt[0].writeMask = mask;
    context.OMSetBlendState(gpu.Blend(desc).get());
    const float left = float(mask) / 32 - 1;
    gpu.DrawRect(test_shaders::rect_PSTint,
                 {.tint = {0.2f, 0.4f, 0.6f, 0.8f}, .rectangle = {left, 1, left + 1 / 32.f, -1}});
  }
  const Rgba8 drawn{51, 102, 153, 204};
  EXPECT_TRUE(Matches(gpu.Read(target), [&](uint32_t x, auto) {
    Rgba8 texel;
    for (size_t c = 0; c < 4; ++c) texel[c] = x < 16 && (x >> c & 1) ? drawn[c] : kDest[c];
    return texel;
  }));
}

TEST_P(BlendTest, IndependentBlend) {
  RHI_NEEDS_CAP(independentBlend);
  const Target a = gpu.MakeTarget({}), b = gpu.MakeTarget({});
  for (const bool independent : {false, true}) {
    gpu.Clear(a, {0.2f, 0.2f, 0.2f, 0.2f});
    gpu.Clear(b, {0.2f, 0.2f, 0.2f, 0.2f});
    IRenderTargetView* views[2] = {a.rtv.get(), b.rtv.get()};
    context.OMSetRenderTargets(2, views, nullptr);
    gpu.SetViewport(0, 0, 16, 16);
    BlendDesc desc;
    desc.independent = independent;
    desc.rt[0] = {.enable = true, .src = B::One, .dest = B::One, .srcAlpha = B::One, .destAlpha = B::One};
    desc.rt[1].writeMask = 0x5;
    context.OMSetBlendState(gpu.Blend(desc).get());
    gpu.DrawRect(test_shaders::rect_PSTwoTargets, {.tint = {0.4f, 0.2f, 0.6f, 0}});
    EXPECT_TRUE(Matches(gpu.Read(a), [](auto, auto) { return Rgba8{153, 102, 204, 51}; }));
    const Rgba8 second = independent ? Rgba8{153, 51, 102, 51} : Rgba8{204, 102, 153, 51};
    EXPECT_TRUE(Matches(gpu.Read(b), [&](auto, auto) { return second; })) << independent;
  }
}

TEST_P(BlendTest, ClearIgnoresMaskScissorAndViewport) {
  Start();
  BlendDesc desc;
  desc.rt[0].writeMask = 0;
  const Rect r{1, 0, 2, 1};
  context.OMSetBlendState(gpu.Blend(desc).get());
  context.RSSetState(gpu.Rasterizer({.scissor = true}).get());
  context.RSSetScissorRects(1, &r);
  gpu.SetViewport(3, 0, 2, 1);
  gpu.DrawRect(test_shaders::rect_PSTint);  // so that the state reaches the driver
  gpu.Clear(target, {0, 1, 1, 0});
  EXPECT_TRUE(Matches(gpu.Read(target), [](auto, auto) { return Rgba8{0, 255, 255, 0}; }));
}

// A clear within a pass, after draws: what was drawn before is gone, what is drawn after stays.
TEST_P(BlendTest, ClearBetweenDraws) {
  Start();
  gpu.DrawRect(test_shaders::rect_PSTint, {.tint = {1, 0, 0, 1}});
  gpu.Clear(target, {0, 1, 0, 1});
  gpu.DrawRect(test_shaders::rect_PSTint, {.tint = {0, 0, 1, 1}, .rectangle = {-1, 1, 0, -1}});
  EXPECT_TRUE(Matches(gpu.Read(target), [](uint32_t x, auto) {
    return x < 32 ? Rgba8{0, 0, 255, 255} : Rgba8{0, 255, 0, 255};
  }));
}

// A clear that no draw follows is not lost, whether its target is bound or not.
TEST_P(BlendTest, ClearWithoutADraw) {
  Start();
  gpu.Clear(target, {1, 1, 0, 1});
  EXPECT_TRUE(Matches(gpu.Read(target), [](auto, auto) { return Rgba8{255, 255, 0, 255}; }));
  context.OMSetRenderTargets(0, nullptr, nullptr);
  gpu.Clear(target, {0, 1, 1, 1});
  context.EndFrame();
  EXPECT_TRUE(Matches(gpu.Read(target), [](auto, auto) { return Rgba8{0, 255, 255, 255}; }));
  gpu.Clear(target, {1, 0, 1, 1});
  const Ref<ITexture> copy = gpu.Texture({.width = 64, .height = 1, .format = Format::RGBA8_UNorm});
  context.CopyResource(copy.get(), target.color.get());
  EXPECT_TRUE(Matches(gpu.Read(copy.get()), [](auto, auto) { return Rgba8{255, 0, 255, 255}; }));
}

RHI_ON_EVERY_BACKEND(BlendTest);
RHI_MATRIX(BlendFactorTest, FactorsAndOps(), [](const FactorAndOp& p) { return NameOf(p); });

}  // namespace
}  // namespace rhi_test

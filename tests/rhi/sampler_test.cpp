// Samplers: address modes, borders, filters, level of detail, comparison, and how they pair with textures.
#include <algorithm>

#include "rhi_fixture.h"

namespace rhi_test {
namespace {

using namespace rhi;

constexpr SamplerDesc kPoint{.min = Filter::Point, .mag = Filter::Point, .mip = Filter::Point};

// 4 x 4, each texel another value.
Ref<ITexture> Small(Gpu& gpu) {
  return gpu.TextureOf<Rgba8>({.width = 4, .height = 4, .format = Format::RGBA8_UNorm},
                              [](uint32_t x, uint32_t y, auto, auto) {
                                return Rgba8{uint8_t(x * 60 + 10), uint8_t(y * 50 + 20), uint8_t(x * y * 20), 255};
                              });
}
// u and v go from -1 to 2.
Image DrawRepeated(Gpu& gpu, const SamplerDesc& desc) {
  const Target target = gpu.MakeTarget({.width = 48, .height = 48});
  gpu.SetTarget(target);
  gpu.SetTexture(Stage::Pixel, 0, Small(gpu).get());
  gpu.SetSampler(Stage::Pixel, 0, desc);
  gpu.DrawRect(test_shaders::sample_PSSample, {.extra = {0, 3, -1, 0}});
  return gpu.Read(target);
}
using SamplerTest = RhiTest;

constexpr AddressMode kModes[] = {AddressMode::Wrap, AddressMode::Mirror, AddressMode::Clamp, AddressMode::Border};
int Address(int i, AddressMode mode) {  // of four texels; -1: the border
  if (mode == AddressMode::Wrap) return i & 3;
  if (mode == AddressMode::Clamp) return std::min(3, std::max(0, i));
  if (mode == AddressMode::Mirror) return (i & 4) ? 3 - (i & 3) : (i & 3);
  return i < 0 || i > 3 ? -1 : i;
}
Rgba8 SmallTexel(int x, int y, const Rgba8& border) {
  return x < 0 || y < 0 ? border : Rgba8{uint8_t(x * 60 + 10), uint8_t(y * 50 + 20), uint8_t(x * y * 20), 255};
}

struct AddressModes {
  AddressMode u, v;
};
std::string NameOf(AddressMode mode) {
  static constexpr const char* kNames[] = {"wrap", "mirror", "clamp", "border"};
  return kNames[std::find(std::begin(kModes), std::end(kModes), mode) - kModes];
}
std::string NameOf(const AddressModes& m) { return NameOf(m.u) + "_" + NameOf(m.v); }
std::vector<AddressModes> EveryPairOfModes() {
  std::vector<AddressModes> all;
  for (const AddressMode u : kModes)
    for (const AddressMode v : kModes) all.push_back({u, v});
  return all;
}

class SamplerAddressTest : public RhiTestOf<AddressModes> {
 protected:
  SamplerDesc Desc(SamplerDesc desc) const {
    desc.u = Parameter().u;
    desc.v = Parameter().v;
    return desc;
  }
};

TEST_P(SamplerAddressTest, WrapModes) {
  const auto oracle = [this](uint32_t x, uint32_t y) {
    const int i = int(std::floor((x + 0.5) / 4)) - 4, j = int(std::floor((y + 0.5) / 4)) - 4;
    return SmallTexel(Address(i, Parameter().u), Address(j, Parameter().v), {0, 0, 0, 0});
  };
  EXPECT_TRUE(Matches(DrawRepeated(gpu, Desc(kPoint)), oracle));
}

TEST_P(SamplerAddressTest, LinearFilter) {
  const auto oracle = [this](uint32_t x, uint32_t y) {
    const double s = (x + 0.5) / 4 - 4.5, t = (y + 0.5) / 4 - 4.5;
    const int i = int(std::floor(s)), j = int(std::floor(t));
    Rgba8 result;
    for (size_t c = 0; c < 4; ++c) {
      double sum = 0;
      for (int k = 0; k < 4; ++k) {
        const double wx = (k & 1) ? s - i : 1 - (s - i), wy = (k & 2) ? t - j : 1 - (t - j);
        const int u = Address(i + (k & 1), Parameter().u), v = Address(j + (k >> 1), Parameter().v);
        sum += wx * wy * SmallTexel(u, v, {0, 0, 0, 0})[c];
      }
      result[c] = uint8_t(sum + 0.5);
    }
    return result;
  };
  EXPECT_TRUE(Matches(DrawRepeated(gpu, Desc({})), oracle, Within("filter_weights")));
}

struct BorderColor {
  const char* name;
  std::array<float, 4> color;
};
constexpr BorderColor kBorders[] = {{"transparent", {0, 0, 0, 0}}, {"black", {0, 0, 0, 1}}, {"white", {1, 1, 1, 1}}};
const char* NameOf(const BorderColor& b) { return b.name; }

// The ones that every driver has.
using SamplerBorderTest = RhiTestOf<BorderColor>;
TEST_P(SamplerBorderTest, Border) {
  SamplerDesc desc = kPoint;
  desc.u = desc.v = AddressMode::Border;
  desc.border = Parameter().color;
  Rgba8 border;
  for (size_t c = 0; c < 4; ++c) border[c] = ToUnorm8(Parameter().color[c]);
  EXPECT_TRUE(Matches(DrawRepeated(gpu, desc), [&](uint32_t x, uint32_t y) {
    const bool inside = x >= 16 && x < 32 && y >= 16 && y < 32;
    return inside ? SmallTexel(int(x - 16) / 4, int(y - 16) / 4, {}) : border;
  }));
}

TEST_P(SamplerTest, OtherBordersByCap) {
  SamplerDesc desc = kPoint;
  desc.u = desc.v = AddressMode::Border;
  desc.border = {1, 0.2f, 0.4f, 0.6f};
  if (Caps().customBorderColor) {
    EXPECT_EQ(DrawRepeated(gpu, desc).At<Rgba8>(3, 20), (Rgba8{255, 51, 102, 153}));
  } else {
    sink.Expect(MsgCode::CapMissing, "no customBorderColor");
    Ref<ISamplerState> none;
    EXPECT_EQ(device.CreateSamplerState(desc, &none), Status::Unsupported);
  }
}

// Each mip has a value of its own.
Ref<ITexture> MipValues(Gpu& gpu) {
  return gpu.TextureOf<Rgba8>({.width = 16, .height = 16, .mipLevels = 0, .format = Format::RGBA8_UNorm},
                              [](auto, auto, uint32_t mip, auto) {
                                return Rgba8{uint8_t(mip * 50), 0, 0, 255};
                              });
}

TEST_P(SamplerTest, LodClampBiasAndMipFilter) {
  struct Case {
    Filter mip;
    float bias, minLod, maxLod, level;
    uint8_t expected;
  };
  const Case cases[] = {{Filter::Point, 0, 0, 1000, 2, 100},    {Filter::Point, 0, 0, 1000, 2.4f, 100},
                        {Filter::Point, 0, 0, 1000, 2.6f, 150}, {Filter::Linear, 0, 0, 1000, 2.5f, 125},
                        {Filter::Linear, 0, 1.5f, 1000, 0, 75}, {Filter::Linear, 0, 0, 2, 4, 100},
                        {Filter::Linear, 0, 0, 0, 4, 0},        {Filter::Point, 0, 3, 3, 0, 150}};
  const Target target = gpu.MakeTarget({.width = 2, .height = 2});
  gpu.SetTarget(target);
  gpu.SetTexture(Stage::Pixel, 0, MipValues(gpu).get());
  for (const Case& c : cases) {
    gpu.SetSampler(Stage::Pixel, 0, {.mip = c.mip, .mipBias = c.bias, .minLod = c.minLod, .maxLod = c.maxLod});
    gpu.DrawRect(test_shaders::sample_PSSampleLevel, {.extra = {0, 0, 0, c.level}});
    EXPECT_TRUE(Matches(gpu.Read(target),
                        [&](auto, auto) {
                          return Rgba8{c.expected, 0, 0, 255};
                        }))
        << c.level << ' ' << c.minLod;
  }
}

TEST_P(SamplerTest, ImplicitLodAndBias) {
  const Target target = gpu.MakeTarget({.width = 4, .height = 4});  // 16 texels over 4 pixels: level 2
  gpu.SetTarget(target);
  gpu.SetTexture(Stage::Pixel, 0, MipValues(gpu).get());
  for (const int bias : {-1, 0, 1}) {
    gpu.SetSampler(Stage::Pixel, 0, {.mip = Filter::Point, .mipBias = float(bias)});
    gpu.DrawRect(test_shaders::sample_PSSample, {.extra = {0, 1, 0, 0}});
    EXPECT_TRUE(Matches(gpu.Read(target), [&](auto, auto) {
      return Rgba8{uint8_t(100 + 50 * bias), 0, 0, 255};
    })) << bias;
  }
}

TEST_P(SamplerTest, OneTextureTwoSamplers) {
  const Target target = gpu.MakeTarget({.width = 48, .height = 48});
  gpu.SetTarget(target);
  gpu.SetTexture(Stage::Pixel, 0, Small(gpu).get());
  gpu.SetSampler(Stage::Pixel, 0, kPoint);
  gpu.SetSampler(Stage::Pixel, 1, {});
  gpu.DrawRect(test_shaders::sample_PSTwoSamplers);
  const Image both = gpu.Read(target);
  gpu.SetSampler(Stage::Pixel, 1, kPoint);
  gpu.DrawRect(test_shaders::sample_PSTwoSamplers);
  const Image point = gpu.Read(target);
  gpu.SetSampler(Stage::Pixel, 0, {});
  gpu.SetSampler(Stage::Pixel, 1, {});
  gpu.DrawRect(test_shaders::sample_PSTwoSamplers);
  const Image linear = gpu.Read(target);
  EXPECT_TRUE(Matches(point, [](uint32_t x, uint32_t y) { return SmallTexel(int(x / 12), int(y / 12), {}); }));
  EXPECT_FALSE(SameImage(point, linear));
  EXPECT_TRUE(Matches(both, [&](uint32_t x, uint32_t y) { return (x < 24 ? point : linear).At<Rgba8>(x, y); }));
}

TEST_P(SamplerTest, OneSamplerTwoTextures) {
  const Target target = gpu.MakeTarget({.width = 8, .height = 8});
  const auto solid = [&](uint8_t v) {
    return gpu.TextureOf<Rgba8>({.width = 2, .height = 2, .format = Format::RGBA8_UNorm}, [v](auto, auto, auto, auto) {
      return Rgba8{v, v, v, v};
    });
  };
  gpu.SetTarget(target);
  gpu.SetTexture(Stage::Pixel, 0, solid(40).get());
  gpu.SetTexture(Stage::Pixel, 1, solid(90).get());
  gpu.SetSampler(Stage::Pixel, 0, {});
  gpu.DrawRect(test_shaders::sample_PSTwoTextures);
  EXPECT_TRUE(Matches(gpu.Read(target), [](uint32_t x, auto) {
    const uint8_t v = x < 4 ? 40 : 90;
    return Rgba8{v, v, v, v};
  }));
}

TEST_P(SamplerTest, ComparisonOfADepthTexture) {
  const Target shadow = gpu.MakeTarget({.width = 4, .height = 4});
  const Ref<ITexture> depth = gpu.Texture(
      {.width = 4, .height = 4, .format = Format::D32_Float, .bind = Bind::DepthStencil | Bind::ShaderResource});
  const Ref<IDepthStencilView> dsv = gpu.DepthView(depth.get());
  context.ClearDepthStencilView(dsv.get(), true, 0.5f, false, 0);
  gpu.SetTarget(shadow);
  gpu.SetTexture(Stage::Pixel, 0, depth.get());
  const struct {
    Comparison func;
    float reference;
    bool lit;
  } cases[] = {{Comparison::LessEqual, 0.4f, true}, {Comparison::LessEqual, 0.6f, false},
               {Comparison::Greater, 0.6f, true},   {Comparison::Greater, 0.5f, false},
               {Comparison::Always, 2, true},       {Comparison::Never, 0, false},
               {Comparison::Equal, 0.5f, true},     {Comparison::NotEqual, 0.5f, false}};
  for (const auto& c : cases) {
    gpu.SetSampler(Stage::Pixel, 2, {.comparison = true, .func = c.func});
    gpu.DrawRect(test_shaders::sample_PSCompare, {.extra = {0, c.reference, 0, 0}});
    const uint8_t v = c.lit ? 255 : 0;
    EXPECT_TRUE(Matches(gpu.Read(shadow),
                        [v](auto, auto) {
                          return Rgba8{v, v, v, 255};
                        }))
        << int(c.func) << ' ' << c.reference;
  }
}

// Rows of texels that only anisotropic filtering keeps apart when the coordinates are stretched across them.
TEST_P(SamplerTest, AnisoMonotone) {
  RHI_NEEDS_CAP(samplerAnisotropy);
  const Ref<ITexture> rows = gpu.TextureOf<Rgba8>({.width = 64,
                                                   .height = 64,
                                                   .mipLevels = 0,
                                                   .format = Format::RGBA8_UNorm,
                                                   .bind = Bind::ShaderResource | Bind::RenderTarget},
                                                  [](auto, uint32_t y, auto, auto) {
                                                    const uint8_t v = (y & 4) ? 255 : 0;
                                                    return Rgba8{v, v, v, 255};
                                                  });
  context.GenerateMips(gpu.View(rows.get()).get());
  const Target target = gpu.MakeTarget({.width = 32, .height = 32});
  gpu.SetTarget(target);
  gpu.SetTexture(Stage::Pixel, 0, rows.get());
  double last = -1, first = 0;
  for (const uint32_t ratio : {1u, 2u, 4u, 8u, 16u}) {
    const Filter f = ratio == 1 ? Filter::Linear : Filter::Anisotropic;
    gpu.SetSampler(Stage::Pixel, 0,
                   {.min = f, .mag = f, .mip = f, .u = AddressMode::Wrap, .v = AddressMode::Wrap, .maxAniso = ratio});
    gpu.DrawRect(test_shaders::sample_PSStretched);
    const Image image = gpu.Read(target);
    double contrast = 0;
    for (uint32_t y = 0; y < 32; ++y) contrast += std::abs(image.At<Rgba8>(16, y)[0] - 127.5);
    EXPECT_GE(contrast, last - 1) << ratio;
    last = contrast;
    if (ratio == 1) first = contrast;
  }
  EXPECT_GT(last, first + 32 * 30);
}

TEST_P(SamplerTest, AnisotropyOutOfRangeIsRefused) {
  sink.Expect(MsgCode::InvalidDesc, "maxAniso is 1..16");
  Ref<ISamplerState> none;
  EXPECT_EQ(device.CreateSamplerState({.min = Filter::Anisotropic, .maxAniso = 17}, &none), Status::InvalidArg);
  EXPECT_EQ(device.CreateSamplerState({.min = Filter::Anisotropic, .maxAniso = 0}, &none), Status::InvalidArg);
}

RHI_ON_EVERY_BACKEND(SamplerTest);
RHI_MATRIX(SamplerAddressTest, EveryPairOfModes(), [](const AddressModes& m) { return NameOf(m); });
RHI_MATRIX(SamplerBorderTest, kBorders, [](const BorderColor& b) { return NameOf(b); });

}  // namespace
}  // namespace rhi_test

// CheckFormatSupport and CheckMultisample against what creation accepts and what then works, for every format.
#include <bit>

#include "rhi_fixture.h"

namespace rhi_test {
namespace {

using namespace rhi;

std::vector<Format> AllFormats() {
  std::vector<Format> all;
  for (uint32_t i = 0; i <= uint32_t(Format::Count); ++i) all.push_back(Format(i));  // also two that are none
  return all;
}

// ------------------------------------------------------------------------------------ the CPU's idea of each format
float FromHalf(uint32_t h) {
  const int exponent = int(h >> 10 & 31);
  const float mantissa = float(h & 1023);
  const float value = exponent ? std::ldexp(1024 + mantissa, exponent - 25) : std::ldexp(mantissa, -24);
  return h & 0x8000 ? -value : value;
}
// The unsigned floats of R11G11B10: 5 bits of exponent, `bits` of mantissa.
float FromSmall(uint32_t v, int bits) {
  const int exponent = int(v >> bits);
  const float mantissa = float(v & ((1u << bits) - 1));
  return exponent ? std::ldexp(float(1 << bits) + mantissa, exponent - 15 - bits) : std::ldexp(mantissa, -14 - bits);
}

template <class T>
T Get(const uint8_t* bytes, size_t i) {
  T value;
  std::memcpy(&value, bytes + i * sizeof value, sizeof value);
  return value;
}

Rgba32F Decode(Format format, const uint8_t* b) {
  const FormatInfo& info = GetFormatInfo(format);
  Rgba32F v{0, 0, 0, 1};
  switch (format) {
    case Format::R10G10B10A2_UNorm: {
      const uint32_t w = Get<uint32_t>(b, 0);
      return {float(w & 1023) / 1023, float(w >> 10 & 1023) / 1023, float(w >> 20 & 1023) / 1023, float(w >> 30) / 3};
    }
    case Format::R11G11B10_Float: {
      const uint32_t w = Get<uint32_t>(b, 0);
      return {FromSmall(w & 2047, 6), FromSmall(w >> 11 & 2047, 6), FromSmall(w >> 22, 5), 1};
    }
    default: break;
  }
  const size_t bytes = size_t(info.blockBytes) / info.components;
  for (size_t i = 0; i < info.components; ++i) {
    if (info.isFloat)
      v[i] = bytes == 2 ? FromHalf(Get<uint16_t>(b, i)) : Get<float>(b, i);
    else if (info.isInteger)
      v[i] = float(bytes == 1 ? b[i] : bytes == 2 ? Get<uint16_t>(b, i) : Get<uint32_t>(b, i));
    else
      v[i] = float(b[i]) / 255;
    if (info.sRGB && i < 3) v[i] = float(SrgbToLinear(v[i]));
  }
  if (ToLinear(format) == Format::BGRA8_UNorm) std::swap(v[0], v[2]);
  return v;
}

// Bytes of a texel that every format takes as an ordinary number: no infinities, and integers that a float can hold.
std::vector<uint8_t> SampleTexels(Format format, uint32_t count) {
  const FormatInfo& info = GetFormatInfo(format);
  std::vector<uint8_t> out;
  for (uint32_t i = 0; i < count; ++i)
    for (uint32_t k = 0; k < info.blockBytes; ++k) {
      uint8_t byte = uint8_t(i * 37 + k * 101 + 11);
      const uint32_t size = info.components ? info.blockBytes / info.components : 1;
      if (format == Format::R11G11B10_Float)
        byte &= 0x7B;  // no field's exponent is all ones
      else if (info.isFloat && k % size == size - 1)
        byte &= 0xB8 | 3;  // an exponent of about 1
      if (format == Format::R32_UInt && k > 1) byte = 0;
      out.push_back(byte);
    }
  return out;
}

class FormatTest : public RhiTest {
 protected:
  Status Create(const TextureDesc& desc, Ref<ITexture>* out) {
    sink.Allow(MsgCode::CapMissing, "a format that is not offered");
    sink.Allow(MsgCode::InvalidDesc, "a format that is none, or not for that use");
    return device.CreateTexture(desc, nullptr, out);
  }
  bool Creates(Format format, Bind bind, uint32_t samples = 1) {
    Ref<ITexture> t;
    const TextureDim dim = samples > 1 ? TextureDim::Tex2DMS : TextureDim::Tex2D;
    const TextureDesc desc{.dim = dim, .width = 8, .height = 8, .sampleCount = samples, .format = format, .bind = bind};
    return Create(desc, &t) == Status::Ok;
  }
  bool Has(Format format, FormatSupport bit) const { return device.CheckFormatSupport(format) & bit; }
  static Bind TargetBind(Format f) { return GetFormatInfo(f).depth ? Bind::DepthStencil : Bind::RenderTarget; }
  const ShaderBlob& LoaderOf(Format f) const {
    return GetFormatInfo(f).isInteger ? test_shaders::formats_PSLoadInteger : test_shaders::sample_PSLoad;
  }
};

TEST_P(FormatTest, SupportIsWhatCreationAccepts) {
  for (const Format f : AllFormats()) {
    const FormatSupport s = device.CheckFormatSupport(f);
    const char* name = ToString(f);
    EXPECT_EQ(Creates(f, Bind::None), bool(s & FormatSupport::Texture2D)) << name;
    EXPECT_EQ(Creates(f, Bind::ShaderResource), bool(s & FormatSupport::Sample)) << name;
    EXPECT_EQ(Creates(f, Bind::RenderTarget), bool(s & FormatSupport::RenderTarget)) << name;
    EXPECT_EQ(Creates(f, Bind::DepthStencil), bool(s & FormatSupport::DepthStencil)) << name;
    EXPECT_EQ(Creates(f, Bind::UnorderedAccess), bool(s & FormatSupport::UnorderedAccess)) << name;
    EXPECT_EQ(Creates(f, TargetBind(f), 4), bool(s & FormatSupport::Multisample)) << name;
    // What follows from each other.
    EXPECT_TRUE(!(s & FormatSupport::Sample) || (s & FormatSupport::Texture2D)) << name;
    EXPECT_TRUE(!(s & FormatSupport::SampleLinear) || (s & FormatSupport::Sample)) << name;
    EXPECT_TRUE(!(s & FormatSupport::Blendable) || (s & FormatSupport::RenderTarget)) << name;
    EXPECT_TRUE(!(s & FormatSupport::Resolve) || (s & FormatSupport::Multisample)) << name;
    EXPECT_TRUE(!(s & FormatSupport::MipAutogen) || (s & FormatSupport::RenderTarget)) << name;
    EXPECT_TRUE(!(s & FormatSupport::VertexBuffer) || (s & FormatSupport::Buffer)) << name;
    EXPECT_TRUE(!(s & FormatSupport::IndexBuffer) || (s & FormatSupport::Buffer)) << name;
  }
}

// Every dimension with every single use: creation works, or says that it does not; never an error of the API.
TEST_P(FormatTest, EveryDimensionAndUseIsMadeOrRefused) {
  const TextureDim dims[] = {TextureDim::Tex2D, TextureDim::Tex2DArray, TextureDim::TexCube, TextureDim::Tex3D,
                             TextureDim::Tex2DMS};
  const Bind binds[] = {Bind::None,
                        Bind::ShaderResource,
                        Bind::RenderTarget,
                        Bind::DepthStencil,
                        Bind::UnorderedAccess,
                        Bind::RenderTarget | Bind::ShaderResource | Bind::UnorderedAccess,
                        Bind::DepthStencil | Bind::ShaderResource};
  for (const Format f : AllFormats())
    for (const TextureDim dim : dims)
      for (const Bind bind : binds)
        for (const Usage usage : {Usage::Default, Usage::Staging}) {
          const TextureDesc desc{.dim = dim,
                                 .width = 8,
                                 .height = 8,
                                 .depthOrArray = dim == TextureDim::TexCube                                  ? 6u
                                                 : dim == TextureDim::Tex2DArray || dim == TextureDim::Tex3D ? 4u
                                                                                                             : 1u,
                                 .mipLevels = dim == TextureDim::Tex2DMS ? 1u : 0u,
                                 .sampleCount = dim == TextureDim::Tex2DMS ? 4u : 1u,
                                 .format = f,
                                 .usage = usage,
                                 .bind = bind};
          Ref<ITexture> t;
          const Status s = Create(desc, &t);
          EXPECT_TRUE(s == Status::Ok || s == Status::Unsupported || s == Status::InvalidArg)
              << ToString(f) << int(dim) << ' ' << uint32_t(bind) << ToString(s);
          if (s != Status::Ok) continue;
          if (bind & Bind::ShaderResource) gpu.View(t.get());
          if (bind & Bind::RenderTarget) gpu.TargetView(t.get());
          if (bind & Bind::DepthStencil) gpu.DepthView(t.get());
          if ((bind & Bind::UnorderedAccess) && !GetFormatInfo(f).sRGB) gpu.WriteView(t.get());
        }
}

TEST_P(FormatTest, MultisampleLevelsAreWhatCreationAccepts) {
  for (const Format f : AllFormats())
    for (uint32_t samples = 2; samples <= 64; samples *= 2) {
      const bool target = Has(f, FormatSupport::RenderTarget) || Has(f, FormatSupport::DepthStencil);
      EXPECT_EQ(Creates(f, TargetBind(f), samples), device.CheckMultisample(f, samples) == 1 && target)
          << ToString(f) << ' ' << samples;
    }
  for (const uint32_t samples : {0u, 3u, 5u, 128u})
    EXPECT_EQ(device.CheckMultisample(Format::RGBA8_UNorm, samples), 0u);
}

// Upload, read-back and shader read of every format that has texels of its own.
TEST_P(FormatTest, TexelsAreReadAsTheyAreWritten) {
  for (const Format f : AllFormats()) {
    const FormatInfo& info = GetFormatInfo(f);
    if (!Has(f, FormatSupport::Sample) || info.blockSize > 1 || info.depth) continue;
    const std::vector<uint8_t> texels = SampleTexels(f, 32);
    const SubresourceData init{texels.data(), 8u * info.blockBytes, 0};
    const Ref<ITexture> t = gpu.Texture({.width = 8, .height = 4, .format = f}, &init);
    EXPECT_EQ(gpu.Read(t.get()).bytes, texels) << ToString(f);
    const Target target = gpu.MakeTarget({.width = 8, .height = 4, .format = Format::RGBA32_Float});
    gpu.SetTarget(target);
    gpu.SetTexture(Stage::Pixel, 0, t.get());
    gpu.DrawRect(LoaderOf(f));
    const auto oracle = [&](uint32_t x, uint32_t y) { return Decode(f, &texels[(y * 8 + x) * info.blockBytes]); };
    EXPECT_TRUE(Matches(gpu.Read(target), oracle, Within(info.sRGB ? "srgb_decoding_of_formats" : "unorm_to_float")))
        << ToString(f);
  }
}

// A draw and a clear of every target format give the same bytes, and these mean the colour.
TEST_P(FormatTest, TargetsTakeDrawsAndClears) {
  const Rgba32F color{0.25f, 0.5f, 0.75f, 1}, numbers{7, 130, 201, 77};
  for (const Format f : AllFormats()) {
    const FormatInfo& info = GetFormatInfo(f);
    if (!Has(f, FormatSupport::RenderTarget)) continue;
    const Rgba32F& value = info.isInteger ? numbers : color;
    const Target target = gpu.MakeTarget({.width = 8, .height = 4, .format = f});
    gpu.Clear(target, value);
    gpu.SetTarget(target);
    gpu.DrawRect(info.isInteger ? test_shaders::formats_PSInteger : test_shaders::rect_PSTint,
                 {.tint = value, .rectangle = {-1, 1, 0, -1}});
    const Image image = gpu.Read(target);
    for (const uint32_t x : {0u, 7u}) {
      const Rgba32F seen = Decode(f, &image.bytes[x * info.blockBytes]);
      for (size_t c = 0; c < info.components; ++c)
        EXPECT_TRUE(
            Agrees(seen[c], value[c], info.isInteger || info.isFloat ? conformance::kExact : Within("format_step")))
            << ToString(f) << x << c;
    }
  }
}

TEST_P(FormatTest, BlendableFormatsBlend) {
  BlendDesc add;
  add.rt[0] = {.enable = true,
               .src = rhi::Blend::One,
               .dest = rhi::Blend::One,
               .srcAlpha = rhi::Blend::One,
               .destAlpha = rhi::Blend::One};
  for (const Format f : AllFormats()) {
    if (!Has(f, FormatSupport::Blendable)) continue;
    const FormatInfo& info = GetFormatInfo(f);
    const Target target = gpu.MakeTarget({.width = 2, .height = 2, .format = f});
    gpu.Clear(target, {0.25f, 0.25f, 0.25f, 0.25f});
    gpu.SetTarget(target);
    context.OMSetBlendState(gpu.Blend(add).get());
    // In steps of a third the cleared 0.25 is 1/3. A sum of 5/6 would be halfway between two steps: another is drawn.
    const bool coarse = f == Format::R10G10B10A2_UNorm;
    gpu.DrawRect(test_shaders::rect_PSTint, {.tint = {0.5f, 0.125f, 0.25f, coarse ? 0.25f : 0.5f}});
    const Rgba32F seen = Decode(f, gpu.Read(target).bytes.data());
    const Rgba32F sum{0.75f, 0.375f, 0.5f, coarse ? 1 / 3.f + 0.25f : 0.75f};
    for (size_t c = 0; c < info.components; ++c)
      EXPECT_TRUE(
          Agrees(seen[c], sum[c],
                 info.isFloat ? conformance::kExact : Within(coarse && c == 3 ? "two_bit_blend" : "format_blend")))
          << ToString(f) << c;
  }
}

TEST_P(FormatTest, ResolveAndMipsWorkWhereTheyAreOffered) {
  for (const Format f : AllFormats()) {
    const FormatInfo& info = GetFormatInfo(f);
    if (Has(f, FormatSupport::Resolve)) {
      const Target target = gpu.MakeTarget({.width = 2, .height = 2, .format = f, .samples = 4});
      gpu.Clear(target, {0.25f, 0.5f, 0.75f, 1});
      const Rgba32F seen = Decode(f, gpu.Read(target).bytes.data());
      EXPECT_TRUE(Agrees(seen[0], 0.25, Within("format_resolve"))) << ToString(f);
    }
    if (!Has(f, FormatSupport::MipAutogen)) continue;
    const TextureDesc desc{
        .width = 4, .height = 4, .mipLevels = 0, .format = f, .bind = Bind::RenderTarget | Bind::ShaderResource};
    const Ref<ITexture> t = gpu.Texture(desc);
    context.ClearRenderTargetView(gpu.TargetView(t.get()).get(), Rgba32F{0.25f, 0.5f, 0.75f, 1}.data());
    context.GenerateMips(gpu.View(t.get()).get());
    const Image top = gpu.Read(t.get(), 0), last = gpu.Read(t.get(), 2);
    EXPECT_EQ(std::vector<uint8_t>(top.bytes.begin(), top.bytes.begin() + info.blockBytes), last.bytes) << ToString(f);
  }
}

TEST_P(FormatTest, GenerateMipsOfOtherFormatsIsReported) {
  sink.Expect(MsgCode::CapMissing, "integers cannot be averaged");
  const Ref<ITexture> t = gpu.Texture({.width = 4,
                                       .height = 4,
                                       .mipLevels = 0,
                                       .format = Format::RGBA8_UInt,
                                       .bind = Bind::RenderTarget | Bind::ShaderResource});
  context.GenerateMips(gpu.View(t.get()).get());
}

TEST_P(FormatTest, UnorderedAccessFormatsAreWritten) {
  const Rgba32F color{0.25f, 0.5f, 0.75f, 1}, numbers{7, 130, 201, 77};
  for (const Format f : AllFormats()) {
    const FormatInfo& info = GetFormatInfo(f);
    if (!Has(f, FormatSupport::UnorderedAccess)) continue;
    const Ref<ITexture> t = gpu.Texture({.width = 4, .height = 4, .format = f, .bind = Bind::UnorderedAccess});
    const Ref<IUnorderedAccessView> view = gpu.WriteView(t.get());
    IUnorderedAccessView* raw = view.get();
    context.CSSetUnorderedAccessViews(info.isInteger ? 1 : 0, 1, &raw);
    const Rgba32F& value = info.isInteger ? numbers : color;
    gpu.SetDraw({.tint = value});
    context.CSSetShader(gpu.Shader(info.isInteger ? test_shaders::uav_CSIntegers : test_shaders::uav_CSPlane).get());
    context.Dispatch(1, 1, 1);
    const Rgba32F seen = Decode(f, gpu.Read(t.get()).bytes.data());
    for (size_t c = 0; c < info.components; ++c)
      EXPECT_TRUE(
          Agrees(seen[c], value[c], info.isInteger || info.isFloat ? conformance::kExact : Within("format_step")))
          << ToString(f) << c;
  }
}

// Linear filtering: halfway between two texels.
TEST_P(FormatTest, LinearFormatsAreFiltered) {
  for (const Format f : AllFormats()) {
    if (!Has(f, FormatSupport::SampleLinear) || !Has(f, FormatSupport::RenderTarget)) continue;
    const TextureDesc desc{.width = 2, .height = 1, .format = f, .bind = Bind::RenderTarget | Bind::ShaderResource};
    const Ref<ITexture> t = gpu.Texture(desc);
    Target whole{2, 1, t, {}, gpu.TargetView(t.get()), {}};
    gpu.Clear(whole, {0, 0, 0, 0});
    gpu.SetTarget(whole);
    gpu.DrawRect(test_shaders::rect_PSTint, {.rectangle = {-1, 1, 0, -1}});  // the left texel is 1
    const Target target = gpu.MakeTarget({.width = 1, .height = 1, .format = Format::RGBA32_Float});
    gpu.SetTarget(target);
    gpu.SetTexture(Stage::Pixel, 0, t.get());
    gpu.SetSampler(Stage::Pixel, 0, {});
    gpu.DrawRect(test_shaders::sample_PSSample, {.extra = {0, 1, 0, 0}});
    EXPECT_TRUE(Agrees(gpu.Read(target).At<Rgba32F>(0, 0)[0], 0.5, Within("format_filter"))) << ToString(f);
  }
}

TEST_P(FormatTest, IndexFormats) {
  const Ref<IBuffer> b = gpu.BufferOf(Bind::IndexBuffer, std::vector<uint32_t>(4));
  sink.Expect(MsgCode::FormatMismatch, "every other format");
  for (const Format f : AllFormats()) {
    const int before = sink.Count(MsgCode::FormatMismatch);
    context.IASetIndexBuffer(b.get(), f, 0);
    EXPECT_EQ(sink.Count(MsgCode::FormatMismatch) == before, Has(f, FormatSupport::IndexBuffer)) << ToString(f);
  }
}

TEST_P(FormatTest, VertexFormats) {
  for (const Format f : AllFormats()) {
    sink.Allow(MsgCode::CapMissing, "no vertex format");
    sink.Allow(MsgCode::LayoutMismatch, "no vertex format");
    const InputElement elements[] = {{.semantic = "POSITION", .format = f}, {.semantic = "COLOR", .format = f}};
    Ref<IInputLayout> layout;
    const Status s = device.CreateInputLayout(elements, 2, gpu.Shader(test_shaders::mesh_VSMesh).get(), &layout);
    EXPECT_EQ(s == Status::Ok, Has(f, FormatSupport::VertexBuffer)) << ToString(f) << ToString(s);
  }
}

RHI_ON_EVERY_BACKEND(FormatTest);

}  // namespace
}  // namespace rhi_test

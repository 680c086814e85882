// Pictures that the backends must draw with the same bytes: the ones for which no exact oracle exists. The others are
// compared with theirs, to the byte, on every backend.
#include "rhi_fixture.h"

namespace rhi_test {
namespace {

using namespace rhi;

struct Scene {
  const char* name;
  void (*draw)(Gpu&, const Target&);
  TargetDesc target;
};

void DrawPattern(Gpu& gpu, const Target&) { gpu.DrawRect(test_shaders::rect_PSPattern, {.tint = {0.3f, 0.7f, 0, 0}}); }

Ref<ITexture> NoiseTexture(Gpu& gpu, Format format) {
  const Ref<ITexture> t = gpu.TextureOf<Rgba8>(
      {.width = 64, .height = 64, .mipLevels = 0, .format = format, .bind = Bind::ShaderResource | Bind::RenderTarget},
      [](uint32_t x, uint32_t y, auto, auto) {
        const uint32_t h = (x * 374761393u + y * 668265263u) * 1274126177u;
        return Rgba8{uint8_t(h >> 3), uint8_t(h >> 11), uint8_t(h >> 19), uint8_t(h >> 24)};
      });
  gpu.context->GenerateMips(gpu.View(t.get()).get());
  return t;
}

void DrawSampled(Gpu& gpu, Format format, const SamplerDesc& sampler, float scale) {
  gpu.SetTexture(Stage::Pixel, 0, NoiseTexture(gpu, format).get());
  gpu.SetSampler(Stage::Pixel, 0, sampler);
  gpu.DrawRect(test_shaders::sample_PSSample, {.extra = {0, scale, -0.37f, 0}});
}

void DrawTrilinear(Gpu& gpu, const Target&) {
  DrawSampled(gpu, Format::RGBA8_UNorm, {.u = AddressMode::Wrap, .v = AddressMode::Mirror}, 3.3f);
}
void DrawSrgbTexture(Gpu& gpu, const Target&) {
  DrawSampled(gpu, Format::RGBA8_UNorm_sRGB, {.u = AddressMode::Wrap, .v = AddressMode::Wrap}, 0.9f);
}
void DrawAniso(Gpu& gpu, const Target&) {
  gpu.SetTexture(Stage::Pixel, 0, NoiseTexture(gpu, Format::RGBA8_UNorm).get());
  const Filter f = gpu.device->GetCaps().samplerAnisotropy ? Filter::Anisotropic : Filter::Linear;
  gpu.SetSampler(Stage::Pixel, 0,
                 {.min = f,
                  .mag = f,
                  .mip = f,
                  .u = AddressMode::Wrap,
                  .v = AddressMode::Wrap,
                  .maxAniso = f == Filter::Linear ? 1u : 8u});
  gpu.DrawRect(test_shaders::sample_PSStretched);
}

// A hundred triangles of every size and direction, with interpolated colors.
void DrawTriangles(Gpu& gpu, const Target&) {
  struct Vertex {
    float position[3], color[4];
  };
  std::vector<Vertex> v;
  uint32_t seed = 12345;
  const auto next = [&] {
    seed = seed * 1664525u + 1013904223u;
    return float(seed >> 8) / float(1u << 24);
  };
  for (int i = 0; i < 300; ++i) {
    Vertex& w = v.emplace_back();
    for (float& p : w.position) p = next() * 2.4f - 1.2f;
    w.position[2] = next();
    for (float& c : w.color) c = next();
  }
  const InputElement layout[] = {{.semantic = "POSITION", .format = Format::RGB32_Float},
                                 {.semantic = "COLOR", .format = Format::RGBA32_Float, .offset = 12}};
  const Ref<IBuffer> b = gpu.BufferOf(Bind::VertexBuffer, v);
  gpu.SetShaders(test_shaders::mesh_VSMesh, test_shaders::mesh_PSMesh);
  gpu.context->IASetInputLayout(gpu.Layout(layout, gpu.Shader(test_shaders::mesh_VSMesh).get()).get());
  gpu.context->RSSetState(gpu.Rasterizer({.cull = CullMode::None, .multisample = true}).get());
  gpu.SetVertices(b.get(), sizeof(Vertex));
  gpu.context->IASetPrimitiveTopology(PrimitiveTopology::TriangleList);
  gpu.context->Draw(300, 0);
}

void DrawBlended(Gpu& gpu, const Target& target) {
  BlendDesc over;
  over.rt[0] = {.enable = true,
                .src = rhi::Blend::SrcAlpha,
                .dest = rhi::Blend::InvSrcAlpha,
                .srcAlpha = rhi::Blend::One,
                .destAlpha = rhi::Blend::InvSrcAlpha};
  gpu.context->OMSetBlendState(gpu.Blend(over).get());
  gpu.context->OMSetDepthStencilState(gpu.DepthStencil({.depthEnable = false}).get());
  DrawTriangles(gpu, target);
}
void DrawCoverage(Gpu& gpu, const Target& target) {
  BlendDesc a2c;
  a2c.alphaToCoverage = true;
  gpu.context->OMSetBlendState(gpu.Blend(a2c).get());
  DrawTriangles(gpu, target);
}

constexpr TargetDesc kPlain{.width = 96, .height = 80};
constexpr TargetDesc With(Format format, Format depth, uint32_t samples) { return {96, 80, format, depth, samples}; }
constexpr Scene kScenes[] = {
    {"pattern", DrawPattern, kPlain},
    {"pattern_16f", DrawPattern, With(Format::RGBA16_Float, Format::Unknown, 1)},
    {"pattern_32f", DrawPattern, With(Format::RGBA32_Float, Format::Unknown, 1)},
    {"trilinear", DrawTrilinear, kPlain},
    {"srgb_texture", DrawSrgbTexture, kPlain},
    {"srgb_both", DrawSrgbTexture, With(Format::RGBA8_UNorm_sRGB, Format::Unknown, 1)},
    {"aniso", DrawAniso, kPlain},
    {"triangles", DrawTriangles, kPlain},
    {"triangles_depth", DrawTriangles, With(Format::RGBA8_UNorm, Format::D32_Float, 1)},
    {"triangles_depth_4x", DrawTriangles, With(Format::RGBA8_UNorm, Format::D32_Float, 4)},
    {"blended", DrawBlended, kPlain},
    {"blended_srgb", DrawBlended, With(Format::RGBA8_UNorm_sRGB, Format::Unknown, 1)},
    {"blended_16f", DrawBlended, With(Format::RGBA16_Float, Format::Unknown, 1)},
    {"blended_4x", DrawBlended, With(Format::RGBA8_UNorm, Format::Unknown, 4)},
    {"alpha_to_coverage_4x", DrawCoverage, With(Format::RGBA8_UNorm, Format::D32_Float, 4)},
};

Image Draw(Gpu& gpu, const Scene& scene) {
  const Target target = gpu.MakeTarget(scene.target);
  gpu.Clear(target, {0.1f, 0.2f, 0.3f, 0.4f});
  gpu.SetTarget(target);
  scene.draw(gpu, target);
  return gpu.Read(target);
}

void PrintTo(const Scene& scene, std::ostream* out) { *out << scene.name; }
using ParitySceneTest = BothTestOf<Scene>;

TEST_P(ParitySceneTest, SameBytes) { EXPECT_TRUE(SameImage(Draw(gl, Parameter()), Draw(vulkan, Parameter()))); }

// A small error of one backend must show: here it is planted.
using ParityTest = BothTest;
TEST_P(ParityTest, ADeliberateDifferenceIsCaught) {
  Scene other = kScenes[0];
  other.draw = [](Gpu& gpu, const Target&) {
    gpu.DrawRect(test_shaders::rect_PSPattern, {.tint = {0.3001f, 0.7f, 0, 0}});
  };
  EXPECT_FALSE(SameImage(Draw(gl, other), Draw(vulkan, kScenes[0])));
}

// GenerateMips of an array: every level of every slice.
class ParityMipsTest : public BothTestOf<Format> {
 protected:
  static std::vector<Image> Levels(Gpu& gpu, Format format) {
    const Ref<ITexture> t = gpu.TextureOf<Rgba8>(
        {.dim = TextureDim::Tex2DArray,
         .width = 40,
         .height = 24,
         .depthOrArray = 3,
         .mipLevels = 0,
         .format = format,
         .bind = Bind::ShaderResource | Bind::RenderTarget},
        [](uint32_t x, uint32_t y, uint32_t mip, uint32_t slice) {
          const uint32_t h = (x * 374761393u + y * 668265263u + slice * 77777u) * 1274126177u;
          return mip ? Rgba8{} : Rgba8{uint8_t(h >> 3), uint8_t(h >> 11), uint8_t(h >> 19), uint8_t(h >> 24)};
        });
    gpu.context->GenerateMips(gpu.View(t.get()).get());
    std::vector<Image> levels;
    for (uint32_t slice = 0; slice < 3; ++slice)
      for (uint32_t mip = 0; mip < t->Desc().mipLevels; ++mip) levels.push_back(gpu.Read(t.get(), mip, slice));
    return levels;
  }
};

TEST_P(ParityMipsTest, GenMipsArray) {
  const std::vector<Image> a = Levels(gl, Parameter()), b = Levels(vulkan, Parameter());
  ASSERT_EQ(a.size(), b.size());
  for (size_t i = 0; i < a.size(); ++i) EXPECT_TRUE(SameImage(a[i], b[i])) << "level " << i;
}

const char* NameOfScene(const Scene& scene) { return scene.name; }
const char* NameOfEncoding(Format f) { return GetFormatInfo(f).sRGB ? "srgb" : "unorm"; }
constexpr Format kEncodings[] = {Format::RGBA8_UNorm, Format::RGBA8_UNorm_sRGB};
RHI_MATRIX_ON_BOTH(ParitySceneTest, kScenes, NameOfScene);
RHI_MATRIX_ON_BOTH(ParityMipsTest, kEncodings, NameOfEncoding);
RHI_ON_BOTH(ParityTest);

}  // namespace
}  // namespace rhi_test

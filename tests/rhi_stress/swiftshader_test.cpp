// SwiftShader: a Vulkan driver without geometry shaders, and a rasteriser of its own. All else works, under validation,
// and what it lacks is refused in words.
#include "swiftshader.h"

#include "rig.h"

namespace rhi_stress {
namespace {

using namespace rhi;

class SwiftShaderTest : public testing::Test {
 protected:
  void SetUp() override {
    if (SwiftShaderIcd().empty())
      GTEST_SKIP() << "no SwiftShader: install the Debian package chromium-common, or set FUR_SWIFTSHADER_ICD";
    rig = std::make_unique<Rig>(Backend::Vulkan, true);
    vs = rig->Shader(stress_shaders::stress_VSRect);
  }
  void TearDown() override {
    if (!rig) return;
    rig->Finish();
    rig->sink.Verify();
  }
  const rhi::Caps& Caps() const { return rig->device->GetCaps(); }
  void Clear(const Target& target, const Rgba32F& color) {
    rig->context->ClearRenderTargetView(target.view.get(), color.data());
  }
  void Draw(const Target& target, const ShaderBlob& ps, const DrawConstants& constants) {
    rig->SetTarget(target);
    rig->SetConstants(rig->Constants().get(), constants);
    rig->DrawRect(vs.get(), rig->Shader(ps).get());
  }

  std::unique_ptr<Rig> rig;
  Ref<IShader> vs;
};

TEST_F(SwiftShaderTest, IsTheAdapterAndHasNoGeometryShaders) {
  EXPECT_NE(std::string(Caps().adapter.data()).find("SwiftShader"), std::string::npos) << Caps().adapter.data();
  EXPECT_TRUE(Caps().software);
  EXPECT_FALSE(Caps().geometryShader);
  EXPECT_TRUE(Caps().compute && Caps().drawIndirect);
  EXPECT_GE(Caps().maxColorSamples, 4u);
}

TEST_F(SwiftShaderTest, GeometryShaderIsRefusedInWords) {
  rig->sink.Expect(MsgCode::CapMissing, "SwiftShader has no geometry shaders");
  Ref<IShader> none;
  EXPECT_EQ(rig->device->CreateShader(stress_shaders::stress_GSMain, &none), Status::Unsupported);
  EXPECT_FALSE(none);
  const std::string text = rig->sink.LastText(MsgCode::CapMissing);
  EXPECT_NE(text.find("geometry shader"), std::string::npos) << text;
  EXPECT_NE(text.find("Caps::geometryShader"), std::string::npos) << text;
  rig->ExpectUsable();
}

TEST_F(SwiftShaderTest, MissingQueriesAreRefusedInWords) {
  Ref<IQuery> query;
  if (Caps().pipelineStatistics) GTEST_SKIP() << "this version has pipeline statistics";
  rig->sink.Expect(MsgCode::CapMissing, "no pipeline statistics");
  EXPECT_EQ(rig->device->CreateQuery({QueryType::PipelineStatistics}, &query), Status::Unsupported);
}

TEST_F(SwiftShaderTest, Clears) {
  const Target target = rig->MakeTarget(16);
  Clear(target, {1, 0.2f, 0, 1});
  EXPECT_TRUE(Matches(rig->Read(target.texture.get()), [](auto, auto) { return Rgba8{255, 51, 0, 255}; }));
}

// Row 0 is the top, and edges between pixels are exact on every rasteriser.
TEST_F(SwiftShaderTest, DrawsARectangle) {
  const Target target = rig->MakeTarget(16);
  Clear(target, {0, 0, 1, 1});
  Draw(target, stress_shaders::stress_PSTint, {.tint = {1, 0, 0, 1}, .rectangle = {-1, 1, 0, 0}});
  EXPECT_TRUE(Matches(rig->Read(target.texture.get()), [](uint32_t x, uint32_t y) {
    return x < 8 && y < 8 ? Rgba8{255, 0, 0, 255} : Rgba8{0, 0, 255, 255};
  }));
}

TEST_F(SwiftShaderTest, SamplesATexture) {
  std::array<Rgba8, 16> texels;
  for (uint8_t i = 0; i < 16; ++i) texels[i] = {uint8_t(i * 16), uint8_t(255 - i), 3, 255};
  const SubresourceData init{texels.data(), 16, 64};
  const Ref<ITexture> picture = rig->Texture({.width = 4, .height = 4, .format = Format::RGBA8_UNorm}, &init);
  Ref<ISamplerState> sampler;
  const SamplerDesc point{.min = Filter::Point, .mag = Filter::Point, .mip = Filter::Point};
  rig->Require(rig->device->CreateSamplerState(point, &sampler), "CreateSamplerState");
  const Ref<IShaderResourceView> view = rig->View(picture.get());
  IShaderResourceView* bound = view.get();
  ISamplerState* sampling = sampler.get();
  rig->context->PSSetShaderResources(0, 1, &bound);
  rig->context->PSSetSamplers(0, 1, &sampling);
  const Target target = rig->MakeTarget(8);
  Draw(target, stress_shaders::stress_PSPicture, {});
  EXPECT_TRUE(
      Matches(rig->Read(target.texture.get()), [&](uint32_t x, uint32_t y) { return texels[y / 2 * 4 + x / 2]; }));
}

// The right edge goes through the middle of column 5: half its samples.
TEST_F(SwiftShaderTest, ResolvesSamples) {
  const Target samples = rig->MakeTarget(8, 4), target = rig->MakeTarget(8);
  Clear(samples, {0, 0, 0, 1});
  Draw(samples, stress_shaders::stress_PSTint, {.tint = {1, 0, 0, 1}, .rectangle = {-1, 1, 0.375f, -1}});
  rig->context->ResolveSubresource(target.texture.get(), 0, samples.texture.get(), 0, Format::RGBA8_UNorm);
  EXPECT_TRUE(Matches(
      rig->Read(target.texture.get()),
      [](uint32_t x, uint32_t) {
        return Rgba8{uint8_t(x < 5 ? 255 : x == 5 ? 128 : 0), 0, 0, 255};
      },
      Within("resolve_average")));
}

TEST_F(SwiftShaderTest, DrawsFromVertexBuffers) {
  constexpr std::array<float, 8> kCorners{0, 0, 1, 0, 0, 1, 1, 1};
  const InputElement element{.semantic = "POSITION", .format = Format::RG32_Float};
  const Ref<IShader> mesh = rig->Shader(stress_shaders::stress_VSMesh);
  Ref<IInputLayout> layout;
  rig->Require(rig->device->CreateInputLayout(&element, 1, mesh.get(), &layout), "CreateInputLayout");
  const Ref<IBuffer> vertices = rig->Buffer(
      {.byteWidth = sizeof kCorners, .usage = Usage::Immutable, .bind = Bind::VertexBuffer}, kCorners.data());
  IBuffer* buffer = vertices.get();
  const uint32_t stride = 8, offset = 0;
  rig->context->IASetInputLayout(layout.get());
  rig->context->IASetVertexBuffers(0, 1, &buffer, &stride, &offset);
  const Target target = rig->MakeTarget(8);
  Clear(target, {0, 0, 0, 0});
  vs = mesh;
  Draw(target, stress_shaders::stress_PSTint, {.tint = {0, 1, 0, 1}, .rectangle = {0, 0, 1, -1}});
  EXPECT_TRUE(Matches(rig->Read(target.texture.get()), [](uint32_t x, uint32_t y) {
    return x >= 4 && y >= 4 ? Rgba8{0, 255, 0, 255} : Rgba8{0, 0, 0, 0};
  }));
}

// The driver has no shaderDrawParameters: where a draw starts is told to the shader by other means. Direct and indirect
// draws take turns, each on a column of its own; a corner that counts from elsewhere would miss it. (Draw binds all,
// and draws a rectangle without area.)
TEST_F(SwiftShaderTest, VertexIdsCountFromZeroWhereverADrawStarts) {
  constexpr std::array<DrawArgs, 2> kArgs{{{4, 1, 7, 0}, {4, 1, 400, 3}}};
  const Ref<IBuffer> args =
      rig->Buffer({.byteWidth = sizeof kArgs, .usage = Usage::Immutable, .bind = Bind::IndirectArgs}, kArgs.data());
  const Target target = rig->MakeTarget(8);
  Clear(target, {0, 0, 0, 0});
  for (uint32_t column = 0; column < 8; ++column) {
    const float left = float(column) / 4 - 1;
    const float blue = float(column + 1) / 255;
    Draw(target, stress_shaders::stress_PSTint, {.tint = {1, 0, blue, 1}, .rectangle = {left, 1, left + 0.25f, 1}});
    rig->SetConstants(rig->Constants().get(), {.tint = {0, 1, blue, 1}, .rectangle = {left, 1, left + 0.25f, -1}});
    if (column % 3 == 0) rig->context->Draw(4, column * 5);
    if (column % 3 == 1) rig->context->DrawInstancedIndirect(args.get(), column % 2 * sizeof(DrawArgs));
    if (column % 3 == 2) rig->context->DrawInstanced(4, 1, column, column);
  }
  EXPECT_TRUE(Matches(rig->Read(target.texture.get()), [](uint32_t x, uint32_t) {
    return Rgba8{0, 255, uint8_t(x + 1), 255};
  }));
}

TEST_F(SwiftShaderTest, ReadsBuffersBack) {
  std::vector<uint32_t> data(1024);
  for (uint32_t i = 0; i < 1024; ++i) data[i] = i * 2654435761u;
  const Ref<IBuffer> buffer = rig->Buffer({.byteWidth = 4096, .bind = Bind::VertexBuffer}, data.data());
  std::vector<uint32_t> out(1024);
  rig->Require(rig->device->ReadBack(buffer.get(), 0, 4096, out.data()), "ReadBack");
  EXPECT_EQ(out, data);
}

}  // namespace
}  // namespace rhi_stress

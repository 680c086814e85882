// The tables, SPIR-V and GLSL of the shaders in hlsl/, compiled by fur_add_shaders.
#include <gtest/gtest.h>

#include <algorithm>
#include <spirv-tools/libspirv.hpp>
#include <string>
#include <vector>

#include "run_tool.h"
#include "test_shaders.h"

namespace {

using namespace test_shaders;
using rhi::ShaderResourceKind;

const rhi::ShaderBlob* const kAll[] = {&base_VSMain, &base_PSMain,   &base_PSFewer,   &fins_GSMain,
                                       &pixel_PSAll, &pixel_PSEarly, &compute_CSMain, &base_PSMainRed};

std::string Disassemble(const rhi::ShaderBlob& blob) {
  std::string text;
  spvtools::SpirvTools(SPV_ENV_VULKAN_1_1)
      .Disassemble(blob.spirv.data, blob.spirv.size, &text, SPV_BINARY_TO_TEXT_OPTION_NONE);
  return text;
}
bool Has(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

size_t Count(const std::string& text, const std::string& part) {
  size_t n = 0;
  for (size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++n;
  return n;
}

std::string WriteGlsl(const Scratch& scratch, const rhi::ShaderBlob& blob) {
  constexpr const char* kSuffix[] = {"vert", "geom", "frag", "comp"};
  return scratch.Write(std::string("shader.") + kSuffix[size_t(blob.stage)], blob.glsl);
}

TEST(Spirv, IsValidForVulkan11AndNeedsNoExtension) {
  for (const auto* blob : kAll) {
    EXPECT_TRUE(spvtools::SpirvTools(SPV_ENV_VULKAN_1_1).Validate(blob->spirv.data, blob->spirv.size)) << blob->name;
    const std::string text = Disassemble(*blob);
    EXPECT_FALSE(Has(text, "OpExtension")) << blob->name;
    EXPECT_FALSE(Has(text, "OpLine")) << blob->name;
    EXPECT_FALSE(Has(text, "UserSemantic")) << blob->name;
    EXPECT_TRUE(Has(text, "\"main\"")) << blob->name;
    EXPECT_EQ(blob->spirv[1], 0x00010300u) << blob->name;
  }
}

TEST(Glsl, CompilesOnItsOwn) {
  for (const auto* blob : kAll) {
    const Scratch scratch;
    const RunResult r = RunCommand(std::string(GLSLANG_VALIDATOR) + " " + WriteGlsl(scratch, *blob));
    EXPECT_EQ(r.status, 0) << blob->name << "\n" << r.output << blob->glsl;
    EXPECT_EQ(std::string(blob->glsl).find("#version 450"), 0u);
  }
}

TEST(Glsl, StagesLink) {
  const Scratch scratch;
  const std::string files =
      WriteGlsl(scratch, base_VSMain) + " " + WriteGlsl(scratch, fins_GSMain) + " " + WriteGlsl(scratch, base_PSMain);
  const RunResult r = RunCommand(std::string(GLSLANG_VALIDATOR) + " -l " + files);
  EXPECT_EQ(r.status, 0) << r.output;
}

TEST(Bases, AreSubtractedInSpirv) {
  const std::string text = Disassemble(base_VSMain);
  EXPECT_TRUE(Has(text, "BuiltIn BaseVertex"));
  EXPECT_TRUE(Has(text, "BuiltIn BaseInstance"));
  EXPECT_TRUE(Has(text, "OpCapability DrawParameters"));
  EXPECT_EQ(Count(text, "OpISub"), 2u);
  EXPECT_TRUE(base_VSMain.reflection.usesVertexId);
  EXPECT_TRUE(base_VSMain.reflection.usesInstanceId);
}

TEST(Bases, InGlslOnlyTheVertexHasOne) {
  const std::string glsl = base_VSMain.glsl;
  EXPECT_FALSE(Has(glsl, "BaseInstance"));
  EXPECT_TRUE(Has(glsl, "gl_InstanceID"));
  EXPECT_TRUE(Has(glsl, "layout(std140, binding = 4) uniform rhi_DrawParameters { int rhi_FirstVertex; };"));
  EXPECT_TRUE(Has(glsl, "BaseVertex + rhi_FirstVertex"));
}

TEST(Bases, AreLeftAloneWhereUnused) {
  EXPECT_FALSE(Has(fins_GSMain.glsl, "rhi_FirstVertex"));
  EXPECT_FALSE(Has(Disassemble(fins_GSMain), "DrawParameters"));
  EXPECT_FALSE(fins_GSMain.reflection.usesVertexId);
}

TEST(Reflection, VertexInputs) {
  const auto& inputs = base_VSMain.reflection.inputs;
  ASSERT_EQ(inputs.size, 3u);
  EXPECT_STREQ(inputs[0].semantic, "POSITION");
  EXPECT_STREQ(inputs[1].semantic, "NORMAL");
  EXPECT_STREQ(inputs[2].semantic, "TEXCOORD");
  EXPECT_EQ(inputs[2].semanticIndex, 1u);
  for (uint32_t i = 0; i < 3; ++i) EXPECT_EQ(inputs[i].location, i);
}

TEST(Reflection, ConstantBuffersOfTheGeometryShader) {
  const auto& buffers = fins_GSMain.reflection.constantBuffers;
  ASSERT_EQ(buffers.size, 4u);
  constexpr const char* kNames[] = {"Frame", "Pass", "Object", "Draw"};
  constexpr uint32_t kBytes[] = {80, 32, 64, 64};
  for (uint32_t i = 0; i < 4; ++i) {
    EXPECT_EQ(buffers[i].slot, i);
    EXPECT_STREQ(buffers[i].name, kNames[i]);
    EXPECT_EQ(buffers[i].byteWidth, kBytes[i]);
  }
}

void ExpectResource(const rhi::ShaderResource& r, ShaderResourceKind kind, uint32_t slot, rhi::TextureDim dim,
                    uint32_t stride, const char* name) {
  EXPECT_EQ(r.kind, kind) << name;
  EXPECT_EQ(r.slot, slot) << name;
  EXPECT_EQ(r.dim, dim) << name;
  EXPECT_EQ(r.stride, stride) << name;
  EXPECT_STREQ(r.name, name);
}

TEST(Reflection, ResourcesOfTheGeometryShader) {
  const auto& r = fins_GSMain.reflection;
  ASSERT_EQ(r.resources.size, 3u);
  ExpectResource(r.resources[0], ShaderResourceKind::StructuredBuffer, 0, rhi::TextureDim::Tex2D, 16, "fins");
  ExpectResource(r.resources[1], ShaderResourceKind::Texture, 1, rhi::TextureDim::Tex2DArray, 0, "shells");
  ExpectResource(r.resources[2], ShaderResourceKind::Texture, 2, rhi::TextureDim::Tex2D, 0, "noise");
  ASSERT_EQ(r.samplers.size, 2u);
  EXPECT_STREQ(r.samplers[0].name, "linearWrap");
  EXPECT_STREQ(r.samplers[1].name, "pointClamp");
}

TEST(Reflection, PairsOfOneTextureAndTwoSamplers) {
  const auto& pairs = fins_GSMain.reflection.pairs;  // (t1, s0), (t2, s0), (t2, s1)
  ASSERT_EQ(pairs.size, 3u);
  EXPECT_EQ(std::pair(pairs[0].texture, pairs[0].sampler), std::pair(uint8_t(1), uint8_t(0)));
  EXPECT_EQ(std::pair(pairs[1].texture, pairs[1].sampler), std::pair(uint8_t(2), uint8_t(0)));
  EXPECT_EQ(std::pair(pairs[2].texture, pairs[2].sampler), std::pair(uint8_t(2), uint8_t(1)));
  const std::string glsl = fins_GSMain.glsl;
  EXPECT_TRUE(Has(glsl, "layout(binding = 16) uniform sampler2DArray gs_t1_s0;"));
  EXPECT_TRUE(Has(glsl, "layout(binding = 17) uniform sampler2D gs_t2_s0;"));
  EXPECT_TRUE(Has(glsl, "layout(binding = 18) uniform sampler2D gs_t2_s1;"));
  EXPECT_TRUE(Has(glsl, "layout(binding = 4, std430) readonly buffer gs_t0_finsBlock"));
}

TEST(Reflection, ATextureThatIsOnlyLoadedHasNoSampler) {
  const auto& pairs = base_PSMain.reflection.pairs;  // (t0, s0), (t0, s1), (t1, s0), (t2, none)
  ASSERT_EQ(pairs.size, 4u);
  EXPECT_EQ(pairs[3].texture, 2);
  EXPECT_EQ(pairs[3].sampler, rhi::kNoSampler);
  EXPECT_TRUE(Has(base_PSMain.glsl, "layout(binding = 35) uniform sampler2D ps_t2_load;"));
}

TEST(Reflection, Geometry) {
  const auto& r = fins_GSMain.reflection;
  EXPECT_EQ(r.gsInput, rhi::PrimitiveTopology::LineListAdj);
  EXPECT_EQ(r.gsMaxVertices, 8u);
  EXPECT_EQ(r.gsOutputComponents, 4u + 3u + 2u + 1u + 1u);
  EXPECT_TRUE(r.writesLayer);
  EXPECT_FALSE(base_VSMain.reflection.writesLayer);
  EXPECT_EQ(Count(fins_GSMain.glsl, "EmitVertex()"), 8u);
  EXPECT_EQ(Count(fins_GSMain.glsl, "EndPrimitive()"), 2u);
}

TEST(Reflection, PixelShaderKinds) {
  const auto& r = pixel_PSAll.reflection;
  ASSERT_EQ(r.resources.size, 5u);
  ExpectResource(r.resources[0], ShaderResourceKind::Texture, 0, rhi::TextureDim::Tex2DMS, 0, "samples");
  ExpectResource(r.resources[1], ShaderResourceKind::Texture, 4, rhi::TextureDim::Tex2D, 0, "ids");
  ExpectResource(r.resources[2], ShaderResourceKind::Texture, 5, rhi::TextureDim::TexCube, 0, "sky");
  ExpectResource(r.resources[3], ShaderResourceKind::Texture, 6, rhi::TextureDim::Tex3D, 0, "volume");
  EXPECT_TRUE(r.resources[1].integer);
  EXPECT_FALSE(r.resources[0].integer);
  for (const char* word : {"gl_FragDepth", "gl_SampleMask", "gl_SampleID", "gl_PrimitiveID", "sampler2DShadow"})
    EXPECT_TRUE(Has(pixel_PSAll.glsl, word)) << word;
  EXPECT_TRUE(Has(pixel_PSEarly.glsl, "early_fragment_tests"));
  EXPECT_TRUE(Has(base_PSMain.glsl, "discard"));
  EXPECT_TRUE(Has(base_PSMain.glsl, "gl_FrontFacing"));
}

TEST(Reflection, Compute) {
  const auto& r = compute_CSMain.reflection;
  EXPECT_EQ(r.groupSize, (std::array<uint32_t, 3>{8, 4, 1}));
  ASSERT_EQ(r.resources.size, 5u);
  ExpectResource(r.resources[0], ShaderResourceKind::StructuredBuffer, 0, rhi::TextureDim::Tex2D, 32, "source");
  ExpectResource(r.resources[1], ShaderResourceKind::RWStructuredBuffer, 0, rhi::TextureDim::Tex2D, 32, "target");
  ExpectResource(r.resources[2], ShaderResourceKind::RWStructuredBuffer, 1, rhi::TextureDim::Tex2D, 4, "counts");
  ExpectResource(r.resources[3], ShaderResourceKind::RWTexture, 2, rhi::TextureDim::Tex2D, 0, "picture");
  ExpectResource(r.resources[4], ShaderResourceKind::RWTexture, 3, rhi::TextureDim::Tex2D, 0, "histogram");
  EXPECT_TRUE(r.resources[4].integer);
  EXPECT_TRUE(Has(compute_CSMain.glsl, "layout(binding = 2) uniform writeonly image2D"));
  EXPECT_TRUE(Has(compute_CSMain.glsl, "layout(binding = 3, r32ui) uniform uimage2D"));
  EXPECT_TRUE(Has(compute_CSMain.glsl, "layout(binding = 9, std430) buffer cs_u1_countsBlock"));
}

// The words of every OpDecorate <decoration>, sorted.
std::vector<uint32_t> Decorations(const rhi::ShaderBlob& blob, uint32_t decoration) {
  constexpr uint32_t kOpDecorate = 71;
  std::vector<uint32_t> values;
  for (uint32_t at = 5; at < blob.spirv.size; at += blob.spirv[at] >> 16)
    if ((blob.spirv[at] & 0xFFFF) == kOpDecorate && blob.spirv[at + 2] == decoration)
      values.push_back(blob.spirv[at + 3]);
  std::sort(values.begin(), values.end());
  return values;
}

TEST(Spirv, SetsAndBindingsAreTheContracts) {
  constexpr uint32_t kBinding = 33, kSet = 34;
  EXPECT_EQ(Decorations(fins_GSMain, kSet), (std::vector<uint32_t>{0, 0, 0, 0, 2, 2, 2, 2, 2}));
  EXPECT_EQ(Decorations(fins_GSMain, kBinding), (std::vector<uint32_t>{0, 1, 2, 3, 16, 17, 18, 32, 33}));
  EXPECT_EQ(Decorations(base_VSMain, kSet), (std::vector<uint32_t>{0, 0, 1}));
  EXPECT_EQ(Decorations(base_PSMain, kSet), (std::vector<uint32_t>{0, 3, 3, 3, 3, 3}));
  EXPECT_EQ(Decorations(compute_CSMain, kSet), (std::vector<uint32_t>{1, 2, 2, 2, 2}));
  EXPECT_EQ(Decorations(compute_CSMain, kBinding), (std::vector<uint32_t>{16, 48, 49, 50, 51}));
}

TEST(Interface, GoesBySemanticNotByOrder) {
  EXPECT_TRUE(Has(base_VSMain.glsl, "layout(location = 1) out vec2"));
  EXPECT_TRUE(Has(base_PSFewer.glsl, "layout(location = 1) in vec2"));
  EXPECT_TRUE(Has(base_PSFewer.glsl, "layout(location = 2) flat in uint"));
}

// Neither fused nor rearranged, or the same position would come out differently in two shaders.
TEST(Sums, StayAsTheyAreWritten) {
  const Scratch scratch;
  const RunResult r =
      CompileText(scratch, "ps",
                  "cbuffer C : register(b0) { float4 k; };\n"
                  "float D(float3 a, float3 b) { return (a.x * b.x + a.y * b.y) + a.z * b.z; }\n"
                  "float4 Main(float4 a : TEXCOORD0) : SV_Target { return D(a.xyz, k.xyz) * 2 * 3 - (a - k); }",
                  "--dump-glsl " + scratch.Path("out.glsl"));
  EXPECT_EQ(r.status, 0) << r.output;
  const std::string glsl = ReadText(scratch.Path("out.glsl"));
  EXPECT_FALSE(Has(glsl, "fma(")) << glsl;
  EXPECT_TRUE(Has(glsl, "* 2.0) * 3.0")) << glsl;
  for (const auto* blob : kAll) {
    EXPECT_FALSE(Has(blob->glsl, "fma(")) << blob->name;
    EXPECT_FALSE(Has(Disassemble(*blob), "NoContraction")) << blob->name;
  }
}

// A matrix that is row_major in HLSL lies in memory as GLSL's columns do: the same bytes, and m[0] the same four
// floats.
TEST(Interface, RowMajorMatricesKeepTheirBytes) {
  const std::string text = Disassemble(base_VSMain);
  EXPECT_TRUE(Has(text, "ColMajor"));
  EXPECT_FALSE(Has(base_VSMain.glsl, "row_major"));
  const Scratch scratch;
  const RunResult r = CompileText(scratch, "vs",
                                  "cbuffer C : register(b0) { float4x4 columns; };\n"
                                  "float4 Main(float4 a : POSITION) : SV_Position { return columns[1] * a.x; }",
                                  "--dump-glsl " + scratch.Path("out.glsl"));
  EXPECT_EQ(r.status, 0) << r.output;
  EXPECT_TRUE(Has(ReadText(scratch.Path("out.glsl")), "layout(row_major) mat4 columns"))
      << ReadText(scratch.Path("out.glsl"));
}

}  // namespace

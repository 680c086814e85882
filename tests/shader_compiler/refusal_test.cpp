// What fur_shaderc must refuse, and where it says the fault is.
#include <gtest/gtest.h>

#include <filesystem>
#include <ostream>

#include "run_tool.h"

namespace {

struct Refusal {
  const char* name;
  const char* stage;
  const char* hlsl;
  const char* message;  // part of the output
};
std::ostream& operator<<(std::ostream& out, const Refusal& r) { return out << r.name; }

class Refused : public testing::TestWithParam<Refusal> {};

TEST_P(Refused, WithItsReason) {
  const Scratch scratch;
  const RunResult r = CompileText(scratch, GetParam().stage, GetParam().hlsl);
  EXPECT_EQ(r.status, 1) << r.output;
  EXPECT_NE(r.output.find(GetParam().message), std::string::npos) << r.output;
  EXPECT_NE(r.output.find("error: "), std::string::npos) << r.output;
  EXPECT_FALSE(std::filesystem::exists(scratch.Path("out.cpp")));
}

// Sums whose order the drivers choose. Line 2 each.
const Refusal kSums[] = {
    {"Dot", "ps", "float4 Main(float4 a : TEXCOORD0) : SV_Target {\n return dot(a, a); }",
     "shader.hlsl:2: error: dot()"},
    {"MulVectors", "ps", "float4 Main(float4 a : TEXCOORD0) : SV_Target {\n return mul(a, a); }",
     "shader.hlsl:2: error: dot()"},
    {"MulMatrixVector", "ps",
     "cbuffer C : register(b0) { float4x4 m; }; float4 Main(float4 a : TEXCOORD0) : SV_Target {\n return mul(m, a); }",
     "shader.hlsl:2: error: mul()"},
    {"MulVectorMatrix", "ps",
     "cbuffer C : register(b0) { float4x4 m; }; float4 Main(float4 a : TEXCOORD0) : SV_Target {\n return mul(a, m); }",
     "shader.hlsl:2: error: mul()"},
    {"MulMatrices", "ps",
     "cbuffer C : register(b0) { float4x4 m; }; float4 Main(float4 a : TEXCOORD0) : SV_Target {\n return mul(m, m)[0]; "
     "}",
     "shader.hlsl:2: error: mul()"},
    {"Normalize", "ps", "float4 Main(float4 a : TEXCOORD0) : SV_Target {\n return normalize(a); }",
     "shader.hlsl:2: error: normalize()"},
    {"Length", "ps", "float4 Main(float4 a : TEXCOORD0) : SV_Target {\n return length(a); }",
     "shader.hlsl:2: error: length()"},
    {"Distance", "ps", "float4 Main(float4 a : TEXCOORD0) : SV_Target {\n return distance(a, a.yxzw); }",
     "shader.hlsl:2: error: distance()"},
    {"Reflect", "ps", "float4 Main(float4 a : TEXCOORD0) : SV_Target {\n return reflect(a, a.yxzw); }",
     "shader.hlsl:2: error: reflect()"},
    {"Refract", "ps", "float4 Main(float4 a : TEXCOORD0) : SV_Target {\n return refract(a, a.yxzw, 1.5); }",
     "shader.hlsl:2: error: refract()"},
    {"FaceForward", "ps", "float4 Main(float4 a : TEXCOORD0) : SV_Target {\n return faceforward(a, a.yxzw, a); }",
     "shader.hlsl:2: error: faceforward()"},
    {"Cross", "ps", "float4 Main(float3 a : TEXCOORD0) : SV_Target {\n return float4(cross(a, a.yzx), 1); }",
     "shader.hlsl:2: error: cross()"},
    {"Determinant", "ps", "float4 Main(float4 a : TEXCOORD0) : SV_Target {\n return determinant(float2x2(a)); }",
     "shader.hlsl:2: error: determinant()"},
};
INSTANTIATE_TEST_SUITE_P(Sums, Refused, testing::ValuesIn(kSums), [](const auto& i) { return i.param.name; });

// What glslang 12 or SPIRV-Cross would turn into wrong code.
const Refusal kTraps[] = {
    {"PragmaOnce", "ps", "// x\n#pragma once\nfloat4 Main() : SV_Target { return 1; }",
     "shader.hlsl:2: error: #pragma once"},
    {"AngleInclude", "ps", "#include <x.h>\nfloat4 Main() : SV_Target { return 1; }",
     "shader.hlsl:1: error: #include <> is not supported"},
    {"MissingInclude", "ps", "#include \"nosuch.h\"\nfloat4 Main() : SV_Target { return 1; }",
     "shader.hlsl:1: error: "},
    {"Template", "ps", "template<typename T> T f(T x) { return x; }\nfloat4 Main() : SV_Target { return f(1.0); }",
     "shader.hlsl:"},
    {"NoEntry", "ps", "float4 Other() : SV_Target { return 1; }", "Entry point not found"},
    {"AtomicIntLiteral", "cs",
     "RWByteAddressBuffer b : register(u0);\n[numthreads(1,1,1)] void Main() {\n b.InterlockedAdd(0, 4); }",
     "shader.hlsl:3: error: "},
    {"MatrixSwizzle", "ps",
     "cbuffer C : register(b0) { float4x4 m; };\nfloat4 Main() : SV_Target {\n return float4(m._m00_m10, m._m01_m11); "
     "}",
     "matrix swizzle"},
    {"Append", "cs",
     "AppendStructuredBuffer<uint> b : register(u0);\n[numthreads(1,1,1)] void Main() { b.Append(1u); }",
     "hidden counter"},
    {"Consume", "cs",
     "ConsumeStructuredBuffer<uint> b : register(u0); RWStructuredBuffer<uint> c : register(u1);\n"
     "[numthreads(1,1,1)] void Main() { c[0] = b.Consume(); }",
     "hidden counter"},
    {"IncrementCounter", "cs",
     "RWStructuredBuffer<uint> b : register(u0);\n[numthreads(1,1,1)] void Main() { b[b.IncrementCounter()] = 1; }",
     "hidden counter"},
    {"PositionW", "ps", "float4 Main(float4 p : SV_Position) : SV_Target {\n return p.w; }",
     "shader.hlsl:2: error: reads SV_Position.w"},
    {"PositionWhole", "ps", "float4 Main(float4 p : SV_Position) : SV_Target {\n return p * 2; }", "SV_Position.w"},
    {"PositionSwizzle", "ps", "float4 Main(float4 p : SV_Position) : SV_Target {\n return p.xyww; }", "SV_Position.w"},
    {"PositionIndex", "ps",
     "cbuffer C : register(b0) { uint i; };\nfloat4 Main(float4 p : SV_Position) : SV_Target { return p[i]; }",
     "SV_Position.w"},
    {"LayerFromVertexShader", "vs",
     "struct O { float4 p : SV_Position; uint l : SV_RenderTargetArrayIndex; };\n"
     "O Main(float4 a : POSITION) { O o; o.p = a; o.l = 1; return o; }",
     "error: "},
    {"CoverageInput", "ps", "float4 Main(uint c : SV_Coverage) : SV_Target { return float(c); }",
     "SV_Coverage cannot be an input"},
    {"Precise", "ps", "float4 Main(float4 a : TEXCOORD0) : SV_Target { precise float4 b = a * a.x + a.y; return b; }",
     "'precise' has no effect"},
    {"OddSemantic", "ps", "float4 Main(float4 a : FURRINESS) : SV_Target { return a; }",
     "semantic 'FURRINESS0' cannot pass"},
    {"VaryingArray", "ps", "float4 Main(float4 a[2] : TEXCOORD0) : SV_Target { return a[1]; }",
     "one float4 for each row"},
    {"InputMatrix", "vs", "float4 Main(float4x4 a : WORLD) : SV_Position { return a[1]; }", "one float4 for each row"},
    {"TooManyGsScalars", "gs",
     "struct V { float4 p : SV_Position; };\n[maxvertexcount(300)] void Main(point V v[1], inout PointStream<V> s) { "
     "s.Append(v[0]); }",
     "at most 1024"},
};
INSTANTIATE_TEST_SUITE_P(Traps, Refused, testing::ValuesIn(kTraps), [](const auto& i) { return i.param.name; });

#define PS_RETURN(x) "\nfloat4 Main() : SV_Target { return " x "; }"
const Refusal kLayouts[] = {
    {"ScalarThenFloat3", "ps", "cbuffer C : register(b0) { float a; float3 b; };" PS_RETURN("a + b.x"),
     "'C.b' would be at byte 4"},
    {"Float2AtFour", "ps", "cbuffer C : register(b0) { float a; float2 b; };" PS_RETURN("a + b.x"),
     "'C.b' would be at byte 4"},
    {"AfterArray", "ps", "cbuffer C : register(b0) { float a[2]; float b; };" PS_RETURN("b"),
     "'C.b' would be at byte 20"},
    {"AfterStruct", "ps", "struct S { float x; }; cbuffer C : register(b0) { S a; float b; };" PS_RETURN("b"),
     "'C.b' would be at byte 4"},
    {"AfterMatrix", "ps", "cbuffer C : register(b0) { row_major float3x3 a; float b; };" PS_RETURN("b"),
     "'C.b' would be at byte 44"},
    {"BufferOfFloat3", "ps", "StructuredBuffer<float3> s : register(t0);" PS_RETURN("s[0].x"),
     "an element of 's' has 12 bytes"},
    {"StructWithFloat3", "ps",
     "struct S { float a; float3 b; }; StructuredBuffer<S> s : register(t0);" PS_RETURN("s[0].b.x"),
     "'s.b' would be at byte 4"},
    {"StructTail", "ps", "struct S { float4 a; float b; }; StructuredBuffer<S> s : register(t0);" PS_RETURN("s[0].b"),
     "an element of 's' has 20 bytes"},
    {"LooseGlobal", "ps", "float4 tint;" PS_RETURN("tint"), "outside every cbuffer"},
    {"NoRegister", "ps", "Texture2D t; SamplerState s : register(s0);" PS_RETURN("t.Sample(s, 0)"),
     "'t' has no register"},
    {"CbufferWithoutRegister", "ps", "cbuffer C { float4 a; };" PS_RETURN("a"), "'C' has no register"},
    {"CbufferSlot", "ps", "cbuffer C : register(b4) { float4 a; };" PS_RETURN("a"), "'C' is not in b0..b3"},
    {"TextureSlot", "ps", "Texture2D t : register(t16);" PS_RETURN("t.Load(0)"), "'t' is not in t0..t15"},
    {"Space", "ps", "Texture2D t : register(t1, space1);" PS_RETURN("t.Load(0)"), "names a space"},
    {"SharedSlot", "ps", "Texture2D t : register(t1); Texture2D u : register(t1);" PS_RETURN("t.Load(0) + u.Load(0)"),
     "share"},
    {"ArrayOfTextures", "ps", "Texture2D t[2] : register(t1);" PS_RETURN("t[0].Load(0)"), "array of resources"},
    {"TypedBuffer", "ps", "Buffer<float4> t : register(t1);" PS_RETURN("t.Load(0)"), "a kind that the RHI lacks"},
    {"Texture1D", "ps", "Texture1D t : register(t1);" PS_RETURN("t.Load(int2(0, 0))"), "a kind that the RHI lacks"},
    {"UavInPixelShader", "ps", "RWStructuredBuffer<uint> t : register(u1);" PS_RETURN("t[0]"), "only compute shaders"},
    {"Big", "ps", "cbuffer C : register(b0) { float4 a[1025]; };" PS_RETURN("a[3]"), "at most 16384"},
    {"FiveBuffers", "ps",
     "StructuredBuffer<float4> a : register(t0), b : register(t1), c : register(t2), d : register(t3), e : "
     "register(t4);" PS_RETURN("a[0]+b[0]+c[0]+d[0]+e[0]"),
     "too many structured buffers"},
    {"ReadOfWideImage", "cs",
     "RWTexture2D<float4> t : register(u0);\n[numthreads(1,1,1)] void Main() { t[uint2(0,0)] = t[uint2(1,1)]; }",
     "must be of float, int or uint"},
};
INSTANTIATE_TEST_SUITE_P(Layouts, Refused, testing::ValuesIn(kLayouts), [](const auto& i) { return i.param.name; });

TEST(Errors, NameTheIncludedFileAndLine) {
  const Scratch scratch;
  scratch.Write("inc.hlsl", "float F() {\n  return 1;\n}\nfloat G() { return nosuch; }\n");
  const RunResult r =
      CompileText(scratch, "ps", "\n\n#include \"inc.hlsl\"\nfloat4 Main() : SV_Target { return F(); }");
  EXPECT_EQ(r.status, 1);
  EXPECT_NE(r.output.find("inc.hlsl:4: error: "), std::string::npos) << r.output;
  EXPECT_NE(r.output.find("nosuch"), std::string::npos) << r.output;
}

TEST(Errors, RefusalsNameTheIncludedFileAndLine) {
  const Scratch scratch;
  scratch.Write("inc.hlsl", "float F(float3 a) {\n\n  return dot(a, a);\n}\n");
  const RunResult r = CompileText(
      scratch, "ps", "#include \"inc.hlsl\"\nfloat4 Main(float3 a : TEXCOORD0) : SV_Target { return F(a); }");
  EXPECT_NE(r.output.find("inc.hlsl:3: error: dot()"), std::string::npos) << r.output;
}

// A limit on the size of files kills the compiling process when it writes; to the parent that is a crash like any
// other.
TEST(Errors, ACrashNamesTheShader) {
  const Scratch scratch;
  const std::string input = scratch.Write("shader.hlsl", "float4 Main() : SV_Target { return 1; }");
  const RunResult r =
      RunCommand("ulimit -f 0; " + std::string(FUR_SHADERC) + " --stage ps --entry Main --symbol s --namespace n -o " +
                 scratch.Path("out.cpp") + " " + input);
  EXPECT_EQ(r.status, 1) << r.output;
  EXPECT_NE(r.output.find("shader.hlsl: error: the compiler crashed"), std::string::npos) << r.output;
}

TEST(Errors, ABadCommandLineIsExitCode2) {
  EXPECT_EQ(RunCommand(std::string(FUR_SHADERC) + " --stage vs").status, 2);
  EXPECT_EQ(RunCommand(std::string(FUR_SHADERC) + " --nosuch").status, 2);
}

TEST(Depfile, ListsEveryInclude) {
  const Scratch scratch;
  scratch.Write("a.hlsl", "#ifndef A\n#define A\n#include \"b.hlsl\"\n#endif\n");
  scratch.Write("b.hlsl", "float B() { return VALUE; }\n");
  const RunResult r = CompileText(scratch, "ps", "#include \"a.hlsl\"\nfloat4 Main() : SV_Target { return B(); }",
                                  "-D VALUE=2 --depfile " + scratch.Path("out.d"));
  EXPECT_EQ(r.status, 0) << r.output;
  const std::string text = ReadText(scratch.Path("out.d"));
  EXPECT_EQ(text.find(scratch.Path("out.cpp") + ": "), 0u) << text;
  for (const char* file : {"shader.hlsl", "a.hlsl", "b.hlsl"})
    EXPECT_NE(text.find(scratch.Path(file)), std::string::npos) << text;
}

}  // namespace

// The product's shader functions, called once for each of many arguments: stress_functions_test.cpp compares the results
// with double precision. draw.x says which function.
#define SWAY
#define GROOM
#include "../../../shaders_hlsl/present.hlsl"
#include "../../../shaders_hlsl/fin_edge.hlsli"
#include "../../../shaders_hlsl/fur_shade.hlsli"

struct Arguments {
  float4 a, b, c;
};
StructuredBuffer<Arguments> arguments : register(t8);
RWStructuredBuffer<float4> results : register(u0);

float4 Call(uint function, Arguments x) {
  if (function == 0u) return float4(UnitOr(x.a.xyz, float3(0, 0, 1)), 0);
  if (function == 1u) return float4(Cross3(x.a.xyz, x.b.xyz), Dot3(x.a.xyz, x.b.xyz));
  if (function == 2u) return float4(UnpackStrand(x.a.xyz), 0);
  if (function == 3u) return float4(SlabOpacity(x.a.x, x.a.y), 0, 0, 0);
  if (function == 4u) return float4(SineOfTurns(x.a.x), 0, 0, 0);
  if (function == 5u) return float4(Encode(x.a.x), 0, 0, 0);
  if (function == 6u) return float4(FurLight(x.c.xyz, x.a.xyz, x.b.xyz, float3(x.a.w, x.b.w, -1.0), x.c.w, 0.0), 0);
  if (function == 7u) return float4(GroomedAlbedo(x.a.xyz, x.a.w, x.b.xyz), 0);
  if (function == 8u) return float4(TipOffset(x.a.xyz, x.b.xyz), 0);
  return float4(FinFade(x.a.xyz, x.b.xyz, x.c.xyz, float3(x.a.w, x.b.w, x.c.w)), 0, 0, 0);
}

[numthreads(64, 1, 1)]
void CSMain(uint3 id : SV_DispatchThreadID) { results[id.x] = Call(uint(draw.x), arguments[id.x]); }

#ifndef COMMON_HLSL
#define COMMON_HLSL
cbuffer Frame : register(b0) { row_major float4x4 viewProj; float3 eye; float time; };
cbuffer Pass : register(b1) { float4 passColor; float2 passScale; uint passFlags; uint passPad; };
cbuffer Object : register(b2) { row_major float4x4 world; };
cbuffer Draw : register(b3) { float shellHeight; float drawPad; float2 drawOffset; float4 drawTable[3]; };

struct Varyings {
  float4 position : SV_Position;
  float3 normal : TEXCOORD0;
  float2 uv : TEXCOORD1;
  nointerpolation uint id : TEXCOORD2;
};

float4 Transform(row_major float4x4 m, float3 v) { return ((m[0] * v.x + m[1] * v.y) + m[2] * v.z) + m[3]; }
#endif

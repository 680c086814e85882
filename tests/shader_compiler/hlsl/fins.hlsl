#include "common.hlsl"
struct Fin { float4 color; };
StructuredBuffer<Fin> fins : register(t0);
Texture2DArray shells : register(t1);
Texture2D noise : register(t2);
SamplerState linearWrap : register(s0);
SamplerState pointClamp : register(s1);

struct FinVertex {
  float4 position : SV_Position;
  float3 normal : TEXCOORD0;
  float2 uv : TEXCOORD1;
  nointerpolation uint id : TEXCOORD2;
  uint layer : SV_RenderTargetArrayIndex;
};

void Emit(inout TriangleStream<FinVertex> stream, Varyings v, float h, uint layer) {
  FinVertex o;
  o.position = v.position + Transform(world, v.normal * (h * passScale.x));
  o.normal = v.normal;
  o.uv = v.uv + noise.SampleLevel(linearWrap, v.uv, 0).xy + noise.SampleLevel(pointClamp, v.uv, 0).xy;
  o.uv += shells.SampleLevel(linearWrap, float3(v.uv, 0), 0).xy + fins[v.id].color.xy * shellHeight;
  o.id = v.id;
  o.layer = layer;
  stream.Append(o);
}

[maxvertexcount(8)]
void GSMain(lineadj Varyings v[4], uint primitive : SV_PrimitiveID, inout TriangleStream<FinVertex> stream) {
  [unroll] for (uint side = 0; side < 2; ++side) {
    Emit(stream, v[1], 0, primitive & 1);
    Emit(stream, v[2], 0, primitive & 1);
    Emit(stream, v[1], eye.x, primitive & 1);
    Emit(stream, v[side], 1, side);
    stream.RestartStrip();
  }
}

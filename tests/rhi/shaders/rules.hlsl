// What every stage sees of registers with nothing behind them, and of elements beyond the end.
#include "common.hlsli"

struct Item {
  float4 value;
};
Texture2D plane : register(t0);
Texture2DArray layers : register(t1);
TextureCube cube : register(t2);
Texture3D volume : register(t3);
Texture2D<uint4> integers : register(t4);
StructuredBuffer<Item> items : register(t5);
SamplerState point_ : register(s0);
cbuffer Rows : register(b0) { float4 rows[4]; };
#ifdef COMPUTE
RWStructuredBuffer<Item> target : register(u0);
#endif

struct Seeing {
  float4 position : SV_Position;
  nointerpolation float4 seen : TEXCOORD0;
};

float Most(float4 v) { return max(max(v.x, v.y), max(v.z, v.w)); }

// Red: the textures, green: element extra.y of the items, blue: the last row of the constants. Each the greatest of its
// components, so that 0 means all of them.
float4 Seen() {
  float textures = Most(plane.SampleLevel(point_, float2(0.5, 0.5), 0));
  textures += Most(layers.SampleLevel(point_, float3(0.5, 0.5, 0), 0));
  textures += Most(cube.SampleLevel(point_, float3(1, 0, 0), 0));
  textures += Most(volume.SampleLevel(point_, float3(0.5, 0.5, 0.5), 0));
  textures += Most(float4(integers.Load(int3(0, 0, 0)))) / 255.0;
  return float4(textures, Most(items[uint(extra.y)].value), Most(rows[3]), 1);
}

#ifndef COMPUTE
Seeing Corner(uint id, float4 seen) {
  Seeing o;
  float2 p = float2(id & 1u, id >> 1u);
  o.position = float4(p.x * 2.0 - 1.0, 1.0 - p.y * 2.0, 0.5, 1.0);
  o.seen = seen;
  return o;
}
Seeing VSSees(uint id : SV_VertexID) { return Corner(id, Seen()); }
Seeing VSBlind(uint id : SV_VertexID) { return Corner(id, float4(0, 0, 0, 0)); }

[maxvertexcount(3)]
void GSSees(triangle Seeing v[3], inout TriangleStream<Seeing> stream) {
  [unroll] for (uint i = 0u; i < 3u; ++i) {
    Seeing o;
    o.position = v[i].position;
    o.seen = Seen();
    stream.Append(o);
  }
}

float4 PSSees(Seeing v) : SV_Target { return Seen(); }
float4 PSShows(Seeing v) : SV_Target { return v.seen; }
#else
[numthreads(1, 1, 1)]
void CSSees(uint3 id : SV_DispatchThreadID) { target[id.x].value = Seen(); }
#endif

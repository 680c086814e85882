#include "common.hlsl"
struct Vertex { float3 position : POSITION; float3 normal : NORMAL; float2 uv : TEXCOORD1; };
struct Element { float4 tint; float2 offset; uint2 flags; };
StructuredBuffer<Element> elements : register(t3);
Texture2D albedo : register(t0);
Texture2DArray shells : register(t1);
Texture2D table : register(t2);
SamplerState linearWrap : register(s0);
SamplerState pointClamp : register(s1);

Varyings VSMain(Vertex v, uint vertex : SV_VertexID, uint instance : SV_InstanceID) {
  Varyings o;
  o.position = Transform(viewProj, v.position + float3(0, shellHeight, 0));
  o.normal = v.normal;
  o.uv = v.uv + elements[instance].offset;
  o.id = vertex + instance;
  return o;
}

float4 Fetch(Texture2D t, SamplerState s, float2 uv) { return t.Sample(s, uv); }

float4 PSMain(Varyings i, bool front : SV_IsFrontFace) : SV_Target {
  float4 a = Fetch(albedo, linearWrap, i.uv) + Fetch(albedo, pointClamp, i.uv);
  a += shells.Sample(linearWrap, float3(i.uv, 1)) + table.Load(int3(i.position.xy, 0));
  if (a.a < 0.5) discard;
  return front ? a : a * passColor;
}

// Leaves out `normal`: the locations go by semantic, so `uv` still is the vertex shader's.
struct Fewer { float2 uv : TEXCOORD1; nointerpolation uint id : TEXCOORD2; };
float4 PSFewer(Fewer i) : SV_Target { return float4(i.uv, float(i.id), 1); }

// Structured buffers, constants of every slot, and registers of every stage.
#include "common.hlsli"

struct Item {
  float4 value;
};
StructuredBuffer<Item> items : register(t0);
StructuredBuffer<Item> moreItems : register(t5);

cbuffer Frame : register(b0) { float4 frameValue; };
cbuffer Pass : register(b1) { float4 passValue; };
cbuffer Object : register(b2) { float4 objectValue; };

// Pixel x shows element x + extra.y.
float4 PSItem(Varying v) : SV_Target { return items[uint(v.position.x) + uint(extra.y)].value; }
float4 PSTwoBuffers(Varying v) : SV_Target {
  uint x = uint(v.position.x);
  return v.position.y < 1.0 ? items[x].value : moreItems[x].value;
}
float4 PSConstants(Varying v) : SV_Target { return float4(frameValue.x, passValue.y, objectValue.z, tint.w); }

struct StageVarying {
  float4 position : SV_Position;
  float2 uv : TEXCOORD0;
  nointerpolation float4 fromVertex : TEXCOORD1;
};
Texture2D table : register(t1);
SamplerState tableSampler : register(s1);
Varying VSConstants(uint id : SV_VertexID) {  // the same slots in the vertex shader
  Varying o;
  float2 p = float2(id & 1u, id >> 1u);
  o.position = float4(p.x * 2.0 - 1.0, 1.0 - p.y * 2.0, 0.5, 1.0);
  o.uv = float2(frameValue.x + objectValue.z, passValue.y);
  return o;
}
StageVarying VSStage(uint id : SV_VertexID) {
  StageVarying o;
  o.uv = float2(id & 1u, id >> 1u);
  o.position = float4(o.uv.x * 2.0 - 1.0, 1.0 - o.uv.y * 2.0, 0.5, 1.0);
  o.fromVertex = table.SampleLevel(tableSampler, float2(0.75, 0.5), 0) * 0.5;
  return o;
}
float4 PSStage(StageVarying v) : SV_Target { return v.fromVertex + table.SampleLevel(tableSampler, float2(0.75, 0.5), 0) * 0.5; }

// Rectangles, one for each item: value is left, top, right, bottom. Instanced; the color is tint.
Varying VSPulled(uint id : SV_VertexID, uint instance : SV_InstanceID) {
  Varying o;
  float4 r = items[instance].value;
  o.uv = float2(id & 1u, id >> 1u);
  o.position = float4((id & 1u) != 0u ? r.z : r.x, (id & 2u) != 0u ? r.w : r.y, 0.5, 1.0);
  return o;
}

// Triangles that each cover one pixel and show what the input assembler gave.
#include "common.hlsli"

struct IdVarying {
  float4 position : SV_Position;
  nointerpolation float4 ids : TEXCOORD0;
};

struct IdVertex {
  float2 position : POSITION;  // clip space
  float4 data : COLOR1;
  uint vertex : SV_VertexID;
  uint instance : SV_InstanceID;
};

// Red: vertex id, green: instance id, blue: the data's x; alpha 1. All over 255. extra.yz moves each instance.
IdVarying VSIds(IdVertex v) {
  IdVarying o;
  o.position = float4(v.position + float2(v.instance, v.instance) * extra.yz, 0.5, 1.0);
  o.ids = float4(float(v.vertex), float(v.instance), v.data.x * 255.0, 255.0) / 255.0;
  return o;
}

float4 PSIds(IdVarying v) : SV_Target { return v.ids; }

// An element of each attribute; the sum shows that all arrive.
struct ManyVertex {
  float3 position : POSITION;
  float4 color : COLOR;
  uint4 bytes : BLENDINDICES;
  float2 pair : TEXCOORD3;
};
IdVarying VSFormats(ManyVertex v) {
  IdVarying o;
  o.position = float4(v.position, 1.0);
  o.ids = float4(v.color.r, float(v.bytes.g) / 255.0, v.pair.y, v.color.a);
  return o;
}

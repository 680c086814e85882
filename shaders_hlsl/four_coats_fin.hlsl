// Fins of preset four-coats: the edge's two points and the same two pushed out along their own vertex normals.
#include "four_coats.hlsli"
#include "line_fin.hlsli"
#include "vertex.hlsli"

Texture2D finMap : register(t6);

struct CoatFinVarying {
  float4 position : SV_Position;
  float3 normal : TEXCOORD0;  // world
  float2 uv : TEXCOORD1;
  float2 strand : TEXCOORD2;  // along the edge in tiles; height
};

LinePoint VSMain(VertexIn v) { return MakeLinePoint(v.position, v.uv, v.normal); }

CoatFinVarying Push(LinePoint v, float along, float height) {
  CoatFinVarying o;
  float3 p = v.position.xyz + Unit3(v.normal) * (FurLengthAt(v.uv) * height);
  o.position = TransformPoint(objectToClip, p);
  o.normal = TransformVector(normalToWorld, v.normal);
  o.uv = v.uv;
  o.strand = float2(along, height);
  return o;
}

[maxvertexcount(4)]
void GSMain(line LinePoint v[2], inout TriangleStream<CoatFinVarying> fins) {
  if (InDeadZone(v[0], v[1])) {
    float2 along = AlongEdge(v[0].uv, v[1].uv);
    fins.Append(Push(v[0], along.x, 0.0));
    fins.Append(Push(v[1], along.y, 0.0));
    fins.Append(Push(v[0], along.x, 1.0));
    fins.Append(Push(v[1], along.y, 1.0));
    fins.RestartStrip();
  }
}

float4 PSMain(CoatFinVarying v) : SV_Target {
  float coverage = finMap.Sample(volumeSampler, FinMapAt(v.strand)).r;
  return ShadeCoat(v.uv, v.normal, coverage, coverage, v.strand.y);
}

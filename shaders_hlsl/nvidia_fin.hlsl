// Fins of preset nvidia-d3d10: a strip of four vertices on each edge that is part of the silhouette, or nearly so.
#include "nvidia.hlsli"
#include "vertex.hlsli"

struct FinPoint {
  float4 position : SV_Position;  // object space
  float2 uv : TEXCOORD0;
  float3 normal : TEXCOORD1;
  float4 tangent : TEXCOORD2;
};

FinPoint VSMain(VertexIn v) {
  FinPoint o;
  o.position = float4(v.position, 1.0);
  o.uv = v.uv;
  o.normal = v.normal;
  o.tangent = v.tangent;
  return o;
}

float3 FromEye(FinPoint v) { return TransformPoint(objectToEye, v.position.xyz).xyz; }
float3 FaceNormal(float3 a, float3 b, float3 c) { return UnitOr(Cross3(b - a, c - a), float3(0, 0, 0)); }

// As published, with its else-if: the second triangle is looked at only when the first one is not near its horizon, so
// that a fin pops where both are (docs/presets.md). Points relative to the eye; e at the middle of the edge.
float FinFade(float3 p0, float3 p1, float3 p2, float3 p3) {
  float3 e = -UnitOr(p1 + p2, float3(0, 0, 1));
  float n1 = Dot3(e, FaceNormal(p1, p2, p3));
  float n2 = Dot3(e, FaceNormal(p2, p1, p0));
  float threshold = fin.x;
  if (n1 * n2 < 0.0) return 1.0;
  if (abs(n1) < threshold) return 1.0 - abs(n1) / threshold;
  if (abs(n2) < threshold) return 1.0 - abs(n2) / threshold;
  return 0.0;
}

FurPixel Raise(FinPoint v, float alpha, float k, float slice, float opacity) {
  return MakePixel(Combed(v.position.xyz, v.normal, alpha, k), v.normal, v.tangent, float4(v.uv, slice, opacity));
}

[maxvertexcount(4)]
void GSMain(lineadj FinPoint v[4], inout TriangleStream<FurPixel> fins) {
  float opacity = FinFade(FromEye(v[0]), FromEye(v[1]), FromEye(v[2]), FromEye(v[3])) * fin.y;
  float a1 = LengthAlpha(v[1].uv), a2 = LengthAlpha(v[2].uv);
  if (opacity > 0.0 && max(a1, a2) >= kBald) {
    float shells = furShape.w, top = furShape.z - 1.0;
    fins.Append(Raise(v[1], a1, 0.0, 0.0, opacity));
    fins.Append(Raise(v[2], a2, 0.0, 0.0, opacity));
    fins.Append(Raise(v[1], a1, shells, top, opacity));
    fins.Append(Raise(v[2], a2, shells, top, opacity));
    fins.RestartStrip();
  }
}

float4 PSMain(FurPixel v) : SV_Target { return ShadePixel(v, v.uvLayer.w); }

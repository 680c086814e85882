// Fins of preset gs-shells: each end of an edge in the dead zone is pushed along its own vertex normal. The colour
// keeps the line's texture coordinates; the opacity has new ones, along the edge and from root (0) to tip (1).
#include "gs_shells.hlsli"
#include "line_fin.hlsli"
#include "vertex.hlsli"

Texture2D finMap : register(t6);

LinePoint VSMain(VertexIn v) { return MakeLinePoint(v.position, v.uv, v.normal); }

[maxvertexcount(4)]
void GSMain(line LinePoint v[2], inout TriangleStream<GsShellVarying> fins) {
  if (InDeadZone(v[0], v[1])) {
    float2 along = AlongEdge(v[0].uv, v[1].uv);
    fins.Append(Extrude(v[0].position.xyz, v[0].normal, v[0].uv, float2(along.x, 0.0), 0.0));
    fins.Append(Extrude(v[1].position.xyz, v[1].normal, v[1].uv, float2(along.y, 0.0), 0.0));
    fins.Append(Extrude(v[0].position.xyz, v[0].normal, v[0].uv, float2(along.x, 1.0), 1.0));
    fins.Append(Extrude(v[1].position.xyz, v[1].normal, v[1].uv, float2(along.y, 1.0), 1.0));
    fins.RestartStrip();
  }
}

float4 PSMain(GsShellVarying v) : SV_Target {
  return ShadeHair(v, finMap.Sample(volumeSampler, FinMapAt(v.opacityUv)).r);
}

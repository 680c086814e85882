// Shells of preset gs-shells: the geometry shader makes every layer of a triangle, inside out.
#include "gs_shells.hlsli"
#include "line_fin.hlsli"
#include "vertex.hlsli"

Texture2D opacityMap : register(t5);

LinePoint VSMain(VertexIn v) { return MakeLinePoint(v.position, v.uv, v.normal); }

[maxvertexcount(84)]
void GSMain(triangle LinePoint v[3], inout TriangleStream<GsShellVarying> shells) {
  uint count = uint(furShape.w);
  for (uint shell = 0u; shell < count; ++shell) {
    float height = float(shell + 1u) / furShape.w;
    for (uint corner = 0u; corner < 3u; ++corner)
      shells.Append(Extrude(v[corner].position.xyz, v[corner].normal, v[corner].uv, v[corner].uv * furShape.y, height));
    shells.RestartStrip();
  }
}

float4 PSMain(GsShellVarying v) : SV_Target {
  return ShadeHair(v, opacityMap.Sample(volumeSampler, v.opacityUv).r);
}

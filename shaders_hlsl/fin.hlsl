// Fins of the technique `shells`: a quad on each edge of the silhouette, lit like the shells, as long at each end as the
// fur is there. Made by a geometry shader, or by vertex pulling where there is none (fin_pull.hlsl).
#include "fin_edge.hlsli"
#include "fur_shade.hlsli"

FurVertex VSMain(FurVertex v) { return v; }

[maxvertexcount(6)]
void GSMain(lineadj FurVertex v[4], inout TriangleStream<FurVarying> fins) {
  float opacity = FinOpacity(v[0], v[1], v[2], v[3]);
  if (opacity > 0.0) {
    for (uint corner = 0u; corner < 6u; ++corner) {
      fins.Append(FinCorner(v[1], v[2], corner, opacity));
      if (corner == 2u) fins.RestartStrip();
    }
  }
}

float4 PSMain(FurVarying v) : SV_Target {
  Fur fur = ReadFur(v.uv.zw, v.fur.x);
  float alpha = FinAlpha(fur) * v.fur.z * InsideFur(v);
  return float4(FurColor(v, fur) * alpha, alpha);
}

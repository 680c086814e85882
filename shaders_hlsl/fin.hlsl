// Fins of the technique `shells`: a quad on each edge of the silhouette, lit like the shells, as long at each end as the
// fur is there. Made by a geometry shader, or by vertex pulling where there is none (fin_pull.hlsl). Variant
// FIN_IN_VOLUME: as opaque as the fur that the shells miss; else as published, a sheet.
#include "fin_edge.hlsli"
#ifdef FIN_IN_VOLUME
#include "fin_volume.hlsli"
#endif
#include "fur_shade.hlsli"

FurVertex VSMain(FurVertex v) { return v; }

[maxvertexcount(6)]
void GSMain(lineadj FurVertex v[4], inout TriangleStream<FurVarying> fins) {
  float opacity = FinOpacity(v[0], v[1], v[2], v[3]);
  if (opacity > 0.0) {
    for (uint corner = 0u; corner < 6u; ++corner) {
#ifdef FIN_IN_VOLUME
      fins.Append(FinInVolume(v[0], v[1], v[2], v[3], corner));
#else
      fins.Append(FinCorner(v[1], v[2], corner, opacity));
#endif
      if (corner == 2u) fins.RestartStrip();
    }
  }
}

float4 PSMain(FurVarying v) : SV_Target {
  float4 texel = ReadSurface(v);
  Fur fur = ReadFur(v.uv.zw, v.fur.x);
#ifdef FIN_IN_VOLUME
  float alpha = SlabOpacity(fur.coverage, fur.crowding * furShape.z * WayInVolume(v)) * fin.y * InsideFur(v, texel);
#else
  float alpha = FinAlpha(fur) * v.fur.z * InsideFur(v, texel);
#endif
  return float4(FurColor(v, fur, texel) * alpha, alpha);
}

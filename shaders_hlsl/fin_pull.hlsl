// Fins by vertex pulling: six vertices for each edge of a list, or for those that a compute shader has kept (COMPACTED).
// An edge that grows none collapses to a point.
#include "fin_edge.hlsli"
#include "fin_list.hlsli"
#ifdef FIN_IN_VOLUME
#include "fin_volume.hlsli"
#endif

#ifdef COMPACTED
StructuredBuffer<uint> keptEdges : register(t7);
#endif

FurVarying VSMain(uint vertex : SV_VertexID) {
  uint edge = vertex / 6u;
#ifdef COMPACTED
  edge = keptEdges[uint(draw.y) + edge];
#endif
  uint4 ends = finEdges[edge];
  FurVertex v0 = LoadFurVertex(ends.x), v1 = LoadFurVertex(ends.y), v2 = LoadFurVertex(ends.z), v3 = LoadFurVertex(ends.w);
  float opacity = FinOpacity(v0, v1, v2, v3);
  uint corner = opacity > 0.0 ? vertex % 6u : 0u;
#ifdef FIN_IN_VOLUME
  return FinInVolume(v0, v1, v2, v3, corner);
#else
  return FinCorner(v1, v2, corner, opacity);
#endif
}

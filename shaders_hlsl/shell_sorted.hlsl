// Shells triangle by triangle: all of one triangle's before those of the next, in the order of a list.
#include "fur_list.hlsli"

StructuredBuffer<uint> triangleOrder : register(t6);  // fur::TriangleOrder, back to front: twice the triangle's number,
                                                      // + 1 where its shells come outside in
StructuredBuffer<uint> furIndices : register(t7);     // three for each triangle

FurVarying VSMain(uint vertex : SV_VertexID) {
  uint shells = uint(draw.z), place = vertex / (3u * shells), within = vertex - place * (3u * shells);
  uint shell = within / 3u, corner = within - shell * 3u, entry = triangleOrder[place];
  float step = (entry & 1u) == 0u ? float(shell) : draw.z - 1.0 - float(shell);
  return PointAt(LoadFurVertex(furIndices[3u * (entry >> 1u) + corner]), (step + 0.5) / furShape.w, 1.0);
}

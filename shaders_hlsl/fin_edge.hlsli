// Whether an edge grows a fin, and how opaque it is. An edge comes with its two triangles as line adjacency: 1-2 is the
// edge as the triangle 1, 2, 3 winds it; 0 is opposite in the other triangle. A boundary edge repeats its one opposite.
#ifndef FIN_EDGE_HLSLI
#define FIN_EDGE_HLSLI
#include "fur_point.hlsli"

float3 FaceNormal(float3 a, float3 b, float3 c) { return UnitOr(Cross3(b - a, c - a), float3(0, 0, 0)); }

// Points relative to the eye. 1 for a silhouette, and fading in over the angle before it, so that no fin pops: at the
// moment when an edge becomes a silhouette, e.N of one of its triangles is 0. A boundary's other side is its back.
float FinFade(float3 p0, float3 p1, float3 p2, float3 p3) {
  float3 e = -UnitOr(p1 + p2, float3(0, 0, 1));
  float n1 = Dot3(e, FaceNormal(p1, p2, p3));
  float n2 = Dot3(e, FaceNormal(p2, p1, p0));
  float exact = n1 * n2 < 0.0 ? 1.0 : 0.0;
  float threshold = max(fin.x, 1e-6);
  return saturate(max(exact, 1.0 - min(abs(n1), abs(n2)) / threshold));
}

float FinOpacity(FurVertex v0, FurVertex v1, FurVertex v2, FurVertex v3) {
  float3 p0 = TransformPoint(objectToEye, v0.position.xyz).xyz, p1 = TransformPoint(objectToEye, v1.position.xyz).xyz;
  float3 p2 = TransformPoint(objectToEye, v2.position.xyz).xyz, p3 = TransformPoint(objectToEye, v3.position.xyz).xyz;
  return max(v1.position.w, v2.position.w) > 0.0 ? FinFade(p0, p1, p2, p3) * fin.y : 0.0;
}

// Corner 0..5 of the two triangles of a fin: root 1, root 2, tip 1; tip 1, root 2, tip 2.
FurVarying FinCorner(FurVertex v1, FurVertex v2, uint corner, float opacity) {
  bool second = corner == 1u || corner >= 4u;
  bool tip = corner == 2u || corner == 3u || corner == 5u;
  FurVertex v = v1;
  if (second) v = v2;
  return PointAt(v, tip ? 1.0 : 0.0, opacity);
}

#endif

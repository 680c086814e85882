// A fin in a volume. It is the wall between the fur of two triangles, so that a ray which comes through the fin passes
// from one into the other at its height. Where a triangle is seen edge on, shells are crossed too seldom to say how much
// fur is on the way; the wall knows: docs/shells.md has the law.
#ifndef FIN_VOLUME_HLSLI
#define FIN_VOLUME_HLSLI
#include "fin_edge.hlsli"

float Det(float3 unit, float3 a, float3 b) { return Dot3(unit, Cross3(a, b)); }

// Of the triangle p1, p2, other at one height, points relative to the eye. A ray that meets the edge at p1 + u (p2 - p1)
// runs over the triangle until it meets one of the other two edges, in fur heights: u / x or (1 - u) / y, where positive.
// z: cosine to the eye, positive in front. `up`: way of a strand for one unit of height.
float3 Crossing(float3 p1, float3 p2, float3 other, float3 unit, float3 view, float3 up) {
  float cosine = -Dot3(view, unit);
  float3 along = view + unit * cosine;
  float area = Det(unit, p2 - p1, other - p1);
  float inwards = Det(unit, p2 - p1, along) * area < 0.0 ? -1.0 : 1.0;
  float scale = abs(area) > 1e-20 ? inwards * abs(Dot3(up, unit)) / area : 0.0;
  return float3(-Det(unit, along, other - p1) * scale, Det(unit, along, other - p2) * scale, cosine);
}

float3 FromEyeAt(FurVertex v, float height) { return TransformPoint(objectToEye, PlaceAt(v, height)).xyz; }

// `before`: of the triangle that the ray comes from, `behind`: of the one that it goes to; w: whether there is one.
FurVarying FinInVolume(FurVertex v0, FurVertex v1, FurVertex v2, FurVertex v3, uint corner) {
  FurVarying o = FinCorner(v1, v2, corner, 0.0);
  bool second = corner == 1u || corner >= 4u;
  float height = o.fur.x;
  float3 p0 = FromEyeAt(v0, height), p1 = FromEyeAt(v1, height), p2 = FromEyeAt(v2, height), p3 = FromEyeAt(v3, height);
  float3 view = UnitOr(o.fromEye, float3(0, 0, 1));
  float3 up = o.direction * (o.fur.y * furShape.x);
  bool boundary = all(v0.position.xyz == v3.position.xyz);  // both sides would be the same triangle
  float4 own = float4(Crossing(p1, p2, p3, FaceNormal(p1, p2, p3), view, up), 1.0);
  float4 other = float4(Crossing(p1, p2, p0, FaceNormal(p2, p1, p0), view, up), boundary ? 0.0 : 1.0);
  float3 wall = Cross3(p2 - p1, o.direction);
  bool ownFirst = Dot3(wall, p3 - p1) * Dot3(wall, p1) < 0.0;
  o.before = other;
  o.behind = own;
  if (ownFirst) {
    o.before = own;
    o.behind = other;
  }
  o.fur.z = second ? 1.0 : 0.0;
  return o;
}

static const float kFar = 1e6;

// Half of the way over a triangle, for the other half belongs to the wall at its end, in fur heights; as far as the fur
// goes, and the share of it that shells leave to fins.
float WayLeft(float4 crossing, float along, float height, bool rises) {
  float first = crossing.x > 0.0 ? along / crossing.x : kFar;
  float second = crossing.y > 0.0 ? (1.0 - along) / crossing.y : kFar;
  float way = min(first, second);
  float cosine = abs(crossing.z);
  float within = (rises ? 1.0 - height : height) / max(cosine, 1e-6);
  float left = 1.0 - cosine / max(cosine, furSemantics.x);
  return way < kFar ? min(way * 0.5, within) * left * crossing.w : 0.0;
}

// Fur heights on the way of the ray that no shell stands for.
float WayInVolume(FurVarying v) {
  // With several samples a pixel's middle may lie beside the fin.
  float along = saturate(v.fur.z), height = saturate(v.fur.x);
  return WayLeft(v.before, along, height, v.before.z > 0.0) + WayLeft(v.behind, along, height, v.behind.z < 0.0);
}

#endif

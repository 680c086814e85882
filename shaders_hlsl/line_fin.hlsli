// Fins of presets gs-shells and four-coats: an edge comes as a line, with its two vertices only. Its normal is the mean
// of theirs; it is part of the silhouette where that is nearly perpendicular to the view.
#ifndef FUR_LINE_FIN_HLSLI
#define FUR_LINE_FIN_HLSLI
#include "fur_constants.h"
#include "math.hlsli"

struct LinePoint {
  float4 position : SV_Position;  // object space
  float2 uv : TEXCOORD0;
  float3 normal : TEXCOORD1;
};

LinePoint MakeLinePoint(float3 position, float2 uv, float3 normal) {
  LinePoint o;
  o.position = float4(position, 1.0);
  o.uv = uv;
  o.normal = normal;
  return o;
}

// |edge normal . view| < the dead zone, both unit, the view from the middle of the edge.
bool InDeadZone(LinePoint a, LinePoint b) {
  float3 na = UnitOr(TransformVector(normalToWorld, a.normal), float3(0, 0, 0));
  float3 nb = UnitOr(TransformVector(normalToWorld, b.normal), float3(0, 0, 0));
  float3 middle = TransformPoint(objectToEye, (a.position.xyz + b.position.xyz) * 0.5).xyz;
  float3 edgeNormal = UnitOr(na + nb, float3(0, 0, 0));
  return abs(Dot3(edgeNormal, UnitOr(middle, float3(0, 0, 1)))) < fin.z;
}

// Where the fin's opacity is read along the edge: tiles of the fur from a phase of the edge's own, so that strands are
// as wide as on the shells and neighbouring fins do not repeat each other.
float2 AlongEdge(float2 uvA, float2 uvB) {
  float2 across = (uvB - uvA) * furShape.y;
  float phase = (uvA.x * 3.0 + uvA.y * 5.0) * furShape.y;
  float start = phase - floor(phase);
  return float2(start, start + sqrt(across.x * across.x + across.y * across.y));
}

// x: along the edge, y: height. The coat is the lower half of the map; the rest is empty, so that nothing wraps around.
float2 FinMapAt(float2 strand) { return float2(strand.x, 1.0 / 256.0 + (0.5 - 1.0 / 256.0) * strand.y); }

#endif

// A rectangle from nothing but the vertex id, and pixel shaders of a line or two.
#include "common.hlsli"

Varying VSRect(uint id : SV_VertexID) {
  Varying o;
  o.uv = float2(id & 1u, id >> 1u);
  o.position = float4((id & 1u) != 0u ? rectangle.z : rectangle.x, (id & 2u) != 0u ? rectangle.w : rectangle.y, extra.x, 1.0);
  return o;
}

float4 PSTint(Varying v) : SV_Target { return tint; }
float4 PSUv(Varying v) : SV_Target { return float4(v.uv, 0.0, 1.0); }
float4 PSPosition(Varying v) : SV_Target { return float4(v.position.xyz, 1.0); }
// Alpha grows from left to right over 256 pixels.
float4 PSAlphaRamp(Varying v) : SV_Target { return float4(tint.rgb, floor(v.position.x) / 255.0); }
float4 PSFace(Varying v, bool front : SV_IsFrontFace) : SV_Target { return front ? float4(1, 0, 0, 1) : float4(0, 1, 0, 1); }

struct TwoTargets {
  float4 a : SV_Target0;
  float4 b : SV_Target1;
};
TwoTargets PSTwoTargets(Varying v) {
  TwoTargets o;
  o.a = tint;
  o.b = tint.bgra;
  return o;
}

// For blending with two sources.
TwoTargets PSTwoSources(Varying v) {
  TwoTargets o;
  o.a = tint;
  o.b = extra.yzwx;
  return o;
}

struct ColorAndDepth {
  float4 color : SV_Target;
  float depth : SV_Depth;
};
ColorAndDepth PSDepth(Varying v) {
  ColorAndDepth o;
  o.color = tint;
  o.depth = v.uv.x;
  return o;
}
// A few operations of the mathematical library, for pictures that two drivers must agree on.
float4 PSPattern(Varying v) : SV_Target {
  float2 p = v.uv * 6.0 + tint.xy;
  float wave = (p.x * p.x + p.y * p.y) * 0.25;
  return float4(frac(wave), saturate(v.uv.x * v.uv.y), abs(ddx(p.x)) * 8.0, sqrt(v.uv.y));
}

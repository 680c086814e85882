// The sums of linear algebra, spelled out. Drivers sum mul, dot and normalize in different orders; these give the same
// bits on each (docs/decisions.md). The shader compiler refuses the built-ins.
#ifndef FUR_MATH_HLSLI
#define FUR_MATH_HLSLI

float Dot3(float3 a, float3 b) { return (a.x * b.x + a.y * b.y) + a.z * b.z; }

float3 Cross3(float3 a, float3 b) {
  return float3(a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x);
}

// As the built-in: not finite for a zero vector.
float3 Unit3(float3 v) { return v * rsqrt(Dot3(v, v)); }

// A zero vector gives `fallback`. The least square is far above the denormals, which some drivers flush, and below that of
// a cross product of two edges of 1e-9.
float3 UnitOr(float3 v, float3 fallback) {
  float d = Dot3(v, v);
  return d > 1e-36 ? v * rsqrt(d) : fallback;
}

float4 TransformPoint(float4x4 m, float3 p) { return ((m[0] * p.x + m[1] * p.y) + m[2] * p.z) + m[3]; }
float3 TransformVector(float4x4 m, float3 v) { return (m[0].xyz * v.x + m[1].xyz * v.y) + m[2].xyz * v.z; }

// Tangent space to the space of the frame.
float3 FromFrame(float3 t, float3 tangent, float3 bitangent, float3 normal) {
  return (tangent * t.x + bitangent * t.y) + normal * t.z;
}

#endif

// Pixel shaders for textures of other kinds than the usual: integers, samples; and compute shaders that write textures.
#include "common.hlsli"

Texture2D<uint4> integers : register(t0);
Texture2DMS<float4> samples : register(t1);

// An integer texel as it is, in a float target.
float4 PSLoadInteger(Varying v) : SV_Target { return float4(integers.Load(int3(v.position.xy, 0))); }
uint4 PSInteger(Varying v) : SV_Target { return uint4(tint); }
// Column x shows sample x.
float4 PSLoadSample(Varying v) : SV_Target { return samples.Load(int2(0, 0), int(v.position.x)); }

// Pixel shaders that read textures.
#include "common.hlsli"

Texture2D picture : register(t0);
Texture2D other : register(t1);
Texture2DArray layers : register(t2);
TextureCube cube : register(t3);
Texture3D volume : register(t4);
SamplerState first : register(s0);
SamplerState second : register(s1);
SamplerComparisonState compare : register(s2);

float2 Scaled(float2 uv) { return uv * extra.y + extra.z; }

float4 PSSample(Varying v) : SV_Target { return picture.Sample(first, Scaled(v.uv)); }
float4 PSSampleLevel(Varying v) : SV_Target { return picture.SampleLevel(first, v.uv, extra.w); }
float4 PSLoad(Varying v) : SV_Target { return picture.Load(int3(v.position.xy, 0)); }
// One texture with two samplers: left half by the first.
float4 PSTwoSamplers(Varying v) : SV_Target {
  float4 a = picture.SampleLevel(first, v.uv, 0), b = picture.SampleLevel(second, v.uv, 0);
  return v.uv.x < 0.5 ? a : b;
}
// Two textures with one sampler.
float4 PSTwoTextures(Varying v) : SV_Target {
  return v.uv.x < 0.5 ? picture.SampleLevel(first, v.uv, 0) : other.SampleLevel(first, v.uv, 0);
}
// extra.y: the layer, not rounded; extra.w: the mip.
float4 PSLayer(Varying v) : SV_Target { return layers.SampleLevel(first, float3(v.uv, extra.y), extra.w); }
// The layer grows from left to right, from extra.y by extra.z for each pixel.
float4 PSLayerRamp(Varying v) : SV_Target {
  return layers.SampleLevel(first, float3(0.5, 0.5, extra.y + floor(v.position.x) * extra.z), 0);
}
float4 PSCube(Varying v) : SV_Target { return cube.SampleLevel(first, extra.yzw, 0); }
float4 PSVolume(Varying v) : SV_Target { return volume.SampleLevel(first, float3(v.uv, extra.y), 0); }
float4 PSCompare(Varying v) : SV_Target {
  float lit = picture.SampleCmpLevelZero(compare, v.uv, extra.y);
  return float4(lit, lit, lit, 1);
}
// The coordinates change 16 times as fast across as down.
float4 PSStretched(Varying v) : SV_Target { return picture.Sample(first, v.uv * float2(16, 1)); }
float4 PSSize(Varying v) : SV_Target {
  uint w, h, count, mips;
  layers.GetDimensions(0, w, h, count, mips);
  return float4(float(w), float(h), float(count), float(mips)) / 255.0;
}

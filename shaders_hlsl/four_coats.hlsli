// Preset four-coats (the fourth description; docs/presets.md): a vertex of 10 scalars as published, 4 + 3 + 2 + 1, so
// that 30 shells of a triangle take 900 of the 1,024 of a geometry shader.
#ifndef FUR_FOUR_COATS_HLSLI
#define FUR_FOUR_COATS_HLSLI
#include "fur_constants.h"
#include "fur_volume.hlsli"
#include "lambert.hlsli"
#include "math.hlsli"

struct CoatVarying {
  float4 position : SV_Position;
  float3 normal : TEXCOORD0;  // world
  float2 uv : TEXCOORD1;
  nointerpolation int layer : TEXCOORD2;
};

float FurLengthAt(float2 uv) { return lengthMap.SampleLevel(surfaceSampler, uv, 0).r * furShape.x; }

float4 ShadeCoat(float2 uv, float3 normal, float coverage, float thickness, float height) {
  float alpha = coverage * (1.0 - furLight.w * height);
  if (alpha < 0.01) discard;
  float3 albedo = baseColorMap.Sample(surfaceSampler, uv).rgb;
  return float4(saturate(HairLambert(albedo, normal, thickness, height)), alpha);
}

#endif

// Preset gs-shells (the third description; docs/presets.md): shells and fins share a vertex of 12 scalars, of which the
// 1,024 of Direct3D 10's geometry shader hold 85: 28 shells of a triangle.
#ifndef FUR_GS_SHELLS_HLSLI
#define FUR_GS_SHELLS_HLSLI
#include "fur_constants.h"
#include "lambert.hlsli"
#include "math.hlsli"

Texture2D baseColorMap : register(t0);
Texture2D spotMap : register(t7);  // rgb: what is on the furless spots, a: where they are
SamplerState surfaceSampler : register(s0);
SamplerState volumeSampler : register(s1);

struct GsShellVarying {
  float4 position : SV_Position;
  float2 uv : TEXCOORD0;          // of the model: colour
  float2 opacityUv : TEXCOORD1;   // of the opacity map
  float height : TEXCOORD2;       // 0 root, 1 tip
  float3 normal : TEXCOORD3;      // world
};

GsShellVarying Extrude(float3 p, float3 normal, float2 uv, float2 opacityUv, float height) {
  GsShellVarying o;
  o.position = TransformPoint(objectToClip, p + Unit3(normal) * (furShape.x * height));
  o.uv = uv;
  o.opacityUv = opacityUv;
  o.height = height;
  o.normal = TransformVector(normalToWorld, normal);
  return o;
}

// The further from the skin, the lower the opacity; none on furless spots.
float4 ShadeHair(GsShellVarying v, float opacity) {
  float spot = spotMap.Sample(surfaceSampler, v.uv).a;
  float alpha = opacity * (1.0 - v.height) * (1.0 - spot);
  if (alpha < 0.01) discard;
  float3 albedo = baseColorMap.Sample(surfaceSampler, v.uv).rgb;
  return float4(saturate(HairLambert(albedo, v.normal, opacity, v.height)), alpha);
}

#endif

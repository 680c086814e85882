// Fur lighting after Kajiya and Kay (SIGGRAPH 1989), as a function of the strand's tangent. docs/accuracy.md states the
// equations of both looks.
#ifndef FUR_LIGHT_HLSLI
#define FUR_LIGHT_HLSLI
#include "fur_constants.h"
#include "math.hlsli"

// As published (Habr's demo): light and eye vectors both point along the ray, the diffuse term is inverted, the specular
// sign puts the lobe at the retro cone, and nothing guards the square roots. Kept as the baseline's look.
float3 SeedFurLight(float3 albedo, float3 strand, float3 fromEye) {
  float3 view = Unit3(fromEye);
  float tl = Dot3(strand, lightDirection.xyz);
  float te = Dot3(strand, view);
  float sinTl = sqrt(1.0 - tl * tl);
  float sinTe = sqrt(1.0 - te * te);
  float lobe = pow(abs(tl * te + sinTl * sinTe), furLight.y);
  return (lightAmbient.rgb * albedo + lightDiffuse.rgb * (1.0 - sinTl) * albedo) + lightSpecular.rgb * lobe * furLight.z;
}

static const float kWrap = 0.5;  // how far light reaches around the body: g = (n.l + wrap) / (1 + wrap)
// Share of the diffuse light that neighbouring strands have scattered before: it no longer knows the strand's direction,
// and what it keeps is the mean of the sine over all directions, pi / 4.
static const float kScattered = 0.5;
static const float kMeanSine = 0.785398163;

// Look correct: strand and surface normal are unit; height 0 root .. 1 tip.
float3 FurLight(float3 albedo, float3 strand, float3 normal, float3 fromEye, float height) {
  float3 toLight = -lightDirection.xyz;
  float3 toEye = -UnitOr(fromEye, float3(0, 0, 1));
  float tl = Dot3(strand, toLight);
  float te = Dot3(strand, toEye);
  float sinTl = sqrt(max(0.0, 1.0 - tl * tl));
  float sinTe = sqrt(max(0.0, 1.0 - te * te));
  float facing = saturate((Dot3(normal, toLight) + kWrap) / (1.0 + kWrap));
  float lobe = pow(max(0.0, sinTl * sinTe - tl * te), furLight.y) * facing;
  float ramp = furLight.x + (1.0 - furLight.x) * height;
  float diffuse = sinTl * (1.0 - kScattered) + kMeanSine * kScattered;
  float3 direct = lightDiffuse.rgb * albedo * (diffuse * facing) + lightSpecular.rgb * (lobe * furLight.z);
  return (lightAmbient.rgb * albedo + direct) * ramp;
}

#endif

// The light of presets gs-shells and four-coats: Lambert's; the skin lies in the fur's shadow (docs/presets.md).
#ifndef FUR_LAMBERT_HLSLI
#define FUR_LAMBERT_HLSLI
#include "fur_constants.h"
#include "math.hlsli"

float3 Lambert(float3 albedo, float3 normal) {
  float diffuse = max(0.0, Dot3(UnitOr(normal, float3(0, 0, 1)), -lightDirection.xyz));
  return lightAmbient.rgb * albedo + lightDiffuse.rgb * albedo * diffuse;
}

// Under the fur: furLight.x is what the hairs' shadow leaves of the light.
float3 SkinLambert(float3 albedo, float3 normal) { return Lambert(albedo, normal) * furLight.x; }

// Of hair: furLight.y is left of the light between the hairs near the skin, all of it on a thick hair's tip. Mostly by
// how thick the hair is, which does not depend on the height: shells made triangle by triangle are not in order where
// they overlap a neighbour's, and a strong ramp by height would show every edge (docs/presets.md).
float3 HairLambert(float3 albedo, float3 normal, float thickness, float height) {
  float open = 0.75 * sqrt(thickness) + 0.25 * height;
  return Lambert(albedo, normal) * (furLight.y + (1.0 - furLight.y) * open);
}

#endif

// Fur lighting after Kajiya and Kay (SIGGRAPH 1989), as a function of the strand's tangent. docs/accuracy.md states the
// equations of both looks.
#ifndef FUR_LIGHT_HLSLI
#define FUR_LIGHT_HLSLI
#include "fur_constants.h"
#include "math.hlsli"

// Strands that differ within the pixel widen a highlight. Tilts of variance `spread` about each axis turn its angle, that of
// l plus or minus that of e, by a variance of spread |u_l +- u_e|^2 = 2 spread (1 +- u_l.u_e), u the unit parts across the
// strand (acrossDot: their product before they are made unit, sines: that of their lengths). A lobe exp(-p x^2 / 2) seen
// through that is one of exponent p / w, lower by sqrt(w). For normals: M. Toksvig, "Mipmapping normal maps", 2005.
float Widening(float acrossDot, float sines, float spread, float turn) {
  float together = clamp(acrossDot / max(sines, 1e-6), -1.0, 1.0);
  return 1.0 + 2.0 * furLight.y * spread * (1.0 + turn * together);
}
float WideLobe(float cosine, float widening) { return pow(cosine, furLight.y / widening) / sqrt(widening); }

// As published (Habr's demo): light and eye vectors both point along the ray, the diffuse term is inverted, the specular
// sign puts the lobe at the retro cone, and nothing guards the square roots. Kept as the baseline's look.
float3 SeedColor(float3 albedo, float sinTl, float lobe) {
  return (lightAmbient.rgb * albedo + lightDiffuse.rgb * (1.0 - sinTl) * albedo) + lightSpecular.rgb * lobe * furLight.z;
}

float3 SeedFurLight(float3 albedo, float3 strand, float3 fromEye) {
  float3 view = Unit3(fromEye);
  float tl = Dot3(strand, lightDirection.xyz);
  float te = Dot3(strand, view);
  float sinTl = sqrt(1.0 - tl * tl);
  float sinTe = sqrt(1.0 - te * te);
  return SeedColor(albedo, sinTl, pow(abs(tl * te + sinTl * sinTe), furLight.y));
}

// The same for strands that differ by `spread`; the roots are guarded.
float3 SeedFurLight(float3 albedo, float3 strand, float3 fromEye, float spread) {
  float3 view = UnitOr(fromEye, float3(0, 0, 1));
  float tl = Dot3(strand, lightDirection.xyz);
  float te = Dot3(strand, view);
  float sinTl = sqrt(max(0.0, 1.0 - tl * tl));
  float sinTe = sqrt(max(0.0, 1.0 - te * te));
  float widening = Widening(Dot3(lightDirection.xyz, view) - tl * te, sinTl * sinTe, spread, -1.0);
  return SeedColor(albedo, sinTl, WideLobe(abs(tl * te + sinTl * sinTe), widening));
}

static const float kWrap = 0.5;  // how far light reaches around the body: g = (n.l + wrap) / (1 + wrap)
// Share of the diffuse light that neighbouring strands have scattered before: it no longer knows the strand's direction,
// and what it keeps is the mean of the sine over all directions, pi / 4.
static const float kScattered = 0.5;
static const float kMeanSine = 0.785398163;

// Look correct: strand and surface normal are unit; height 0 root .. 1 tip; spread: of the strands in the pixel, 0: none.
float3 FurLight(float3 albedo, float3 strand, float3 normal, float3 fromEye, float height, float spread) {
  float3 toLight = -lightDirection.xyz;
  float3 toEye = -UnitOr(fromEye, float3(0, 0, 1));
  float tl = Dot3(strand, toLight);
  float te = Dot3(strand, toEye);
  float sinTl = sqrt(max(0.0, 1.0 - tl * tl));
  float sinTe = sqrt(max(0.0, 1.0 - te * te));
  float facing = saturate((Dot3(normal, toLight) + kWrap) / (1.0 + kWrap));
  float widening = Widening(Dot3(toLight, toEye) - tl * te, sinTl * sinTe, spread, 1.0);
  float lobe = WideLobe(max(0.0, sinTl * sinTe - tl * te), widening) * facing;
  float ramp = furLight.x + (1.0 - furLight.x) * height;
  float diffuse = sinTl * (1.0 - kScattered) + kMeanSine * kScattered;
  float3 direct = lightDiffuse.rgb * albedo * (diffuse * facing) + lightSpecular.rgb * (lobe * furLight.z);
  return (lightAmbient.rgb * albedo + direct) * ramp;
}

#endif

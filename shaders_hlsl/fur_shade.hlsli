// The pixel of shells and fins: coverage and colour of the fur at a place and a height, premultiplied.
// Variants: LOOK_SEED (published lighting), VOLUME (opacity by path length), BETWEEN_SLICES (a shell may lie between two
// slices of the volume; without it each lies on one).
#ifndef FUR_SHADE_HLSLI
#define FUR_SHADE_HLSLI
#include "fur_light.hlsli"
#include "fur_point.hlsli"
#include "fur_volume.hlsli"

static const float kMostCoverage = 0.999;

// Coverage and packed tangent, linear between slices: slice j is centred at (j + 1/2) / N0, and clamped at the ends.
// The height falloff holds at the slices: a_j (1 - f j / N0).
float4 ReadFur(float2 tiles, float height) {
  float slice = clamp(height * furShape.z - 0.5, 0.0, furShape.z - 1.0);
#ifdef BETWEEN_SLICES
  float below = floor(slice);
  float above = min(below + 1.0, furShape.z - 1.0);
  float4 lower = furVolume.Sample(volumeSampler, float3(tiles, below));
  float4 fur = lower + (furVolume.Sample(volumeSampler, float3(tiles, above)) - lower) * (slice - below);
#else
  float4 fur = furVolume.Sample(volumeSampler, float3(tiles, slice));
#endif
  fur.a = min(fur.a * (1.0 - furLight.w * slice / furShape.z), kMostCoverage);
  return fur;
}

// The share of the published slab's opacity that this shell stands for: 1 - (1 - a)^(N0 / N), and in a volume the way
// through the slab is longer by 1 / |m.w|, m the normal of the shell's own surface.
float ShellAlpha(float coverage, float3 fromEye) {
  float exponent = furSemantics.y;
#ifdef VOLUME
  float3 m = Cross3(ddx(fromEye), ddy(fromEye));
  float cosine = abs(Dot3(UnitOr(m, float3(0, 0, 1)), UnitOr(fromEye, float3(0, 0, 1))));
  exponent = exponent / max(cosine, furSemantics.x);
#endif
  return 1.0 - pow(1.0 - coverage, exponent);
}

float3 FurColor(FurVarying v, float3 packedTangent) {
  float3 albedo = baseColorMap.Sample(surfaceSampler, v.uv.xy).rgb;
  float3 normal = UnitOr(v.normal, float3(0, 0, 1));
  float3 axis = UnitOr(v.direction, normal);
  float3 tangent = UnitOr(v.tangent.xyz - axis * Dot3(v.tangent.xyz, axis), float3(1, 0, 0));
#ifdef LOOK_SEED
  float3 strand = UnitOr(FromFrame(UnpackStrand(packedTangent), tangent, Cross3(axis, tangent), axis), axis);
  float3 color = SeedFurLight(albedo, strand, v.fromEye);
  // The published ramp is stated at the slices, of which slice j is centred at (j + 1/2) / N0.
  float height = max(v.fur.x - 0.5 / furShape.z, 0.0);
  return color * (height * (1.0 - furLight.x) + furLight.x);
#else
  float3 bitangent = Cross3(axis, tangent) * (v.tangent.w < 0.0 ? -1.0 : 1.0);
  float3 strand = UnitOr(FromFrame(UnpackStrand(packedTangent), tangent, bitangent, axis), axis);
  return FurLight(albedo * baseColor.rgb, strand, normal, v.fromEye, v.fur.x);
#endif
}

// The length map at the fragment ends the fur where the strand would be longer than it says.
float InsideFur(FurVarying v) {
  float furLength = lengthMap.Sample(surfaceSampler, v.uv.xy).r;
  return v.fur.x * v.fur.y <= furLength ? 1.0 : 0.0;
}

#endif

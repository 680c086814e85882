// The pixel of shells and fins: coverage and colour of the fur at a place and a height, premultiplied.
// Variants: LOOK_SEED (published lighting), VOLUME (opacity by path length), BETWEEN_SLICES (of the whole volume, linear
// between two slices; without it each shell has a slice of its own), GROOM (clumps, density, colours: fur_groom.hlsli), TINT
// (the strands have colours of their own; look correct).
#ifndef FUR_SHADE_HLSLI
#define FUR_SHADE_HLSLI
#ifdef GROOM
#include "fur_groom.hlsli"
#endif
#include "fur_light.hlsli"
#include "fur_point.hlsli"
#include "fur_volume.hlsli"

static const float kMostCoverage = 0.999;
static const float kVolumeMipBiasSquared = 0.25;  // 4^fur::kVolumeMipBias

struct Fur {
  float3 packed;    // tangent
  float coverage;
  float2 lean;      // GROOM: towards the middle of the clump
  float crowding;   // GROOM: exponent of 1 - coverage
  float3 own;       // TINT: factor of the colour
};

#ifdef GROOM
#define READ_SLICE(map) map.SampleGrad(volumeSampler, float3(tiles, slice), dx, dy)
#else
#define READ_SLICE(map) map.Sample(volumeSampler, float3(tiles, slice))
#endif

// The number of the shell at a height (i + 1/2) / N.
float ShellOf(float height) { return height * furShape.w - 0.5; }

float4 ReadSlice(float2 tiles, float slice, float2 dx, float2 dy) { return READ_SLICE(furVolume); }

// Coverage and packed tangent, linear between slices: slice j is centred at (j + 1/2) / N0, and clamped at the ends.
// The height falloff holds at the slices: a_j (1 - f j / N0).
float4 ReadVolume(float2 tiles, float height, float2 dx, float2 dy) {
  float slice = clamp(height * furShape.z - 0.5, 0.0, furShape.z - 1.0);
#ifdef BETWEEN_SLICES
  float below = floor(slice);
  float above = min(below + 1.0, furShape.z - 1.0);
  float4 lower = ReadSlice(tiles, below, dx, dy);
  float4 fur = lower + (ReadSlice(tiles, above, dx, dy) - lower) * (slice - below);
#else
  float4 fur = ReadSlice(tiles, ShellOf(height), dx, dy);
#endif
  fur.a = min(fur.a * (1.0 - furLight.w * slice / furShape.z), kMostCoverage);
  return fur;
}

#ifdef TINT
float3 ReadTintSlice(float2 tiles, float slice, float2 dx, float2 dy) { return READ_SLICE(furTint).rgb; }

// The factor of the fur's colour, linear between slices as all else.
float3 ReadTint(float2 tiles, float height, float2 dx, float2 dy) {
  float slice = clamp(height * furShape.z - 0.5, 0.0, furShape.z - 1.0);
#ifdef BETWEEN_SLICES
  float below = floor(slice);
  float above = min(below + 1.0, furShape.z - 1.0);
  float3 lower = ReadTintSlice(tiles, below, dx, dy);
  float3 own = lower + (ReadTintSlice(tiles, above, dx, dy) - lower) * (slice - below);
#else
  float3 own = ReadTintSlice(tiles, ShellOf(height), dx, dy);
#endif
  return 1.0 + (own * (255.0 / 128.0) - 1.0) * furSemantics.w;
}
#else
float3 ReadTint(float2 tiles, float height, float2 dx, float2 dy) { return float3(1, 1, 1); }
#endif

Fur ReadFur(float2 tiles, float height) {
  Fur fur;
#ifdef GROOM
  Clump clump = FindClump(tiles, height);
  float4 read = ReadVolume(clump.root, height, clump.dx, clump.dy);
  fur.coverage = read.a * clump.inside;
  fur.own = ReadTint(clump.root, height, clump.dx, clump.dy);
  fur.lean = clump.lean;
  // Strands that stand closer together are more of them on the way of light.
  fur.crowding = groom.x * (clump.spread * clump.spread);
#else
  float4 read = ReadVolume(tiles, height, float2(0, 0), float2(0, 0));
  fur.coverage = read.a;
  fur.own = ReadTint(tiles, height, float2(0, 0), float2(0, 0));
  fur.lean = float2(0, 0);
  fur.crowding = 1.0;
#endif
  fur.packed = read.rgb;
  return fur;
}

// Of a fin: what it reads is one slab.
float FinAlpha(Fur fur) {
#ifdef GROOM
  return SlabOpacity(fur.coverage, fur.crowding);
#else
  return fur.coverage;
#endif
}

// The share of the published slab's opacity that this shell stands for: 1 - (1 - a)^(N0 / N), and in a volume the way
// through the slab is longer by 1 / |m.w|, m the normal of the shell's own surface.
float ShellAlpha(Fur fur, float3 fromEye) {
  float exponent = furSemantics.y;
#ifdef GROOM
  exponent = exponent * fur.crowding;
#endif
#ifdef VOLUME
  float3 m = Cross3(ddx(fromEye), ddy(fromEye));
  float cosine = abs(Dot3(UnitOr(m, float3(0, 0, 1)), UnitOr(fromEye, float3(0, 0, 1))));
  exponent = exponent / max(cosine, furSemantics.x);
#endif
  return SlabOpacity(fur.coverage, exponent);
}

float3 StrandIn(Fur fur) {
  float3 strand = UnpackStrand(fur.packed);
#ifdef GROOM
  strand.xy += fur.lean * strand.z;
#endif
  return strand;
}

// What of a shortened mean is the strands' own spread: the rest is the filter's mixing of neighbours, which mip 0 has too.
static const float kSpreadShare = 0.6;

// Variance of the strands' tilt about each axis where the volume is minified: the mean of unit directions is shorter by as
// much. At mip 0, none: the fur model filters packed directions and makes them unit.
float StrandSpread(Fur fur, float2 tiles) {
  uint width, height, slices;
  furVolume.GetDimensions(width, height, slices);
  float2 dx = ddx(tiles) * float2(width, height), dy = ddy(tiles) * float2(width, height);
  float footprint = max(dx.x * dx.x + dx.y * dx.y, dy.x * dy.x + dy.y * dy.y) * kVolumeMipBiasSquared;
  float minified = saturate((footprint - 1.0) / 3.0);  // 0 at mip 0, 1 from mip 1 on
  float3 t = fur.packed * 2.0 - 1.0;
  float square = Dot3(t, t);
  return square < kLeastPacked ? 0.0 : saturate(1.0 - sqrt(square)) * (minified * kSpreadShare);
}

// The base colour, and in alpha the length map, by which the fur ends where the strand would be longer than it says.
float4 ReadSurface(FurVarying v) { return baseColorMap.Sample(surfaceSampler, v.uv.xy); }

float InsideFur(FurVarying v, float4 surfaceTexel) { return v.fur.x * v.fur.y <= surfaceTexel.a ? 1.0 : 0.0; }

float3 FurAlbedo(FurVarying v, Fur fur, float4 surfaceTexel) {
  float3 albedo = surfaceTexel.rgb;
#ifndef LOOK_SEED
  albedo *= baseColor.rgb;
#endif
#ifdef GROOM
  albedo = GroomedAlbedo(albedo, v.fur.x, fur.own);
#elif defined(TINT)
  albedo = min(albedo * fur.own, 1.0);
#endif
  return albedo;
}

float3 FurColor(FurVarying v, Fur fur, float4 surfaceTexel) {
  float3 albedo = FurAlbedo(v, fur, surfaceTexel);
  float3 normal = UnitOr(v.normal, float3(0, 0, 1));
  float3 axis = UnitOr(v.direction, normal);
  float3 tangent = UnitOr(v.tangent.xyz - axis * Dot3(v.tangent.xyz, axis), float3(1, 0, 0));
#ifdef LOOK_SEED
  float3 strand = UnitOr(FromFrame(StrandIn(fur), tangent, Cross3(axis, tangent), axis), axis);
  float3 color = SeedFurLight(albedo, strand, v.fromEye, StrandSpread(fur, v.uv.zw));
  // The published ramp is stated at the slices, of which slice j is centred at (j + 1/2) / N0.
  float height = max(v.fur.x - 0.5 / furShape.z, 0.0);
  return color * (height * (1.0 - furLight.x) + furLight.x);
#else
  float3 bitangent = Cross3(axis, tangent) * (v.tangent.w < 0.0 ? -1.0 : 1.0);
  float3 strand = UnitOr(FromFrame(StrandIn(fur), tangent, bitangent, axis), axis);
  return FurLight(albedo, strand, normal, v.fromEye, v.fur.x, StrandSpread(fur, v.uv.zw));
#endif
}

#endif

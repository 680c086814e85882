// Textures of a furred material and the reading of its volume.
#ifndef FUR_VOLUME_HLSLI
#define FUR_VOLUME_HLSLI
#include "fur_constants.h"
#include "math.hlsli"

Texture2D baseColorMap : register(t0);
Texture2D lengthMap : register(t3);
Texture2DArray furVolume : register(t4);  // rgb: packed tangent, a: coverage
#ifdef TINT
Texture2DArray furTint : register(t8);    // rgb: factor of the colour, byte / 128
#endif
SamplerState surfaceSampler : register(s0);
SamplerState volumeSampler : register(s1);

static const float kLeastPacked = 1.0 / 4096.0;

// Unpacks a strand direction in tangent space. |2 rgb - 1| < 1/64 means "no direction": straight up.
float3 UnpackStrand(float3 packed) {
  float3 t = packed * 2.0 - 1.0;
  return Dot3(t, t) < kLeastPacked ? float3(0, 0, 1) : Unit3(t);
}

// Of `exponent` slabs of this coverage behind each other: 1 - (1 - a)^e.
float SlabOpacity(float coverage, float exponent) { return 1.0 - pow(1.0 - coverage, exponent); }

#endif

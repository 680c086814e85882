// The sideways offset c of a strand's tip, in lengths of the fur: fur/groom.h in floats.
// Variant SWAY: gravity and wind, which differ from vertex to vertex.
#ifndef FUR_SWAY_HLSLI
#define FUR_SWAY_HLSLI
#include "fur_constants.h"
#include "math.hlsli"

#ifdef SWAY
// sin(2 pi turns) to 4e-6, by its series over a quarter: drivers' own sines differ.
float SineOfTurns(float turns) {
  float t = turns - floor(turns + 0.5);
  float x = (0.25 - abs(abs(t) - 0.25)) * 6.2831853;
  float s = x * x;
  float sine = x * (1.0 + s * (-1.0 / 6.0 + s * (1.0 / 120.0 + s * (-1.0 / 5040.0 + s * (1.0 / 362880.0)))));
  return t < 0.0 ? -sine : sine;
}

float WindAt(float3 position) {
  float turns = Dot3(windWave.xyz, position) - windWave.w;
  return (0.5 + 0.5 * SineOfTurns(turns)) * (0.625 + 0.375 * SineOfTurns(turns * 0.25));
}

float3 TipOffset(float3 position, float3 direction) {
  float3 fall = gravity.xyz - direction * Dot3(gravity.xyz, direction);
  return (comb.xyz + wind.xyz * WindAt(position)) + fall;
}
#else
float3 TipOffset(float3 position, float3 direction) { return comb.xyz; }
#endif

#endif

// The furred vertex and where it stands at a height: X(h) = p + h l d + h^k l c (docs/accuracy.md).
#ifndef FUR_POINT_HLSLI
#define FUR_POINT_HLSLI
#include "fur_constants.h"
#include "fur_sway.hlsli"
#include "math.hlsli"

struct FurVertex {  // fur::FurVertex
  float4 position : POSITION;    // xyz, w: length relative to the material's, at the welded vertex
  float4 direction : NORMAL;     // xyz: unit fur direction, welded by position; w: u of the model's maps
  float4 tangent : TANGENT;      // of the fur's texture coordinates; w: handedness
  float4 normal : TEXCOORD0;     // xyz: shading normal; w: v of the model's maps
  float4 furUv : TEXCOORD1;      // xy: tiles of the volume
};

struct FurVarying {
  float4 position : SV_Position;
  float4 uv : TEXCOORD0;         // xy: the model's maps, zw: tiles of the volume
  float3 fur : TEXCOORD1;        // x: height, y: relative length, z: opacity of the fin, or where it is along its edge
  float3 normal : TEXCOORD2;     // world axes, from here on
  float3 direction : TEXCOORD3;  // of the strand's axis at this height
  float4 tangent : TEXCOORD4;
  float3 fromEye : TEXCOORD5;
#ifdef FIN_IN_VOLUME
  float4 before : TEXCOORD6;     // fin_volume.hlsli
  float4 behind : TEXCOORD7;
#endif
};
// Scalars of a FurVarying: 4 + 4 + 3 + 3 + 3 + 4 + 3. A geometry shader may emit 1,024 (Direct3D 10, Vulkan's and GL's
// floor), so at most 42 vertices, 14 shells of a triangle.
#define FUR_VARYING_SCALARS 24
#define FUR_SHELLS_IN_GS 14

float3 PlaceAt(FurVertex v, float3 tip, float height) {
  float furLength = v.position.w * furShape.x;
  // Not 0: pow(0, 0) is not 1 everywhere.
  float h = max(height, 1e-6);
  return v.position.xyz + (v.direction.xyz * (height * furLength) + tip * (pow(h, comb.w) * furLength));
}

float3 PlaceAt(FurVertex v, float height) { return PlaceAt(v, TipOffset(v.position.xyz, v.direction.xyz), height); }

FurVarying PointAt(FurVertex v, float height, float opacity) {
  float h = max(height, 1e-6);
  float3 tip = TipOffset(v.position.xyz, v.direction.xyz);
  float3 p = PlaceAt(v, tip, height);
  FurVarying o;
  o.position = TransformPoint(objectToClip, p);
  o.uv = float4(v.direction.w, v.normal.w, v.furUv.xy);
  o.fur = float3(height, v.position.w, opacity);
  o.normal = TransformVector(normalToWorld, v.normal.xyz);
  o.direction = TransformVector(objectToEye, v.direction.xyz + tip * (comb.w * pow(h, comb.w - 1.0)));
  o.tangent = float4(TransformVector(objectToEye, v.tangent.xyz), v.tangent.w * normalToWorld[3].w);
  o.fromEye = TransformPoint(objectToEye, p).xyz;
#ifdef FIN_IN_VOLUME
  o.before = float4(0, 0, 0, 0);
  o.behind = float4(0, 0, 0, 0);
#endif
  return o;
}

// Shells stand at the middle of their slab.
float ShellHeight(uint instance) { return (draw.x + draw.y * float(instance) + 0.5) / furShape.w; }

#endif

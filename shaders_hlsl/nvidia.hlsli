// Preset nvidia-d3d10 (the first description; docs/presets.md): the length is the alpha of the colour texture, a global
// comb bends the fur, and Kajiya-Kay lights it.
#ifndef FUR_NVIDIA_HLSLI
#define FUR_NVIDIA_HLSLI
#include "fur_constants.h"
#include "fur_volume.hlsli"
#include "math.hlsli"

static const float kLeastLength = 0.2;  // the shells' increment is scaled by max(alpha, this)
static const float kBald = 0.01;        // alpha below it is "no fur" (an 8-bit alpha of 0 to 2)

struct FurPixel {
  float4 position : SV_Position;
  float4 uvLayer : TEXCOORD0;  // z: slice, w: opacity of a fin
  float3 normal : TEXCOORD1;
  float4 tangent : TEXCOORD2;
  float3 fromEye : TEXCOORD3;
};

float LengthAlpha(float2 uv) { return baseColorMap.SampleLevel(surfaceSampler, uv, 0).a; }

// p + (n + s comb) d k max(a, 0.2): comb.xyz is s comb, furSemantics.z the spacing d.
float3 Combed(float3 p, float3 normal, float alpha, float k) {
  return p + (Unit3(normal) + comb.xyz) * (furSemantics.z * k * max(alpha, kLeastLength));
}

FurPixel MakePixel(float3 p, float3 normal, float4 tangent, float4 uvLayer) {
  FurPixel o;
  o.position = TransformPoint(objectToClip, p);
  o.uvLayer = uvLayer;
  o.normal = TransformVector(normalToWorld, Unit3(normal));
  o.tangent = float4(TransformVector(objectToEye, tangent.xyz), tangent.w);
  o.fromEye = TransformPoint(objectToEye, p).xyz;
  return o;
}

// Kajiya and Kay with ka, kd and ks in the light's colours. As published the lobe is that of two vectors on one side of
// the fibre, (T.L)(T.E) + sin(T,L) sin(T,E); the diffuse term is sin(T,L). The roots are guarded against NaN.
float3 NvidiaLight(float3 albedo, float3 strand, float3 fromEye, float height) {
  float3 toLight = -lightDirection.xyz;
  float3 toEye = -UnitOr(fromEye, float3(0, 0, 1));
  float tl = Dot3(strand, toLight);
  float te = Dot3(strand, toEye);
  float sinTl = sqrt(max(0.0, 1.0 - tl * tl));
  float sinTe = sqrt(max(0.0, 1.0 - te * te));
  float lobe = pow(max(0.0, tl * te + sinTl * sinTe), furLight.y);
  float3 color = lightAmbient.rgb * albedo + lightDiffuse.rgb * albedo * sinTl + lightSpecular.rgb * lobe;
  return color * (furLight.x + (1.0 - furLight.x) * height);
}

// `opacity`: of the whole fin. Shells do not read theirs from the vertex: a driver that sees a constant leave the
// vertex shader puts it into the pixel shader, another interpolates it to nearly 1, and an opacity half way between two
// steps of 8 bits is rounded apart.
float4 ShadePixel(FurPixel v, float opacity) {
  float4 fur = furVolume.Sample(volumeSampler, float3(v.uvLayer.xy * furShape.y, v.uvLayer.z));
  float4 color = baseColorMap.Sample(surfaceSampler, v.uvLayer.xy);
  if (color.a < kBald || fur.a < 0.01) discard;
  float height = v.uvLayer.z / furShape.z;
  float3 normal = UnitOr(v.normal, float3(0, 0, 1));
  float3 tangent = UnitOr(v.tangent.xyz, float3(1, 0, 0));
  float3 side = Cross3(normal, tangent) * v.tangent.w;
  float3 strand = UnitOr(FromFrame(UnpackStrand(fur.rgb), tangent, side, normal), normal);
  float alpha = fur.a * (1.0 - furLight.w * height) * opacity;
  return float4(NvidiaLight(color.rgb, strand, v.fromEye, height), alpha);
}

#endif

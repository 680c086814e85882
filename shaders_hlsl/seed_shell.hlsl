// Shells of the seed technique: one instance for each shell, displaced along the vertex normal, inside out.
// Variants: LOOK_SEED (published lighting), VOLUME (opacity by path length, see docs/accuracy.md).
#include "fur_constants.h"
#include "fur_light.hlsli"
#include "fur_volume.hlsli"
#include "math.hlsli"
#include "vertex.hlsli"

struct ShellVarying {
  float4 position : SV_Position;
  float3 uvLayer : TEXCOORD0;  // z: slice
  float3 normal : TEXCOORD1;
  float4 tangent : TEXCOORD2;
  float3 fromEye : TEXCOORD3;
};

ShellVarying VSMain(VertexIn v, uint shell : SV_InstanceID) {
  float shells = furShape.w;
  float furLength = lengthMap.SampleLevel(surfaceSampler, v.uv, 0).r;
  float3 p = v.position + Unit3(v.normal) * furLength * furShape.x * float(shell + 1) / shells;
  ShellVarying o;
  o.position = TransformPoint(objectToClip, p);
  o.uvLayer = float3(v.uv, float(shell) * furShape.z / shells);
  o.normal = TransformVector(normalToWorld, Unit3(v.normal));
  o.tangent = float4(TransformVector(objectToEye, v.tangent.xyz), v.tangent.w);
  o.fromEye = TransformPoint(objectToEye, p).xyz;
  return o;
}

#ifdef VOLUME
// A slab is crossed over 1 / |m.w| of its thickness; m is the normal of the shell surface itself.
float PathLengthAlpha(float alpha, float3 fromEye) {
  float3 m = Cross3(ddx(fromEye), ddy(fromEye));
  float cosine = abs(Dot3(UnitOr(m, float3(0, 0, 1)), UnitOr(fromEye, float3(0, 0, 1))));
  return 1.0 - pow(1.0 - min(alpha, 0.999), 1.0 / max(cosine, furSemantics.x));
}
#endif

float4 PSMain(ShellVarying v) : SV_Target {
  float4 fur = furVolume.Sample(volumeSampler, float3(v.uvLayer.xy * furShape.y, v.uvLayer.z));
  if (fur.a < 0.01) discard;
  float height = v.uvLayer.z / furShape.z;
  float3 albedo = baseColorMap.Sample(surfaceSampler, v.uvLayer.xy).rgb;
  float alpha = fur.a * (1.0 - furLight.w * height);
#ifdef LOOK_SEED
  float3 t = Unit3((fur.rgb - 0.5) * 2.0);
  float3 strand = Unit3(FromFrame(t, v.tangent.xyz, Cross3(v.normal, v.tangent.xyz), v.normal));
  float3 color = SeedFurLight(albedo, strand, v.fromEye);
  color *= height * (1.0 - furLight.x) + furLight.x;
#else
  float3 normal = UnitOr(v.normal, float3(0, 0, 1));
  float3 tangent = UnitOr(v.tangent.xyz, float3(1, 0, 0));
  float3 strand = UnitOr(FromFrame(UnpackStrand(fur.rgb), tangent, Cross3(normal, tangent) * v.tangent.w, normal), normal);
  float3 color = FurLight(albedo * baseColor.rgb, strand, normal, v.fromEye, height, 0.0);
#endif
#ifdef VOLUME
  alpha = PathLengthAlpha(alpha, v.fromEye);
#endif
  return float4(color, alpha);
}

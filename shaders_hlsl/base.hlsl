// The solid pass: skin and bald parts, Blinn-Phong with a normal map and a specular map.
// Variants: LOOK_SEED: the published demo's lighting, value for value; WET: the skin under wet fur is dark too.
#include "fur_constants.h"
#include "base_varying.hlsli"
#include "math.hlsli"
#include "vertex.hlsli"

Texture2D baseColorMap : register(t0);
Texture2D normalMap : register(t1);
Texture2D specularMap : register(t2);
SamplerState surfaceSampler : register(s0);

BaseVarying VSMain(VertexIn v) {
  BaseVarying o;
  o.position = TransformPoint(objectToClip, v.position);
  o.uv = v.uv;
  o.normal = TransformVector(normalToWorld, v.normal);
  o.tangent = float4(TransformVector(objectToEye, v.tangent.xyz), v.tangent.w * normalToWorld[3].w);
  o.fromEye = TransformPoint(objectToEye, v.position).xyz;
  return o;
}

float3 ShadingNormal(BaseVarying v) {
  float3 t = normalMap.Sample(surfaceSampler, v.uv).rgb * 2.0 - 1.0;
#ifdef LOOK_SEED
  // The published map is green-down and its handedness is +1 everywhere; the asset was converted to glTF's green-up.
  t = Unit3(float3(t.x, -t.y, t.z));
  return Unit3(FromFrame(t, v.tangent.xyz, Cross3(v.normal, v.tangent.xyz), v.normal));
#else
  float3 n = UnitOr(v.normal, float3(0, 0, 1));
  if (surface.y == 0.0) return n;
  t = float3(t.xy * surface.x, t.z);
  float3 tangent = UnitOr(v.tangent.xyz, float3(1, 0, 0));
  return UnitOr(FromFrame(t, tangent, Cross3(n, tangent) * v.tangent.w, n), n);
#endif
}

float4 PSMain(BaseVarying v) : SV_Target {
  float3 albedo = baseColorMap.Sample(surfaceSampler, v.uv).rgb * baseColor.rgb;
#ifdef WET
  albedo = pow(clamp(albedo, 1e-6, 1.0), groom.w);
#endif
  float3 gloss = specularMap.Sample(surfaceSampler, v.uv).rgb * specular.rgb;
  float3 n = ShadingNormal(v);
  float3 toLight = -lightDirection.xyz;
  float3 toEye = -Unit3(v.fromEye);
  float3 halfway = UnitOr(toLight + toEye, n);
  float diffuse = max(0.0, Dot3(n, toLight));
  float highlight = pow(max(Dot3(n, halfway), 0.0), specular.w);
#ifndef LOOK_SEED
  highlight = diffuse > 0.0 ? highlight : 0.0;
#endif
  float3 color = (lightAmbient.rgb * albedo + lightDiffuse.rgb * albedo * diffuse) + lightSpecular.rgb * gloss * highlight;
  return float4(saturate(color), 1.0);
}

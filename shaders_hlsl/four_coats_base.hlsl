// The skin of preset four-coats: simple Lambert, darkened a little for the shadow that the hairs would cast.
#include "base_varying.hlsli"
#include "four_coats.hlsli"

float4 PSMain(BaseVarying v) : SV_Target {
  float3 albedo = baseColorMap.Sample(surfaceSampler, v.uv).rgb;
  return float4(saturate(SkinLambert(albedo, v.normal)), 1.0);
}

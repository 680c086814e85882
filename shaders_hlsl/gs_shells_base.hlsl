// The skin of preset gs-shells: Lambert's light in the fur's shadow; on furless spots their own texture, in the open.
#include "base_varying.hlsli"
#include "gs_shells.hlsli"

float4 PSMain(BaseVarying v) : SV_Target {
  float4 spot = spotMap.Sample(surfaceSampler, v.uv);
  float3 skin = SkinLambert(baseColorMap.Sample(surfaceSampler, v.uv).rgb, v.normal);
  return float4(saturate(skin + (Lambert(spot.rgb, v.normal) - skin) * spot.a), 1.0);
}

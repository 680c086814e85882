// Shells of the technique `shells`: one copy of the skin for each, displaced along the fur's direction, at the middle of
// the slab that it stands for. The variants of the pixel shader are fur_shade.hlsli's.
#include "fur_shade.hlsli"

FurVarying VSMain(FurVertex v, uint instance : SV_InstanceID) { return PointAt(v, ShellHeight(instance), 1.0); }

float4 PSMain(FurVarying v) : SV_Target {
  float4 texel = ReadSurface(v);
  Fur fur = ReadFur(v.uv.zw, v.fur.x);
  float alpha = ShellAlpha(fur, v.fromEye) * InsideFur(v, texel);
  return float4(FurColor(v, fur, texel) * alpha, alpha);
}

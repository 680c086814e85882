// Shells of preset nvidia-d3d10: a draw for each shell, inside out; b3 says which.
#include "nvidia.hlsli"
#include "vertex.hlsli"

FurPixel VSMain(VertexIn v) {
  float3 p = Combed(v.position, v.normal, LengthAlpha(v.uv), draw.x + 1.0);
  return MakePixel(p, v.normal, v.tangent, float4(v.uv, draw.x * furShape.z / furShape.w, 0.0));
}

float4 PSMain(FurPixel v) : SV_Target { return ShadePixel(v, 1.0); }

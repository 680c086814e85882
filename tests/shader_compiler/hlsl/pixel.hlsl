#include "common.hlsl"
Texture2DMS<float4> samples : register(t0);
Texture2D<uint4> ids : register(t4);
TextureCube sky : register(t5);
Texture3D volume : register(t6);
Texture2D shadow : register(t7);
SamplerState linearWrap : register(s0);
SamplerComparisonState compare : register(s3);

struct Output { float4 color : SV_Target0; float4 more : SV_Target1; float depth : SV_Depth; uint coverage : SV_Coverage; };

Output PSAll(Varyings i, uint sampleIndex : SV_SampleIndex, uint primitive : SV_PrimitiveID) {
  Output o;
  uint w, h, levels;
  ids.GetDimensions(0, w, h, levels);
  o.color = samples.Load(int2(i.position.xy), sampleIndex) + float4(ids.Load(int3(1, 2, 0)));
  o.more = sky.Sample(linearWrap, i.normal) + volume.SampleLevel(linearWrap, i.normal, float(w));
  o.more.x += shadow.SampleCmpLevelZero(compare, i.uv, i.position.z) + float(primitive);
  o.depth = i.position.z * 0.5;
  o.coverage = 3;
  return o;
}

[earlydepthstencil]
float4 PSEarly(Varyings i) : SV_Target { return float4(ddx(i.uv), ddy(i.uv)) * drawTable[1]; }

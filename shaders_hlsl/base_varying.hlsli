// What the solid pass hands to its pixel shaders.
#ifndef FUR_BASE_VARYING_HLSLI
#define FUR_BASE_VARYING_HLSLI

struct BaseVarying {
  float4 position : SV_Position;
  float2 uv : TEXCOORD0;
  float3 normal : TEXCOORD1;
  float4 tangent : TEXCOORD2;
  float3 fromEye : TEXCOORD3;  // world axes
};

#endif

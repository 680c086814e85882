// The one vertex format (fur::Vertex).
#ifndef FUR_VERTEX_HLSLI
#define FUR_VERTEX_HLSLI

struct VertexIn {
  float3 position : POSITION;
  float3 normal : NORMAL;
  float4 tangent : TANGENT;
  float2 uv : TEXCOORD0;
};

#endif

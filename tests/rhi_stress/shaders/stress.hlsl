// Rectangles, from nothing or from vertices, tinted or textured, and through a geometry shader.
cbuffer Draw : register(b3) {  // DrawConstants of rig.h
  float4 tint;
  float4 rectangle;  // left, top, right, bottom in clip space
};
Texture2D picture : register(t0);
SamplerState picked : register(s0);

struct Varying {
  float4 position : SV_Position;
  float2 uv : TEXCOORD0;
};

float4 Corner(float2 uv) {
  float2 p = rectangle.xy + uv * (rectangle.zw - rectangle.xy);
  return float4(p, 0.5, 1.0);
}

Varying VSRect(uint id : SV_VertexID) {
  Varying o;
  o.uv = float2(id & 1u, id >> 1u);
  o.position = Corner(o.uv);
  return o;
}

struct Vertex {
  float2 uv : POSITION;
};
Varying VSMesh(Vertex v) {
  Varying o;
  o.uv = v.uv;
  o.position = Corner(v.uv);
  return o;
}

#if defined(GEOMETRY)
[maxvertexcount(3)]
void GSMain(triangle Varying v[3], inout TriangleStream<Varying> stream) {
  [unroll] for (uint i = 0u; i < 3u; ++i) stream.Append(v[i]);
}
#endif

float4 PSTint(Varying v) : SV_Target { return tint; }
float4 PSTinted(Varying v) : SV_Target { return tint.bgra; }
float4 PSPicture(Varying v) : SV_Target { return picture.Sample(picked, v.uv) * tint; }

RWStructuredBuffer<uint4> words : register(u0);
[numthreads(4, 1, 1)]
void CSFill(uint3 id : SV_DispatchThreadID) {
  words[id.x] = uint4(id.x, 1u, 2u, 3u);
}

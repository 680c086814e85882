// Compute shaders: the draws' arguments and data are written on the GPU.
struct Item {
  float4 value;
};
cbuffer Draw : register(b3) {
  float4 tint;
  float4 rectangle;
  float4 extra;
};
RWStructuredBuffer<Item> target : register(u0);
RWStructuredBuffer<uint> arguments : register(u1);
RWTexture2D<float4> picture : register(u2);
StructuredBuffer<Item> source : register(t0);

// 64 rectangles that cover an 8 x 8 grid, of which only the even columns are not empty.
[numthreads(64, 1, 1)]
void CSGrid(uint3 id : SV_DispatchThreadID) {
  uint x = id.x & 7u, y = id.x >> 3u;
  float left = float(x) * 0.25 - 1.0, top = 1.0 - float(y) * 0.25;
  target[id.x].value = (x & 1u) == 0u ? float4(left, top, left + 0.25, top - 0.25) : float4(0, 0, 0, 0);
}

// DrawArgs of 4 vertices and extra.y instances, DispatchArgs of (extra.z, 1, 1) behind them.
[numthreads(1, 1, 1)]
void CSArguments(uint3 id : SV_DispatchThreadID) {
  arguments[0] = 4u;
  arguments[1] = uint(extra.y);
  arguments[2] = 0u;
  arguments[3] = 0u;
  arguments[4] = uint(extra.z);
  arguments[5] = 1u;
  arguments[6] = 1u;
}

[numthreads(4, 1, 1)]
void CSAdd(uint3 id : SV_DispatchThreadID) { target[id.x].value = source[id.x].value + tint; }

[numthreads(1, 1, 1)]
void CSCount(uint3 id : SV_DispatchThreadID) { InterlockedAdd(arguments[0], 1u); }

[numthreads(8, 8, 1)]
void CSPicture(uint3 id : SV_DispatchThreadID) { picture[id.xy] = float4(float(id.x), float(id.y), 0, 255) / 255.0; }

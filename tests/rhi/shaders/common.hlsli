// What most of the test shaders share.
#ifndef RHI_TEST_COMMON_HLSLI
#define RHI_TEST_COMMON_HLSLI

struct Varying {
  float4 position : SV_Position;
  float2 uv : TEXCOORD0;
};

cbuffer Draw : register(b3) {  // DrawConstants of gpu.h
  float4 tint;
  float4 rectangle;  // left, top, right, bottom in clip space
  float4 extra;      // x: depth of the rectangle
};

// The target of `width` pixels' pixel (x, y): corner 0 top left, 1 top right, 2 bottom left, 3 bottom right.
float4 PixelCorner(float2 pixel, float2 size, uint corner) {
  float2 p = (pixel + float2(corner & 1u, corner >> 1u)) / size;
  return float4(p.x * 2.0 - 1.0, 1.0 - p.y * 2.0, 0.5, 1.0);
}

#endif

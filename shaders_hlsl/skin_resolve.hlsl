// The skin's samples averaged into the frame, where there can be skin: a rectangle, draw.xy to draw.zw in clip space.
#include "fur_constants.h"

Texture2DMS<float4> skin : register(t0);

float4 VSMain(uint vertex : SV_VertexID) : SV_Position {
  return float4((vertex & 1u) == 0u ? draw.x : draw.z, vertex < 2u ? draw.y : draw.w, 0.0, 1.0);
}

float4 PSMain(float4 position : SV_Position) : SV_Target {
  int2 pixel = int2(position.xy);
  float4 sum = (skin.Load(pixel, 0) + skin.Load(pixel, 1)) + (skin.Load(pixel, 2) + skin.Load(pixel, 3));
  return sum * 0.25;
}

// Bare skin from its four samples, premultiplied by the share that it fills of the pixel, over the whole viewport. draw.xy: where
// in the frame the samples begin.
#include "fur_constants.h"

Texture2DMS<float4> bareSkin : register(t9);

float4 VSMain(uint vertex : SV_VertexID) : SV_Position {
  return float4((vertex & 1u) == 0u ? -1.0 : 1.0, vertex < 2u ? -1.0 : 1.0, 0.0, 1.0);
}

float4 PSMain(float4 position : SV_Position) : SV_Target {
  int2 pixel = int2(position.xy) - int2(draw.xy);
  float4 sum = (bareSkin.Load(pixel, 0) + bareSkin.Load(pixel, 1)) + (bareSkin.Load(pixel, 2) + bareSkin.Load(pixel, 3));
  return sum * 0.25;
}

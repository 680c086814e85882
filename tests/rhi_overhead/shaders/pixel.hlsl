// A triangle that covers the centre of one pixel, and two pixel shaders to switch between.
cbuffer Draw : register(b3) {  // DrawConstants of workload.h
  float4 place;                // clip space: the pixel's top left corner, and its size (y downwards, so negative)
  float4 color;
};
struct Varying {
  float4 position : SV_Position;
};

// Corners at 0.1, 0.1 and 1.3, 0.1 and 0.1, 1.3 of the pixel: its centre is within, its neighbours' are not.
Varying VSPixel(uint id : SV_VertexID) {
  Varying o;
  float2 corner = float2(0.1 + 1.2 * float(id & 1u), 0.1 + 1.2 * float(id >> 1u));
  o.position = float4(place.xy + corner * place.zw, 0.5, 1.0);
  return o;
}

float4 PSColor(Varying v) : SV_Target { return color; }
float4 PSSwapped(Varying v) : SV_Target { return color.bgra; }

// Brings the frame, blended in linear light and in floats, to the picture's eight bits: one triangle over it all.
// Variant SRGB: the one transfer function of look correct, spelled out, since a driver's own may be off by a whole step.
Texture2D frame : register(t0);

float4 VSMain(uint vertex : SV_VertexID) : SV_Position {
  float2 corner = float2(vertex == 1u ? 3.0 : -1.0, vertex == 2u ? 3.0 : -1.0);
  return float4(corner, 0.0, 1.0);
}

// IEC 61966-2-1.
float Encode(float linearValue) {
  return linearValue <= 0.0031308 ? linearValue * 12.92 : 1.055 * pow(linearValue, 1.0 / 2.4) - 0.055;
}

float4 PSMain(float4 position : SV_Position) : SV_Target {
  float3 color = saturate(frame.Load(int3(int2(position.xy), 0)).rgb);
#ifdef SRGB
  color = float3(Encode(color.r), Encode(color.g), Encode(color.b));
#endif
  return float4(color, 1.0);
}

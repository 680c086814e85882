// Brings the frame, blended in linear light and in half floats, to the picture's format: one triangle over it all.
Texture2D frame : register(t0);

float4 VSMain(uint vertex : SV_VertexID) : SV_Position {
  float2 corner = float2(vertex == 1u ? 3.0 : -1.0, vertex == 2u ? 3.0 : -1.0);
  return float4(corner, 0.0, 1.0);
}

float4 PSMain(float4 position : SV_Position) : SV_Target {
  return saturate(frame.Load(int3(int2(position.xy), 0)));
}

// The smallest scene that reads a vertex buffer, constants, a texture and a sampler.
cbuffer Draw : register(b3) {
  float4 tint;
};
Texture2D picture : register(t0);
SamplerState bilinear : register(s0);

float4 VSMain(float4 position : POSITION) : SV_Position { return position; }

float4 PSMain(float4 position : SV_Position) : SV_Target { return picture.SampleLevel(bilinear, position.xy / 8.0, 0.0) * tint; }

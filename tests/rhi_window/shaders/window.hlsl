// A textured triangle without symmetry, that can be moved.
cbuffer Draw : register(b3) {
  float4 place;  // xy: added to the corners
};
Texture2D picture : register(t0);
SamplerState pictureSampler : register(s0);

struct Varying {
  float4 position : SV_Position;
  float2 uv : TEXCOORD0;
};

Varying VSTriangle(uint id : SV_VertexID) {
  float2 corner = id == 0u ? float2(-0.6, 0.7) : (id == 1u ? float2(0.7, 0.2) : float2(-0.3, -0.8));
  Varying o;
  o.position = float4(corner + place.xy, 0.5, 1.0);
  o.uv = corner * 1.5;
  return o;
}

float4 PSTriangle(Varying v) : SV_Target { return picture.Sample(pictureSampler, v.uv); }

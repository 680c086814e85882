// Compute shaders that write textures of each kind. extra.y is the size of a slice.
cbuffer Draw : register(b3) {
  float4 tint;
  float4 rectangle;
  float4 extra;
};
RWTexture2D<float4> plane : register(u0);
RWTexture2D<uint4> integers : register(u1);
RWTexture2DArray<float4> layers : register(u2);
RWTexture3D<float4> volume : register(u3);
RWTexture2D<float> single : register(u4);

float4 Mark(uint3 id) { return float4(float(id.x + 1u), float(id.y + 1u), float(id.z + 1u), 255.0) / 255.0; }

[numthreads(4, 4, 1)]
void CSPlane(uint3 id : SV_DispatchThreadID) { plane[id.xy] = tint; }
[numthreads(4, 4, 1)]
void CSIntegers(uint3 id : SV_DispatchThreadID) { integers[id.xy] = uint4(tint); }
[numthreads(4, 4, 1)]
void CSLayers(uint3 id : SV_DispatchThreadID) { layers[id] = Mark(id); }
[numthreads(4, 4, 1)]
void CSVolume(uint3 id : SV_DispatchThreadID) { volume[id] = Mark(id); }
// Reads what it writes.
[numthreads(4, 4, 1)]
void CSTwice(uint3 id : SV_DispatchThreadID) { single[id.xy] = single[id.xy] + single[id.xy]; }

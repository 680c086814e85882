// Positions in clip space and colors from vertex buffers.
struct MeshVertex {
  float3 position : POSITION;
  float4 color : COLOR;
};
struct MeshVarying {
  float4 position : SV_Position;
  float4 color : COLOR;
};

MeshVarying VSMesh(MeshVertex v) {
  MeshVarying o;
  o.position = float4(v.position, 1.0);
  o.color = v.color;
  return o;
}
float4 PSMesh(MeshVarying v) : SV_Target { return v.color; }

// A color for each instance.
struct InstancedVertex {
  float2 position : POSITION;
  float4 color : COLOR;
  float2 offset : TEXCOORD2;
};
MeshVarying VSInstanced(InstancedVertex v) {
  MeshVarying o;
  o.position = float4(v.position + v.offset, 0.5, 1.0);
  o.color = v.color;
  return o;
}

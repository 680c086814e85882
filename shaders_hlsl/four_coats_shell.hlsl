// Shells of preset four-coats: a loop over the layers in the geometry shader, each further out by length / layers.
// Variant MOST_SHELLS: for more than the published 30, up to the 34 whose 1,020 scalars are still allowed.
#include "four_coats.hlsli"
#include "line_fin.hlsli"
#include "vertex.hlsli"

#ifdef MOST_SHELLS
#define SHELL_VERTICES 102
#else
#define SHELL_VERTICES 90
#endif

Texture2D opacityMap : register(t5);

LinePoint VSMain(VertexIn v) { return MakeLinePoint(v.position, v.uv, v.normal); }

[maxvertexcount(SHELL_VERTICES)]
void GSMain(triangle LinePoint v[3], inout TriangleStream<CoatVarying> shells) {
  int count = int(furShape.w);
  for (int layer = 0; layer < count; ++layer) {
    for (int corner = 0; corner < 3; ++corner) {
      float offset = FurLengthAt(v[corner].uv) / furShape.w * float(layer + 1);
      CoatVarying o;
      o.position = TransformPoint(objectToClip, v[corner].position.xyz + Unit3(v[corner].normal) * offset);
      o.normal = TransformVector(normalToWorld, v[corner].normal);
      o.uv = v[corner].uv;
      o.layer = layer;
      shells.Append(o);
    }
    shells.RestartStrip();
  }
}

float4 PSMain(CoatVarying v) : SV_Target {
  float height = float(v.layer) / furShape.w;
  float coverage = furVolume.Sample(volumeSampler, float3(v.uv * furShape.y, height * furShape.z)).a;
  float thickness = opacityMap.Sample(volumeSampler, v.uv * furShape.y).r;
  return ShadeCoat(v.uv, v.normal, coverage, thickness, height);
}

// Fins of the seed technique: a geometry shader over LineListAdj looks at the two triangles of an edge and raises a quad
// where one faces the eye and the other does not. As published: the length is read at vertex 1 only, and the eye stays in
// world space while the vertices are in object space (docs/seed.md lists what is kept and why).
// Variants: LOOK_SEED (published: unlit).
#include "fur_constants.h"
#include "fur_light.hlsli"
#include "fur_volume.hlsli"
#include "math.hlsli"
#include "vertex.hlsli"

struct FinPoint {
  float4 position : SV_Position;  // object space
  float2 uv : TEXCOORD0;
  float3 normal : TEXCOORD1;
#ifndef LOOK_SEED
  float4 tangent : TEXCOORD2;
#endif
};

struct FinVarying {
  float4 position : SV_Position;
  float3 uvLayer : TEXCOORD0;  // z: slice
#ifndef LOOK_SEED
  float3 normal : TEXCOORD1;
  float4 tangent : TEXCOORD2;
  float3 fromEye : TEXCOORD3;
#endif
};

FinPoint VSMain(VertexIn v) {
  FinPoint o;
  o.position = float4(v.position, 1.0);
  o.uv = v.uv;
  o.normal = v.normal;
#ifndef LOOK_SEED
  o.tangent = v.tangent;
#endif
  return o;
}

FinVarying Raise(FinPoint p, float furLength, float slice) {
  float3 q = p.position.xyz + p.normal * furLength;
  FinVarying o;
  o.position = TransformPoint(objectToClip, q);
  o.uvLayer = float3(p.uv, slice);
#ifndef LOOK_SEED
  o.normal = TransformVector(normalToWorld, p.normal);
  o.tangent = float4(TransformVector(objectToEye, p.tangent.xyz), p.tangent.w);
  o.fromEye = TransformPoint(objectToEye, q).xyz;
#endif
  return o;
}

float3 FaceNormal(float3 a, float3 b, float3 c) { return Unit3(Cross3(a - b, c - b)); }

[maxvertexcount(6)]
void GSMain(lineadj FinPoint v[4], inout TriangleStream<FinVarying> fins) {
  float3 p0 = v[0].position.xyz, p1 = v[1].position.xyz, p2 = v[2].position.xyz, p3 = v[3].position.xyz;
  float3 view0 = -Unit3(eyeWorld.xyz - (p0 + p1 + p2) / 3.0);
  float3 view1 = -Unit3(eyeWorld.xyz - (p1 + p2 + p3) / 3.0);
  float edge = Dot3(FaceNormal(p0, p1, p2), view0) * Dot3(FaceNormal(p1, p2, p3), view1);
  float relative = lengthMap.SampleLevel(surfaceSampler, v[1].uv, 0).r;
  // The published threshold is 1e-3 model units at a fur length of 0.03.
  if (edge > 0.0 && relative > 1.0 / 30.0) {
    float furLength = relative * furShape.x;
    float top = furShape.z - 1.0;
    FinVarying root1 = Raise(v[1], 0.0, 0.0);
    FinVarying root2 = Raise(v[2], 0.0, 0.0);
    FinVarying tip1 = Raise(v[1], furLength, top);
    FinVarying tip2 = Raise(v[2], furLength, top);
    fins.Append(tip1);
    fins.Append(root2);
    fins.Append(root1);
    fins.RestartStrip();
    fins.Append(root2);
    fins.Append(tip1);
    fins.Append(tip2);
    fins.RestartStrip();
  }
}

float4 PSMain(FinVarying v) : SV_Target {
  float4 fur = furVolume.Sample(volumeSampler, float3(v.uvLayer.xy * furShape.y, v.uvLayer.z));
  if (fur.a < 0.01) discard;
  float height = v.uvLayer.z / furShape.z;
  float alpha = fur.a * (1.0 - furLight.w * height);
  float3 albedo = baseColorMap.Sample(surfaceSampler, v.uvLayer.xy).rgb;
#ifdef LOOK_SEED
  float3 color = albedo * (height * (1.0 - furLight.x) + furLight.x);
#else
  float3 normal = UnitOr(v.normal, float3(0, 0, 1));
  float3 tangent = UnitOr(v.tangent.xyz, float3(1, 0, 0));
  float3 strand = UnitOr(FromFrame(UnpackStrand(fur.rgb), tangent, Cross3(normal, tangent) * v.tangent.w, normal), normal);
  float3 color = FurLight(albedo * baseColor.rgb, strand, normal, v.fromEye, height, 0.0);
#endif
  return float4(color, alpha);
}

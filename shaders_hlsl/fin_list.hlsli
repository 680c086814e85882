// The furred mesh as buffers that any stage can read.
#ifndef FIN_LIST_HLSLI
#define FIN_LIST_HLSLI
#include "fur_point.hlsli"

struct PackedFurVertex {
  float4 position, direction, tangent, normal, furUv;
};
StructuredBuffer<PackedFurVertex> furVertices : register(t5);
StructuredBuffer<uint4> finEdges : register(t6);  // line adjacency, four vertices for each edge

FurVertex LoadFurVertex(uint i) {
  PackedFurVertex p = furVertices[i];
  FurVertex v;
  v.position = p.position;
  v.direction = p.direction;
  v.tangent = p.tangent;
  v.normal = p.normal;
  v.furUv = p.furUv;
  return v;
}

#endif

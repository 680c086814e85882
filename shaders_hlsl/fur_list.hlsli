// The furred vertices as a buffer that any stage can read.
#ifndef FUR_LIST_HLSLI
#define FUR_LIST_HLSLI
#include "fur_point.hlsli"

struct PackedFurVertex {
  float4 position, direction, tangent, normal, furUv;
};
StructuredBuffer<PackedFurVertex> furVertices : register(t5);

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

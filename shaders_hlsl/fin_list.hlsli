// The edges of the furred mesh as a buffer that any stage can read.
#ifndef FIN_LIST_HLSLI
#define FIN_LIST_HLSLI
#include "fur_list.hlsli"

StructuredBuffer<uint4> finEdges : register(t6);  // line adjacency, four vertices for each edge

#endif

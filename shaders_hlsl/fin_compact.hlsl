// Keeps the edges that grow a fin, in the order of the list, so that what is blended does not depend on how the group's
// threads ran. One group walks over the list of one part of one animal; the sums over its threads are a Hillis-Steele
// scan (Hillis and Steele, "Data Parallel Algorithms", CACM 1986).
#include "fin_edge.hlsli"
#include "fin_list.hlsli"

#define GROUP 256u

RWStructuredBuffer<uint> keptEdges : register(u0);
RWStructuredBuffer<uint4> drawArguments : register(u1);  // rhi::DrawArgs

// Shared, not a register: Mesa's GLSL compiler takes a sum that is carried through a translated loop for uninitialized.
groupshared uint keptSoFar;
groupshared uint sums[GROUP];

bool GrowsFin(uint edge) {
  uint4 ends = finEdges[edge];
  return FinOpacity(LoadFurVertex(ends.x), LoadFurVertex(ends.y), LoadFurVertex(ends.z), LoadFurVertex(ends.w)) > 0.0;
}

// The number of threads up to this one that keep something.
uint SumUpTo(uint thread, uint mine) {
  sums[thread] = mine;
  GroupMemoryBarrierWithGroupSync();
  for (uint reach = 1u; reach < GROUP; reach *= 2u) {
    uint before = thread >= reach ? sums[thread - reach] : 0u;
    GroupMemoryBarrierWithGroupSync();
    sums[thread] += before;
    GroupMemoryBarrierWithGroupSync();
  }
  return sums[thread];
}

[numthreads(256, 1, 1)]
void CSMain(uint thread : SV_GroupIndex) {
  uint edges = uint(draw.x), first = uint(draw.y);
  if (thread == 0u) keptSoFar = 0u;
  for (uint start = 0u; start < edges; start += GROUP) {
    uint edge = start + thread;
    uint mine = 0u;
    if (edge < edges) mine = GrowsFin(edge) ? 1u : 0u;
    uint upTo = SumUpTo(thread, mine);
    if (mine == 1u) keptEdges[first + keptSoFar + upTo - 1u] = edge;
    GroupMemoryBarrierWithGroupSync();
    if (thread == 0u) keptSoFar += sums[GROUP - 1u];
    GroupMemoryBarrierWithGroupSync();
  }
  if (thread == 0u) drawArguments[uint(draw.z)] = uint4(keptSoFar * 6u, 1u, 0u, 0u);
}

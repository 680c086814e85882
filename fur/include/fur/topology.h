// Welding and line adjacency.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "fur/model.h"

namespace fur {

// Vertices at bitwise equal positions (-0 == 0) share one welded index. `representative[w]` is the first vertex of w.
struct Weld {
  std::vector<uint32_t> welded;          // for each vertex
  std::vector<uint32_t> representative;  // for each welded index
};
Weld WeldByPosition(std::span<const Vertex> vertices);

// LineListAdj indices (4 for each edge: opposite, edge, edge, opposite) the way the published demo makes them: pairs
// triangles by index only, each edge once from each of its two triangles, none from an edge with one triangle. For
// triangle (p0,p1,p2) and its edge p0-p1: adjacent opposite, p0, p1, p2; and so on around.
std::vector<uint32_t> SeedLineAdjacency(std::span<const uint32_t> indices);

// LineListAdj indices over welded edges: each undirected edge once, in order of first appearance; vertices 1, 2 are the
// edge as the first triangle winds it, 3 is that triangle's opposite, 0 the other triangle's opposite. A boundary edge
// repeats its one opposite (0 == 3 by position). An edge with more than two triangles gives one entry for each pair that
// is adjacent in angle around the edge. Degenerate triangles (two welded vertices equal) are left out.
std::vector<uint32_t> LineAdjacency(std::span<const Vertex> vertices, std::span<const uint32_t> indices, const Weld&);

}  // namespace fur

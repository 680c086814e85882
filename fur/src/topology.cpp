#include "fur/topology.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <unordered_map>

namespace fur {
namespace {

constexpr uint32_t kNone = ~0u;

// The finaliser of SplitMix64 (Steele, Lea, Flood 2014, "Fast Splittable Pseudorandom Number Generators", figure 16).
uint64_t Mix(uint64_t x) {
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9ull;
  x = (x ^ (x >> 27)) * 0x94d049bb133111ebull;
  return x ^ (x >> 31);
}

using PositionBits = std::array<uint32_t, 3>;

PositionBits BitsOf(const glm::vec3& p) {
  // x + 0 turns -0 into 0 and leaves everything else alone.
  return {std::bit_cast<uint32_t>(p.x + 0.0f), std::bit_cast<uint32_t>(p.y + 0.0f),
          std::bit_cast<uint32_t>(p.z + 0.0f)};
}

struct PositionHash {
  size_t operator()(const PositionBits& b) const { return Mix(Mix(uint64_t{b[0]} << 32 | b[1]) + b[2]); }
};
struct EdgeHash {
  size_t operator()(uint64_t key) const { return Mix(key + 0x9e3779b97f4a7c15ull); }
};

uint64_t EdgeKey(uint32_t a, uint32_t b) { return uint64_t{std::min(a, b)} << 32 | std::max(a, b); }

// A corner is a position in the index list; it stands for the edge from it to the next corner of its triangle.
uint32_t Next(uint32_t corner) { return corner % 3 == 2 ? corner - 2 : corner + 1; }

// The corners of each undirected edge, as one list for each edge, edges in order of first appearance.
struct EdgeLists {
  std::vector<uint32_t> first;  // for each edge: its first corner
  std::vector<uint32_t> next;   // for each corner: the edge's next corner, or kNone
};

template <class VertexOf, class Skip>
EdgeLists CollectEdges(uint32_t cornerCount, VertexOf vertexOf, Skip skipTriangle) {
  struct Ends {
    uint32_t edge;
    uint32_t last;
  };
  std::unordered_map<uint64_t, Ends, EdgeHash> edges;
  edges.reserve(cornerCount / 2 + 1);
  EdgeLists lists{{}, std::vector<uint32_t>(cornerCount, kNone)};
  for (uint32_t c = 0; c < cornerCount; ++c) {
    if (skipTriangle(c - c % 3)) continue;
    const auto edge = static_cast<uint32_t>(lists.first.size());
    const auto [it, isNew] = edges.try_emplace(EdgeKey(vertexOf(c), vertexOf(Next(c))), Ends{edge, c});
    if (isNew) {
      lists.first.push_back(c);
    } else {
      lists.next[it->second.last] = c;
      it->second.last = c;
    }
  }
  return lists;
}

std::vector<uint32_t> CornersOf(const EdgeLists& lists, uint32_t edge) {
  std::vector<uint32_t> corners;
  for (uint32_t c = lists.first[edge]; c != kNone; c = lists.next[c]) corners.push_back(c);
  return corners;
}

class LineAdjacencyBuilder {
 public:
  LineAdjacencyBuilder(std::span<const Vertex> vertices, std::span<const uint32_t> indices)
      : vertices_(vertices), indices_(indices) {}

  void AddEdge(std::vector<uint32_t> corners) {
    if (corners.size() == 1) return AddPair(corners[0], corners[0]);
    if (corners.size() == 2) return AddPair(corners[0], corners[1]);
    SortByAngle(&corners);
    for (size_t i = 0; i < corners.size(); ++i) AddPair(corners[i], corners[(i + 1) % corners.size()]);
  }
  std::vector<uint32_t> Take() { return std::move(lines_); }

 private:
  glm::dvec3 Position(uint32_t corner) const { return vertices_[indices_[corner]].position; }
  uint32_t Opposite(uint32_t corner) const { return indices_[Next(Next(corner))]; }

  // The edge is wound as the triangle that comes first in the index list winds it.
  void AddPair(uint32_t a, uint32_t b) {
    if (b < a) std::swap(a, b);
    lines_.insert(lines_.end(), {Opposite(b), indices_[a], indices_[Next(a)], Opposite(a)});
  }

  // Angles are measured from the first triangle, so that it stays first; equal angles (triangles that lie on each
  // other) keep the order of the index list, which makes the result deterministic.
  void SortByAngle(std::vector<uint32_t>* corners) const {
    const uint32_t first = corners->front();
    const glm::dvec3 origin = Position(first);
    const glm::dvec3 axis = glm::normalize(Position(Next(first)) - origin);
    const auto perpendicular = [&](uint32_t c) {
      const glm::dvec3 toOpposite = glm::dvec3(vertices_[Opposite(c)].position) - origin;
      return toOpposite - axis * glm::dot(axis, toOpposite);
    };
    const glm::dvec3 x = perpendicular(first);
    const glm::dvec3 y = glm::cross(axis, x);
    std::vector<std::pair<double, uint32_t>> byAngle;
    for (uint32_t c : *corners) {
      const glm::dvec3 d = perpendicular(c);
      const double angle = std::atan2(glm::dot(d, y), glm::dot(d, x));
      byAngle.emplace_back(c == first ? -1 : angle < 0 ? angle + 2 * 3.14159265358979323846 : angle, c);
    }
    std::sort(byAngle.begin(), byAngle.end());
    for (size_t i = 0; i < byAngle.size(); ++i) (*corners)[i] = byAngle[i].second;
  }

  std::span<const Vertex> vertices_;
  std::span<const uint32_t> indices_;
  std::vector<uint32_t> lines_;
};

}  // namespace

Weld WeldByPosition(std::span<const Vertex> vertices) {
  std::unordered_map<PositionBits, uint32_t, PositionHash> known;
  known.reserve(vertices.size());
  Weld weld;
  weld.welded.reserve(vertices.size());
  for (uint32_t v = 0; v < vertices.size(); ++v) {
    const auto fresh = static_cast<uint32_t>(weld.representative.size());
    const auto [it, isNew] = known.try_emplace(BitsOf(vertices[v].position), fresh);
    if (isNew) weld.representative.push_back(v);
    weld.welded.push_back(it->second);
  }
  return weld;
}

std::vector<uint32_t> SeedLineAdjacency(std::span<const uint32_t> indices) {
  const auto cornerCount = static_cast<uint32_t>(indices.size() - indices.size() % 3);
  const EdgeLists lists = CollectEdges(
      cornerCount, [&](uint32_t c) { return indices[c]; }, [](uint32_t) { return false; });
  // An edge with more than two triangles: every triangle is paired with the first of the others.
  std::vector<uint32_t> partner(cornerCount, kNone);
  for (uint32_t head : lists.first) {
    partner[head] = lists.next[head];
    for (uint32_t c = lists.next[head]; c != kNone; c = lists.next[c]) partner[c] = head;
  }
  std::vector<uint32_t> lines;
  for (uint32_t c = 0; c < cornerCount; ++c) {
    if (partner[c] == kNone) continue;
    lines.insert(lines.end(), {indices[Next(Next(partner[c]))], indices[c], indices[Next(c)], indices[Next(Next(c))]});
  }
  return lines;
}

// The indices are those of the triangles themselves, not the welded ones: vertices 1, 2 and 3 carry the first
// triangle's texture coordinates, vertex 0 the other triangle's. Linear in the number of triangles, apart from the sort
// of the triangles around one non-manifold edge. Two triangles on the same three points (a sheet with two sides) give 0
// == 3 by position, as a boundary does: seen edge-on both are silhouettes.
std::vector<uint32_t> LineAdjacency(std::span<const Vertex> vertices, std::span<const uint32_t> indices,
                                    const Weld& weld) {
  const auto cornerCount = static_cast<uint32_t>(indices.size() - indices.size() % 3);
  const auto vertexOf = [&](uint32_t c) { return weld.welded[indices[c]]; };
  const auto isDegenerate = [&](uint32_t c) {
    const uint32_t a = vertexOf(c), b = vertexOf(c + 1), d = vertexOf(c + 2);
    return a == b || b == d || d == a;
  };
  const EdgeLists lists = CollectEdges(cornerCount, vertexOf, isDegenerate);
  LineAdjacencyBuilder builder(vertices, indices);
  for (uint32_t edge = 0; edge < lists.first.size(); ++edge) builder.AddEdge(CornersOf(lists, edge));
  return builder.Take();
}

}  // namespace fur

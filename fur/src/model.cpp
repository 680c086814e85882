#include "fur/model.h"

#include <limits>
#include <map>

#include "fur/topology.h"
#include "union_find.h"

namespace fur {

namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr Bounds kNothing{glm::dvec3(kInfinity), glm::dvec3(-kInfinity)};

void Add(const glm::dvec3& p, Bounds* bounds) {
  bounds->min = glm::min(bounds->min, p);
  bounds->max = glm::max(bounds->max, p);
}

}  // namespace

Bounds ComputeBounds(const Model& model) {
  Bounds bounds = kNothing;
  for (const Part& part : model.parts)
    for (const Vertex& vertex : model.primitives[part.primitive].vertices)
      Add(glm::dvec3(part.transform * glm::dvec4(glm::dvec3(vertex.position), 1.0)), &bounds);
  return bounds.min.x > bounds.max.x ? Bounds{} : bounds;  // no vertex at all: a point at the origin
}

std::vector<Bounds> PieceBounds(const Primitive& primitive) {
  const Weld weld = WeldByPosition(primitive.vertices);
  UnionFind joined(weld.representative.size());
  const auto& indices = primitive.indices;
  for (size_t i = 0; i + 2 < indices.size(); i += 3)
    for (size_t k = 1; k < 3; ++k) joined.Join(weld.welded[indices[i]], weld.welded[indices[i + k]]);
  std::map<uint32_t, Bounds> pieces;
  for (const uint32_t index : indices) {
    Bounds& bounds = pieces.try_emplace(joined.Root(weld.welded[index]), kNothing).first->second;
    Add(glm::dvec3(primitive.vertices[index].position), &bounds);
  }
  std::vector<Bounds> all;
  for (const auto& [root, bounds] : pieces) all.push_back(bounds);
  return all;
}

}  // namespace fur

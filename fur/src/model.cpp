#include "fur/model.h"

#include <limits>

namespace fur {

Bounds ComputeBounds(const Model& model) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  Bounds bounds{glm::dvec3(kInfinity), glm::dvec3(-kInfinity)};
  for (const Part& part : model.parts) {
    for (const Vertex& vertex : model.primitives[part.primitive].vertices) {
      const glm::dvec3 p(part.transform * glm::dvec4(glm::dvec3(vertex.position), 1.0));
      bounds.min = glm::min(bounds.min, p);
      bounds.max = glm::max(bounds.max, p);
    }
  }
  return bounds.min.x > bounds.max.x ? Bounds{} : bounds;  // no vertex at all: a point at the origin
}

}  // namespace fur

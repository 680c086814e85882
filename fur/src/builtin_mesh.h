// Triangles from the built-in animal's distance field.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

namespace fur::builtin {

struct Mesh {
  std::vector<glm::dvec3> positions;
  std::vector<glm::dvec3> normals;
  std::vector<uint32_t> indices;
};

// The furred skin: closed, counter-clockwise from outside.
Mesh PolygonizeSkin();

// A ball for eyes and nose, poles along +-z.
Mesh MakeBall(const glm::dvec3& center, const glm::dvec3& radii, int rings, int segments);

}  // namespace fur::builtin

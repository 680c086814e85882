// Texture coordinates for the built-in animal: charts that are nearly isometric, so that hairs are equally dense
// everywhere.
#pragma once

#include <vector>

#include "builtin_mesh.h"
#include "fur/model.h"

namespace fur::builtin {

struct Atlas {
  std::vector<Vertex> vertices;  // split along the charts' borders; equal positions bit for bit
  std::vector<uint32_t> indices;
  double uvPerUnit = 0;  // texture coordinates for one unit of length
  uint32_t charts = 0;
};

// `size`: texels across the textures that will be painted; charts keep a gutter between them.
Atlas MakeAtlas(const Mesh& mesh, uint32_t size);

// Fills tangents from the texture coordinates: averaged over each vertex's triangles, made perpendicular to the normal.
void FillTangents(std::vector<Vertex>* vertices, const std::vector<uint32_t>& indices);

// The direction that hair is combed to at a point of the skin: backwards, down the legs, along the tail; tangential, at
// most unit length.
glm::dvec3 CombDirection(const glm::dvec3& p, const glm::dvec3& normal);

}  // namespace fur::builtin

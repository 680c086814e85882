// What the technique `shells` draws of a furred primitive: the skin with the fur's own attributes, closed at every seam.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "fur/model.h"

namespace fur {

// As the shaders read it (shaders_hlsl/fur_point.hlsli), from a vertex buffer or from a structured buffer.
struct FurVertex {
  glm::vec4 position;   // xyz; w: length of the fur relative to the material's, welded by position
  glm::vec4 direction;  // xyz: unit fur direction, welded by position; w: u of the model's maps
  glm::vec4 tangent;    // xyz: along u of the fur's own texture coordinates; w: handedness, +-1
  glm::vec4 normal;     // xyz: the shading normal; w: v of the model's maps
  glm::vec4 furUv;      // xy: tiles of the volume
};
static_assert(sizeof(FurVertex) == 80);

struct FurMesh {
  std::vector<FurVertex> vertices;  // those of the primitive, then the far corners of neighbours in other primitives
  std::vector<uint32_t> indices;    // triangles, without those that are bald at all three corners
  std::vector<uint32_t> edges;      // LineListAdj: each undirected edge once, without those that are bald at both ends
  uint32_t baldTriangles = 0, baldEdges = 0;
};

// Which texture coordinates the volume is tiled over.
enum class FurTiling {
  Model,     // the model's, times layer_uv_scale, as published: density follows their stretch
  Isometric  // made for the fur (fur/fur_uv.h), with the same mean density
};

// One mesh for each primitive of the model; those of bald primitives are empty. Primitives that the same transform places
// are welded with one another, so that shells stay closed and no fin grows where two materials meet.
//
// Direction: the mean, over the corners that meet at a position, weighted by their angles, of the vertex normals or of
// the direction map. Length: the mean of the length map there. Both maps are read bilinearly at full size. Where the
// mean direction vanishes (a sheet with two sides), the vertex's own normal stands.
std::vector<FurMesh> MakeFurMeshes(const Model&, FurTiling);

// The bilinear value of an RGBA8 picture at (u, v), channels 0..1, as a sampler reads it at mip 0.
glm::dvec4 SampleBilinear(const Image&, const glm::dvec2& uv, bool wrapU, bool wrapV);

}  // namespace fur

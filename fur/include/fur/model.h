// A model in memory: geometry, materials, pictures, fur. Everything is range-checked when it is made; what follows may
// index without looking.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <optional>
#include <string>
#include <vector>

#include "fur/params.h"
#include "fur/result.h"

namespace fur {

// RGBA8, row 0 on top, tightly packed: pixels.size() == width * height * 4.
struct Image {
  std::string name;
  uint32_t width = 0, height = 0;
  std::vector<uint8_t> pixels;
};

// The fur volume: N0 slices, slice 0 at the root. RGB: packed strand tangent (t = 2 rgb - 1, tangent space as glTF's
// normal maps: x along u, y up the picture, against v, z along the normal); A: coverage. Tiles in u and v.
// pixels.size() == width * height * layers * 4.
struct FurVolume {
  std::string name;
  uint32_t width = 0, height = 0, layers = 0;
  std::vector<uint8_t> pixels;
  // Either empty or as many bytes as `pixels`, slice for slice: what the strands at a texel have of their own, weighted
  // by coverage. RGB: factor of the fur's colour, linear, byte / 128 (0 .. 1.99; 128 leaves the colour alone). A: offset
  // from the strand's own root, byte / 255: 0 at its root, 1 at its tip, however long it is.
  std::vector<uint8_t> tint;
};

struct Vertex {
  glm::vec3 position{0};
  glm::vec3 normal{0, 0, 1};      // unit
  glm::vec4 tangent{1, 0, 0, 1};  // xyz unit, perpendicular to the normal; w = +-1 handedness, bitangent = w cross(n, t)
  glm::vec2 uv{0};
};

struct TextureRef {
  int32_t image = -1;  // index into Model::images; -1: none
  bool wrapU = true, wrapV = true;  // false: clamp
};

// What grows on a material, with its files already read.
struct MaterialFur {
  FurParams params;
  int32_t volume = -1;        // index into Model::volumes; >= 0 in a furred material
  int32_t lengthMap = -1;     // index into Model::images, red channel; -1: 1 everywhere
  int32_t directionMap = -1;  // index into Model::images, tangent-space direction; -1: the normal
};

struct Material {
  std::string name;
  glm::vec4 baseColor{1};  // linear factor
  TextureRef baseColorTexture, normalTexture, specularTexture;  // specular: KHR_materials_specular's colour
  float normalScale = 1;
  glm::vec3 specularColor{1};  // linear factor
  float roughness = 1, metallic = 0;
  bool doubleSided = false;
  std::optional<MaterialFur> fur;
};

// Triangles of one material. Indices are in range; degenerate triangles may occur.
struct Primitive {
  std::string name;
  std::vector<Vertex> vertices;
  std::vector<uint32_t> indices;  // 3 for each triangle
  uint32_t material = 0;          // index into Model::materials
};

// A primitive placed by a node of the scene.
struct Part {
  uint32_t primitive = 0;
  glm::dmat4 transform{1};  // model space (glTF scene space) from primitive space
};

struct Bounds {
  glm::dvec3 min{0}, max{0};
  glm::dvec3 Center() const { return (min + max) * 0.5; }
  double Diameter() const { return glm::length(max - min); }
};

struct Model {
  std::string name;
  std::vector<Primitive> primitives;
  std::vector<Part> parts;
  std::vector<Material> materials;  // never empty; a primitive without one gets a default
  std::vector<Image> images;
  std::vector<FurVolume> volumes;
  std::vector<std::string> warnings;  // oddities that did not prevent loading, one line each
};

// Box of all parts' vertices in model space, without fur.
Bounds ComputeBounds(const Model&);
// The boxes of what hangs together by equal positions, in the primitive's axes.
std::vector<Bounds> PieceBounds(const Primitive&);

// What whoever draws a model relies on: every number finite, every index in range, pictures of the size that they say.
// InputMalformed naming the first that is not, as "primitive 'ear', vertex 12: the normal is not finite". Loaders give
// such models; one made by hand may be wrong.
Result<Done> CheckModel(const Model&);

}  // namespace fur

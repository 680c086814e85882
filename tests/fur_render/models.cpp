#include "models.h"

#include <cmath>

namespace fur::test {
namespace {

// FrameCounts and pictures of the seed technique are stated for a furred material at length map 1.
MaterialFur FurOf(const Coat& coat) {
  MaterialFur fur;
  fur.params.length = coat.length;
  fur.params.layerUvScale = 1;
  fur.params.selfShadow = coat.selfShadow;
  fur.params.specularPower = coat.specularPower;
  fur.params.specularScale = coat.specularScale;
  fur.volume = 0;
  return fur;
}

FurVolume VolumeOf(const Coat& coat) {
  constexpr uint32_t kSide = 4;
  FurVolume volume{"coat", kSide, kSide, uint32_t(coat.slices.size()), {}};
  for (const Texel& t : coat.slices)
    for (uint32_t i = 0; i < kSide * kSide; ++i) volume.pixels.insert(volume.pixels.end(), t.begin(), t.end());
  for (const Texel& t : coat.tints)
    for (uint32_t i = 0; i < kSide * kSide; ++i) volume.tint.insert(volume.tint.end(), t.begin(), t.end());
  return volume;
}

void Grow(const Coat& coat, Model* model) {
  model->volumes = {VolumeOf(coat)};
  model->materials[0].fur = FurOf(coat);
}

}  // namespace

Image Plain(const std::string& name, const Texel& t) {
  Image image{name, 4, 4, {}};
  for (int i = 0; i < 16; ++i) image.pixels.insert(image.pixels.end(), t.begin(), t.end());
  return image;
}

Primitive Square(double half) {
  const auto h = float(half);
  Primitive p{.name = "square", .indices = {0, 1, 2, 0, 2, 3}};
  for (const glm::vec2 corner : {glm::vec2(-1, -1), glm::vec2(1, -1), glm::vec2(1, 1), glm::vec2(-1, 1)})
    p.vertices.push_back({.position = glm::vec3(corner * h, 0), .uv = {(corner.x + 1) / 2, (1 - corner.y) / 2}});
  return p;
}

Model BaldSquare(double half, const Texel& color) {
  Model model;
  model.name = "square";
  model.images = {Plain("color", color)};
  model.materials = {{.name = "skin", .specularColor = glm::vec3(0)}};
  model.materials[0].baseColorTexture.image = 0;
  model.primitives = {Square(half)};
  model.parts = {{.primitive = 0}};
  return model;
}

Coat UniformCoat(uint32_t slices, uint8_t coverage, std::array<uint8_t, 3> t) {
  Coat coat;
  coat.slices.assign(slices, Texel{t[0], t[1], t[2], coverage});
  return coat;
}

Model FurredSquare(double half, const Texel& color, const Coat& coat) {
  Model model = BaldSquare(half, color);
  Grow(coat, &model);
  return model;
}

Model FurredMesh(const std::vector<glm::vec3>& positions, const std::vector<uint32_t>& indices, const Coat& coat) {
  Model model = BaldSquare(1, {200, 150, 100, 255});
  Primitive p{.name = "mesh", .indices = indices};
  for (const glm::vec3& q : positions) {
    const glm::vec3 normal = glm::normalize(q);
    const glm::vec3 side = std::abs(normal.y) < 0.9f ? glm::vec3(0, 1, 0) : glm::vec3(1, 0, 0);
    p.vertices.push_back(
        {.position = q, .normal = normal, .tangent = glm::vec4(glm::normalize(glm::cross(side, normal)), 1)});
  }
  model.primitives = {p};
  Grow(coat, &model);
  return model;
}

Model Tetrahedron(const Coat& coat) {
  return FurredMesh({{1, 1, 1}, {1, -1, -1}, {-1, 1, -1}, {-1, -1, 1}}, {0, 1, 2, 0, 3, 1, 0, 2, 3, 1, 3, 2}, coat);
}

Model Cube(const Coat& coat) {
  std::vector<glm::vec3> corners;
  for (int i = 0; i < 8; ++i) corners.push_back({i & 1 ? 1 : -1, i & 2 ? 1 : -1, i & 4 ? 1 : -1});
  return FurredMesh(corners, {0, 2, 3, 0, 3, 1, 4, 5, 7, 4, 7, 6, 0, 1, 5, 0, 5, 4,
                              2, 6, 7, 2, 7, 3, 0, 4, 6, 0, 6, 2, 1, 3, 7, 1, 7, 5},
                    coat);
}

Camera CameraAt(double distance, double yawDegrees, double pitchDegrees, double fovY) {
  const double yaw = glm::radians(yawDegrees), pitch = glm::radians(pitchDegrees);
  Camera camera;
  camera.eye = glm::dvec3(std::sin(yaw) * std::cos(pitch), std::sin(pitch), std::cos(yaw) * std::cos(pitch)) * distance;
  camera.fovY = fovY;
  return camera;
}

Model Roof(const Coat& coat) {
  Model model = FurredMesh({{-1, 0, 0}, {1, 0, 0}, {0, 1, -1}, {0, -1, -1}}, {0, 1, 2, 1, 0, 3}, coat);
  for (Vertex& v : model.primitives[0].vertices) {
    v.normal = {0, 0, 1};
    v.tangent = {1, 0, 0, 1};
    v.uv = {v.position.x < 0 ? 0.125f : 0.875f, 0.5f};
  }
  return model;
}

}  // namespace fur::test

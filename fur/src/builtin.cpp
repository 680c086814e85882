#include "fur/builtin.h"

#include "builtin_atlas.h"
#include "builtin_mesh.h"
#include "builtin_paint.h"
#include "builtin_shape.h"
#include "fur/bake.h"

namespace fur {
namespace {

using namespace builtin;

constexpr uint32_t kTextureSize = 512;
constexpr double kFurLength = 0.075;  // 3.7 % of the body's length
constexpr double kTileWidth = 0.20;   // on the skin: a strand of two texels is 1/640 of the body's length thick
constexpr uint32_t kCoatSeed = 7;

// Texture coordinates of a ball: the hemisphere around `axis`, seen from the front, fills the unit square's disc.
void FrontUvs(const Ball& ball, const glm::dvec3& axis, std::vector<Vertex>* vertices) {
  const glm::dvec3 right = glm::normalize(glm::cross(glm::dvec3(0, 1, 0), axis)), up = glm::cross(axis, right);
  for (Vertex& v : *vertices) {
    const glm::dvec3 q = (glm::dvec3(v.position) - ball.center) / ball.radii;
    v.uv = glm::vec2(0.5 + 0.499 * glm::dot(right, q), 0.5 - 0.499 * glm::dot(up, q));
  }
}

Primitive BallPrimitive(const char* name, const Ball& ball, const glm::dvec3& axis, uint32_t material) {
  const Mesh mesh = MakeBall(ball.center, ball.radii, 12, 24);
  Primitive primitive{.name = name, .indices = mesh.indices, .material = material};
  for (size_t i = 0; i < mesh.positions.size(); ++i) {
    primitive.vertices.push_back({.position = glm::vec3(mesh.positions[i]), .normal = glm::vec3(mesh.normals[i])});
  }
  FrontUvs(ball, axis, &primitive.vertices);
  FillTangents(&primitive.vertices, primitive.indices);
  return primitive;
}

Material SkinMaterial(double uvPerUnit) {
  Material skin{.name = "fur", .specularColor = glm::vec3(0.2f), .roughness = 0.9f};
  skin.baseColorTexture.image = 0;
  MaterialFur fur;
  fur.params.length = kFurLength;
  fur.params.layerUvScale = 1 / (kTileWidth * uvPerUnit);
  fur.params.shells = 24;
  fur.params.selfShadow = 0.35;
  fur.volume = 0;
  fur.lengthMap = 1;
  fur.directionMap = 2;
  skin.fur = fur;
  return skin;
}

Material GlossyMaterial(const char* name, const glm::vec4& color, float roughness) {
  return {.name = name, .baseColor = color, .roughness = roughness};
}

void AddPart(Model* model, Primitive primitive) {
  model->parts.push_back({.primitive = static_cast<uint32_t>(model->primitives.size())});
  model->primitives.push_back(std::move(primitive));
}

}  // namespace

Model MakeBuiltinAnimal() {
  Atlas atlas = MakeAtlas(PolygonizeSkin(), kTextureSize);
  SkinImages images = PaintSkin(atlas, kTextureSize);
  Model model;
  model.name = "builtin";
  model.images = {std::move(images.color), std::move(images.length), std::move(images.direction), PaintEye(128)};
  model.volumes = {GrowCoat(kCoatSeed)};
  model.materials = {SkinMaterial(atlas.uvPerUnit), GlossyMaterial("eye", glm::vec4(1), 0.08f),
                     GlossyMaterial("nose", {0.035f, 0.022f, 0.02f, 1}, 0.35f)};
  model.materials[1].baseColorTexture = {.image = 3, .wrapU = false, .wrapV = false};
  AddPart(&model, {.name = "fur", .vertices = std::move(atlas.vertices), .indices = std::move(atlas.indices)});
  const glm::dvec3 mirror{-1, 1, 1};
  AddPart(&model, BallPrimitive("eye_left", Eye(), EyeAxis(), 1));
  AddPart(&model, BallPrimitive("eye_right", {Eye().center * mirror, Eye().radii}, EyeAxis() * mirror, 1));
  AddPart(&model, BallPrimitive("nose", Nose(), {0, 0, 1}, 2));
  return model;
}

}  // namespace fur

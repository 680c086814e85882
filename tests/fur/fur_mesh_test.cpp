// What technique `shells` makes of a furred primitive, exactly.
#include "fur/fur_mesh.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace fur {
namespace {

using Indices = std::vector<uint32_t>;

MaterialFur PlainFur() {
  MaterialFur fur;
  fur.params.length = 0.1;
  fur.params.layerUvScale = 3;
  fur.volume = 0;
  return fur;
}

// One part for each primitive, all furred with material 0; material 1 is bald.
Model Furred(std::vector<Primitive> primitives) {
  Model model;
  model.materials.resize(2);
  model.materials[0].fur = PlainFur();
  model.volumes = {{"coat", 1, 1, 1, {128, 128, 255, 255}}};
  model.primitives = std::move(primitives);
  for (uint32_t i = 0; i < model.primitives.size(); ++i) model.parts.push_back({.primitive = i});
  return model;
}

FurMesh Mesh(const Model& model, size_t primitive = 0) { return MakeFurMeshes(model, FurTiling::Model)[primitive]; }

glm::vec3 Position(const FurVertex& v) { return glm::vec3(v.position); }
glm::vec3 Direction(const FurVertex& v) { return glm::vec3(v.direction); }

void ExpectNear(const glm::vec3& got, const glm::dvec3& expected, double tolerance = 1e-6) {
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(got[c], expected[c], tolerance) << "component " << c;
}

// A flat quad in z = 0, two triangles, u and v along x and y over 0..1.
Primitive Quad(const glm::vec3& corner = glm::vec3(0), uint32_t material = 0) {
  Primitive p{.name = "quad", .indices = {0, 1, 2, 0, 2, 3}, .material = material};
  for (const glm::vec2 c : {glm::vec2(0, 0), glm::vec2(1, 0), glm::vec2(1, 1), glm::vec2(0, 1)})
    p.vertices.push_back({.position = corner + glm::vec3(c, 0), .uv = c});
  return p;
}

Image Row(const std::vector<std::array<uint8_t, 4>>& texels) {
  Image image{"row", uint32_t(texels.size()), 1, {}};
  for (const auto& t : texels) image.pixels.insert(image.pixels.end(), t.begin(), t.end());
  return image;
}

void SetLengthMap(Model* model, const Image& image) {
  model->images.push_back(image);
  model->materials[0].fur->lengthMap = int32_t(model->images.size()) - 1;
  model->materials[0].baseColorTexture = {.image = -1, .wrapU = false, .wrapV = false};
}

// ------------------------------------------------------------------------------------------------------ directions
// Each side of the cube has four vertices of its own with the side's normal. `split` moves one side to a primitive of
// its own, the first.
std::vector<Primitive> FlatCube(bool split) {
  std::vector<Primitive> primitives(split ? 2 : 1);
  for (int side = 0; side < 6; ++side) {
    Primitive& p = primitives[split && side > 0 ? 1 : 0];
    const int axis = side / 2;
    const float sign = side % 2 ? 1.0f : -1.0f;
    glm::vec3 normal(0), u(0), v(0);
    normal[axis] = sign;
    u[(axis + 1) % 3] = 1;
    v[(axis + 2) % 3] = sign;
    const auto first = uint32_t(p.vertices.size());
    for (const glm::vec2 c : {glm::vec2(-1, -1), glm::vec2(1, -1), glm::vec2(1, 1), glm::vec2(-1, 1)})
      p.vertices.push_back({.position = normal + u * c.x + v * c.y, .normal = normal, .tangent = glm::vec4(u, 1)});
    for (const uint32_t k : {0u, 1u, 2u, 0u, 2u, 3u}) p.indices.push_back(first + k);
  }
  return primitives;
}

void ExpectDiagonals(const FurMesh& mesh) {
  for (const FurVertex& v : mesh.vertices) {
    ExpectNear(Direction(v), glm::dvec3(Position(v)) / std::sqrt(3.0), 1e-7);
    EXPECT_EQ(v.position.w, 1);
  }
}

// A corner has 90 degrees of each side, in one triangle or in two: weighted by angle the three normals count alike.
TEST(FurMesh, DirectionsCloseACubeWithFlatNormals) {
  const FurMesh mesh = Mesh(Furred(FlatCube(false)));
  ASSERT_EQ(mesh.vertices.size(), 24u);
  ExpectDiagonals(mesh);
  for (const FurVertex& v : mesh.vertices)
    EXPECT_EQ(glm::length(glm::vec3(v.normal)), 1) << "the shading normal stays flat";
  EXPECT_EQ(glm::vec3(mesh.vertices[0].normal), glm::vec3(-1, 0, 0));
  EXPECT_EQ(mesh.indices.size(), 36u);
  EXPECT_EQ(mesh.edges.size(), 4u * 18u) << "12 edges and 6 diagonals";
}

TEST(FurMesh, DirectionsCloseAcrossPrimitivesOfOneTransform) {
  const Model model = Furred(FlatCube(true));
  const std::vector<FurMesh> meshes = MakeFurMeshes(model, FurTiling::Model);
  ASSERT_EQ(meshes.size(), 2u);
  ExpectDiagonals(meshes[0]);
  ExpectDiagonals(meshes[1]);
  EXPECT_EQ(meshes[0].edges.size() + meshes[1].edges.size(), 4u * 18u) << "each edge once over both";
  EXPECT_EQ(meshes[0].edges.size(), 4u * 5u) << "the four edges that they share belong to the first";
}

TEST(FurMesh, PrimitivesAtDifferentTransformsAreNotWelded) {
  Model model = Furred(FlatCube(true));
  model.parts[1].transform[3][0] = 5;
  const FurMesh mesh = Mesh(model);
  for (const FurVertex& v : mesh.vertices) ExpectNear(Direction(v), {-1, 0, 0}, 0);
  EXPECT_EQ(mesh.vertices.size(), 4u);
}

// The mean is weighted by angle: at the roof's ridge by 135 and 45 degrees.
TEST(FurMesh, DirectionsAreWeightedByAngle) {
  Primitive p{.name = "roof", .indices = {0, 1, 2, 3, 4, 5}};
  const glm::vec3 at(0), ridge(1, 0, 0);
  const glm::vec3 wide(-1, 1, 0), narrow(1, 0, -1);
  for (const glm::vec3& q : {at, ridge, wide}) p.vertices.push_back({.position = q, .normal = {0, 0, 1}});
  for (const glm::vec3& q : {at, narrow, ridge}) p.vertices.push_back({.position = q, .normal = {0, 1, 0}});
  const FurMesh mesh = Mesh(Furred({p}));
  const glm::dvec3 expected = glm::normalize(glm::dvec3(0, 45, 135));
  ExpectNear(Direction(mesh.vertices[0]), expected, 1e-7);
  EXPECT_EQ(Direction(mesh.vertices[0]), Direction(mesh.vertices[3]));
}

TEST(FurMesh, SeamsInTheMapsStayClosed) {
  Primitive p = Quad();
  p.vertices[1].normal = glm::vec3(0.6f, 0, 0.8f);
  p.vertices.push_back(p.vertices[0]);
  p.vertices.push_back(p.vertices[2]);
  for (size_t i : {4, 5}) p.vertices[i].uv += glm::vec2(0.25f, 0.5f);
  p.vertices[4].normal = glm::vec3(0, 0.6f, 0.8f);
  p.indices = {0, 1, 2, 4, 5, 3};
  const FurMesh mesh = Mesh(Furred({p}));
  EXPECT_EQ(Direction(mesh.vertices[0]), Direction(mesh.vertices[4]));
  EXPECT_EQ(Direction(mesh.vertices[2]), Direction(mesh.vertices[5]));
  ExpectNear(Direction(mesh.vertices[0]), glm::normalize(glm::dvec3(0, 0.6, 1.8)), 1e-7);  // 45 degrees each
  EXPECT_EQ(mesh.vertices[4].direction.w, 0.25f) << "u of the maps stays the vertex's own";
  EXPECT_EQ(mesh.vertices[4].normal.w, 0.5f);
  EXPECT_EQ(glm::vec2(mesh.vertices[4].furUv), glm::vec2(0.75f, 1.5f)) << "three tiles for each unit";
  EXPECT_EQ(mesh.edges.size(), 4u * 5u) << "the seam is one edge";
}

TEST(FurMesh, ASheetWithTwoSidesKeepsItsOwnNormals) {
  Primitive p = Quad();
  for (size_t i = 0; i < 4; ++i) {
    p.vertices.push_back(p.vertices[i]);
    p.vertices.back().normal = glm::vec3(0, 0, -1);
  }
  p.indices.insert(p.indices.end(), {4, 6, 5, 4, 7, 6});
  const FurMesh mesh = Mesh(Furred({p}));
  for (size_t i = 0; i < 8; ++i) EXPECT_EQ(Direction(mesh.vertices[i]), glm::vec3(0, 0, i < 4 ? 1 : -1));
}

// --------------------------------------------------------------------------------------------------- direction maps
Model MappedDirection(std::array<uint8_t, 4> texel, float handedness) {
  Model model = Furred({Quad()});
  for (Vertex& v : model.primitives[0].vertices) v.tangent = {0, 1, 0, handedness};
  model.images = {Row({texel})};
  model.materials[0].fur->directionMap = 0;
  return model;
}

// t = 2 rgb - 1; direction = t.x T + t.y w (N x T) + t.z N, with T = +Y, N = +Z, so N x T = -X.
TEST(FurMesh, DirectionMapIsInTheTangentFrame) {
  const glm::dvec3 t(2 * 204 / 255.0 - 1, 2 * 153 / 255.0 - 1, 2 * 230 / 255.0 - 1);
  for (const float w : {1.0f, -1.0f}) {
    const FurMesh mesh = Mesh(MappedDirection({204, 153, 230, 255}, w));
    for (const FurVertex& v : mesh.vertices) ExpectNear(Direction(v), glm::normalize(glm::dvec3(-w * t.y, t.x, t.z)));
  }
}

// |t| < 1/64: docs/accuracy.md.
TEST(FurMesh, ATexelWithoutDirectionMeansTheNormal) {
  for (const uint8_t grey : {uint8_t(127), uint8_t(128)}) {
    const FurMesh mesh = Mesh(MappedDirection({grey, grey, grey, 255}, 1));
    for (const FurVertex& v : mesh.vertices) EXPECT_EQ(Direction(v), glm::vec3(0, 0, 1)) << int(grey);
  }
  const FurMesh mesh = Mesh(MappedDirection({130, 128, 128, 255}, 1));  // |t| = 0.0204
  EXPECT_GT(Direction(mesh.vertices[0]).y, 0.9f) << "this one has a direction";
}

// ---------------------------------------------------------------------------------------------------------- lengths
// Four texels 0, 51, 102, 255, clamped: their middles are at u = 1/8, 3/8, 5/8, 7/8.
double RowAt(double u) {
  const std::array<double, 4> texels{0, 0.2, 0.4, 1};
  const double x = std::clamp(u * 4 - 0.5, 0.0, 3.0);
  const auto i = std::min<size_t>(size_t(x), 2);
  return texels[i] + (texels[i + 1] - texels[i]) * (x - double(i));
}

TEST(FurMesh, LengthMapIsReadBilinearly) {
  Primitive p = Quad();
  const std::array<float, 4> u{0.2f, 0.5f, 0.8f, 0.97f};
  for (size_t i = 0; i < 4; ++i) p.vertices[i].uv = {u[i], 0.3f};
  Model model = Furred({p});
  SetLengthMap(&model, Row({{0, 9, 9, 9}, {51, 9, 9, 9}, {102, 9, 9, 9}, {255, 9, 9, 9}}));
  const FurMesh mesh = Mesh(model);
  for (size_t i = 0; i < 4; ++i) EXPECT_NEAR(mesh.vertices[i].position.w, RowAt(u[i]), 1e-7) << u[i];
}

TEST(FurMesh, SampleBilinearWrapsOrClamps) {
  const Image image = Row({{0, 0, 0, 0}, {255, 51, 0, 255}});
  EXPECT_DOUBLE_EQ(SampleBilinear(image, {0.5, 0.5}, false, false).r, 0.5);
  EXPECT_DOUBLE_EQ(SampleBilinear(image, {0.5, 0.5}, false, false).g, 0.1);
  EXPECT_DOUBLE_EQ(SampleBilinear(image, {0, 0}, false, false).r, 0);
  EXPECT_DOUBLE_EQ(SampleBilinear(image, {1, 7}, false, false).r, 1);
  EXPECT_DOUBLE_EQ(SampleBilinear(image, {0, 0}, true, true).r, 0.5) << "between the last texel and the first";
  EXPECT_DOUBLE_EQ(SampleBilinear(image, {-3.25, 9}, true, true).r, 1);
  EXPECT_DOUBLE_EQ(SampleBilinear(image, {1e9 + 0.5, 0}, true, true).r, 0.5);
  EXPECT_DOUBLE_EQ(SampleBilinear(image, {1e300, -1e300}, false, false).r, 1);
}

// The two copies of a seam read 0.2 and 0.4: 45 degrees each.
TEST(FurMesh, LengthAtASeamIsTheMean) {
  Primitive p = Quad();
  p.vertices.push_back(p.vertices[0]);
  p.vertices.push_back(p.vertices[2]);
  p.indices = {0, 1, 2, 4, 5, 3};
  const std::array<float, 6> u{0.375f, 0.375f, 0.375f, 0.625f, 0.625f, 0.625f};
  for (size_t i = 0; i < 6; ++i) p.vertices[i].uv = {u[i], 0.5f};
  Model model = Furred({p});
  SetLengthMap(&model, Row({{0, 0, 0, 0}, {51, 0, 0, 0}, {102, 0, 0, 0}, {255, 0, 0, 0}}));
  const FurMesh mesh = Mesh(model);
  for (const size_t i : {0, 2, 4, 5}) EXPECT_NEAR(mesh.vertices[i].position.w, 0.3, 1e-7) << i;
  EXPECT_NEAR(mesh.vertices[1].position.w, 0.2, 1e-7);
  EXPECT_NEAR(mesh.vertices[3].position.w, 0.4, 1e-7);
}

// A strip of five quads over u = 0..1, with fur from u = 0.6 on only.
Model Strip() {
  Primitive p{.name = "strip"};
  for (uint32_t i = 0; i < 6; ++i)
    for (const float y : {0.0f, 1.0f}) p.vertices.push_back({.position = {float(i), y, 0}, .uv = {float(i) / 5, 0.5f}});
  for (uint32_t i = 0; i < 10; i += 2) p.indices.insert(p.indices.end(), {i, i + 2, i + 3, i, i + 3, i + 1});
  Model model = Furred({p});
  // Texel middles at 0.05, 0.15 ...: 0 up to 0.45, 1 from 0.55 on.
  Image row = Row({});
  row.width = 10;
  for (int i = 0; i < 10; ++i) row.pixels.insert(row.pixels.end(), {uint8_t(i < 5 ? 0 : 255), 0, 0, 0});
  SetLengthMap(&model, row);
  return model;
}

TEST(FurMesh, BaldTrianglesAndEdgesAreDroppedAndCounted) {
  const FurMesh mesh = Mesh(Strip());
  for (size_t i = 0; i < 12; ++i) EXPECT_EQ(mesh.vertices[i].position.w, i < 6 ? 0 : 1) << i;  // columns 0..2 are bald
  EXPECT_EQ(mesh.baldTriangles, 4u) << "two quads";
  EXPECT_EQ(mesh.indices, (Indices{4, 6, 7, 4, 7, 5, 6, 8, 9, 6, 9, 7, 8, 10, 11, 8, 11, 9}));
  // 6 rungs, 5 diagonals, 10 rails; bald: 3 rungs, 2 diagonals, 4 rails.
  EXPECT_EQ(mesh.baldEdges, 9u);
  EXPECT_EQ(mesh.edges.size(), 4u * 12u);
  for (size_t i = 0; i < mesh.edges.size(); i += 4) EXPECT_TRUE(mesh.edges[i + 1] >= 6 || mesh.edges[i + 2] >= 6) << i;
}

// ------------------------------------------------------------------------------------------------------------ edges
TEST(FurMesh, BoundaryEdgesRepeatTheirOpposite) {
  const FurMesh mesh = Mesh(Furred({Quad()}));
  EXPECT_EQ(mesh.edges, (Indices{2, 0, 1, 2,  //
                                 0, 1, 2, 0,  //
                                 3, 2, 0, 1,  //
                                 0, 2, 3, 0,  //
                                 2, 3, 0, 2}));
  EXPECT_EQ(mesh.vertices.size(), 4u) << "no ghosts";
}

// The bald neighbour comes first in the model, and its far corner is known to the fur as a ghost.
TEST(FurMesh, EdgesTowardsBaldPrimitivesBelongToTheFur) {
  Model model = Furred({Quad({1, 0, 0}, 1), Quad({0, 0, 0}, 0)});
  const std::vector<FurMesh> meshes = MakeFurMeshes(model, FurTiling::Model);
  ASSERT_EQ(meshes.size(), 2u);
  EXPECT_TRUE(meshes[0].vertices.empty() && meshes[0].indices.empty() && meshes[0].edges.empty());
  const FurMesh& fur = meshes[1];
  EXPECT_EQ(fur.edges.size(), 4u * 5u);
  ASSERT_EQ(fur.vertices.size(), 5u) << "one ghost";
  EXPECT_EQ(Position(fur.vertices[4]), glm::vec3(2, 1, 0)) << "across the edge x = 1: the bald (1,0) (2,1) (1,1)";
  EXPECT_EQ(fur.vertices[4].position.w, 0) << "bald";
  // The shared edge is the fur's 1-2, wound as the fur winds it.
  EXPECT_EQ((Indices(fur.edges.begin() + 4, fur.edges.begin() + 8)), (Indices{4, 1, 2, 0}));
  EXPECT_EQ(fur.indices, (Indices{0, 1, 2, 0, 2, 3}));
}

TEST(FurMesh, FurOnThePrimitiveThatIsSwitchedOffIsBald) {
  Model model = Furred({Quad()});
  model.materials[0].fur->params.enabled = false;
  const FurMesh mesh = Mesh(model);
  EXPECT_TRUE(mesh.vertices.empty() && mesh.indices.empty() && mesh.edges.empty());
}

// Two furred materials: the ghost has the neighbour's length and the edge its weld.
TEST(FurMesh, GhostsOfFurredNeighboursHaveFur) {
  const std::vector<FurMesh> meshes = MakeFurMeshes(Furred({Quad(), Quad({1, 0, 0})}), FurTiling::Model);
  ASSERT_EQ(meshes[0].vertices.size(), 5u);
  EXPECT_EQ(Position(meshes[0].vertices[4]), glm::vec3(2, 1, 0));
  EXPECT_EQ(meshes[0].vertices[4].position.w, 1);
  EXPECT_EQ(meshes[0].edges.size(), 4u * 5u);
  EXPECT_EQ(meshes[1].edges.size(), 4u * 4u) << "the shared edge belongs to the first";
  EXPECT_EQ(meshes[1].vertices.size(), 4u) << "and needs no ghost here";
  EXPECT_FLOAT_EQ(Direction(meshes[0].vertices[1]).z, 1);
}

TEST(FurMesh, DegenerateTrianglesHaveNoEdges) {
  Primitive p = Quad();
  p.indices.insert(p.indices.end(), {1, 1, 2});
  const FurMesh mesh = Mesh(Furred({p}));
  EXPECT_EQ(mesh.edges.size(), 4u * 5u);
  EXPECT_EQ(mesh.indices.size(), 9u);
  for (const FurVertex& v : mesh.vertices) EXPECT_EQ(Direction(v), glm::vec3(0, 0, 1));
}

// A primitive that no part places is still a mesh of its own.
TEST(FurMesh, UnplacedPrimitives) {
  Model model = Furred({Quad(), Quad({1, 0, 0})});
  model.parts.pop_back();
  const std::vector<FurMesh> meshes = MakeFurMeshes(model, FurTiling::Model);
  EXPECT_EQ(meshes[0].vertices.size(), 4u);
  EXPECT_EQ(meshes[1].vertices.size(), 4u);
  EXPECT_EQ(meshes[1].edges.size(), 4u * 5u);
}

}  // namespace
}  // namespace fur

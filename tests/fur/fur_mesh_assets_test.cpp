// The furred meshes of the real models.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <map>
#include <set>
#include <vector>

#include "assets.h"
#include "fur/builtin.h"
#include "fur/fur_mesh.h"
#include "fur/gltf.h"

namespace fur {
namespace {

using test::AssetsDir;

using Position = std::array<float, 3>;
template <class V>
Position PositionOf(const V& v) {
  return {v.position.x + 0.0f, v.position.y + 0.0f, v.position.z + 0.0f};
}

// What differs at positions with more than one vertex.
struct Seams {
  size_t positions = 0;                          // with several vertices
  size_t splitDirections = 0, splitLengths = 0;  // of these
};
Seams CountSeams(const FurMesh& mesh) {
  std::map<Position, std::vector<const FurVertex*>> at;
  for (const FurVertex& v : mesh.vertices) at[PositionOf(v)].push_back(&v);
  Seams seams;
  for (const auto& [position, vertices] : at) {
    if (vertices.size() < 2) continue;
    bool directions = false, lengths = false;
    for (const FurVertex* v : vertices) {
      directions = directions || glm::vec3(v->direction) != glm::vec3(vertices[0]->direction);
      lengths = lengths || v->position.w != vertices[0]->position.w;
    }
    ++seams.positions;
    seams.splitDirections += directions;
    seams.splitLengths += lengths;
  }
  return seams;
}

struct EdgeCounts {
  size_t all = 0, boundary = 0, twice = 0, baldEnds = 0, baldBoth = 0;
};
EdgeCounts CountEdges(const FurMesh& mesh) {
  EdgeCounts counts;
  std::set<std::set<Position>> known;
  for (size_t i = 0; i < mesh.edges.size(); i += 4) {
    const auto vertex = [&](size_t k) -> const FurVertex& { return mesh.vertices[mesh.edges[i + k]]; };
    ++counts.all;
    counts.boundary += PositionOf(vertex(0)) == PositionOf(vertex(3));
    counts.twice += !known.insert({PositionOf(vertex(1)), PositionOf(vertex(2))}).second;
    const int bald = (vertex(1).position.w <= 0) + (vertex(2).position.w <= 0);
    counts.baldEnds += bald == 1;
    counts.baldBoth += bald == 2;
  }
  return counts;
}

Result<Model> Load(const std::string& name) {
  if (name == "builtin") return MakeBuiltinAnimal();
  return LoadGltf(AssetsDir() / name);
}

class FurMeshAssets : public testing::TestWithParam<const char*> {
 protected:
  void SetUp() override {
    const std::string name = GetParam();
    if (name != "builtin" && !std::filesystem::exists(AssetsDir() / name)) GTEST_SKIP() << "no " << AssetsDir() / name;
    Result<Model> model = Load(name);
    ASSERT_TRUE(model) << model.error().message;
    model_ = std::move(*model);
  }
  Model model_;
};

// No two vertices at one position differ in direction or length, whatever the tiling of the volume.
TEST_P(FurMeshAssets, ClosedAndEachEdgeOnce) {
  size_t furred = 0;
  for (const FurTiling tiling : {FurTiling::Model, FurTiling::Isometric}) {
    const std::vector<FurMesh> meshes = MakeFurMeshes(model_, tiling);
    ASSERT_EQ(meshes.size(), model_.primitives.size());
    for (const FurMesh& mesh : meshes) {
      furred += !mesh.indices.empty();
      const Seams seams = CountSeams(mesh);
      EXPECT_EQ(seams.splitDirections, 0u);
      EXPECT_EQ(seams.splitLengths, 0u);
      const EdgeCounts edges = CountEdges(mesh);
      EXPECT_EQ(edges.twice, 0u);
      EXPECT_EQ(edges.baldBoth, 0u);
      for (const FurVertex& v : mesh.vertices) {
        EXPECT_NEAR(glm::length(glm::vec3(v.direction)), 1, 1e-5);
        EXPECT_TRUE(v.position.w >= 0 && v.position.w <= 1);
      }
    }
  }
  EXPECT_GT(furred, 0u);
}

INSTANTIATE_TEST_SUITE_P(All, FurMeshAssets,
                         testing::Values("builtin", "cat/cat.gltf", "fox/fox.glb", "husky/husky.glb", "spot/spot.glb",
                                         "suzanne/suzanne.glb", "torus/torus.gltf", "plushy_toy/plushy_toy.gltf"));

// ---------------------------------------------------------------------------------- against the tables in SOURCE.md
class CatFurMesh : public testing::Test {
 protected:
  void SetUp() override {
    const std::filesystem::path file = AssetsDir() / "cat/cat.gltf";
    if (!std::filesystem::exists(file)) GTEST_SKIP() << "no " << file;
    Result<Model> model = LoadGltf(file);
    ASSERT_TRUE(model) << model.error().message;
    model_ = std::move(*model);
    ASSERT_EQ(model_.primitives.size(), 2u);
  }
  // The fur without its neighbours.
  FurMesh Alone(bool lengthMap) const {
    Model only = model_;
    only.primitives = {model_.primitives[1]};
    only.parts = {{.primitive = 0, .transform = model_.parts[1].transform}};
    if (!lengthMap) only.materials[1].fur->lengthMap = -1;
    return MakeFurMeshes(only, FurTiling::Model)[0];
  }
  Model model_;
};

// Each vertex by itself would read another length at 121 of them, and the shells would gape there.
TEST_F(CatFurMesh, SeamsThatTheMapsSplitAreClosed) {
  const FurMesh mesh = Alone(true);
  const Seams seams = CountSeams(mesh);
  EXPECT_EQ(seams.positions, 592u) << "positions with several vertices";
  EXPECT_EQ(seams.splitDirections, 0u);
  EXPECT_EQ(seams.splitLengths, 0u);
  const Image& map = model_.images[size_t(model_.materials[1].fur->lengthMap)];
  std::map<Position, std::set<double>> byItself;
  for (const Vertex& v : model_.primitives[1].vertices)
    byItself[PositionOf(v)].insert(SampleBilinear(map, v.uv, true, true).r);
  EXPECT_EQ(std::count_if(byItself.begin(), byItself.end(), [](const auto& at) { return at.second.size() > 1; }), 121);
}

// 5147 edges by index. 2,956 triangles with 32 open sides: (3 * 2956 + 32) / 2 edges.
TEST_F(CatFurMesh, EdgesOnce) {
  const EdgeCounts all = CountEdges(Alone(false));
  EXPECT_EQ(all.all, 4450u);
  EXPECT_EQ(all.boundary, 32u);
  EXPECT_EQ(all.twice + all.baldEnds, 0u);
  const FurMesh mapped = Alone(true);
  EXPECT_EQ(CountEdges(mapped).all + mapped.baldEdges, 4450u);
}

// Beside its neighbours 26 open sides meet the eyes and claws. A fin that has fur at one end has none at the other.
TEST_F(CatFurMesh, FinsEndBaldOnlyBesideFur) {
  const FurMesh mesh = MakeFurMeshes(model_, FurTiling::Model)[1];
  const EdgeCounts edges = CountEdges(mesh);
  EXPECT_EQ(edges.all, 4154u);
  EXPECT_EQ(mesh.baldEdges, 296u);
  EXPECT_EQ(mesh.baldTriangles, 142u);
  EXPECT_EQ(edges.boundary, 6u);
  EXPECT_EQ(edges.baldBoth, 0u);
  EXPECT_EQ(edges.baldEnds, 314u);
}

}  // namespace
}  // namespace fur

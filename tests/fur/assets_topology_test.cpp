// Counts on the real models, against the tables in the assets' SOURCE.md.
#include <gtest/gtest.h>

#include <filesystem>

#include "assets.h"
#include "fur/gltf.h"
#include "fur/topology.h"

namespace fur {
namespace {

using test::AssetsDir;

struct EdgeCounts {
  size_t manifold = 0, boundary = 0;
  bool operator==(const EdgeCounts&) const = default;
};
void PrintTo(const EdgeCounts& c, std::ostream* os) { *os << c.manifold << " manifold, " << c.boundary << " boundary"; }

// All primitives as one mesh, because the tables weld across them.
EdgeCounts CountEdges(const Model& model) {
  std::vector<Vertex> vertices;
  std::vector<uint32_t> indices;
  for (const Primitive& p : model.primitives) {
    for (uint32_t i : p.indices) indices.push_back(i + static_cast<uint32_t>(vertices.size()));
    vertices.insert(vertices.end(), p.vertices.begin(), p.vertices.end());
  }
  const Weld weld = WeldByPosition(vertices);
  const std::vector<uint32_t> lines = LineAdjacency(vertices, indices, weld);
  EdgeCounts counts;
  for (size_t i = 0; i < lines.size(); i += 4) {
    const bool boundary = weld.welded[lines[i]] == weld.welded[lines[i + 3]];
    ++(boundary ? counts.boundary : counts.manifold);
  }
  return counts;
}

struct AssetCase {
  const char* file;
  EdgeCounts edges;
};
void PrintTo(const AssetCase& c, std::ostream* os) { *os << c.file; }

class AssetTopology : public testing::TestWithParam<AssetCase> {};

TEST_P(AssetTopology, EdgesAfterWelding) {
  const std::filesystem::path file = AssetsDir() / GetParam().file;
  if (!std::filesystem::exists(file)) GTEST_SKIP() << "no " << file;
  const Result<Model> model = LoadGltf(file);
  ASSERT_TRUE(model) << model.error().message;
  EXPECT_EQ(CountEdges(*model), GetParam().edges);
}

INSTANTIATE_TEST_SUITE_P(All, AssetTopology,
                         testing::Values(AssetCase{"fox/fox.glb", {864, 0}}, AssetCase{"husky/husky.glb", {2880, 0}},
                                         AssetCase{"plushy_toy/plushy_toy.gltf", {23844, 96}},
                                         AssetCase{"spot/spot.glb", {8784, 0}},
                                         AssetCase{"suzanne/suzanne.glb", {5862, 84}},
                                         AssetCase{"torus/torus.gltf", {4608, 0}}));

class CatTopology : public testing::Test {
 protected:
  void SetUp() override {
    const std::filesystem::path file = AssetsDir() / "cat/cat.gltf";
    if (!std::filesystem::exists(file)) GTEST_SKIP() << "no " << file;
    Result<Model> model = LoadGltf(file);
    ASSERT_TRUE(model) << model.error().message;
    model_ = std::move(*model);
    ASSERT_EQ(model_.primitives.size(), 2u);
  }
  Model model_;
};

TEST_F(CatTopology, SeedSubmitsEveryEdgeTwice) {
  size_t lines = 0;
  for (const Primitive& p : model_.primitives) lines += SeedLineAdjacency(p.indices).size() / 4;
  EXPECT_EQ(lines, 9846u);
}

TEST_F(CatTopology, SeamsOfTheFurCloseByWelding) {
  const Primitive& fur = model_.primitives[1];
  const size_t pairedByIndex = SeedLineAdjacency(fur.indices).size() / 4 / 2;
  EXPECT_EQ(fur.indices.size() - 2 * pairedByIndex, 1426u);
  EXPECT_EQ(fur.indices.size() - pairedByIndex, 5147u);
  Model only;
  only.primitives.push_back(fur);
  EXPECT_EQ(CountEdges(only).boundary, 32u);
}

}  // namespace
}  // namespace fur

// How evenly hairs would stand on the real models, by the model's UVs and by the fur's own.
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <filesystem>

#include "assets.h"
#include "fur/builtin.h"
#include "fur/fur_uv.h"
#include "fur/gltf.h"
#include "fur/topology.h"

namespace fur {
namespace {

using test::AssetsDir;

std::vector<glm::dvec2> ModelUv(const Primitive& p) {
  std::vector<glm::dvec2> uv;
  for (const Vertex& v : p.vertices) uv.emplace_back(v.uv);
  return uv;
}

struct Jumps {
  uint32_t jumps = 0, places = 0;
};

// Positions with several vertices, and those of them where two tangents differ by more than 30 degrees.
Jumps CountJumps(const Primitive& p, const std::vector<glm::dvec3>& tangents) {
  const Weld weld = WeldByPosition(p.vertices);
  std::vector<std::vector<uint32_t>> at(weld.representative.size());
  for (uint32_t v = 0; v < p.vertices.size(); ++v) at[weld.welded[v]].push_back(v);
  Jumps out;
  for (const std::vector<uint32_t>& here : at) {
    if (here.size() < 2) continue;
    double least = 1;
    for (uint32_t a : here) {
      for (uint32_t b : here) least = std::min(least, glm::dot(tangents[a], tangents[b]));
    }
    ++out.places;
    out.jumps += least < std::sqrt(3.0) / 2 ? 1 : 0;
  }
  return out;
}

std::vector<glm::dvec3> ModelTangents(const Primitive& p) {
  std::vector<glm::dvec3> tangents;
  for (const Vertex& v : p.vertices) tangents.emplace_back(v.tangent);
  return tangents;
}

struct SpreadCase {
  const char* file;      // empty: the built-in animal
  const char* material;  // of the primitive that is measured
  double ratio;          // at most, by the fur's own coordinates
  uint32_t flipped = 0;  // at most
};
void PrintTo(const SpreadCase& c, std::ostream* os) { *os << (*c.file ? c.file : "built-in animal"); }

class FurUvAssets : public testing::TestWithParam<SpreadCase> {
 protected:
  // Skips where the file is missing.
  void SetUp() override {
    const SpreadCase& c = GetParam();
    if (*c.file) {
      const std::filesystem::path file = AssetsDir() / c.file;
      if (!std::filesystem::exists(file)) GTEST_SKIP() << "no " << file;
      Result<Model> model = LoadGltf(file);
      ASSERT_TRUE(model) << model.error().message;
      model_ = std::move(*model);
    } else {
      model_ = MakeBuiltinAnimal();
    }
    for (const Primitive& p : model_.primitives) {
      if (model_.materials[p.material].name == c.material) primitive_ = &p;
    }
    ASSERT_NE(primitive_, nullptr) << "no material " << c.material;
  }

  Model model_;
  const Primitive* primitive_ = nullptr;
};

TEST_P(FurUvAssets, HairsSpreadMoreEvenlyThanByTheModelsUvs) {
  const Primitive& p = *primitive_;
  const auto start = std::chrono::steady_clock::now();
  const FurUv fur = MakeFurUv(p);
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  const UvSpread before = MeasureSpread(p, ModelUv(p)), after = MeasureSpread(p, fur.uv);
  const Jumps jumpsBefore = CountJumps(p, ModelTangents(p)), jumpsAfter = CountJumps(p, fur.tangent);
  std::printf(
      "%s %s: %zu triangles, %u charts, %u kept; p95/p5 %.3f -> %.3f; mirrored %u -> %u; tangents jump at %u -> "
      "%u of %u positions; %.3f s\n",
      GetParam().file, GetParam().material, p.indices.size() / 3, fur.charts, fur.keptCharts, before.Ratio(),
      after.Ratio(), before.flipped, after.flipped, jumpsBefore.jumps, jumpsAfter.jumps, jumpsAfter.places, seconds);
  EXPECT_LE(after.Ratio(), GetParam().ratio);
  EXPECT_LE(after.Ratio(), before.Ratio());
  EXPECT_LE(after.flipped, GetParam().flipped);
  EXPECT_NEAR(after.median, 1, 0.02);
  EXPECT_EQ(fur.keptCharts, 0u);
  for (size_t v = 0; v < p.vertices.size(); ++v) {
    ASSERT_TRUE(std::isfinite(fur.uv[v].x) && std::isfinite(fur.uv[v].y));
    ASSERT_NEAR(glm::length(fur.tangent[v]), 1, 1e-9);
    ASSERT_NEAR(glm::dot(fur.tangent[v], glm::dvec3(p.vertices[v].normal)), 0, 1e-5);
  }
}

// A little above what was measured. One triangle of the cat stays turned over, in a chart whose border meets itself.
INSTANTIATE_TEST_SUITE_P(All, FurUvAssets,
                         testing::Values(SpreadCase{"cat/cat.gltf", "fur", 1.25, 2},
                                         SpreadCase{"fox/fox.glb", "fox_material", 1.05},
                                         SpreadCase{"spot/spot.glb", "spot", 1.25},
                                         SpreadCase{"plushy_toy/plushy_toy.gltf", "Fur Body", 1.15},
                                         SpreadCase{"suzanne/suzanne.glb", "default", 1.2},
                                         SpreadCase{"torus/torus.gltf", "default", 1.15},
                                         SpreadCase{"husky/husky.glb", "Material", 1.03}, SpreadCase{"", "fur", 1.03}));

}  // namespace
}  // namespace fur

#include "fur/topology.h"

#include <gtest/gtest.h>

#include <cmath>

namespace fur {
namespace {

using Indices = std::vector<uint32_t>;

std::vector<Vertex> Points(std::initializer_list<glm::vec3> positions) {
  std::vector<Vertex> vertices;
  for (const glm::vec3& p : positions) vertices.push_back({.position = p});
  return vertices;
}

Indices Lines(const std::vector<Vertex>& vertices, const Indices& indices) {
  return LineAdjacency(vertices, indices, WeldByPosition(vertices));
}

TEST(WeldByPosition, EqualBitsShareOneIndexAndZeroHasNoSign) {
  const auto vertices = Points({{0, 1, 2}, {3, 4, 5}, {-0.0f, 1, 2}, {3, 4, 5}, {3, 4, 5.0000005f}});
  const Weld weld = WeldByPosition(vertices);
  EXPECT_EQ(weld.welded, (Indices{0, 1, 0, 1, 2}));
  EXPECT_EQ(weld.representative, (Indices{0, 1, 4}));
}

TEST(WeldByPosition, NothingInNothingOut) {
  const Weld weld = WeldByPosition({});
  EXPECT_TRUE(weld.welded.empty());
  EXPECT_TRUE(weld.representative.empty());
}

TEST(LineAdjacency, Tetrahedron) {
  const auto vertices = Points({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}});
  const Indices indices{0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3};
  EXPECT_EQ(Lines(vertices, indices), (Indices{3, 0, 2, 1,  //
                                               3, 2, 1, 0,  //
                                               3, 1, 0, 2,  //
                                               2, 1, 3, 0,  //
                                               2, 3, 0, 1,  //
                                               1, 3, 2, 0}));
}

TEST(LineAdjacency, TwoTrianglesHaveOneInnerEdgeAndRepeatTheOppositeOnTheRim) {
  const auto vertices = Points({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}});
  EXPECT_EQ(Lines(vertices, {0, 1, 2, 0, 2, 3}), (Indices{2, 0, 1, 2,  //
                                                          0, 1, 2, 0,  //
                                                          3, 2, 0, 1,  //
                                                          0, 2, 3, 0,  //
                                                          2, 3, 0, 2}));
}

TEST(LineAdjacency, StripOfQuads) {
  const auto vertices = Points({{0, 0, 0}, {0, 1, 0}, {1, 0, 0}, {1, 1, 0}, {2, 0, 0}, {2, 1, 0}});
  const Indices lines = Lines(vertices, {0, 2, 1, 1, 2, 3, 2, 4, 3, 3, 4, 5});
  ASSERT_EQ(lines.size(), 4u * 9u);
  size_t inner = 0;
  for (size_t i = 0; i < lines.size(); i += 4) inner += lines[i] != lines[i + 3];
  EXPECT_EQ(inner, 3u);
}

// Five triangles over five vertices: the shortest Moebius strip. Each is (i, i+1, i+2) mod 5; its winding cannot be
// made consistent, which must not matter.
TEST(LineAdjacency, MoebiusStrip) {
  std::vector<Vertex> vertices;
  for (int i = 0; i < 5; ++i) {
    const float a = 2.5132741f * static_cast<float>(i);
    vertices.push_back({.position = {std::cos(a), std::sin(a), static_cast<float>(i % 2)}});
  }
  Indices indices;
  for (uint32_t i = 0; i < 5; ++i) indices.insert(indices.end(), {i, (i + 1) % 5, (i + 2) % 5});
  const Indices lines = Lines(vertices, indices);
  ASSERT_EQ(lines.size(), 4u * 10u);  // C(5, 2) edges: five inner ones i,i+1 and five rim ones i,i+2
  for (size_t i = 0; i < lines.size(); i += 4) {
    const uint32_t gap = (lines[i + 2] + 5 - lines[i + 1]) % 5;
    EXPECT_EQ(lines[i] != lines[i + 3], gap == 1 || gap == 4);
  }
}

TEST(LineAdjacency, ThreePageBookIsPairedByAngle) {
  // Spine along z; pages at 0, 200 and 90 degrees in this order, so 0-90, 90-200, 200-0 are neighbours.
  const auto vertices = Points({{0, 0, 0}, {0, 0, 1}, {1, 0, 0}, {-0.94f, -0.34f, 0}, {0, 1, 0}});
  const Indices lines = Lines(vertices, {0, 1, 2, 0, 1, 3, 1, 0, 4});
  ASSERT_EQ(lines.size(), 4u * (3u + 6u));
  EXPECT_EQ(Indices(lines.begin(), lines.begin() + 12), (Indices{4, 0, 1, 2,  //
                                                                 4, 0, 1, 3,  //
                                                                 3, 0, 1, 2}));
}

TEST(LineAdjacency, SeamWithDuplicatedVerticesCloses) {
  const auto vertices = Points({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 0, 0}, {1, 1, -0.0f}, {0, 1, 0}});
  EXPECT_EQ(Lines(vertices, {0, 1, 2, 3, 4, 5}), (Indices{2, 0, 1, 2,  //
                                                          0, 1, 2, 0,  //
                                                          5, 2, 0, 1,  //
                                                          3, 4, 5, 3,  //
                                                          4, 5, 3, 4}));
}

TEST(LineAdjacency, DegenerateTrianglesAreLeftOut) {
  const auto vertices = Points({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 0, 0}});
  EXPECT_EQ(Lines(vertices, {0, 3, 1, 0, 1, 2, 2, 2, 2}), (Indices{2, 0, 1, 2, 0, 1, 2, 0, 1, 2, 0, 1}));
  EXPECT_TRUE(Lines(vertices, {}).empty());
}

TEST(SeedLineAdjacency, EachInnerEdgeComesFromBothTriangles) {
  EXPECT_EQ(SeedLineAdjacency(Indices{0, 1, 2, 0, 2, 3}), (Indices{3, 2, 0, 1, 1, 0, 2, 3}));
}

TEST(SeedLineAdjacency, SeamsByIndexStayOpen) { EXPECT_TRUE(SeedLineAdjacency(Indices{0, 1, 2, 3, 4, 5}).empty()); }

TEST(SeedLineAdjacency, ClosedMeshListsEveryEdgeTwice) {
  EXPECT_EQ(SeedLineAdjacency(Indices{0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3}).size(), 4u * 12u);
}

}  // namespace
}  // namespace fur

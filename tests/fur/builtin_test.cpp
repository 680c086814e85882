#include "fur/builtin.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <set>

#include "fur/topology.h"

namespace fur {
namespace {

// One for all tests: making it takes some tenths of a second.
const Model& Animal() {
  static const Model model = MakeBuiltinAnimal();
  return model;
}
const Primitive& Skin() { return Animal().primitives.at(0); }

bool SameBytes(const Vertex& a, const Vertex& b) {
  return a.position == b.position && a.normal == b.normal && a.tangent == b.tangent && a.uv == b.uv;
}

TEST(BuiltinAnimal, SkinIsOnePrimitiveOfThreeToEightThousandTriangles) {
  const size_t triangles = Skin().indices.size() / 3;
  EXPECT_GE(triangles, 3000u);
  EXPECT_LE(triangles, 8000u);
  size_t furred = 0;
  for (const Primitive& p : Animal().primitives) furred += Animal().materials[p.material].fur.has_value();
  EXPECT_EQ(furred, 1u);
}

TEST(BuiltinAnimal, EveryWeldedEdgeHasTwoTrianglesThatTurnOppositeWays) {
  const Weld weld = WeldByPosition(Skin().vertices);
  std::map<std::pair<uint32_t, uint32_t>, int> directed;
  const auto& indices = Skin().indices;
  for (size_t c = 0; c < indices.size(); ++c) {
    ++directed[{weld.welded[indices[c]], weld.welded[indices[c % 3 == 2 ? c - 2 : c + 1]]}];
  }
  for (const auto& [edge, count] : directed) {
    ASSERT_EQ(count, 1);
    ASSERT_EQ(directed.count({edge.second, edge.first}), 1u);
  }
}

TEST(BuiltinAnimal, SkinIsOneBodyWithoutHandles) {
  const Weld weld = WeldByPosition(Skin().vertices);
  const auto edges = LineAdjacency(Skin().vertices, Skin().indices, weld).size() / 4;
  const auto euler = static_cast<long>(weld.representative.size()) - static_cast<long>(edges) +
                     static_cast<long>(Skin().indices.size() / 3);
  EXPECT_EQ(euler, 2);
}

TEST(BuiltinAnimal, SeamsDuplicateVertices) {
  const Weld weld = WeldByPosition(Skin().vertices);
  EXPECT_GT(Skin().vertices.size(), weld.representative.size() + 100);
  EXPECT_LT(Skin().vertices.size(), weld.representative.size() * 3 / 2);
  for (size_t v = 0; v < Skin().vertices.size(); ++v) {
    EXPECT_EQ(Skin().vertices[v].normal, Skin().vertices[weld.representative[weld.welded[v]]].normal);
  }
}

TEST(BuiltinAnimal, IndicesAndReferencesAreInRange) {
  const Model& m = Animal();
  for (const Part& part : m.parts) EXPECT_LT(part.primitive, m.primitives.size());
  for (const Primitive& p : m.primitives) {
    EXPECT_LT(p.material, m.materials.size());
    for (uint32_t i : p.indices) ASSERT_LT(i, p.vertices.size());
  }
  for (const Material& material : m.materials) {
    EXPECT_LT(material.baseColorTexture.image, static_cast<int32_t>(m.images.size()));
  }
  const MaterialFur& fur = *m.materials[0].fur;
  EXPECT_LT(static_cast<size_t>(fur.volume), m.volumes.size());
  EXPECT_LT(static_cast<size_t>(fur.lengthMap), m.images.size());
  EXPECT_LT(static_cast<size_t>(fur.directionMap), m.images.size());
  for (const Image& i : m.images) EXPECT_EQ(i.pixels.size(), size_t{i.width} * i.height * 4);
}

TEST(BuiltinAnimal, TrianglesHaveAreaAndFaceTheWayTheirNormalsDo) {
  for (const Primitive& p : Animal().primitives) {
    for (size_t t = 0; t < p.indices.size(); t += 3) {
      const Vertex &a = p.vertices[p.indices[t]], &b = p.vertices[p.indices[t + 1]], &c = p.vertices[p.indices[t + 2]];
      const glm::dvec3 normal = glm::cross(glm::dvec3(b.position - a.position), glm::dvec3(c.position - a.position));
      ASSERT_GT(glm::length(normal), 1e-6) << p.name;
      ASSERT_GT(glm::dot(normal, glm::dvec3(a.normal + b.normal + c.normal)), 0) << p.name << " triangle " << t / 3;
    }
  }
}

TEST(BuiltinAnimal, FramesAreFiniteAndOrthonormal) {
  for (const Primitive& p : Animal().primitives) {
    for (const Vertex& v : p.vertices) {
      ASSERT_TRUE(std::isfinite(glm::length(v.position)) && std::isfinite(glm::length(v.uv)));
      ASSERT_NEAR(glm::length(v.normal), 1, 1e-5);
      ASSERT_NEAR(glm::length(glm::vec3(v.tangent)), 1, 1e-5);
      ASSERT_NEAR(glm::dot(v.normal, glm::vec3(v.tangent)), 0, 1e-5);
      ASSERT_EQ(std::abs(v.tangent.w), 1.0f);
      ASSERT_TRUE(v.uv.x >= 0 && v.uv.x <= 1 && v.uv.y >= 0 && v.uv.y <= 1);
    }
  }
}

// Hairs per area follow texture area per area: nearly the same everywhere, and no chart is folded or mirrored.
TEST(BuiltinAnimal, TextureDensityIsEven) {
  double uvTotal = 0, total = 0, deviation = 0;
  std::vector<std::pair<double, double>> areas;
  for (size_t t = 0; t < Skin().indices.size(); t += 3) {
    const auto at = [&](size_t i) { return Skin().vertices[Skin().indices[t + i]]; };
    const glm::dvec2 e = at(1).uv - at(0).uv, f = at(2).uv - at(0).uv;
    const double uv = (e.x * f.y - e.y * f.x) / 2;
    ASSERT_GT(uv, 0) << "triangle " << t / 3;
    areas.emplace_back(uv,
                       glm::length(glm::cross(at(1).position - at(0).position, at(2).position - at(0).position)) / 2);
    uvTotal += uv;
    total += areas.back().second;
  }
  for (const auto& [uv, area] : areas) deviation += area / total * std::pow(uv / area / (uvTotal / total) - 1, 2);
  EXPECT_LT(std::sqrt(deviation), 0.1);
}

TEST(BuiltinAnimal, StandsOnTheGroundTwoUnitsLong) {
  const Model& m = Animal();
  glm::vec3 low(1e9f), high(-1e9f);
  for (const Primitive& p : m.primitives) {
    for (const Vertex& v : p.vertices) low = glm::min(low, v.position), high = glm::max(high, v.position);
  }
  EXPECT_NEAR(low.y, 0, 0.01);
  EXPECT_NEAR(high.z - low.z, 2, 0.3);
  EXPECT_NEAR(low.x + high.x, 0, 0.02);
  EXPECT_GT(high.y, 1.0f);
  EXPECT_LT(high.y, 1.8f);
}

TEST(BuiltinAnimal, EyesAndNoseAreBaldAndSoIsTheSkinAroundThem) {
  const Model& m = Animal();
  std::set<std::string> bald;
  for (const Primitive& p : m.primitives) {
    if (!m.materials[p.material].fur) bald.insert(p.name);
  }
  EXPECT_EQ(bald, (std::set<std::string>{"eye_left", "eye_right", "nose"}));
  const Image& length = m.images[m.materials[0].fur->lengthMap];
  uint8_t longest = 0;
  for (const Vertex& v : Skin().vertices) {
    const auto x = static_cast<size_t>(v.uv.x * static_cast<float>(length.width));
    const auto y = static_cast<size_t>(v.uv.y * static_cast<float>(length.height));
    const uint8_t red = length.pixels[(y * length.width + x) * 4];
    longest = std::max(longest, red);
    const glm::vec3 folded{std::abs(v.position.x), v.position.y, v.position.z};
    if (glm::length(folded - glm::vec3(0.115f, 1.05f, 0.748f)) < 0.066f) {
      EXPECT_LT(red, 8);
    }
  }
  EXPECT_GT(longest, 240);
}

TEST(BuiltinAnimal, IsTheSameEveryTime) {
  const Model again = MakeBuiltinAnimal();
  ASSERT_EQ(again.primitives.size(), Animal().primitives.size());
  for (size_t i = 0; i < again.primitives.size(); ++i) {
    const Primitive &a = again.primitives[i], &b = Animal().primitives[i];
    EXPECT_EQ(a.indices, b.indices);
    EXPECT_TRUE(std::equal(a.vertices.begin(), a.vertices.end(), b.vertices.begin(), b.vertices.end(), SameBytes));
  }
  for (size_t i = 0; i < again.images.size(); ++i) EXPECT_EQ(again.images[i].pixels, Animal().images[i].pixels);
  EXPECT_EQ(again.volumes[0].pixels, Animal().volumes[0].pixels);
}

}  // namespace
}  // namespace fur

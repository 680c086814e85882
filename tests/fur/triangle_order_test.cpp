// The order of furred triangles, against rays through their prisms.
#include "triangle_order.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>

#include "random.h"

namespace fur {
namespace {

using Indices = std::vector<uint32_t>;
using Points = std::vector<glm::dvec3>;
constexpr glm::dvec3 kNoComb(0);

struct Body {
  Points points;
  Indices indices;
};

FurVertex Root(const glm::dvec3& p, const glm::dvec3& direction, double length) {
  return {.position = glm::vec4(glm::vec3(p), float(length)), .direction = glm::vec4(glm::vec3(direction), 0)};
}

constexpr double kLength = 0.25;

// Fur away from the origin, one length for all.
std::vector<FurVertex> Radial(const Body& body) {
  std::vector<FurVertex> vertices;
  for (const glm::dvec3& p : body.points) vertices.push_back(Root(p, glm::normalize(p), kLength));
  return vertices;
}

Body Tetrahedron() {
  return {{{1, 1, 1}, {1, -1, -1}, {-1, 1, -1}, {-1, -1, 1}}, {0, 1, 2, 0, 3, 1, 0, 2, 3, 1, 3, 2}};
}

Body Cube() {
  Body body{
      {}, {0, 2, 3, 0, 3, 1, 4, 5, 7, 4, 7, 6, 0, 1, 5, 0, 5, 4, 2, 6, 7, 2, 7, 3, 0, 4, 6, 0, 6, 2, 1, 3, 7, 1, 7, 5}};
  for (int i = 0; i < 8; ++i) body.points.push_back({i & 1 ? 1 : -1, i & 2 ? 1 : -1, i & 4 ? 1 : -1});
  return body;
}

Body Icosahedron() {
  const double g = (1 + std::sqrt(5.0)) / 2;
  Body body{{{-1, g, 0},
             {1, g, 0},
             {-1, -g, 0},
             {1, -g, 0},
             {0, -1, g},
             {0, 1, g},
             {0, -1, -g},
             {0, 1, -g},
             {g, 0, -1},
             {g, 0, 1},
             {-g, 0, -1},
             {-g, 0, 1}},
            {0, 11, 5, 0, 5, 1, 0, 1, 7, 0, 7, 10, 0, 10, 11, 1, 5, 9, 5, 11, 4,  11, 10, 2,  10, 7, 6, 7, 1, 8,
             3, 9,  4, 3, 4, 2, 3, 2, 6, 3, 6, 8,  3, 8,  9,  4, 9, 5, 2, 4,  11, 6,  2,  10, 8,  6, 7, 9, 8, 1}};
  for (glm::dvec3& p : body.points) p = glm::normalize(p);
  return body;
}

Body Icosphere(int levels) {
  Body body = Icosahedron();
  for (; levels > 0; --levels) {
    Indices finer;
    std::map<std::pair<uint32_t, uint32_t>, uint32_t> middles;
    const auto middle = [&](uint32_t a, uint32_t b) {
      const auto [it, isNew] = middles.try_emplace(std::minmax(a, b), uint32_t(body.points.size()));
      if (isNew) body.points.push_back(glm::normalize(body.points[a] + body.points[b]));
      return it->second;
    };
    for (size_t i = 0; i < body.indices.size(); i += 3) {
      const uint32_t a = body.indices[i], b = body.indices[i + 1], c = body.indices[i + 2];
      const uint32_t ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
      finer.insert(finer.end(), {a, ab, ca, ab, b, bc, ca, bc, c, ab, bc, ca});
    }
    body.indices = finer;
  }
  return body;
}

Indices Sorted(const Body& body, const glm::dvec3& eye) {
  return TriangleOrder(Radial(body), body.indices).BackToFront(eye, kNoComb);
}

bool IsPermutation(Indices order, size_t count) {
  std::sort(order.begin(), order.end());
  Indices all(count);
  std::iota(all.begin(), all.end(), 0u);
  return order == all;
}

// ------------------------------------------------------------------------------------------------- rays and prisms
struct Plane {  // inside: dot(normal, x) <= offset
  glm::dvec3 normal;
  double offset;
};
// The fur of a triangle of a radial body: between its walls, which all contain the origin, above the skin, below the
// tips.
std::array<Plane, 5> Prism(const Body& body, size_t triangle) {
  std::array<glm::dvec3, 3> p, tip;
  for (size_t k = 0; k < 3; ++k) {
    p[k] = body.points[body.indices[3 * triangle + k]];
    tip[k] = p[k] + glm::normalize(p[k]) * kLength;
  }
  const glm::dvec3 skin = glm::cross(p[1] - p[0], p[2] - p[0]), top = glm::cross(tip[1] - tip[0], tip[2] - tip[0]);
  std::array<Plane, 5> planes{Plane{-skin, -glm::dot(skin, p[0])}, Plane{top, glm::dot(top, tip[0])}};
  for (size_t k = 0; k < 3; ++k) planes[2 + k] = {glm::cross(p[(k + 1) % 3], p[k]), 0};
  return planes;
}

struct Crossing {
  double in, out;
  size_t triangle;
};
// Clips the ray, Cyrus and Beck 1978.
bool Cross(const std::array<Plane, 5>& prism, const glm::dvec3& eye, const glm::dvec3& ray, Crossing* c) {
  c->in = 0;
  c->out = std::numeric_limits<double>::infinity();
  for (const Plane& plane : prism) {
    const double speed = glm::dot(plane.normal, ray), gap = plane.offset - glm::dot(plane.normal, eye);
    if (speed > 0) c->out = std::min(c->out, gap / speed);
    if (speed < 0) c->in = std::max(c->in, gap / speed);
    if (speed == 0 && gap < 0) return false;
  }
  return c->out - c->in > 1e-6;  // less is a corner, within the rounding of the float vertices
}

glm::dvec3 RandomDirection(Pcg32* random) {
  for (;;) {
    const glm::dvec3 v = glm::dvec3(random->Uniform(), random->Uniform(), random->Uniform()) * 2.0 - 1.0;
    const double size = glm::length(v);
    if (size > 0.01 && size <= 1) return v / size;
  }
}

// Rays from the eye to random points in the fur; returns the number of pairs of prisms that a ray crosses one after the
// other.
size_t ExpectPaintersOrder(const Body& body, const glm::dvec3& eye, Pcg32* random) {
  const Indices order = Sorted(body, eye);
  EXPECT_TRUE(IsPermutation(order, body.indices.size() / 3));
  std::vector<size_t> place(order.size());
  for (size_t i = 0; i < order.size(); ++i) place[order[i]] = i;
  std::vector<std::array<Plane, 5>> prisms;
  for (size_t t = 0; t < order.size(); ++t) prisms.push_back(Prism(body, t));
  size_t pairs = 0, wrong = 0;
  for (int i = 0; i < 300; ++i) {
    const glm::dvec3 ray = RandomDirection(random) * (1.0 + kLength) - eye;
    std::vector<Crossing> crossings;
    for (size_t t = 0; t < prisms.size(); ++t) {
      Crossing c{0, 0, t};
      if (Cross(prisms[t], eye, ray, &c)) crossings.push_back(c);
    }
    std::sort(crossings.begin(), crossings.end(), [](const Crossing& a, const Crossing& b) { return a.in < b.in; });
    for (size_t k = 1; k < crossings.size(); ++k) {
      EXPECT_GE(crossings[k].in, crossings[k - 1].out - 1e-6) << "the prisms of the test overlap";
      ++pairs;
      wrong += place[crossings[k].triangle] > place[crossings[k - 1].triangle];
    }
  }
  EXPECT_EQ(wrong, 0u) << "of " << pairs << " pairs, eye at " << eye.x << ", " << eye.y << ", " << eye.z;
  return pairs;
}

void ExpectPaintersOrderFromManyEyes(const Body& body) {
  Pcg32 random(7);
  size_t pairs = 0;
  for (int i = 0; i < 30; ++i) {
    const double distance = 1.8 + 6 * random.Uniform();  // from just outside the fur
    pairs += ExpectPaintersOrder(body, RandomDirection(&random) * distance, &random);
  }
  EXPECT_GT(pairs, 3000u);
}

TEST(TriangleOrder, TetrahedronIsPaintedBackToFront) { ExpectPaintersOrderFromManyEyes(Tetrahedron()); }
TEST(TriangleOrder, CubeIsPaintedBackToFront) { ExpectPaintersOrderFromManyEyes(Cube()); }
TEST(TriangleOrder, IcosahedronIsPaintedBackToFront) { ExpectPaintersOrderFromManyEyes(Icosahedron()); }
TEST(TriangleOrder, IcosphereIsPaintedBackToFront) { ExpectPaintersOrderFromManyEyes(Icosphere(2)); }

// Below the skin, inside the fur, on the axes where walls are seen edge-on.
TEST(TriangleOrder, EyeInside) {
  Pcg32 random(11);
  size_t pairs = 0;
  for (const Body& body : {Tetrahedron(), Cube(), Icosphere(1)})
    for (int i = 0; i < 20; ++i)
      pairs += ExpectPaintersOrder(body, RandomDirection(&random) * 1.1 * random.Uniform(), &random);
  EXPECT_GT(pairs, 1000u);
  for (const glm::dvec3& eye : {glm::dvec3(0), {0, 0, 0.5}, {0, 0, 3}, {1, 1, 1}, {2, 2, 2}, {1, 0, 0}})
    ExpectPaintersOrder(Cube(), eye, &random);
}

// ---------------------------------------------------------------------------------------------------- single walls
// Two triangles on the edge x = 0, fur along +Z: one reaches far to +X, one a little to -X.
struct Pair {
  std::vector<FurVertex> vertices;
  Indices indices;
};
Pair LopsidedPair(double length0 = 1, double length1 = 1) {
  const glm::dvec3 up(0, 0, 1);
  const FurVertex a = Root({0, -1, 0}, up, length0), b = Root({0, 1, 0}, up, length1);
  return {{a, b, Root({90, 0, 0}, up, 1), b, a, Root({-1, 0, 0}, up, 1)}, {0, 1, 2, 3, 4, 5}};
}
Indices Sorted(const Pair& pair, const glm::dvec3& eye, const glm::dvec3& comb = kNoComb) {
  return TriangleOrder(pair.vertices, pair.indices).BackToFront(eye, comb);
}

TEST(TriangleOrder, WallDecidesAgainstDistanceAndAcrossSeams) {
  EXPECT_EQ(Sorted(LopsidedPair(), {5, 0, 3}), (Indices{1, 0}));
  EXPECT_EQ(Sorted(LopsidedPair(), {-5, 0, 3}), (Indices{0, 1}));
  Pair apart = LopsidedPair();  // the same without a common edge: by distance
  apart.vertices[3].position.z = apart.vertices[4].position.z = 0.001f;
  EXPECT_EQ(Sorted(apart, {5, 0, 3}), (Indices{0, 1}));
}

TEST(TriangleOrder, WallLeansWithTheFurAndTheComb) {
  Pair pair = LopsidedPair();
  EXPECT_EQ(Sorted(pair, {1, 0, 3}), (Indices{1, 0}));
  EXPECT_EQ(Sorted(pair, {1, 0, 3}, {2, 0, 0}), (Indices{0, 1})) << "at z = 3 the wall is at x = 6";
  EXPECT_EQ(Sorted(pair, {7, 0, 3}, {2, 0, 0}), (Indices{1, 0}));
  for (FurVertex& v : pair.vertices) v.direction = glm::vec4(0.6f, 0, 0.8f, 0);
  EXPECT_EQ(Sorted(pair, {2, 0, 3}), (Indices{0, 1})) << "at z = 3 the wall is at x = 2.25";
  EXPECT_EQ(Sorted(pair, {2.5, 0, 3}), (Indices{1, 0}));
}

TEST(TriangleOrder, LongerFurLeansTheWallMore) {
  Pair pair = LopsidedPair(3, 1);
  for (const size_t i : {0, 4}) pair.vertices[i].direction = glm::vec4(1, 0, 0, 0);
  // Tips: (3, -1, 0) and (0, 1, 1); their mean way is (1.5, 0, 0.5), so at z = 1 the wall is at x = 3.
  EXPECT_EQ(Sorted(pair, {2.9, 0, 1}), (Indices{0, 1}));
  EXPECT_EQ(Sorted(pair, {3.1, 0, 1}), (Indices{1, 0}));
}

TEST(TriangleOrder, WithoutFurOnAnEdgeThereIsNoWall) {
  EXPECT_EQ(Sorted(LopsidedPair(0, 0), {5, 0, 3}), (Indices{0, 1}));
  EXPECT_EQ(Sorted(LopsidedPair(0, 1), {5, 0, 3}), (Indices{1, 0})) << "one end is enough";
}

// ---------------------------------------------------------------------------------------------------- odd meshes
// A triangle in a larger one turned against it: the walls of the ring between them run in a circle.
TEST(TriangleOrder, CirclesAreBrokenByTheFarthest) {
  Body body{{}, {0, 1, 2}};
  for (int i = 0; i < 6; ++i) {
    const double angle = glm::radians(i < 3 ? 120.0 * i : 120.0 * i + 130), radius = i < 3 ? 1 : 4;
    body.points.push_back({radius * std::cos(angle), radius * std::sin(angle), 0});
  }
  for (uint32_t i = 0; i < 3; ++i) {
    const uint32_t j = (i + 1) % 3;
    body.indices.insert(body.indices.end(), {i, 3 + i, j, j, 3 + i, 3 + j});
  }
  std::vector<FurVertex> vertices;
  for (const glm::dvec3& p : body.points) vertices.push_back(Root(p, {0, 0, 1}, 1));
  const Indices order = TriangleOrder(vertices, body.indices).BackToFront({0.01, 0.02, 5}, kNoComb);
  EXPECT_TRUE(IsPermutation(order, 7));
  EXPECT_EQ(order.back(), 0u) << "the eye is above it";
  size_t farthest = 0;
  double most = 0;
  for (size_t t = 0; t < 7; ++t) {
    const glm::dvec3 middle = (body.points[body.indices[3 * t]] + body.points[body.indices[3 * t + 1]] +
                               body.points[body.indices[3 * t + 2]]) /
                              3.0;
    const double distance = glm::length(middle - glm::dvec3(0.01, 0.02, 5));
    if (distance > most) farthest = t;
    most = std::max(most, distance);
  }
  EXPECT_EQ(order.front(), farthest);
}

TEST(TriangleOrder, DegenerateTrianglesStayInTheList) {
  Body body = Cube();
  body.indices.insert(body.indices.begin(), {0, 0, 1, 3, 3, 3});
  body.indices.insert(body.indices.end(), {5, 1, 5});
  body.points.push_back({0, 1, 1});  // on the middle of an edge: three points in a line
  body.indices.insert(body.indices.end(), {6, 7, 8});
  Pcg32 random(3);
  for (int i = 0; i < 20; ++i) {
    const glm::dvec3 eye = RandomDirection(&random) * 4.0;
    const Indices order = Sorted(body, eye);
    EXPECT_TRUE(IsPermutation(order, 16));
    EXPECT_EQ(order, Sorted(body, eye));
  }
}

// By the side of the middle shell's plane: the eye moves through it, and a comb and the fur's length move it.
TEST(TriangleOrder, SeenFromBehindIsBeyondTheMiddleShell) {
  const Body body{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {0, 1, 2}};
  for (const bool flipped : {false, true}) {  // whichever way the triangle is wound, its fur says where its outside is
    std::vector<FurVertex> vertices;
    for (const glm::dvec3& p : body.points) vertices.push_back(Root(p, {0, 0, 1}, 0.5));
    const TriangleOrder order(vertices, flipped ? Indices{0, 2, 1} : body.indices);
    const auto behind = [&](double z, double length, const glm::dvec3& comb) {
      return order.SeenFromBehind(0, {0.2, 0.2, z}, comb, length);
    };
    EXPECT_FALSE(behind(0.26, 1, kNoComb));  // the middle is at 0.5 x 1 / 2
    EXPECT_TRUE(behind(0.24, 1, kNoComb));
    EXPECT_FALSE(behind(0.6, 2, kNoComb));
    EXPECT_TRUE(behind(0.4, 2, kNoComb));
    EXPECT_TRUE(behind(0.3, 1, {0, 0, 1}));  // combed on along the fur: twice as far
    EXPECT_TRUE(behind(-5, 1, kNoComb));
  }
}

TEST(TriangleOrder, NothingInNothingOut) {
  EXPECT_TRUE(TriangleOrder().BackToFront({1, 2, 3}, kNoComb).empty());
  EXPECT_TRUE(TriangleOrder({}, {}).BackToFront({1, 2, 3}, kNoComb).empty());
}

TEST(TriangleOrder, EqualDistancesKeepTheListsOrder) {
  const FurVertex a = Root({1, 0, 0}, {0, 0, 1}, 0), b = Root({0, 1, 0}, {0, 0, 1}, 0),
                  c = Root({0, 0, 0}, {0, 0, 1}, 0);
  EXPECT_EQ(TriangleOrder(std::array{a, b, c}, Indices{0, 1, 2, 1, 2, 0, 2, 0, 1}).BackToFront({0, 0, 9}, kNoComb),
            (Indices{0, 1, 2}));
}

TEST(TriangleOrder, AnEyeThatIsNowhereLeavesTheListsOrder) {
  const double nan = std::numeric_limits<double>::quiet_NaN(), huge = std::numeric_limits<double>::max();
  for (const double x : {nan, std::numeric_limits<double>::infinity(), huge}) {
    EXPECT_TRUE(IsPermutation(Sorted(Cube(), {x, 0, 0}), 12)) << x;
    EXPECT_EQ(Sorted(Cube(), {x, 0, 0}), Sorted(Cube(), {x, 0, 0})) << x;
  }
  EXPECT_EQ(Sorted(LopsidedPair(), {nan, 0, 0}), (Indices{0, 1}));
}

// A book of many pages: linear, not every page with every other.
TEST(TriangleOrder, ManyTrianglesOnOneEdge) {
  Body body{{{0, 0, -1}, {0, 0, 1}}, {}};
  for (uint32_t i = 0; i < 50000; ++i) {
    body.points.push_back({std::cos(i * 1e-4), std::sin(i * 1e-4), 0});
    body.indices.insert(body.indices.end(), {0, 1, 2 + i});
  }
  EXPECT_TRUE(IsPermutation(Sorted(body, {3, 2, 1}), 50000));
}

}  // namespace
}  // namespace fur

#include "fur/fur_uv.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <glm/gtc/matrix_transform.hpp>
#include <optional>

#include "fur_uv_charts.h"
#include "fur_uv_flatten.h"

namespace fur {
namespace {

using glm::dvec2;
using glm::dvec3;

constexpr double kPi = 3.14159265358979323846;
constexpr uint32_t kCells = 8;  // of a sheet, across and down

struct Point {
  dvec3 position, normal;
  dvec2 uv;
};

// A sheet of kCells x kCells squares over s, t = 0..1.
Primitive Sheet(const std::function<Point(double, double)>& at) {
  Primitive p;
  for (uint32_t j = 0; j <= kCells; ++j) {
    for (uint32_t i = 0; i <= kCells; ++i) {
      const Point point = at(double(i) / kCells, double(j) / kCells);
      p.vertices.push_back({.position = glm::vec3(point.position),
                            .normal = glm::vec3(glm::normalize(point.normal)),
                            .uv = glm::vec2(point.uv)});
    }
  }
  for (uint32_t j = 0; j < kCells; ++j) {
    for (uint32_t i = 0; i < kCells; ++i) {
      const uint32_t a = j * (kCells + 1) + i, b = a + 1, c = a + kCells + 1, d = c + 1;
      p.indices.insert(p.indices.end(), {a, b, d, a, d, c});
    }
  }
  return p;
}

// Seen from +z.
Primitive Square(const std::function<dvec2(double, double)>& uv) {
  return Sheet([&](double s, double t) { return Point{{s, t, 0}, {0, 0, 1}, uv(s, t)}; });
}

// Not developable: a bump.
Primitive Bump(double scale = 1, const glm::dmat3& turn = glm::dmat3(1)) {
  return Sheet([&](double s, double t) {
    const double x = s - 0.5, y = t - 0.5, z = 0.5 * std::exp(-6 * (x * x + y * y));
    return Point{turn * dvec3(x, y, z) * scale, turn * dvec3(12 * x * z, 12 * y * z, 1), {s * s, 0.3 * t}};
  });
}

// From radius `bottom` to `top`, cut open along one line. Its facets are flat, so it unrolls exactly.
Primitive Tube(double bottom, double top, const std::function<dvec2(double, double)>& uv) {
  return Sheet([&](double s, double t) {
    const dvec2 around(std::cos(2 * kPi * s), std::sin(2 * kPi * s));
    return Point{dvec3(around * (bottom + (top - bottom) * t), t), dvec3(around, 0), uv(s, t)};
  });
}

void Append(const Primitive& from, Primitive* to) {
  const auto base = static_cast<uint32_t>(to->vertices.size());
  to->vertices.insert(to->vertices.end(), from.vertices.begin(), from.vertices.end());
  for (uint32_t i : from.indices) to->indices.push_back(base + i);
}

Primitive Unindexed(const Primitive& p) {
  Primitive out;
  for (uint32_t i : p.indices) {
    out.indices.push_back(static_cast<uint32_t>(out.vertices.size()));
    out.vertices.push_back(p.vertices[i]);
  }
  return out;
}

std::vector<double> EdgeLengths(const Primitive& p, const std::vector<dvec2>& uv) {
  std::vector<double> out;
  for (uint32_t c = 0; c < p.indices.size(); ++c) {
    out.push_back(glm::length(uv[p.indices[c % 3 == 2 ? c - 2 : c + 1]] - uv[p.indices[c]]));
  }
  return out;
}

double LongestOff(const std::vector<double>& a, const std::vector<double>& b) {
  double off = a.size() == b.size() ? 0 : HUGE_VAL;
  for (size_t i = 0; i < std::min(a.size(), b.size()); ++i) off = std::max(off, std::abs(a[i] - b[i]));
  return off;
}

// The largest difference between an edge's length in uv and on the skin.
double IsometryError(const Primitive& p, const FurUv& fur) {
  std::vector<double> skin;
  for (uint32_t c = 0; c < p.indices.size(); ++c) {
    const dvec3 a(p.vertices[p.indices[c]].position), b(p.vertices[p.indices[c % 3 == 2 ? c - 2 : c + 1]].position);
    skin.push_back(glm::length(b - a));
  }
  return LongestOff(skin, EdgeLengths(p, fur.uv));
}

void ExpectSound(const Primitive& p, const FurUv& fur) {
  ASSERT_EQ(fur.uv.size(), p.vertices.size());
  ASSERT_EQ(fur.tangent.size(), p.vertices.size());
  ASSERT_EQ(fur.handedness.size(), p.vertices.size());
  for (size_t v = 0; v < p.vertices.size(); ++v) {
    ASSERT_TRUE(std::isfinite(fur.uv[v].x) && std::isfinite(fur.uv[v].y)) << "vertex " << v;
    ASSERT_NEAR(glm::length(fur.tangent[v]), 1, 1e-9) << "vertex " << v;
    const dvec3 normal(p.vertices[v].normal);
    ASSERT_NEAR(glm::dot(fur.tangent[v], normal), 0, 1e-6 * glm::length(normal)) << "vertex " << v;
    ASSERT_EQ(std::abs(fur.handedness[v]), 1) << "vertex " << v;
  }
}

uint32_t Mirrored(const FurUv& fur) {
  return static_cast<uint32_t>(std::count(fur.handedness.begin(), fur.handedness.end(), -1.0f));
}

// Isometric, one chart, not mirrored anywhere.
void ExpectUnrolled(const Primitive& p) {
  const FurUv fur = MakeFurUv(p);
  ExpectSound(p, fur);
  EXPECT_EQ(fur.charts, 1u);
  EXPECT_EQ(fur.keptCharts, 0u);
  EXPECT_EQ(Mirrored(fur), 0u);
  EXPECT_LT(IsometryError(p, fur), 1e-6);
}

TEST(FurUv, ASquareIsItselfWhateverItsUvs) {
  ExpectUnrolled(Square([](double s, double t) { return dvec2(s, t); }));
  ExpectUnrolled(Square([](double s, double t) { return dvec2(5 * s, 0.2 * t); }));
  ExpectUnrolled(Square([](double s, double t) { return dvec2(s + 2 * t, 0.1 * t); }));
  ExpectUnrolled(Square([](double s, double t) { return dvec2(std::exp(3 * s), t * (1 + s)); }));
}

TEST(FurUv, TheLocalGlobalStepAloneUnrolls) {
  for (const double side : {1.0, -1.0}) {
    const Primitive p = Tube(1, 0.4, [&](double s, double t) { return dvec2(side * 3 * s + t, 2 * t); });
    const furuv::Charts charts = furuv::FindCharts(p);
    ASSERT_EQ(charts.charts.size(), 1u);
    const std::optional<furuv::Flat> flat = furuv::RelaxModelUv(charts.charts[0]);
    ASSERT_TRUE(flat);
    EXPECT_EQ(flat->flipped, 0u);
    EXPECT_LT(flat->energy, 1e-5 * charts.charts[0].area);
  }
}

TEST(FurUv, AMirroredChartStartsAsItsMirrorImage) {
  Primitive p = Bump();
  const std::optional<furuv::Flat> one = furuv::RelaxModelUv(furuv::FindCharts(p).charts.at(0));
  for (Vertex& v : p.vertices) v.uv.x = -v.uv.x;
  const std::optional<furuv::Flat> other = furuv::RelaxModelUv(furuv::FindCharts(p).charts.at(0));
  ASSERT_TRUE(one && other);
  EXPECT_EQ(one->uv, other->uv);
}

TEST(FurUv, TubesUnroll) {
  ExpectUnrolled(Tube(1, 1, [](double s, double t) { return dvec2(s, t); }));
  ExpectUnrolled(Tube(1, 0.3, [](double s, double t) { return dvec2(3 * s, t * t + t); }));
}

TEST(FurUv, AMirroredChartIsTurnedOver) {
  ExpectUnrolled(Square([](double s, double t) { return dvec2(-3 * s, t); }));
  ExpectUnrolled(Square([](double s, double t) { return dvec2(t, s); }));
}

TEST(FurUv, MirroredHalvesThatShareTheirMiddleUnfold) {
  ExpectUnrolled(Square([](double s, double t) { return dvec2(std::abs(s - 0.5), t); }));
  ExpectUnrolled(Square([](double s, double t) { return dvec2(std::abs(s - 0.25), std::abs(t - 0.5)); }));
}

TEST(FurUv, HandednessIsPlusOneSeenAlongTheNormals) {
  Primitive inside = Tube(1, 1, [](double s, double t) { return dvec2(s, t); });
  for (Vertex& v : inside.vertices) v.normal = -v.normal;
  ExpectUnrolled(inside);
  Primitive mixed = Square([](double s, double t) { return dvec2(s, 2 * t); });
  for (size_t i = 0; i < mixed.indices.size(); i += 12) std::swap(mixed.indices[i], mixed.indices[i + 1]);
  ExpectUnrolled(mixed);
}

TEST(FurUv, UvsWithoutAreaAreReplaced) {
  ExpectUnrolled(Square([](double, double) { return dvec2(0.5); }));
  ExpectUnrolled(Tube(1, 0.5, [](double, double t) { return dvec2(t, 0); }));
  ExpectUnrolled(Square([](double s, double t) { return dvec2(s > 0.4 ? std::nan("") : s, t); }));
}

TEST(FurUv, TheTangentIsThePositionsDerivative) {
  const Primitive p = Square([](double s, double t) { return dvec2(2 * s + t, t); });
  const FurUv fur = MakeFurUv(p);
  for (size_t c = 0; c < p.indices.size(); c += 3) {
    const uint32_t a = p.indices[c], b = p.indices[c + 1];
    const dvec3 along = dvec3(p.vertices[b].position) - dvec3(p.vertices[a].position);
    EXPECT_NEAR(glm::dot(along, fur.tangent[a]), fur.uv[b].x - fur.uv[a].x, 1e-6);
  }
}

TEST(FurUv, AnUnindexedMeshHasTheChartsOfTheIndexedOne) {
  const Primitive indexed = Bump(), loose = Unindexed(indexed);
  const FurUv a = MakeFurUv(indexed), b = MakeFurUv(loose);
  EXPECT_EQ(b.charts, 1u);
  EXPECT_LT(LongestOff(EdgeLengths(indexed, a.uv), EdgeLengths(loose, b.uv)), 1e-9);
  for (size_t c = 0; c < indexed.indices.size(); ++c) {
    EXPECT_LT(glm::length(a.tangent[indexed.indices[c]] - b.tangent[c]), 1e-6);
  }
}

TEST(FurUv, OnlyTheModelsSeamsCut) {
  // The same sheet twice, its second half's UVs elsewhere: positions meet, UVs do not.
  Primitive p = Square([](double s, double t) { return dvec2(s, t); });
  Primitive beside = p;
  for (Vertex& v : beside.vertices) {
    v.position.x += 1;
    v.uv.x += 3;
  }
  Append(beside, &p);
  EXPECT_EQ(MakeFurUv(p).charts, 2u);
  for (size_t v = p.vertices.size() / 2; v < p.vertices.size(); ++v) p.vertices[v].uv.x -= 2;
  EXPECT_EQ(MakeFurUv(p).charts, 1u);
}

TEST(FurUv, DegenerateTrianglesDoNotMatter) {
  Primitive p = Square([](double s, double t) { return dvec2(s, 3 * t); });
  const auto more = static_cast<uint32_t>(p.vertices.size());
  p.vertices.push_back(p.vertices[0]);  // welded to 0
  p.vertices.push_back({.position = {0.5f, -1e-9f, 0}, .uv = {0.5f, -0.3f}});
  p.vertices.push_back({.position = {7, 7, 7}, .uv = {1, 1}});  // unused
  p.vertices.push_back({.position = {9, 9, 9}, .normal = {0, 0, 0}});
  p.indices.insert(p.indices.end(), {3, 3, 3, 0, more, 1, 0, kCells, more + 1, 5, 4, 5, 10, 11, 12});
  p.indices.insert(p.indices.end(), {more + 3, more + 3, more + 3});  // a chart of one point
  const FurUv fur = MakeFurUv(p);
  for (size_t v = 0; v < more; ++v) {
    ASSERT_TRUE(std::isfinite(fur.uv[v].x) && std::isfinite(fur.uv[v].y));
    EXPECT_NEAR(glm::length(fur.uv[v] - fur.uv[0]), glm::length(p.vertices[v].position), 1e-3);
  }
  EXPECT_EQ(fur.charts, 2u);
  p.vertices.back().normal = {0, 0, 1};
  ExpectSound(p, MakeFurUv(p));
}

TEST(FurUv, SliversAndTinyChartsAreFinite) {
  for (const float height : {1.0f, 1e-3f, 1e-6f, 1e-12f, 1e-30f, 0.0f}) {
    Primitive p;
    p.vertices = {{.position = {0, 0, 0}},
                  {.position = {1, 0, 0}, .uv = {1, 0}},
                  {.position = {0.3f, height, 0}, .uv = {0.2f, 1}}};
    p.indices = {0, 1, 2};
    const FurUv fur = MakeFurUv(p);
    ExpectSound(p, fur);
    EXPECT_EQ(fur.charts, 1u);
    if (height >= 1e-3f) {
      EXPECT_LT(IsometryError(p, fur), 1e-6);
    }
  }
  ExpectSound({}, MakeFurUv({}));
}

TEST(FurUv, AClosedChartKeepsTheModelsCoordinates) {
  Primitive p;
  p.vertices = {{.position = {1, 1, 1}, .uv = {0, 0}},
                {.position = {1, -1, -1}, .uv = {1, 0}},
                {.position = {-1, 1, -1}, .uv = {0, 1}},
                {.position = {-1, -1, 1}, .uv = {1, 1}}};
  for (Vertex& v : p.vertices) v.normal = glm::normalize(v.position);
  p.indices = {0, 1, 2, 0, 3, 1, 0, 2, 3, 1, 3, 2};
  const FurUv fur = MakeFurUv(p);
  ExpectSound(p, fur);
  EXPECT_EQ(fur.keptCharts, 1u);
  const double side = glm::length(fur.uv[1] - fur.uv[0]);
  EXPECT_NEAR(glm::length(fur.uv[2] - fur.uv[0]), side, 1e-9);
  EXPECT_NEAR(glm::length(fur.uv[3] - fur.uv[0]), side * std::sqrt(2), 1e-9);
}

TEST(FurUv, WhatStaysMirroredSaysSo) {
  // Two squares back to back, one's UVs mirrored by being shared along the whole border: closed, so it stays folded.
  Primitive p = Square([](double s, double t) { return dvec2(s, t); });
  const auto half = static_cast<uint32_t>(p.vertices.size());
  Primitive back = p;
  for (Vertex& v : back.vertices) {
    const double s = v.uv.x, t = v.uv.y, inside = 16 * s * t * (1 - s) * (1 - t);
    v.position.z = float(-0.1 * inside);
    v.normal = -v.normal;
  }
  for (size_t i = 0; i < back.indices.size(); i += 3) std::swap(back.indices[i], back.indices[i + 1]);
  Append(back, &p);
  const FurUv fur = MakeFurUv(p);
  ExpectSound(p, fur);
  EXPECT_EQ(fur.keptCharts, 1u);
  const uint32_t middle = kCells / 2 * (kCells + 1) + kCells / 2;
  EXPECT_EQ(fur.handedness[middle], -fur.handedness[half + middle]);
  EXPECT_GT(glm::dot(fur.tangent[middle], fur.tangent[half + middle]), 0.99);
}

TEST(FurUv, PowersOfTwoScaleExactly) {
  const FurUv one = MakeFurUv(Bump());
  for (const double scale : {0x1p-20, 0.5, 0x1p10}) {
    const FurUv other = MakeFurUv(Bump(scale));
    for (size_t v = 0; v < one.uv.size(); ++v) {
      ASSERT_EQ(other.uv[v], one.uv[v] * scale) << "vertex " << v << ", scale " << scale;
      ASSERT_EQ(other.tangent[v], one.tangent[v]);
    }
  }
}

TEST(FurUv, TurningTheModelDoesNotMatter) {
  const glm::dmat3 turn(glm::rotate(glm::dmat4(1), 1.1, glm::normalize(dvec3(1, 2, -0.7))));
  const Primitive p = Bump(), turned = Bump(1, turn);
  EXPECT_LT(LongestOff(EdgeLengths(p, MakeFurUv(p).uv), EdgeLengths(turned, MakeFurUv(turned).uv)), 1e-4);
}

TEST(FurUv, EachRunGivesTheSameBytes) {
  const Primitive p = Bump();
  const FurUv a = MakeFurUv(p), b = MakeFurUv(p);
  EXPECT_EQ(a.uv, b.uv);
  EXPECT_EQ(a.tangent, b.tangent);
  EXPECT_EQ(a.handedness, b.handedness);
}

TEST(FurUv, ABumpIsEvenAndKeepsItsArea) {
  const Primitive p = Bump();
  std::vector<dvec2> model;
  for (const Vertex& v : p.vertices) model.emplace_back(v.uv);
  const UvSpread before = MeasureSpread(p, model), after = MeasureSpread(p, MakeFurUv(p).uv);
  EXPECT_GT(before.Ratio(), 2);
  EXPECT_LT(after.Ratio(), 1.15);
  EXPECT_NEAR(after.median, 1, 0.02);
  EXPECT_EQ(after.flipped, 0u);
}

TEST(FurUv, ChartsAreTurnedToAgreeAcrossTheirSeam) {
  // One square whose charts are mapped upright, on the side, and mirrored upside down.
  Primitive p;
  for (int part = 0; part < 3; ++part) {
    Append(Sheet([&](double s, double t) {
             const std::array<dvec2, 3> uv{dvec2(s, t), dvec2(-t, s), dvec2(s, -t)};
             return Point{{s + part, t, 0}, {0, 0, 1}, uv[size_t(part)] + dvec2(10 * part)};
           }),
           &p);
  }
  const FurUv fur = MakeFurUv(p);
  EXPECT_EQ(fur.charts, 3u);
  // Longest in x: u runs along +x.
  for (const dvec3& t : fur.tangent) EXPECT_GT(t.x, 1 - 1e-9);
}

TEST(UvSpread, CountsByTheSkinsArea) {
  // Two unit squares of skin; the second is mapped three times as large and mirrored.
  Primitive p = Square([](double s, double t) { return dvec2(s, t); });
  const size_t half = p.vertices.size();
  Append(Primitive(p), &p);
  std::vector<dvec2> uv;
  for (size_t v = 0; v < p.vertices.size(); ++v) {
    const dvec2 at(p.vertices[v].uv);
    uv.push_back(v < half ? at : dvec2(-3, 3) * at);
  }
  const UvSpread spread = MeasureSpread(p, uv);
  EXPECT_NEAR(spread.p5, 1, 1e-6);
  EXPECT_NEAR(spread.p95, 3, 1e-6);
  EXPECT_NEAR(spread.Ratio(), 3, 1e-6);
  EXPECT_EQ(spread.flipped, 2 * kCells * kCells);
  EXPECT_EQ(MeasureSpread({}, {}).Ratio(), 1);
}

}  // namespace
}  // namespace fur

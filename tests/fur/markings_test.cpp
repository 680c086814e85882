// Markings: distances over the skin, shares, seams, and which way stripes run.
#include "fur/markings.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <map>
#include <nlohmann/json.hpp>

#include "body.h"
#include "fur/builtin.h"
#include "fur/coat_file.h"
#include "fur/fur_mesh.h"
#include "fur/gltf.h"
#include "models.h"
#include "pattern_field.h"
#include "random.h"
#include "surface_painter.h"

namespace fur::test {
namespace {

using glm::dvec2;
using glm::dvec3;

const Model& Animal() {
  static const Model model = MakeBuiltinAnimal();
  return model;
}
const Body& AnimalBody() {
  static const Body body(Animal());
  return body;
}

// A tube along z, open at its ends: rows of rings, one u seam, uvs that wrap once; looks to +z.
Model Tube(double radius, double length, uint32_t rings, uint32_t around) {
  Model model = FurredSquare(1, {255, 255, 255, 255}, UniformCoat(2, 0));
  Primitive& p = model.primitives[0];
  p.vertices.clear();
  p.indices.clear();
  for (uint32_t r = 0; r <= rings; ++r)
    for (uint32_t a = 0; a <= around; ++a) {
      const double turn = 2 * M_PI * (a % around) / around;
      const glm::vec3 normal(std::cos(turn), std::sin(turn), 0);
      const glm::vec3 position(normal.x * radius, normal.y * radius, length * r / rings);
      p.vertices.push_back({position, normal, glm::vec4(0, 0, 1, 1), glm::vec2(dvec2(double(a) / around, double(r) / rings))});
    }
  const uint32_t row = around + 1;
  for (uint32_t r = 0; r < rings; ++r)
    for (uint32_t a = 0; a < around; ++a) {
      const uint32_t v = r * row + a;
      for (const uint32_t i : {v, v + 1, v + row, v + 1, v + row + 1, v + row}) p.indices.push_back(i);
    }
  return model;
}

// Flat, with uneven triangles.
Skin Sheet(uint32_t side) {
  Skin skin;
  Pcg32 random(5);
  for (uint32_t y = 0; y <= side; ++y)
    for (uint32_t x = 0; x <= side; ++x)
      skin.positions.push_back({x + 0.4 * random.Uniform() - 0.2, y + 0.4 * random.Uniform() - 0.2, 0});
  for (uint32_t y = 0; y < side; ++y)
    for (uint32_t x = 0; x < side; ++x) {
      const uint32_t v = y * (side + 1) + x, w = v + side + 1;
      skin.triangles.push_back({v, v + 1, w});
      skin.triangles.push_back({v + 1, w + 1, w});
    }
  return skin;
}

TEST(SurfaceDistance, IsStraightOnASheet) {
  constexpr uint32_t kSide = 40, kMiddle = kSide / 2 * (kSide + 1) + kSide / 2;
  const Skin skin = Sheet(kSide);
  const std::vector<double> distance = SurfaceDistance(skin, {{kMiddle, 0}});
  for (size_t i = 0; i < distance.size(); ++i) {
    const double straight = glm::length(skin.positions[i] - skin.positions[kMiddle]);
    // Never shorter than a straight line but by the method's own error; edges alone would be up to 1.41 times as long.
    EXPECT_NEAR(distance[i], straight, 0.03 * straight + 0.3);
  }
}

TEST(SurfaceDistance, GoesAroundATube) {
  const Model tube = Tube(0.2, 1, 20, 48);
  const Body body(tube);
  const double diameter = ComputeBounds(tube).Diameter();
  // The nose is at the top of the front ring (x = 0), the far side half of the way around from it.
  double least = HUGE_VAL, most = 0;
  for (uint32_t a = 0; a < 48; ++a) {
    const double nose = body.At(0, 20 * 49 + a).nose * diameter;
    least = std::min(least, nose);
    most = std::max(most, nose);
  }
  EXPECT_EQ(least, 0);
  EXPECT_NEAR(most, M_PI * 0.2, 0.02);
}

// Turned around, and told so: the same places.
TEST(Body, LooksWhereTheModelSays) {
  Model turned = Animal();
  for (Part& part : turned.parts) part.transform = glm::rotate(glm::dmat4(1), M_PI, dvec3(0, 1, 0)) * part.transform;
  turned.materials[0].fur->params.front = {0, 5, -3};
  const Body body(turned);
  for (uint32_t v = 0; v < turned.primitives[0].vertices.size(); ++v) {
    const Place &was = AnimalBody().At(0, v), &is = body.At(0, v);
    ASSERT_NEAR(glm::length(was.p - is.p), 0, 1e-9);
    ASSERT_NEAR(was.nose, is.nose, 1e-9);
    ASSERT_NEAR(was.tail, is.tail, 1e-9);
  }
  turned.materials[0].fur->params.front = glm::dvec3(0);
  EXPECT_GT(glm::length(Body(turned).At(0, 0).p - AnimalBody().At(0, 0).p), 0.01) << "not told";
}

TEST(Body, EqualPositionsAreOnePlace) {
  const Primitive& skin = Animal().primitives[0];
  std::map<std::array<float, 3>, const Place*> places;
  size_t seams = 0;
  for (uint32_t v = 0; v < skin.vertices.size(); ++v) {
    const glm::vec3 p = skin.vertices[v].position;
    const auto [it, isNew] = places.try_emplace({p.x, p.y, p.z}, &AnimalBody().At(0, v));
    EXPECT_EQ(it->second, &AnimalBody().At(0, v));
    seams += !isNew;
  }
  EXPECT_GT(seams, 50u) << "the built-in animal has no seams to try";
}

MarkingLayer LayerOf(Pattern pattern) {
  MarkingLayer layer;
  layer.pattern = pattern;
  return layer;
}
constexpr Pattern kPatterns[] = {Pattern::Stripes, Pattern::Rosettes, Pattern::Spots, Pattern::Patches, Pattern::Streaks};

// Random points spread over the skin of a model's first primitive, with their weights of the corners.
template <class Use>
void Throw(const Model& model, uint32_t count, Use use) {
  const Primitive& p = model.primitives[0];
  std::vector<double> sums;
  double sum = 0;
  for (size_t i = 0; i < p.indices.size(); i += 3) {
    const auto at = [&](size_t k) { return dvec3(p.vertices[p.indices[i + k]].position); };
    sums.push_back(sum += glm::length(glm::cross(at(1) - at(0), at(2) - at(0))));
  }
  Pcg32 random(99);
  for (uint32_t i = 0; i < count; ++i) {
    const size_t t = size_t(std::lower_bound(sums.begin(), sums.end(), random.Uniform() * sum) - sums.begin());
    double b = random.Uniform(), c = random.Uniform();
    if (b + c > 1) b = 1 - b, c = 1 - c;
    use(std::array{p.indices[t * 3], p.indices[t * 3 + 1], p.indices[t * 3 + 2]}, 1 - b - c, b, c);
  }
}

// Of the picture, at random points of the skin.
double DarkShare(const Model& model, const Image& picture) {
  double dark = 0;
  constexpr uint32_t kPoints = 20000;
  Throw(model, kPoints, [&](const std::array<uint32_t, 3>& v, double a, double b, double c) {
    const auto uv = [&](size_t k) { return dvec2(model.primitives[0].vertices[v[k]].uv); };
    dark += 1 - SampleBilinear(picture, uv(0) * a + uv(1) * b + uv(2) * c, true, true).r;
  });
  return dark / kPoints;
}

TEST(Markings, EachPatternCoversItsShare) {
  for (const Pattern pattern : kPatterns)
    for (const double coverage : {0.15, 0.4, 0.7}) {
      Markings markings{.size = 512, .layers = {LayerOf(pattern)}};
      markings.layers[0].coverage = coverage;
      const double dark = DarkShare(Animal(), PaintMarkings(Animal(), AnimalBody(), 0, markings));
      EXPECT_NEAR(dark, coverage, 0.02) << "pattern " << int(pattern);
    }
}

TEST(Markings, TheSameBytesOnEachRun) {
  Markings markings{.size = 128};
  for (const Pattern pattern : kPatterns) markings.layers.push_back(LayerOf(pattern));
  const Image first = PaintMarkings(Animal(), AnimalBody(), 0, markings);
  EXPECT_EQ(PaintMarkings(Animal(), Body(Animal()), 0, markings).pixels, first.pixels);
  markings.layers[0].seed = 2;
  EXPECT_NE(PaintMarkings(Animal(), AnimalBody(), 0, markings).pixels, first.pixels);
}

// The picture at a point of the skin is the field's value there, on both sides of every seam.
TEST(Markings, SeamsAreContinuous) {
  Markings markings{.size = 1024, .layers = {LayerOf(Pattern::Patches)}};
  markings.layers[0].scale = 0.2, markings.layers[0].softness = 1;
  const Image picture = PaintMarkings(Animal(), AnimalBody(), 0, markings);
  const Primitive& skin = Animal().primitives[0];
  std::map<std::array<float, 3>, glm::dvec4> colors;
  size_t seams = 0;
  for (const Vertex& v : skin.vertices) {
    const auto color = SampleBilinear(picture, dvec2(v.uv), true, true);
    const auto [it, isNew] = colors.try_emplace({v.position.x, v.position.y, v.position.z}, color);
    if (isNew) continue;
    EXPECT_NEAR(color.r, it->second.r, 0.03);
    ++seams;
  }
  EXPECT_GT(seams, 50u);
}

// Along a tube a stripe comes every `scale`; around it a stripe stays itself.
TEST(Markings, StripesRunAcrossTheBody) {
  const Model tube = Tube(0.1, 1, 60, 32);
  const Body body(tube);
  MarkingLayer layer = LayerOf(Pattern::Stripes);
  layer.scale = 0.05, layer.irregular = 0.3;
  const PatternField field(layer, body);
  const auto changes = [&](dvec2 from, dvec2 step, int steps) {  // of dark to light and back, in rings and turns
    int count = 0;
    bool was = false;
    for (int i = 0; i <= steps; ++i) {
      const dvec2 at = from + step * double(i);
      const auto ring = uint32_t(at.x), a = uint32_t(at.y) % 32;
      const double part = at.x - ring;
      const Place &p = body.At(0, ring * 33 + a), &q = body.At(0, (ring + 1) * 33 + a);
      const bool dark = field.Weight(Mix({&p, &q, &q}, 1 - part, part, 0)) > 0.5;
      count += i > 0 && dark != was;
      was = dark;
    }
    return count;
  };
  int along = 0, around = 0;
  for (int k = 0; k < 32; ++k) along += changes({5, k}, {0.05, 0}, 900);        // 45 of 60 rings: 3/4 of the tube
  for (int k = 0; k < 45; ++k) around += changes({5.5 + k, 0}, {0, 1}, 16);  // half of the way around
  const double diameter = ComputeBounds(tube).Diameter();
  const double stripes = 0.75 / diameter / layer.scale;
  EXPECT_NEAR(along / 32.0 / 2, stripes, 0.25 * stripes);
  // Per length: 3/4 along, and half of 2 pi 0.1 around.
  EXPECT_GT(along / 32.0 / 0.75, 4 * (around / 45.0 / (M_PI * 0.1)));
}

TEST(Markings, WhereAndTaperHoldThemBack) {
  MarkingLayer layer = LayerOf(Pattern::Patches);
  layer.coverage = 1, layer.ragged = 0;
  layer.where = {{BodyCoordinate::Up, 0.2, 0.4}, {BodyCoordinate::Height, 0.9, 0.5}};
  const PatternField field(layer, AnimalBody());
  MarkingLayer thin = layer;
  thin.where.clear();
  thin.taper = {{BodyCoordinate::Up, 0, 0.5}};
  const PatternField tapered(thin, AnimalBody());
  size_t inside = 0;
  for (const Place& at : AnimalBody().Samples()) {
    const bool out = at.n.y < 0.2 || at.h > 0.9, in = at.n.y > 0.4 && at.h < 0.5;
    EXPECT_TRUE(!out || field.Weight(at) == 0);
    EXPECT_TRUE(!in || field.Weight(at) == 1);
    EXPECT_TRUE(at.n.y > 0 || tapered.Weight(at) == 0);
    EXPECT_TRUE(at.n.y < 0.5 || tapered.Weight(at) == 1);
    inside += in;
  }
  EXPECT_GT(inside, 100u);
}

TEST(Markings, SitesKeepTheirDistance) {
  const Sites sites(AnimalBody().Samples(), 0.08, 3);
  ASSERT_GT(sites.All().size(), 40u);
  for (size_t i = 0; i < sites.All().size(); ++i)
    for (size_t j = 0; j < i; ++j) {
      const Place &a = sites.All()[i], &b = sites.All()[j];
      EXPECT_TRUE(glm::dot(a.n, b.n) < -0.3 || glm::length(a.p - b.p) >= 0.08);
    }
  // And leave no gap: else one more would fit. Against the plain search of all sites.
  for (const Place& at : AnimalBody().Samples()) {
    double nearest = HUGE_VAL;
    for (const Place& site : sites.All())
      if (glm::dot(site.n, at.n) >= -0.3) nearest = std::min(nearest, glm::length(site.p - at.p));
    EXPECT_LT(nearest, 0.08);
    EXPECT_EQ(sites.Find(at).first, nearest);
  }
}

// over_base 0 leaves the model's picture, 1 covers it.
TEST(Markings, OverBaseMixes) {
  Markings markings{.base = dvec3(0), .size = 512};
  const auto picture = [&](double over) {
    markings.overBase = over;
    return PaintMarkings(Animal(), AnimalBody(), 0, markings);
  };
  const Image own = Animal().images[size_t(Animal().materials[0].baseColorTexture.image)];
  ASSERT_EQ(own.width, 512u);
  const Image none = picture(0), half = picture(0.5), all = picture(1);
  for (size_t i = 0; i < own.pixels.size(); ++i) {
    if (i % 4 == 3) continue;
    EXPECT_NEAR(none.pixels[i], own.pixels[i], 1);
    EXPECT_NEAR(half.pixels[i], own.pixels[i] / 2.0, 1);
    EXPECT_EQ(all.pixels[i], 0);
  }
}

// Both halves of the tube on the same texels, as a mirrored map has them: the loader gives it coordinates of its own, and
// then each place has its own colour.
TEST(Markings, OverlappingChartsAreUnwrapped) {
  Model tube = Tube(0.1, 1, 30, 32);
  for (Vertex& v : tube.primitives[0].vertices) v.uv.x = std::abs(2 * v.uv.x - 1);
  EXPECT_GT(OverlapShare(tube, Body(tube), 0), 0.8);
  fur::Coat coat;
  coat.strands.size = 8, coat.strands.layers = 2, coat.strands.under.density = coat.strands.over.density = 1;
  coat.markings = Markings{.size = 512, .layers = {LayerOf(Pattern::Patches)}};
  coat.markings->layers[0].scale = 0.15, coat.markings->layers[0].softness = 1;
  ASSERT_TRUE(GroomModel({.coat = &coat}, &tube));
  const Body body(tube);
  EXPECT_LT(OverlapShare(tube, body, 0), 0.002);
  const PatternField field(coat.markings->layers[0], body);
  const Image& picture = tube.images[size_t(tube.materials[0].baseColorTexture.image)];
  const Primitive& p = tube.primitives[0];
  size_t wrong = 0;
  constexpr size_t kPoints = 4000;
  Throw(tube, kPoints, [&](const std::array<uint32_t, 3>& v, double a, double b, double c) {
    const Place at = Mix({&body.At(0, v[0]), &body.At(0, v[1]), &body.At(0, v[2])}, a, b, c);
    const auto uv = [&](size_t k) { return dvec2(p.vertices[v[k]].uv); };
    const double shown = SampleBilinear(picture, uv(0) * a + uv(1) * b + uv(2) * c, true, true).r;
    wrong += std::abs(shown - (1 - field.Weight(at))) > 0.05;
  });
  EXPECT_LT(double(wrong) / kPoints, 0.005) << "more than the texels along the cuts";
}

}  // namespace
}  // namespace fur::test

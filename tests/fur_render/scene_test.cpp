// Camera, placement and scale: no device needed.
#include "fur/scene.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "fur/builtin.h"

namespace fur::test {
namespace {

// SplitMix64 once more (Steele, Lea, Flood 2014, figure 16).
class Generator {
 public:
  uint64_t Next() {
    state_ += 0x9e3779b97f4a7c15ull;
    uint64_t z = state_;
    z ^= z >> 30;
    z *= 0xbf58476d1ce4e5b9ull;
    z ^= z >> 27;
    z *= 0x94d049bb133111ebull;
    return z ^ (z >> 31);
  }
  double Unit() { return double(Next() >> 11) / 9007199254740992.0; }

 private:
  uint64_t state_ = 1;
};

// Degrees in -360..0 by which a matrix turns about Y.
double TurnOf(const glm::dmat4& m) {
  const double degrees = glm::degrees(std::atan2(-m[0].z, m[0].x));
  return degrees > 1e-9 ? degrees - 360 : degrees;
}

void ExpectRigid(const glm::dmat4& m) {
  EXPECT_NEAR(glm::determinant(glm::dmat3(m)), 1, 1e-12);
  EXPECT_NEAR(m[1].y, 1, 1e-12);
  EXPECT_EQ(m[3].w, 1);
}

TEST(Scene, GeneratorIsTheOneOfThePaper) { EXPECT_EQ(Generator().Next(), 0x910a2dec89025cc1ull); }

TEST(Scene, OneAnimalStandsAtTheOrigin) {
  for (const uint32_t count : {0u, 1u}) {
    const std::vector<glm::dmat4> placements = PlaceAnimals(count, 4);
    ASSERT_EQ(placements.size(), 1u);
    EXPECT_EQ(glm::dvec3(placements[0][3]), glm::dvec3(0));
    EXPECT_NEAR(std::abs(TurnOf(placements[0])), 180, 1e-9);
  }
}

// ((i - h) / h * 8, 0, (j - h) / h * 8), h = row / 2 as a real number, i outer, j inner.
void ExpectPublishedField(uint32_t count, double scale) {
  const std::vector<glm::dmat4> placements = PlaceAnimals(count, scale);
  ASSERT_EQ(placements.size(), count);
  const auto rows = uint32_t(std::ceil(std::sqrt(double(count))));
  const double h = rows / 2.0;
  Generator random;
  for (uint32_t k = 0; k < count; ++k) {
    const uint32_t i = k / rows, j = k % rows;
    EXPECT_NEAR(placements[k][3].x, (i - h) / h * 8 * scale, 1e-12 * scale) << k;
    EXPECT_EQ(placements[k][3].y, 0) << k;
    EXPECT_NEAR(placements[k][3].z, (j - h) / h * 8 * scale, 1e-12 * scale) << k;
    EXPECT_NEAR(TurnOf(placements[k]), -180 + 60 * random.Unit(), 1e-9) << k;
    ExpectRigid(placements[k]);
  }
}

TEST(Scene, FieldUpToAHundredIsThePublishedOne) {
  for (const uint32_t count : {2u, 4u, 5u, 25u, 99u, 100u}) ExpectPublishedField(count, 1);
  ExpectPublishedField(25, 32);
}

TEST(Scene, TurnsAreBetween180And120Degrees) {
  std::set<double> turns;
  for (const glm::dmat4& m : PlaceAnimals(400, 1)) {
    EXPECT_GE(TurnOf(m), -180 - 1e-9);
    EXPECT_LE(TurnOf(m), -120);
    turns.insert(TurnOf(m));
  }
  EXPECT_EQ(turns.size(), 400u);
  EXPECT_LT(*turns.begin(), -178);
  EXPECT_GT(*turns.rbegin(), -122);
}

// Above 100 the spacing of 100 stays (8 / 5), the front row stays, the field grows along +Z and about x = 0.
TEST(Scene, LargerFieldsKeepTheSpacing) {
  const std::vector<glm::dmat4> placements = PlaceAnimals(225, 2);
  ASSERT_EQ(placements.size(), 225u);
  for (uint32_t k = 0; k < 225; ++k) {
    EXPECT_NEAR(placements[k][3].x, (k / 15 - 7.5) * 1.6 * 2, 1e-12) << k;
    EXPECT_NEAR(placements[k][3].z, (-8 + (k % 15) * 1.6) * 2, 1e-12) << k;
  }
}

TEST(Scene, PlacementIsDeterministic) { EXPECT_EQ(PlaceAnimals(225, 1), PlaceAnimals(225, 1)); }

TEST(Scene, ProjectionMapsNearTo1AndFarTo0) {
  Camera camera;
  camera.zNear = 0.25;
  camera.zFar = 80;
  camera.fovY = 65;
  const glm::dmat4 p = ProjectionMatrix(camera, 1.5);
  const auto ndc = [&](const glm::dvec3& v) {
    const glm::dvec4 clip = p * glm::dvec4(v, 1);
    return glm::dvec3(clip) / clip.w;
  };
  EXPECT_NEAR(ndc({0, 0, -0.25}).z, 1, 1e-12);
  EXPECT_NEAR(ndc({0, 0, -80}).z, 0, 1e-12);
  const double top = std::tan(glm::radians(65.0) / 2);
  EXPECT_NEAR(ndc({0, top * 3, -3}).y, 1, 1e-12);
  EXPECT_NEAR(ndc({top * 1.5 * 3, 0, -3}).x, 1, 1e-12);
}

TEST(Scene, ViewLooksAlongMinusZWithYUp) {
  const Camera camera{.eye = {-1, 2, -3}, .target = {4, 0, 1}};
  const glm::dmat4 view = ViewMatrix(camera);
  const glm::dvec3 eye(view * glm::dvec4(camera.eye, 1)), target(view * glm::dvec4(camera.target, 1));
  EXPECT_NEAR(glm::length(eye), 0, 1e-12);
  EXPECT_NEAR(target.x, 0, 1e-12);
  EXPECT_NEAR(target.y, 0, 1e-12);
  EXPECT_NEAR(target.z, -glm::length(camera.target - camera.eye), 1e-12);
  EXPECT_GT((view * glm::dvec4(0, 1, 0, 0)).y, 0);
  EXPECT_NEAR(glm::determinant(view), 1, 1e-12);
}

// The box of assets/cat/SOURCE.md.
TEST(Scene, ScaleOfTheCatIsOne) { EXPECT_EQ(SceneScale({{-0.336, -0.015, -1.269}, {0.343, 1.829, 1.395}}), 1); }

TEST(Scene, ScaleIsTheNearestPowerOfTwo) {
  for (const double size : {1e-6, 0.02, 0.4, 1.0, 3.0, 150.0, 1e7}) {
    const Bounds box{glm::dvec3(0), glm::dvec3(size)};
    const double scale = SceneScale(box);
    EXPECT_EQ(std::exp2(std::round(std::log2(scale))), scale) << size;
    const double ratio = box.Diameter() / 3.31 / scale;
    EXPECT_GE(ratio, std::sqrt(0.5) - 1e-9) << size;
    EXPECT_LE(ratio, std::sqrt(2.0) + 1e-9) << size;
  }
  EXPECT_EQ(SceneScale({}), 1) << "a point";
}

struct Extent {
  double side = 0, nearest = 2, farthest = -1;  // largest |x|, |y|; depths
};
Extent ExtentOf(const Bounds& b, const std::vector<glm::dmat4>& placements, const Camera& camera, double aspect) {
  const glm::dmat4 toClip = ProjectionMatrix(camera, aspect) * ViewMatrix(camera);
  Extent e;
  for (const glm::dmat4& m : placements)
    for (int i = 0; i < 8; ++i) {
      const glm::dvec4 corner(i & 1 ? b.max.x : b.min.x, i & 2 ? b.max.y : b.min.y, i & 4 ? b.max.z : b.min.z, 1);
      const glm::dvec4 clip = toClip * (m * corner);
      const glm::dvec3 p = clip.w > 0 ? glm::dvec3(clip) / clip.w : glm::dvec3(9);
      e.side = std::max({e.side, std::abs(p.x), std::abs(p.y)});
      e.nearest = std::min(e.nearest, p.z);
      e.farthest = std::max(e.farthest, p.z);
    }
  return e;
}

TEST(Scene, FramingShowsAllCornersOfAllAnimals) {
  const Bounds cat{{-0.336, -0.015, -1.269}, {0.343, 1.829, 1.395}};
  const Bounds fox{{-13, -1, -88}, {13, 80, 67}}, flat{{-1, 0, -1}, {1, 0, 1}};
  for (const Bounds& box : {cat, fox, flat})
    for (const uint32_t count : {1u, 4u, 25u, 225u})
      for (const double fov : {10.0, 40.0, 90.0})
        for (const double aspect : {0.5, 1.0, 16 / 9.0}) {
          const std::vector<glm::dmat4> placements = PlaceAnimals(count, SceneScale(box));
          const Extent e = ExtentOf(box, placements, FrameBounds(box, placements, fov, aspect), aspect);
          SCOPED_TRACE(testing::Message() << "count " << count << " fov " << fov << " aspect " << aspect);
          EXPECT_LT(e.side, 1);
          EXPECT_GT(e.side, 0.8) << "mostly air";
          EXPECT_GT(e.nearest, 0);
          EXPECT_LT(e.farthest, 1);
        }
}

// From the front left, a little above, of an animal that looks along +Z and is turned by -180 degrees.
TEST(Scene, FramingLooksFromTheFrontLeftAbove) {
  const Bounds box{{-1, 0, -2}, {1, 2, 2}};
  const Camera camera = FrameBounds(box, PlaceAnimals(1, 1), 40, 1.5);
  const glm::dvec3 from = camera.eye - camera.target;
  EXPECT_LT(from.z, 0) << "its nose points to -Z";
  EXPECT_GT(from.y, 0);
  EXPECT_LT(from.x, 0) << "its left is world -X";
  EXPECT_LT(from.y, std::hypot(from.x, from.z)) << "only a little above";
}

TEST(Scene, FramingAPointDoesNotDivideByZero) {
  const Camera camera = FrameBounds({}, {glm::dmat4(1)}, 40, 1);
  EXPECT_TRUE(std::isfinite(glm::length(camera.eye)));
  EXPECT_GT(glm::length(camera.eye - camera.target), 0);
}

TEST(Scene, TurnKeepsTheDistanceAndTheHeight) {
  const Camera camera{.eye = {-1, 2, -3}, .target = {0.5, 0.25, 0}};
  const Camera turned = TurnCamera(camera, 90);
  EXPECT_NEAR(glm::distance(turned.eye, turned.target), glm::distance(camera.eye, camera.target), 1e-12);
  EXPECT_NEAR(turned.eye.y, 2, 1e-12);
  const glm::dvec3 before = camera.eye - camera.target, after = turned.eye - turned.target;
  EXPECT_NEAR(before.x * after.x + before.z * after.z, 0, 1e-12) << "a quarter turn";
  EXPECT_NEAR(glm::distance(TurnCamera(camera, 360).eye, camera.eye), 0, 1e-12);
}

}  // namespace
}  // namespace fur::test

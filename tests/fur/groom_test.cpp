// What groom parameters mean, in closed form: wind, gravity, wetness, thickness, furless spots; and the table of keys.
#include "fur/groom.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <nlohmann/json.hpp>

namespace fur {
namespace {

constexpr double kPi = 3.14159265358979323846;
const glm::dmat4 kNoTurn(1);

FurParams Windy() {
  FurParams p;
  p.wind = {0, 0, 2};  // a direction has no length
  p.windStrength = 0.7;
  p.windFrequency = 0.5;
  p.windLength = 3;
  return p;
}

// (1/2 + 1/2 sin 2 pi q)(5/8 + 3/8 sin(2 pi q / 4)), q = z / length - f t.
double Wind(double z, double t) {
  const double q = z / 3 - 0.5 * t;
  return (0.5 + 0.5 * std::sin(2 * kPi * q)) * (0.625 + 0.375 * std::sin(kPi / 2 * q));
}

TEST(Groom, WindIsTheFormulaAndBlowsItsWay) {
  double least = 1, most = 0;
  for (const double t : {0.0, 0.3, 17.9, 12345.6})
    for (const double z : {-4.0, 0.0, 0.7, 2.2}) {
      const FurSway sway = MakeFurSway(Windy(), kNoTurn, kNoTurn, t, glm::dvec3(0));
      const glm::dvec3 c = TipOffset(sway, {5, -3, z}, {0, 1, 0});
      EXPECT_NEAR(c.z, 0.7 * Wind(z, t), 1e-9);
      EXPECT_EQ(c.x, 0);
      EXPECT_EQ(c.y, 0);
      least = std::min(least, c.z);
      most = std::max(most, c.z);
    }
  EXPECT_GE(least, 0) << "never against the wind";
  EXPECT_GT(most, 0.3);
}

// What is at z at the time t comes to z + frequency wavelength dt at t + dt; through placements too.
TEST(Groom, GustsTravelAlongTheWind) {
  const glm::dmat4 moved =
      glm::rotate(glm::translate(glm::dmat4(1), {3, 1, -2}), 1.1, glm::normalize(glm::dvec3(1, 2, 3)));
  for (const glm::dmat4& placement : {kNoTurn, moved})
    for (const double t : {0.0, 1.25, 400.0}) {
      const auto at = [&](const glm::dvec3& world, double time) {
        const FurSway sway = MakeFurSway(Windy(), placement, kNoTurn, time, glm::dvec3(0));
        return WindAt(sway, glm::dvec3(glm::inverse(placement) * glm::dvec4(world, 1)));
      };
      const double dt = 0.37;
      EXPECT_NEAR(at({0, 0, 1}, t), at({0, 0, 1 + 0.5 * 3 * dt}, t + dt), 1e-9);
      EXPECT_NEAR(at({0, 0, 1}, t), at({7, -3, 1}, t), 1e-9) << "a front is as wide as the world";
      EXPECT_NEAR(at({0, 0, 1}, t), Wind(1, t), 1e-9);
      EXPECT_GT(std::abs(at({0, 0, 1}, t) - at({0, 0, 1}, t + dt)), 1e-3);
    }
}

TEST(Groom, GravityPointsDownInTheWorldAndSideways) {
  FurParams p;
  p.gravity = 0.8;
  const glm::dmat4 part = glm::scale(glm::rotate(glm::dmat4(1), 0.4, glm::dvec3(0, 0, 1)), glm::dvec3(2.5));
  for (const double angle : {0.0, 1.0, 2.5, 4.0}) {
    const glm::dmat4 placement = glm::rotate(glm::dmat4(1), angle, glm::normalize(glm::dvec3(1, 0.5, -1)));
    const glm::dmat3 toWorld = glm::dmat3(placement * part) / 2.5;
    const FurSway sway = MakeFurSway(p, placement, part, 0, glm::dvec3(0));
    for (const glm::dvec3& d : {glm::dvec3(1, 0, 0), glm::dvec3(0, 0, 1), glm::normalize(glm::dvec3(1, -2, 0.5))}) {
      const glm::dvec3 down = toWorld * TipOffset(sway, {0, 0, 0}, d), strand = toWorld * d;
      const glm::dvec3 expected = 0.8 * (glm::dvec3(0, -1, 0) + strand * strand.y);
      EXPECT_LT(glm::length(down - expected), 1e-12);
      EXPECT_LE(glm::length(down), 0.8 + 1e-12) << "no longer than the fur";
    }
  }
}

TEST(Groom, CombIsTheAnimalsAndInertiaTheWorlds) {
  FurParams p;
  p.comb = {0, 0, -4};
  p.combStrength = 0.6;
  p.bend = 3;
  const glm::dmat4 turned = glm::rotate(glm::dmat4(1), kPi / 2, glm::dvec3(0, 1, 0));
  const FurSway sway = MakeFurSway(p, turned, kNoTurn, 0, {0.1, 0, 0});
  EXPECT_FALSE(sway.Varies());
  EXPECT_LT(glm::length(sway.comb - glm::dvec3(0, 0, -0.6 + 0.1)), 1e-12) << "+x of the world is +z of the turned animal";
  const glm::dvec3 point = FurPoint(sway, {1, 2, 3}, {0, 1, 0}, 0.5, 0.4);
  EXPECT_LT(glm::length(point - glm::dvec3(1, 2.2, 3 - 0.5 * 0.5 * 0.064)), 1e-12);
}

TEST(Groom, NeutralParametersAreNeutral) {
  const FurParams p;
  EXPECT_FALSE(IsGroomed(p));
  const FurSway sway = MakeFurSway(p, kNoTurn, kNoTurn, 5, glm::dvec3(0));
  EXPECT_FALSE(sway.Varies());
  EXPECT_EQ(sway.comb, glm::dvec3(0));
  EXPECT_EQ(WetLength(0.3, 0), 0.3);
  EXPECT_EQ(WetSpecularScale(0.35, 0), 0.35);
  EXPECT_EQ(WetSpecularPower(30, 0), 30);
  EXPECT_EQ(WetClumping(0.2, 0), 0.2);
  EXPECT_EQ(WetDarkening(0), 1);
}

TEST(Groom, WetFurIsShorterDarkerShinyAndClumped) {
  EXPECT_DOUBLE_EQ(WetLength(2, 0.5), 2 * 0.825);
  EXPECT_DOUBLE_EQ(WetSpecularScale(0.4, 0.5), 1.0);
  EXPECT_DOUBLE_EQ(WetSpecularPower(30, 0.5), 60);
  EXPECT_DOUBLE_EQ(WetDarkening(0.5), 1.5);
  EXPECT_DOUBLE_EQ(WetClumping(0.3, 0.5), 0.5);
  EXPECT_DOUBLE_EQ(WetClumping(0.8, 0.5), 0.8);
}

TEST(Groom, ThicknessWidensSoftEdges) {
  const FurVolume volume{"v", 2, 1, 2, {9, 8, 7, 0, 9, 8, 7, 64, 9, 8, 7, 128, 9, 8, 7, 255}};
  const auto alpha = [&](double thickness, size_t texel) { return Thickened(volume, thickness).pixels[4 * texel + 3]; };
  EXPECT_EQ(Thickened(volume, 1).pixels, volume.pixels);
  EXPECT_EQ(alpha(2, 0), 0);
  EXPECT_EQ(alpha(2, 1), std::lround(255 * std::sqrt(64 / 255.0)));
  EXPECT_EQ(alpha(0.5, 2), std::lround(255 * std::pow(128 / 255.0, 2)));
  EXPECT_EQ(alpha(0.25, 3), 255);
  EXPECT_EQ(Thickened(volume, 3).pixels[8], 9) << "directions stay";
}

Image Reds(uint32_t width, uint32_t height, std::vector<uint8_t> reds) {
  Image image{"i", width, height, {}};
  for (const uint8_t red : reds) image.pixels.insert(image.pixels.end(), {red, 255, 255, 255});
  return image;
}

TEST(Groom, FurlessSpotsAreRedOfAHalfOrLess) {
  const Image spots = Reds(2, 2, {0, 127, 128, 255});
  const auto reds = [](const Image& image) {
    std::vector<int> all;
    for (size_t i = 0; i < image.pixels.size(); i += 4) all.push_back(image.pixels[i]);
    return all;
  };
  EXPECT_EQ(reds(WithoutFurless(nullptr, spots)), (std::vector<int>{0, 0, 255, 255}));
  const Image lengths = Reds(1, 1, {200});
  EXPECT_EQ(reds(WithoutFurless(&lengths, spots)), (std::vector<int>{0, 0, 200, 200}));
  const Image fine = WithoutFurless(nullptr, spots), both = WithoutFurless(&fine, Reds(1, 1, {255}));
  EXPECT_EQ(reds(both), (std::vector<int>{0, 0, 255, 255})) << "the larger size of the two";
}

// Every key: its ends are taken, beyond them it is refused by name; the schema and the flags name it.
TEST(Groom, EveryKeyHasItsRange) {
  const nlohmann::json schema = nlohmann::json::parse(GroomSchema());
  for (const FurKey& key : FurKeys()) {
    SCOPED_TRACE(key.name);
    const auto accepts = [&](const nlohmann::json& value) {
      FurParams params;
      const Result<Done> done = ApplyFurJson({{key.name, value}}, "here", false, &params);
      if (done) return true;
      EXPECT_NE(done.error().message.find(key.name), std::string::npos) << done.error().message;
      return false;
    };
    const auto number = [&](double x) -> nlohmann::json {
      if (key.kind == FurKind::Vector) return {1.0, x, 1.0};
      if (key.kind == FurKind::Count) return int64_t(x);
      return x;
    };
    EXPECT_TRUE(accepts(nlohmann::json::parse(DefaultText(key))) || key.minIsExcluded);
    EXPECT_FALSE(accepts(nullptr));
    EXPECT_FALSE(accepts(nlohmann::json::object()));
    EXPECT_EQ(std::string(key.flag).rfind("--", 0), 0u);
    const nlohmann::json& described = schema["$defs"]["fur"]["properties"][key.name];
    EXPECT_EQ(described["default"].dump(), DefaultText(key));
    if (key.max == 0) continue;
    EXPECT_EQ(accepts(number(key.min)), !key.minIsExcluded);
    EXPECT_TRUE(accepts(number(key.max)));
    EXPECT_FALSE(accepts(number(key.min - 1)));
    EXPECT_FALSE(accepts(number(key.max * 2)));
    const nlohmann::json& range = key.kind == FurKind::Vector ? described["items"] : described;
    EXPECT_EQ(range[key.minIsExcluded ? "exclusiveMinimum" : "minimum"], key.min);
    EXPECT_EQ(range["maximum"], key.max);
  }
  EXPECT_EQ(schema["$defs"]["fur"]["properties"].size(), FurKeys().size());
  EXPECT_EQ(schema["$defs"]["fur"]["additionalProperties"], false);
}

}  // namespace
}  // namespace fur

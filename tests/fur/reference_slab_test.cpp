// The reference on flat fur, against closed forms and against a sum of very many slabs that the oracle lights.
#include <gtest/gtest.h>

#include <cmath>

#include "reference_support.h"

namespace fur::test {
namespace {

using reference::Radiance;
using reference::Ray;

constexpr double kLength = 0.5;
constexpr uint32_t kSlices = 8;
constexpr uint8_t kCoverage = 100;

Ray Slanted(double degrees) {
  const double a = glm::radians(degrees);
  return RayFrom(glm::dvec3(std::sin(a), 0.3 * std::sin(a), std::cos(a)) * 20.0, {0.1, 0.2, 0});
}

Coat ConstantCoat() {
  Coat coat = UniformCoat(kSlices, kCoverage);
  coat.length = kLength;
  coat.selfShadow = 1;
  return coat;
}

TEST(ReferenceSlab, ConstantDensityIsTheClosedForm) {
  const Coat coat = ConstantCoat();
  const Model model = FurredSquare(50, {200, 150, 100, 255}, coat);
  const double faceOn = ConstantCoatAbove(0, kCoverage / 255.0, kSlices);
  for (const Semantics semantics : {Semantics::Sheet, Semantics::Volume}) {
    const ReferenceScene scene(model, Precise(Look::Correct, semantics));
    for (const double degrees : {0.0, 30.0, 60.0, 75.0}) {
      const Ray ray = Slanted(degrees);
      const double tau = semantics == Semantics::Sheet ? faceOn : faceOn / std::abs(ray.direction.z);
      const Radiance got = scene.Trace(ray);
      EXPECT_TRUE(got.skin);
      EXPECT_NEAR(got.furOpacity, -std::expm1(-tau), 1e-9) << degrees << " degrees";
      const SquareScene square{.look = Look::Correct, .color = {200, 150, 100, 255}, .coat = coat};
      const glm::dvec3 fur(MidpointShell(square, ray.direction, 4)), skin = SkinColor(square, ray.direction);
      const glm::dvec3 expected = glm::mix(skin, fur, -std::expm1(-tau));
      for (int c = 0; c < 3; ++c) EXPECT_NEAR(got.color[c], expected[c], 1e-6) << degrees << " degrees, channel " << c;
    }
  }
}

// Slices and strands that differ, in both looks. Many shells of the oracle come to the same with 1/N^2.
TEST(ReferenceSlab, VaryingCoatIsTheLimitOfManyShells) {
  Coat coat = ConstantCoat();
  coat.selfShadow = 0.4;
  for (size_t i = 0; i < coat.slices.size(); ++i)
    coat.slices[i] = {uint8_t(90 + 20 * i), uint8_t(200 - 15 * i), 200, uint8_t(240 - 25 * i)};
  const Model model = FurredSquare(50, {200, 150, 100, 255}, coat);
  for (const Look look : {Look::Seed, Look::Correct})
    for (const Semantics semantics : {Semantics::Sheet, Semantics::Volume}) {
      const ReferenceScene scene(model, Precise(look, semantics));
      for (const double degrees : {0.0, 40.0, 70.0}) {
        const Ray ray = Slanted(degrees);
        const SquareScene square{.look = look, .semantics = semantics,
                                 .light = look == Look::Seed ? kDemoLight : Light{}, .color = {200, 150, 100, 255},
                                 .coat = coat, .shells = 8000};
        const glm::dvec3 expected = CompositeMidpoints(square, ray.direction), got = scene.Trace(ray).color;
        for (int c = 0; c < 3; ++c)
          EXPECT_NEAR(got[c], expected[c], 2e-6) << "look " << int(look) << ", semantics " << int(semantics) << ", "
                                                 << degrees << " degrees, channel " << c;
      }
    }
}

// Clumps and wetness, which change the skin, the length, the light and where strands stand.
TEST(ReferenceSlab, GroomedCoatIsTheLimitOfManyShells) {
  struct Groom {
    double clumping, wetness, density;
  };
  ReferenceSettings settings = Precise(Look::Correct, Semantics::Volume);
  settings.light = {.direction = {0.7, -0.4, -0.5}, .diffuse = {0.9, 0.8, 0.7}, .ambient = {0.1, 0.12, 0.14},
                    .specular = glm::dvec3(0.5)};  // from the front
  for (const Groom& groom : {Groom{0.6, 0, 1}, {1, 0, 0.5}, {0, 0.5, 1}, {0.9, 0.4, 1.7}, {0, 1, 1}})
    for (const double degrees : {0.0, 40.0, 60.0}) {
      const Ray ray = Slanted(degrees);
      SquareScene square{.semantics = Semantics::Volume, .light = settings.light,
                         .color = {200, 150, 100, 255}, .coat = ConstantCoat(), .shells = 8000, .eye = ray.origin};
      square.coat.selfShadow = 0.3;
      for (size_t i = 0; i < square.coat.slices.size(); ++i)
        square.coat.slices[i] = {uint8_t(90 + 20 * i), uint8_t(200 - 15 * i), 200, uint8_t(150 - 15 * i)};
      square.groom.clumping = groom.clumping;
      square.groom.wetness = groom.wetness;
      square.groom.density = groom.density;
      const Model model = GroomedSquare(&square);
      const ReferenceScene scene(model, settings);
      const glm::dvec3 expected = CompositeMidpoints(square, ray.direction), got = scene.Trace(ray).color;
      for (int c = 0; c < 3; ++c)
        EXPECT_NEAR(got[c], expected[c], 2e-5) << "clumping " << groom.clumping << ", wetness " << groom.wetness << ", "
                                               << degrees << " degrees, channel " << c;
    }
}

// Skin under fur without coverage: rho^(1 + w) of the bald skin's, whose light is linear in rho. No highlight.
TEST(ReferenceSlab, WetSkinIsAPowerOfTheDry) {
  Model model = FurredSquare(50, {200, 150, 100, 255}, UniformCoat(kSlices, 0));
  const Ray ray = Slanted(35);
  ReferenceSettings settings = Precise(Look::Correct, Semantics::Volume);
  settings.light.specular = glm::dvec3(0);
  const glm::dvec3 dry = ReferenceScene(model, settings).Trace(ray).color;
  for (const double wetness : {0.25, 1.0}) {
    model.materials[0].fur->params.wetness = wetness;
    const glm::dvec3 wet = ReferenceScene(model, settings).Trace(ray).color;
    const glm::dvec3 rho(Decode(200 / 255.0), Decode(150 / 255.0), Decode(100 / 255.0));
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(wet[c], dry[c] * std::pow(rho[c], wetness), 1e-12) << "channel " << c;
  }
}

// Columns of texels by turns full and empty: from as opaque as full ones to nothing.
TEST(ReferenceSlab, ReadsTheVolumeBilinearly) {
  Model model = FurredSquare(50, {200, 150, 100, 255}, ConstantCoat());
  FurVolume& volume = model.volumes[0];
  for (size_t i = 0; i < volume.pixels.size() / 4; ++i)
    if (i % volume.width % 2 == 1) volume.pixels[i * 4 + 3] = 0;  // odd columns are empty
  const ReferenceScene scene(model, Precise(Look::Correct, Semantics::Sheet));
  double least = 1, most = 0;
  for (int i = 0; i < 400; ++i) {
    const glm::dvec3 foot(-45 + 0.22 * i, -44 + 0.21 * i, 0);  // whichever way the tiles lie
    const double got = scene.Trace(RayFrom(foot + glm::dvec3(0, 0, 9), foot)).furOpacity;
    least = std::min(least, got);
    most = std::max(most, got);
  }
  EXPECT_LE(most, -std::expm1(-ConstantCoatAbove(0, kCoverage / 255.0, kSlices)) + 1e-9);
  EXPECT_GT(most, 0.9 * -std::expm1(-ConstantCoatAbove(0, kCoverage / 255.0, kSlices)));
  EXPECT_LT(least, 0.2 * most);
}

// Two slabs of the same fur, half a length apart, seen from behind, where skin is culled: depths add where they overlap
// and each shines by its share.
TEST(ReferenceSlab, OverlappingFurIsAMixture) {
  Coat coat = ConstantCoat();
  coat.selfShadow = 0.2;
  const Model model = FurredSquare(50, {200, 150, 100, 255}, coat);
  const double apart = kLength / 2, a = kCoverage / 255.0;
  glm::dmat4 second(1);
  second[3].z = apart;
  const ReferenceScene scene(model, Precise(Look::Correct, Semantics::Volume), {glm::dmat4(1), second});
  const Ray ray = RayFrom({1, 2, -9}, {0.1, 0.2, 0});
  const SquareScene square{.look = Look::Correct, .color = {200, 150, 100, 255}, .coat = coat, .shells = 1};
  const auto light = [&](double h) {  // linear in h
    SquareScene many = square;
    many.shells = 2;
    const glm::dvec3 low(MidpointShell(many, ray.direction, 0)), high(MidpointShell(many, ray.direction, 1));
    return glm::mix(low, high, (h - 0.25) * 2);
  };
  const auto density = [&](double h) {
    if (h < 0 || h > 1) return 0.0;
    const double z = std::clamp(h * kSlices - 0.5, 0.0, kSlices - 1.0);
    return -double(kSlices) * std::log(1 - a * std::clamp(kSlices - 1 - z, 0.0, 1.0));
  };
  glm::dvec3 color(0);
  double through = 1;
  constexpr int kSteps = 24000;
  for (int i = 0; i < kSteps; ++i) {
    const double z = (i + 0.5) / kSteps * (kLength + apart), h1 = z / kLength, h2 = (z - apart) / kLength;
    const double step = (kLength + apart) / kLength / kSteps / std::abs(ray.direction.z);
    const double s1 = density(h1) * step, s2 = density(h2) * step, tau = s1 + s2;
    if (tau > 0) color += (light(h1) * s1 + light(h2) * s2) / tau * (through * -std::expm1(-tau));
    through *= std::exp(-tau);
  }
  ReferenceSettings looser = Precise(Look::Correct, Semantics::Volume);
  looser.tolerance = 1e-6;
  const Radiance got = ReferenceScene(model, looser, {glm::dmat4(1), second}).Trace(ray);
  EXPECT_FALSE(got.skin);
  EXPECT_NEAR(got.furOpacity, 1 - through, 1e-5);
  EXPECT_NEAR(1 - got.furOpacity,
              std::exp(-2 * ConstantCoatAbove(0, a, kSlices) / std::abs(ray.direction.z)), 1e-6);
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(got.color[c], color[c], 2e-4) << "channel " << c;
}

// Bilinear: 1 at the corners of the square, where the welded vertices are, and 0.2 in its middle.
TEST(ReferenceSlab, TheLengthMapEndsTheFur) {
  Model model = FurredSquare(4, {200, 150, 100, 255}, ConstantCoat());
  Image lengths = Plain("length", {51, 51, 51, 255});
  for (const size_t x : {0u, 3u})
    for (const size_t y : {0u, 3u}) lengths.pixels[(y * 4 + x) * 4] = 255;
  model.materials[0].fur->lengthMap = int32_t(model.images.size());
  model.images.push_back(lengths);
  const double a = kCoverage / 255.0;
  const ReferenceScene scene(model, Precise(Look::Correct, Semantics::Sheet));
  const double expected = ConstantCoatAbove(0, a, kSlices) - ConstantCoatAbove(0.2, a, kSlices);
  EXPECT_NEAR(scene.Trace(RayFrom({0.01, 0.02, 9}, {0.01, 0.02, 0})).furOpacity, -std::expm1(-expected), 1e-7);
  const double whole = scene.Trace(RayFrom({3.9, 3.9, 9}, {3.9, 3.9, 0})).furOpacity;
  EXPECT_NEAR(whole, -std::expm1(-ConstantCoatAbove(0, a, kSlices)), 1e-9);
}

TEST(ReferenceSlab, WithoutCoverageItIsTheSkin) {
  const Model bald = BaldSquare(50, {200, 150, 100, 255});
  const Model furred = FurredSquare(50, {200, 150, 100, 255}, UniformCoat(kSlices, 0));
  for (const Look look : {Look::Seed, Look::Correct}) {
    const ReferenceSettings settings = Precise(look, Semantics::Volume);
    const Ray ray = Slanted(35);
    const Radiance got = ReferenceScene(furred, settings).Trace(ray);
    const Radiance skin = ReferenceScene(bald, settings).Trace(ray);
    EXPECT_EQ(got.color, skin.color);
    EXPECT_EQ(got.furOpacity, 0);
    const SquareScene square{.look = look, .light = settings.light, .color = {200, 150, 100, 255}};
    const glm::dvec3 expected = SkinColor(square, ray.direction);
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(skin.color[c], expected[c], 1e-12) << "channel " << c;
  }
}

}  // namespace
}  // namespace fur::test

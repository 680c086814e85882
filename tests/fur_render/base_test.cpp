// The solid pass on a bald square.
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>

#include "oracle.h"
#include "support.h"

namespace fur::test {
namespace {

class Base : public OnEachBackend {};
INSTANTIATE_TEST_SUITE_P(Backends, Base, testing::ValuesIn(Backends()), BackendName);

constexpr Texel kTan{201, 148, 77, 255};

RenderSettings Settings(Look look, const Light& light) {
  return {.width = 33, .height = 25, .look = look, .light = light};
}

Light Only(const glm::dvec3& ambient, const glm::dvec3& diffuse, const glm::dvec3& specular,
           const glm::dvec3& direction = {0, 0, -1}) {
  return {.direction = direction, .diffuse = diffuse, .ambient = ambient, .specular = specular};
}

// In both looks a texture under full ambient light comes out as it went in: decoding and encoding cancel.
TEST_P(Base, FullAmbientLightShowsTheTexelItself) {
  const Light light = Only(glm::dvec3(1), glm::dvec3(0), glm::dvec3(0));
  for (const Look look : {Look::Seed, Look::Correct}) {
    const Frame frame = Render(*device_, BaldSquare(10, kTan), Settings(look, light), CameraAt(3, 0, 0));
    EXPECT_EQ(Center(frame.image), (Rgb{201, 148, 77})) << "look " << int(look);
    EXPECT_EQ(PixelAt(frame.image, 0, 24), (Rgb{201, 148, 77})) << "look " << int(look);
  }
}

TEST_P(Base, AmbientLightIsMultipliedInTheSpaceOfTheLook) {
  const Light light = Only({0.5, 0.25, 1}, glm::dvec3(0), glm::dvec3(0));
  const Frame seed = Render(*device_, BaldSquare(10, kTan), Settings(Look::Seed, light), CameraAt(3, 0, 0));
  ExpectColor(Center(seed.image), {201 / 255.0 * 0.5, 148 / 255.0 * 0.25, 77 / 255.0}, 0.51, "raw values");
  const Frame correct = Render(*device_, BaldSquare(10, kTan), Settings(Look::Correct, light), CameraAt(3, 0, 0));
  ExpectColor(Center(correct.image),
              {Encode(Decode(201 / 255.0) * 0.5), Encode(Decode(148 / 255.0) * 0.25), 77 / 255.0}, 0.75,
              "linear light");
}

// glTF's factor is linear. Look seed has none: the texels are painted with it.
TEST_P(Base, BaseColorFactorIsLinear) {
  const Light light = Only(glm::dvec3(1), glm::dvec3(0), glm::dvec3(0));
  Model model = BaldSquare(10, {255, 255, 255, 255});
  model.materials[0].baseColor = {0.25f, 0.5f, 0.75f, 1};
  model.materials[0].baseColorTexture.image = -1;
  for (const Look look : {Look::Seed, Look::Correct}) {
    const Frame frame = Render(*device_, model, Settings(look, light), CameraAt(3, 0, 0));
    ExpectColor(Center(frame.image), {Encode(0.25), Encode(0.5), Encode(0.75)}, 0.75,
                "look " + std::to_string(int(look)));
  }
}

TEST_P(Base, DiffuseLightIsTheCosine) {
  for (const double degrees : {0.0, 30.0, 60.0, 80.0, 100.0}) {
    const double a = glm::radians(degrees);
    const Light light = Only(glm::dvec3(0), glm::dvec3(1), glm::dvec3(0), {std::sin(a), 0, -std::cos(a)});
    const double cosine = std::max(0.0, std::cos(a));
    const double slant = 1 / 255.0 * std::sin(a);  // the seed's flat normal, (128, 128, 255), leans by this towards x
    const Model white = BaldSquare(10, {255, 255, 255, 255});
    const Frame correct = Render(*device_, white, Settings(Look::Correct, light), CameraAt(3, 0, 0));
    ExpectColor(Center(correct.image), glm::dvec3(Encode(cosine)), 1, "correct at " + std::to_string(degrees));
    const Frame seed = Render(*device_, white, Settings(Look::Seed, light), CameraAt(3, 0, 0));
    ExpectColor(Center(seed.image), glm::dvec3(std::max(0.0, std::cos(a) - slant)), 0.6,
                "seed at " + std::to_string(degrees));
  }
}

// The seed reads the normal map raw and turns its green back; both looks against the second implementation.
TEST_P(Base, BlinnPhongHighlight) {
  Model model = BaldSquare(10, kTan);
  model.images.push_back(Plain("gloss", {255, 128, 64, 255}));
  model.materials[0].specularTexture.image = 1;
  model.materials[0].specularColor = glm::vec3(1);
  model.materials[0].roughness = 0.5f;
  const Light light = Only(glm::dvec3(0.1), glm::dvec3(0.3), glm::dvec3(0.6), {0.5, -0.3, -1});
  for (const Look look : {Look::Seed, Look::Correct}) {
    const RenderSettings settings = Settings(look, light);
    const Camera camera = CameraAt(3, 20, 10);
    const Frame frame = Render(*device_, model, settings, camera);
    const SquareScene scene{.look = look, .light = light, .color = kTan};
    const bool seed = look == Look::Seed;
    const glm::dvec3 raw(1, 128 / 255.0, 64 / 255.0);
    const glm::dvec3 gloss = seed ? raw : glm::dvec3(1, Decode(raw.y), Decode(raw.z));
    const double power = seed ? 10 : 2 / std::pow(0.5, 4) - 2;  // Blinn-Phong power of a roughness
    for (const uint32_t x : {0u, 16u, 32u}) {
      const glm::dvec3 ray = RayThrough(camera, settings.width, settings.height, x, 12);
      ExpectColor(PixelAt(frame.image, x, 12), Stored(look, GlossySkinColor(scene, ray, gloss, power)), 1.01,
                  "look " + std::to_string(int(look)) + " x " + std::to_string(x));
    }
  }
}

// A map that leans the normal by a known angle towards u and v. glTF: green up, so +green is the bitangent.
TEST_P(Base, NormalMapLeansTheNormal) {
  Model model = BaldSquare(10, {255, 255, 255, 255});
  model.images.push_back(Plain("normal", {204, 90, 217, 255}));
  model.materials[0].normalTexture.image = 1;
  const glm::dvec3 n = glm::normalize(glm::dvec3(204, 90, 217) / 127.5 - 1.0),
                   l = glm::normalize(glm::dvec3(0.4, 0.2, 1));
  const Light light = Only(glm::dvec3(0), glm::dvec3(1), glm::dvec3(0), -l);
  const Frame correct = Render(*device_, model, Settings(Look::Correct, light), CameraAt(3, 0, 0));
  ExpectColor(Center(correct.image), glm::dvec3(Encode(glm::dot(n, l))), 1, "correct");
  const Frame seed = Render(*device_, model, Settings(Look::Seed, light), CameraAt(3, 0, 0));
  ExpectColor(Center(seed.image), glm::dvec3(glm::dot(glm::dvec3(n.x, -n.y, n.z), l)), 1, "seed, green turned back");
}

TEST_P(Base, BackgroundIsWhereNothingIs) {
  RenderSettings settings = Settings(Look::Correct, {});
  settings.background = {0.5, 0, 1};
  for (const uint32_t samples : {1u, 4u}) {
    settings.samples = samples;
    const Frame frame = Render(*device_, BaldSquare(0.2, kTan), settings, CameraAt(3, 0, 0));
    ExpectColor(PixelAt(frame.image, 1, 1), {Encode(0.5), 0, 1}, 0.75, "background");
    EXPECT_NE(Center(frame.image), PixelAt(frame.image, 1, 1)) << "the square is not there";
  }
}

// Row 0 is the top, column 0 the left: a square in the upper right quarter lands there.
TEST_P(Base, PictureIsNotFlipped) {
  Model model = BaldSquare(0.2, kTan);
  model.parts[0].transform = glm::translate(glm::dmat4(1), glm::dvec3(0.6, 0.4, 0));
  const Frame frame = Render(*device_, model, Settings(Look::Correct, {}), CameraAt(3, 0, 0));
  EXPECT_NE(PixelAt(frame.image, 23, 8), (Rgb{0, 0, 0}));
  for (const auto& [x, y] : {std::pair{9u, 8u}, {9u, 16u}, {23u, 16u}})
    EXPECT_EQ(PixelAt(frame.image, x, y), (Rgb{0, 0, 0})) << x << "," << y;
}

// Edges exactly through pixel centres: the top and the left one belong to the square, the others do not, as in
// Direct3D. A backend with another rule draws nearly the same picture, but not to the bit.
TEST_P(Base, TopLeftRule) {
  RenderSettings settings = Settings(Look::Correct, {});
  settings.width = settings.height = 32;
  const Frame frame = Render(*device_, BaldSquare(9 / 32.0, kTan), settings, CameraAt(1, 0, 0, 90));
  const auto drawn = [&](uint32_t x, uint32_t y) { return PixelAt(frame.image, x, y) != Rgb{0, 0, 0}; };
  EXPECT_TRUE(drawn(16, 11)) << "top edge";
  EXPECT_FALSE(drawn(16, 20)) << "bottom edge";
  EXPECT_TRUE(drawn(11, 16)) << "left edge";
  EXPECT_FALSE(drawn(20, 16)) << "right edge";
  EXPECT_EQ(frame.counts.baseFragments, 81u);
}

// Back faces are culled, unless the material is double-sided or a mirroring transform turns them to the front.
TEST_P(Base, FaceCulling) {
  Model model = BaldSquare(10, kTan);
  const RenderSettings settings = Settings(Look::Correct, {});
  const uint64_t all = uint64_t{settings.width} * settings.height;
  const auto fragments = [&](double yaw) {
    return Render(*device_, model, settings, CameraAt(3, yaw, 0)).counts.baseFragments;
  };
  EXPECT_EQ(fragments(0), all);
  EXPECT_EQ(fragments(180), 0u);
  model.parts[0].transform = glm::scale(glm::dmat4(1), glm::dvec3(-1, 1, 1));
  EXPECT_EQ(fragments(0), all) << "mirrored";
  EXPECT_EQ(fragments(180), 0u) << "mirrored";
  model.materials[0].doubleSided = true;
  EXPECT_EQ(fragments(0), all) << "double-sided";
  EXPECT_EQ(fragments(180), all) << "double-sided";
}

TEST_P(Base, FourSamplesSmoothTheEdgeOnly) {
  RenderSettings settings = Settings(Look::Correct, Only(glm::dvec3(1), glm::dvec3(0), glm::dvec3(0)));
  Model model = BaldSquare(0.5, {255, 255, 255, 255});
  model.parts[0].transform = glm::rotate(glm::dmat4(1), 0.3, glm::dvec3(0, 0, 1));
  const Frame one = Render(*device_, model, settings, CameraAt(3, 0, 0));
  settings.samples = 4;
  const Frame four = Render(*device_, model, settings, CameraAt(3, 0, 0));
  EXPECT_EQ(Center(four.image), Center(one.image));
  EXPECT_EQ(PixelAt(four.image, 0, 0), PixelAt(one.image, 0, 0));
  int grey1 = 0, grey4 = 0;
  for (uint32_t y = 0; y < settings.height; ++y)
    for (uint32_t x = 0; x < settings.width; ++x) {
      const auto isGrey = [&](const Image& image) { return PixelAt(image, x, y)[0] % 255 != 0; };
      grey1 += isGrey(one.image);
      grey4 += isGrey(four.image);
    }
  EXPECT_EQ(grey1, 0);
  EXPECT_GT(grey4, 10);
}

// A million units from the origin nothing shakes: positions meet in double before they become floats.
TEST_P(Base, FarFromTheOriginThePictureStays) {
  const Model model = BaldSquare(0.5, kTan);
  const Camera near = CameraAt(3, 25, 15);
  const glm::dvec3 offset(1 << 20, -(1 << 19), 1 << 20);
  Camera far = near;
  far.eye += offset;
  far.target += offset;
  const RenderSettings settings = Settings(Look::Correct, {});
  const Frame here = Render(*device_, model, settings, near);
  const Frame there = Render(*device_, model, settings, far, {glm::translate(glm::dmat4(1), offset)});
  EXPECT_GT(here.counts.baseFragments, 20u);
  EXPECT_LE(DifferingPixels(here.image, there.image), 1u);
}

}  // namespace
}  // namespace fur::test

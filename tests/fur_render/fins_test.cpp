// Fins: the set of edges that grow one, against the published test evaluated on the CPU.
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>

#include "emitted.h"
#include "fur/gltf.h"
#include "fur/topology.h"
#include "models.h"
#include "oracle.h"
#include "support.h"

namespace fur::test {
namespace {

class Fins : public OnEachBackend {};
INSTANTIATE_TEST_SUITE_P(Backends, Fins, testing::ValuesIn(Backends()), BackendName);

Coat LongCoat() {
  Coat coat = UniformCoat(16, 255);
  coat.length = 0.4;
  return coat;
}

RenderSettings Settings(Look look = Look::Correct) {
  return {.width = 96,
          .height = 64,
          .technique = Technique::Seed,
          .look = look,
          .semantics = Semantics::Sheet,
          .drawShells = false};
}

// ---------------------------------------------------------------------------------------------- the published test
// Outward face normals and centres; an edge is a silhouette when the eye is in front of one face and behind the other.
bool FacesEye(const Primitive& p, size_t triangle, const glm::dvec3& eye) {
  const glm::dvec3 a(p.vertices[p.indices[triangle]].position), b(p.vertices[p.indices[triangle + 1]].position),
      c(p.vertices[p.indices[triangle + 2]].position);
  return glm::dot(glm::cross(b - a, c - a), eye - (a + b + c) / 3.0) > 0;
}

// Ordered pairs of triangles that share an edge and of which one faces the eye: each edge from both of its sides.
uint64_t ExpectedFins(const Primitive& p, const glm::dvec3& eye) {
  uint64_t fins = 0;
  for (size_t s = 0; s < p.indices.size(); s += 3)
    for (size_t t = 0; t < p.indices.size(); t += 3) {
      int shared = 0;
      for (size_t i = 0; i < 3; ++i)
        for (size_t j = 0; j < 3; ++j) shared += p.indices[s + i] == p.indices[t + j];
      if (shared == 2 && FacesEye(p, s, eye) != FacesEye(p, t, eye)) ++fins;
    }
  return fins;
}

TEST_P(Fins, SilhouetteEdgesOfClosedBodies) {
  if (!(*device_)->GetCaps().pipelineStatistics) GTEST_SKIP() << GetParam().name << " has no pipeline statistics";
  for (const Model& model : {Tetrahedron(LongCoat()), Cube(LongCoat())})
    for (const auto& [yaw, pitch] : {std::pair{0.0, 0.0}, {20.0, 10.0}, {100.0, -50.0}, {200.0, 5.0}, {310.0, 80.0}}) {
      const Camera camera = CameraAt(7.3, yaw + 1, pitch + 2);
      const uint64_t fins = ExpectedFins(model.primitives[0], camera.eye);
      EXPECT_GE(fins, 6u) << "the oracle finds no silhouette";
      EXPECT_EQ(EmittedTriangles(*device_, model, Settings(), camera, glm::dmat4(1)), 2 * fins)
          << "yaw " << yaw << " pitch " << pitch;
    }
}

// The published defect, kept: the world-space eye meets object-space vertices, so a placement does not change the set.
TEST_P(Fins, PlacementDoesNotChangeTheSet) {
  if (!(*device_)->GetCaps().pipelineStatistics) GTEST_SKIP() << GetParam().name << " has no pipeline statistics";
  const Model model = Cube(LongCoat());
  const Camera camera = CameraAt(7.3, 21, 12);
  const uint64_t fins = ExpectedFins(model.primitives[0], camera.eye);
  // So that in truth the eye is in front of one face only; the published test sees three.
  const glm::dmat4 turn = glm::rotate(glm::dmat4(1), 2.0, glm::dvec3(0, 1, 0));
  const glm::dvec3 origin = camera.eye - glm::dvec3(turn * glm::dvec4(0.2, 0.1, 5, 0));
  const glm::dmat4 moved = glm::translate(glm::dmat4(1), origin) * turn;
  const glm::dvec3 eyeInObject(glm::inverse(moved) * glm::dvec4(camera.eye, 1));
  ASSERT_NE(ExpectedFins(model.primitives[0], eyeInObject), fins) << "the placement does not tell the two rules apart";
  EXPECT_EQ(EmittedTriangles(*device_, model, Settings(), camera, moved), 2 * fins);
}

// --------------------------------------------------------------------------------------------------------- one edge
Model Roof() { return fur::test::Roof(LongCoat()); }

// Needs no statistics: the one fin is seen or not.
TEST_P(Fins, RoofGrowsAFinOnlyWhereOneSlopeIsSeen) {
  for (const Look look : {Look::Seed, Look::Correct})
    for (int pitch = -85; pitch <= 85; pitch += 10) {
      const Camera camera = CameraAt(6, 10, pitch);
      const Model roof = Roof();
      const bool expected = ExpectedFins(roof.primitives[0], camera.eye) > 0;
      const FrameCounts c = Render(*device_, roof, Settings(look), camera).counts;
      EXPECT_EQ(c.finFragments > 0, expected) << "pitch " << pitch << " look " << int(look);
      EXPECT_EQ(c.edges, 2u);
    }
}

TEST_P(Fins, FinsChangeThePictureAndCanBeSwitchedOff) {
  RenderSettings settings = Settings();
  const Camera camera = CameraAt(6, 10, 65);
  const Frame with = Render(*device_, Roof(), settings, camera);
  settings.drawFins = false;
  const Frame without = Render(*device_, Roof(), settings, camera);
  EXPECT_GT(with.counts.finFragments, 20u);
  EXPECT_EQ(without.counts.finFragments, 0u);
  const uint64_t changed = DifferingPixels(with.image, without.image);
  EXPECT_GT(changed, 20u);
  EXPECT_LE(changed, with.counts.finFragments) << "pixels changed without a fragment";
}

// From slice 0 at the root to the last at the tip, unlit, darkest at the root: the seed's colours by the fin's height.
TEST_P(Fins, SeedFinIsUnlitAndThinsOutTowardsTheTip) {
  const Coat coat = LongCoat();
  Model roof = Roof();
  roof.materials[0].fur->params.selfShadow = 0.5;
  const Camera camera = CameraAt(6, 0, 88, 20);  // the fin stands up in the picture; +Z points down
  RenderSettings settings = Settings(Look::Seed);
  settings.light.diffuse = glm::dvec3(0);
  settings.light.ambient = glm::dvec3(0);
  settings.light.specular = glm::dvec3(0);
  const Frame frame = Render(*device_, roof, settings, camera);
  int checked = 0;
  for (uint32_t y = 0; y < settings.height; ++y) {
    const glm::dvec3 ray = RayThrough(camera, settings.width, settings.height, 48, y);
    const double z = camera.eye.z - ray.z * camera.eye.y / ray.y;  // where the ray meets the fin's plane, y = 0
    if (z < 0.01 || z > 0.39) continue;
    const double h = z / coat.length * 15 / 16;  // slice 15 of 16 at the tip
    ExpectColor(PixelAt(frame.image, 48, y), glm::dvec3(200, 150, 100) / 255.0 * ((0.5 + 0.5 * h) * (1 - h)), 1.5,
                "height " + std::to_string(h));
    ++checked;
  }
  EXPECT_GE(checked, 10);
}

// Published: the length is read at vertex 1 only, so an edge with one bald end grows half of its two fins, and one with
// two bald ends none. Below a thirtieth nothing grows.
TEST_P(Fins, LengthIsReadAtVertexOne) {
  if (!(*device_)->GetCaps().pipelineStatistics) GTEST_SKIP() << GetParam().name << " has no pipeline statistics";
  const Camera camera = CameraAt(6, 10, 65);
  const auto fins = [&](uint8_t left, uint8_t right) {
    Model roof = Roof();
    Image lengths = Plain("length", {left, left, left, 255});
    for (size_t i = 0; i < 16; ++i)
      if (i % 4 >= 2) lengths.pixels[i * 4] = right;
    roof.images.push_back(lengths);
    roof.materials[0].fur->lengthMap = 1;
    return EmittedTriangles(*device_, roof, Settings(), camera, glm::dmat4(1)) / 2;
  };
  EXPECT_EQ(fins(255, 255), 2u);
  EXPECT_EQ(fins(0, 255), 1u);
  EXPECT_EQ(fins(255, 0), 1u);
  EXPECT_EQ(fins(0, 0), 0u);
  EXPECT_EQ(fins(8, 9), 1u) << "8 / 255 is below 1 / 30, 9 / 255 above";
}

// ----------------------------------------------------------------------------------------------------- submitted edges
TEST_P(Fins, EachEdgeIsSubmittedTwice) {
  EXPECT_EQ(Render(*device_, Tetrahedron(LongCoat()), Settings(), CameraAt(6, 0, 0)).counts.edges, 2u * 6);
  EXPECT_EQ(Render(*device_, Cube(LongCoat()), Settings(), CameraAt(6, 0, 0)).counts.edges, 2u * 18);
}

// The demo grows fins on its hairless mesh too; look correct does not.
TEST_P(Fins, BaldPartsGrowFinsInLookSeedOnly) {
  Model model = Tetrahedron(LongCoat());
  model.materials.push_back({.name = "bald"});
  Primitive bald = Cube(LongCoat()).primitives[0];
  bald.material = 1;
  model.primitives.push_back(bald);
  model.parts.push_back({.primitive = 1});
  EXPECT_EQ(Render(*device_, model, Settings(Look::Correct), CameraAt(6, 0, 0)).counts.edges, 12u);
  EXPECT_EQ(Render(*device_, model, Settings(Look::Seed), CameraAt(6, 0, 0)).counts.edges, 12u + 36u);
}

TEST_P(Fins, CatSubmitsThePublishedNumberOfEdges) {
  const std::filesystem::path file = std::filesystem::path(FUR_ASSETS_DIR) / "cat" / "cat.gltf";
  if (!std::filesystem::exists(file)) GTEST_SKIP() << file << " is absent";
  const Result<Model> cat = LoadGltf(file);
  ASSERT_TRUE(cat) << cat.error().message;
  size_t furred = 0, all = 0;
  for (const Part& part : cat->parts) {
    const Primitive& p = cat->primitives[part.primitive];
    const size_t edges = SeedLineAdjacency(p.indices).size() / 4;
    all += edges;
    if (cat->materials[p.material].fur) furred += edges;
  }
  EXPECT_EQ(all, 9846u) << "each of 4923 edges twice";
  EXPECT_EQ(furred, 7442u) << "5147 edges, of which 1426 have one triangle";
  EXPECT_EQ(Render(*device_, *cat, Settings(Look::Seed), {}).counts.edges, all);
  EXPECT_EQ(Render(*device_, *cat, Settings(Look::Correct), {}).counts.edges, furred);
}

}  // namespace
}  // namespace fur::test

// Fins three ways and shells four ways, on each backend: one picture, but where geometry shaders make it.
//
// Ways whose last stage before the rasteriser is a vertex shader agree to the bit. Behind a geometry shader Mesa brings
// positions to the viewport in other arithmetic than behind a vertex shader: "behind_a_geometry_shader" in
// tolerances.cpp.
#include <functional>
#include <glm/gtc/matrix_transform.hpp>

#include "../fur_render/frames.h"
#include "../fur_render/models.h"
#include "fur_scenes.h"

namespace conformance {
namespace {

using namespace fur;
using rhi_test::Gpu;
using rhi_test::RhiTestOf;

struct Asset {
  const char* name;
  const char* file;  // "": the built-in animal
};
constexpr Asset kBodies[] = {
    {"builtin", ""}, {"cat", "cat/cat.gltf"}, {"torus", "torus/torus.gltf"}, {"spot", "spot/spot.glb"}};
void PrintTo(const Asset& a, std::ostream* out) { *out << a.name; }

void ExpectEqual(const fur::Image& result, const fur::Image& reference, const std::string& what,
                 const Tolerance& tolerance = kExact) {
  EXPECT_TRUE(SameImage(PictureOf(result), PictureOf(reference), tolerance)) << what;
}

class FurModeTest : public RhiTestOf<Asset> {
 protected:
  void SetUp() override {
    model_ = *Parameter().file ? AssetModel(Parameter().file) : &Animal();
    if (!model_) GTEST_SKIP() << "no assets: " << Parameter().file;
  }

  // From two sides: one without, one with multisampling.
  void ForEachView(const std::function<void(FurShot, const std::string&)>& check) {
    for (const uint32_t samples : {1u, 4u}) {
      FurShot shot = CloseShot(*model_);
      shot.camera = TurnCamera(shot.camera, samples == 1 ? 0 : 140);
      shot.settings.samples = samples;
      check(shot, std::to_string(samples) + " samples");
    }
  }
  fur::Image Fins(FurShot shot, FinMode mode) {
    shot.settings.finMode = mode;
    shot.settings.drawShells = false;
    return Draw(gpu, *model_, shot);
  }
  fur::Image Shells(FurShot shot, ShellMode mode) {
    shot.settings.shellMode = mode;
    shot.settings.drawFins = false;
    return Draw(gpu, *model_, shot);
  }

  const Model* model_ = nullptr;
};

TEST_P(FurModeTest, CompactedFinsEqualPulledFins) {
  ForEachView([&](FurShot shot, const std::string& what) {
    const fur::Image pulled = Fins(shot, FinMode::Pulled);
    EXPECT_GT(test::Colors(pulled), 100u) << "there is hardly anything to compare";
    ExpectEqual(Fins(shot, FinMode::Compacted), pulled, what);
    shot.settings.drawFins = false;
    EXPECT_GT(test::DifferingPixels(pulled, Fins(shot, FinMode::Pulled)), 100u) << "the fins hardly show";
  });
}

TEST_P(FurModeTest, GsFinsEqualPulledFins) {
  RHI_NEEDS_CAP(geometryShader);
  ForEachView([&](const FurShot& shot, const std::string& what) {
    ExpectEqual(Fins(shot, FinMode::Geometry), Fins(shot, FinMode::Pulled), what, Within("behind_a_geometry_shader"));
  });
}

TEST_P(FurModeTest, InstancedShellsEqualNDraws) {
  ForEachView([&](const FurShot& shot, const std::string& what) {
    const fur::Image instanced = Shells(shot, ShellMode::Instanced);
    EXPECT_GT(test::Colors(instanced), 100u) << "there is hardly anything to compare";
    ExpectEqual(Shells(shot, ShellMode::Draws), instanced, what);
  });
}

TEST_P(FurModeTest, GsShellsEqualInstancedShells) {
  RHI_NEEDS_CAP(geometryShader);
  ForEachView([&](const FurShot& shot, const std::string& what) {
    ExpectEqual(Shells(shot, ShellMode::Amplified), Shells(shot, ShellMode::Instanced), what,
                Within("behind_a_geometry_shader"));
  });
}
RHI_MATRIX(FurModeTest, kBodies, [](const Asset& a) { return a.name; });

// ------------------------------------------------------------------------------------------ all shells of a triangle
// Crossed on a ray: the prisms back to front, and within one its shells; or shell by shell. On a convex body both are
// the same order. Stripes, so that each triangle looks different from its neighbours in the middle of the fur.
test::Coat LongCoat() {
  test::Coat coat = test::UniformCoat(16, 60, {190, 128, 220});
  coat.length = 0.6;
  return coat;
}
// The eye reaches each part's own axes, mirrored and stretched ones too; and each part has an order of its own.
Model TwoParts() {
  Model model = test::Cube(LongCoat());
  model.parts[0].transform = glm::translate(glm::dmat4(1), glm::dvec3(-1.5, 0.3, 0));
  model.parts[0].transform = glm::scale(model.parts[0].transform, glm::dvec3(0.5, 0.4, 0.6));
  model.parts.push_back({.primitive = 0, .transform = glm::translate(glm::dmat4(1), glm::dvec3(1.5, -0.2, 0))});
  model.parts[1].transform = glm::scale(model.parts[1].transform, glm::dvec3(-0.5, 0.5, 0.3));
  return model;
}
struct Body {
  const char* name;
  Model (*make)();
  std::vector<double> yaws;
  double pitch;
};
const Body kConvex[] = {{"tetrahedron", [] { return test::Tetrahedron(LongCoat()); }, {20, 200}, 30},
                        {"cube", [] { return test::Cube(LongCoat()); }, {20, 200}, 30},
                        {"two_parts", TwoParts, {10}, 15}};
void PrintTo(const Body& b, std::ostream* out) { *out << b.name; }

class FurOrderTest : public RhiTestOf<Body> {
 protected:
  // `mode` against shell by shell.
  void ExpectShellByShell(ShellMode mode, std::initializer_list<uint32_t> atOnce, const Tolerance& tolerance) {
    const Model model = Parameter().make();
    for (const double yaw : Parameter().yaws)
      for (const uint32_t shells : {16u, 32u}) {
        FurShot shot{.camera = test::CameraAt(6, yaw, Parameter().pitch), .placements = PlaceAnimals(1, 1)};
        shot.settings.shells = shells;
        shot.settings.drawFins = false;
        shot.settings.shellMode = ShellMode::Instanced;
        const fur::Image instanced = Draw(gpu, model, shot);
        EXPECT_GT(test::Colors(instanced), 100u);
        shot.settings.shellMode = mode;
        for (const uint32_t n : atOnce) {
          shot.settings.shellsAtOnce = n;
          ExpectEqual(Draw(gpu, model, shot), instanced,
                      "yaw " + std::to_string(yaw) + ", " + std::to_string(shells) + " shells, " + std::to_string(n),
                      tolerance);
        }
      }
  }
};
TEST_P(FurOrderTest, SortedShellsEqualInstancedOnConvexBodies) { ExpectShellByShell(ShellMode::Sorted, {1}, kExact); }
TEST_P(FurOrderTest, GsShellsAtOnceEqualInstancedOnConvexBodies) {
  RHI_NEEDS_CAP(geometryShader);
  ExpectShellByShell(ShellMode::Amplified, {14, 5, 2}, Within("behind_a_geometry_shader"));
}
RHI_MATRIX(FurOrderTest, kConvex, [](const Body& b) { return b.name; });

}  // namespace
}  // namespace conformance

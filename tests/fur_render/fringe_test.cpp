// The outline: how opaque the fur is where the skin is missed, against 512 shells in 32-bit floats. docs/shells.md has
// the table that this prints.
#include <cmath>
#include <cstdio>

#include "fur/builtin.h"
#include "fur/gltf.h"
#include "support.h"

namespace fur::test {
namespace {

constexpr uint32_t kReference = 512;

RenderSettings Settings(Semantics semantics, uint32_t shells, bool fins, bool back) {
  return {.width = 320,
          .height = 214,
          .semantics = semantics,
          .target = TargetFormat::Float32,
          .shells = shells,
          .drawFins = fins,
          .backFaces = back};
}

// Over the pixels that the reference covers with fur alone.
double BandRmse(const FloatImage& reference, const FloatImage& image) {
  double sum = 0;
  uint64_t pixels = 0;
  for (size_t i = 0; i < reference.pixels.size(); ++i) {
    const float a = reference.pixels[i].a;
    if (a <= 1 / 255.0f || a >= 0.9999f) continue;
    sum += std::pow(double(image.pixels[i].a - a), 2);
    ++pixels;
  }
  EXPECT_GT(pixels, 500u);
  return pixels ? std::sqrt(sum / double(pixels)) : 0;
}

class Fringe {
 public:
  Fringe(const Model& model, Semantics semantics)
      : device_(Backends()[0]),
        model_(model),
        camera_(FrameBounds(ComputeBounds(model), PlaceAnimals(1, 1), 40, 1.5)),
        semantics_(semantics),
        reference_(Pixels(device_, model, Settings(semantics, kReference, false, true), camera_, PlaceAnimals(1, 1))) {}
  double Error(uint32_t shells, bool fins, bool back) {
    const RenderSettings settings = Settings(semantics_, shells, fins, back);
    return BandRmse(reference_, Pixels(device_, model_, settings, camera_, PlaceAnimals(1, 1)));
  }

 private:
  TestDevice device_;
  const Model& model_;
  Camera camera_;
  Semantics semantics_;
  FloatImage reference_;
};

void Study(const std::string& name, const Model& model) {
  for (const Semantics semantics : {Semantics::Volume, Semantics::Sheet}) {
    Fringe fringe(model, semantics);
    const bool volume = semantics == Semantics::Volume;
    double before = 1;
    for (const uint32_t n : {8u, 16u, 32u}) {
      const double both = fringe.Error(n, true, true), shells = fringe.Error(n, false, true),
                   frontOnly = fringe.Error(n, false, false);
      std::printf("  %-8s %-6s %2u shells: %.4f with back faces and fins, %.4f without fins, %.4f front faces alone\n",
                  name.c_str(), volume ? "volume" : "sheet", n, both, shells, frontOnly);
      EXPECT_LT(shells, 0.55 * frontOnly) << "back faces hardly help";
      EXPECT_LT(shells, before) << "more shells, more error";
      EXPECT_TRUE(!volume || both < shells) << "fins hurt";
      before = shells;
    }
    EXPECT_LT(before, volume ? 0.065 : 0.02) << "32 shells";
  }
}

TEST(FringeOf, BuiltinAnimal) { Study("built-in", MakeBuiltinAnimal()); }

TEST(FringeOf, Cat) {
  const Result<Model> cat = LoadGltf(std::string(FUR_ASSETS_DIR) + "/cat/cat.gltf");
  if (!cat) GTEST_SKIP() << "the cat is absent from " << FUR_ASSETS_DIR;
  Study("cat", *cat);
}

}  // namespace
}  // namespace fur::test

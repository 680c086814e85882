// The outline: how opaque the fur is where the skin is missed, against the integral of the fur model (fur/reference.h).
// docs/shells.md has the table that this prints. Not against many shells: where a triangle is seen edge on, 512 of them
// still miss fur.
#include <cmath>
#include <cstdio>

#include "fur/builtin.h"
#include "fur/gltf.h"
#include "fur/reference.h"
#include "support.h"

namespace fur::test {
namespace {

constexpr uint32_t kWidth = 320, kHeight = 214, kFactor = 4;  // 16 rays for each pixel; the reference: 64

struct Fault {
  double rmse = 0, bias = 0;
};

// Over the pixels that the reference covers with fur alone.
Fault BandFault(const FloatImage& reference, const FloatImage& fine) {
  Fault fault;
  uint64_t pixels = 0;
  for (uint32_t y = 0; y < kHeight; ++y)
    for (uint32_t x = 0; x < kWidth; ++x) {
      const double a = double(reference.pixels[size_t{y} * kWidth + x].a);
      if (a <= 1 / 255.0 || a >= 0.9999) continue;
      double mean = 0;
      for (uint32_t k = 0; k < kFactor * kFactor; ++k)
        mean += double(fine.pixels[size_t(y * kFactor + k / kFactor) * fine.width + x * kFactor + k % kFactor].a);
      const double d = mean / (kFactor * kFactor) - a;
      fault.rmse += d * d;
      fault.bias += d;
      ++pixels;
    }
  EXPECT_GT(pixels, 500u);
  const double n = std::max(1.0, double(pixels));
  return {std::sqrt(fault.rmse / n), fault.bias / n};
}

class Fringe {
 public:
  Fringe(const Model& model, Semantics semantics)
      : device_(Backends()[0]),
        model_(model),
        camera_(FrameBounds(ComputeBounds(model), PlaceAnimals(1, 1), 40, 1.5)),
        semantics_(semantics) {
    ReferenceSettings settings;
    settings.width = kWidth;
    settings.height = kHeight;
    settings.semantics = semantics;
    const std::vector<glm::dmat4> one = PlaceAnimals(1, 1);
    Result<ReferenceImage> image = RenderReference(model, camera_, one, settings);
    EXPECT_TRUE(image);
    if (image) reference_ = std::move(image->color);
  }
  Fault Of(uint32_t shells, bool fins, bool back) {
    const RenderSettings settings{.width = kWidth * kFactor, .height = kHeight * kFactor, .semantics = semantics_,
                                  .target = TargetFormat::Float32, .shells = shells, .drawFins = fins, .backFaces = back};
    return BandFault(reference_, Pixels(device_, model_, settings, camera_, PlaceAnimals(1, 1)));
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
    for (const uint32_t n : volume ? std::vector<uint32_t>{8, 16, 32} : std::vector<uint32_t>{16}) {
      const Fault both = fringe.Of(n, true, true), shells = fringe.Of(n, false, true), front = fringe.Of(n, false, false);
      std::printf("  %-8s %-6s %2u shells: %.4f (%+.4f) with back faces and fins, %.4f (%+.4f) without fins, "
                  "%.4f front faces alone\n",
                  name.c_str(), volume ? "volume" : "sheet", n, both.rmse, both.bias, shells.rmse, shells.bias, front.rmse);
      EXPECT_LT(shells.rmse, 0.6 * front.rmse) << "back faces hardly help";
      EXPECT_TRUE(!volume || both.rmse < shells.rmse) << "fins hurt";
      EXPECT_TRUE(!volume || n < 16 || both.rmse <= 0.05) << "the goal";
    }
    if (!volume) continue;
    const Fault byDefault = fringe.Of(0, true, true);
    std::printf("  %-8s volume, default: %.4f (%+.4f)\n", name.c_str(), byDefault.rmse, byDefault.bias);
    EXPECT_LE(byDefault.rmse, 0.05);
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

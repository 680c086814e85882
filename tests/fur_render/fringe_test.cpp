// The outline: how opaque the fur is where the skin is missed, against 512 shells in 32-bit floats.
#include <cmath>
#include <cstdio>

#include "fur/builtin.h"
#include "fur/gltf.h"
#include "support.h"

namespace fur::test {
namespace {

FloatImage Pixels(TestDevice& device, const Model& model, const RenderSettings& settings, const Camera& camera) {
  Result<std::unique_ptr<Renderer>> renderer = MakeRenderer(*device, model, settings);
  if (!renderer) {
    ADD_FAILURE() << renderer.error().message;
    return {};
  }
  const glm::dmat4 place = PlaceAnimals(1, 1)[0];
  (*renderer)->Draw(camera, {&place, 1});
  Result<FloatImage> image = (*renderer)->ReadPixels();
  if (!image) ADD_FAILURE() << image.error().message;
  return image ? std::move(*image) : FloatImage{};
}

// Over the pixels that the reference covers with fur alone.
double BandRmse(const FloatImage& reference, const FloatImage& image, uint64_t* pixels) {
  double sum = 0;
  *pixels = 0;
  for (size_t i = 0; i < reference.pixels.size(); ++i) {
    const float a = reference.pixels[i].a;
    if (a <= 1 / 255.0f || a >= 0.9999f) continue;
    sum += std::pow(double(image.pixels[i].a - a), 2);
    ++*pixels;
  }
  return *pixels ? std::sqrt(sum / double(*pixels)) : 0;
}

TEST(Fringe, Study) {
  std::vector<std::pair<std::string, Model>> models;
  models.emplace_back("builtin", MakeBuiltinAnimal());
  if (Result<Model> cat = LoadGltf(std::string(FUR_ASSETS_DIR) + "/cat/cat.gltf")) models.emplace_back("cat", std::move(*cat));
  if (Result<Model> cat = LoadGltf(std::string(FUR_ASSETS_DIR) + "/spot/spot.glb")) models.emplace_back("spot", std::move(*cat));
  for (auto& [name, model] : models) {
    TestDevice device(Backends()[0]);
    const Camera camera = FrameBounds(ComputeBounds(model), PlaceAnimals(1, 1), 40, 1.5);
    RenderSettings s{.width = 480, .height = 320, .target = TargetFormat::Float32, .shells = 512, .drawFins = false};
    for (Semantics semantics : {Semantics::Volume, Semantics::Sheet}) {
      s.semantics = semantics;
      s.shells = 512; s.drawFins = false; s.backFaces = true;
      const FloatImage reference = Pixels(device, model, s, camera);
      for (uint32_t n : {8u, 16u, 32u, 64u})
        for (int fins = 0; fins < 4; ++fins)
          for (bool back : {true, false}) {
            s.shells = n;
            s.backFaces = back;
            s.drawFins = fins > 0;
            s.finThreshold = fins == 1 ? 0.25 : fins == 2 ? 0.1 : 0.0;
            uint64_t pixels = 0;
            const double e = BandRmse(reference, Pixels(device, model, s, camera), &pixels);
            std::printf("%s sem %d N %u fins %g back %d: %.4f (%lu px)\n", name.c_str(), int(semantics), n,
                        fins ? s.finThreshold : -1.0, back, e, pixels);
          }
    }
  }
}

}  // namespace
}  // namespace fur::test

#include <cstdio>
#include <cstring>
#include "fur/builtin.h"
#include "support.h"
namespace fur::test {
TEST(Dev, FloatParity) {
  const Model model = MakeBuiltinAnimal();
  const Camera camera = FrameBounds(ComputeBounds(model), PlaceAnimals(1, 1), 40, 4 / 3.0);
  for (Semantics sem : {Semantics::Sheet, Semantics::Volume})
  for (uint32_t n : {1u, 15u, 16u}) {
    RenderSettings s{.width = 320, .height = 240, .semantics = sem, .target = TargetFormat::Float16, .shells = n, .drawFins = false, .backFaces = false};
    FloatImage img[2]; Image pic[2];
    const glm::dmat4 place = PlaceAnimals(1, 1)[0];
    for (int b = 0; b < 2; ++b) {
      TestDevice device(Backends()[b]);
      auto r = MakeRenderer(*device, model, s);
      (*r)->Draw(camera, {&place, 1});
      img[b] = *(*r)->ReadPixels(); pic[b] = *(*r)->ReadImage();
    }
    int ch[4] = {0, 0, 0, 0}; double big = 0;
    for (size_t i = 0; i < img[0].pixels.size(); ++i)
      for (int c = 0; c < 4; ++c) {
        float a = img[0].pixels[i][c], q = img[1].pixels[i][c];
        if (std::memcmp(&a, &q, 4)) { ++ch[c]; big = std::max(big, double(std::abs(a - q))); }
      }
    std::printf("pic %lu ", DifferingPixels(pic[0], pic[1])); std::printf("sem %d n %u: differ %d %d %d %d, largest %g\n", int(sem), n, ch[0], ch[1], ch[2], ch[3], big);
  }
}
}

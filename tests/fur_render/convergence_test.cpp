// More shells come nearer to the integral: docs/accuracy.md, "Convergence". Pixels on the flank, the fringe apart, each against
// the reference's ray through the pixel's middle; frames in 32-bit floats unless the target's own floor is measured.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>

#include "../fur/reference_support.h"
#include "fur/builtin.h"
#include "fur/gltf.h"
#include "oracle.h"
#include "support.h"

namespace fur::test {
namespace {

constexpr uint32_t kWidth = 48, kHeight = 36;
constexpr uint32_t kCounts[] = {4, 8, 16, 32, 64, 128, 256, 512};
constexpr uint32_t kSlices = 16;  // of both models

// So near that a texel of the volume covers many pixels: both read mip 0. Textures are floats, because llvmpipe's filter of
// bytes has weights of 8 bits, which leaves a floor.
struct View {
  const char* name;
  Model model;
  Camera camera;
};

View Flank() { return {"built-in, flank", MakeBuiltinAnimal(), {.eye = {-1.7, 0.85, -0.3}, .target = {0, 0.62, 0.05}, .fovY = 0.7}}; }

View CatFlank() {
  Result<Model> cat = LoadGltf(std::filesystem::path(FUR_ASSETS_DIR) / "cat" / "cat.gltf");
  if (!cat) return {};
  return {"cat, flank", std::move(*cat), {.eye = {-2.6, 1.5, 0.4}, .target = {0, 0.75, 0.1}, .fovY = 0.5}};
}

struct Truth {
  std::vector<glm::dvec3> color;
  std::vector<bool> interior;  // skin behind the pixel and behind its neighbours
};

Truth Trace(const View& view, Semantics semantics) {
  const ReferenceSettings settings = Precise(Look::Correct, semantics);
  const ReferenceScene scene(view.model, settings);
  Truth truth;
  for (uint32_t y = 0; y < kHeight; ++y)
    for (uint32_t x = 0; x < kWidth; ++x) {
      const glm::dvec3 ray = RayThrough(view.camera, kWidth, kHeight, x, y);
      const reference::Radiance r = scene.Trace(RayFrom(view.camera.eye, view.camera.eye + ray));
      truth.color.push_back(r.color);
      truth.interior.push_back(r.skin && r.furOpacity > 0.5);
    }
  return truth;
}

double Rmse(const FloatImage& image, const std::vector<glm::dvec3>& truth, const std::vector<bool>& interior) {
  double sum = 0;
  size_t count = 0;
  for (size_t i = 0; i < image.pixels.size(); ++i) {
    if (!interior[i]) continue;
    const glm::dvec3 d = glm::dvec3(image.pixels[i]) - truth[i];
    sum += glm::dot(d, d) / 3;
    ++count;
  }
  return count > 0 ? std::sqrt(sum / double(count)) : -1;
}

// Shell by shell: exact where no fur lies over fur.
RenderSettings Settings(Semantics semantics, uint32_t shells, TargetFormat target = TargetFormat::Float32) {
  return {.width = kWidth, .height = kHeight, .semantics = semantics, .target = target, .shells = shells, .drawFins = false,
          .floatTextures = true, .shellMode = ShellMode::Instanced};
}

// Of log(error) over log(N), by least squares.
double Slope(const std::vector<std::pair<double, double>>& points) {
  double x = 0, y = 0, xx = 0, xy = 0;
  for (const auto& [n, error] : points) {
    x += std::log(n), y += std::log(error);
    xx += std::log(n) * std::log(n), xy += std::log(n) * std::log(error);
  }
  const auto count = double(points.size());
  return (count * xy - x * y) / (count * xx - x * x);
}

class Convergence : public OnEachBackend {
 protected:
  // To the integral; and to the limit of the GPU's own, in which most of its filter's floor cancels. A slab has one error for
  // all pixels, which need not fall from each count to the next; over `texels` it must.
  void ExpectConvergence(const View& view, bool texels, double slope) {
    for (const Semantics semantics : {Semantics::Sheet, Semantics::Volume}) {
      const Truth truth = Trace(view, semantics);
      const auto interior = std::count(truth.interior.begin(), truth.interior.end(), true);
      ASSERT_GT(interior, kWidth * kHeight * 3 / 4) << view.name;
      std::vector<FloatImage> frames;
      for (const uint32_t n : kCounts) frames.push_back(Pixels(*device_, view.model, Settings(semantics, n), view.camera));
      std::vector<glm::dvec3> limit;
      for (const glm::vec4& p : frames.back().pixels) limit.emplace_back(p);
      std::printf("  %s, %s, %d pixels; shells: error to the integral, to 512 shells\n", view.name,
                  semantics == Semantics::Sheet ? "sheet" : "volume", int(interior));
      double before = 1;
      std::vector<std::pair<double, double>> beyond;
      for (size_t i = 0; i < frames.size(); ++i) {
        const uint32_t n = kCounts[i];
        const double error = Rmse(frames[i], truth.color, truth.interior), own = Rmse(frames[i], limit, truth.interior);
        std::printf("    %3u: %.5f %.6f\n", n, error, own);
        EXPECT_TRUE(!texels || n > kSlices || error < before) << n;
        if (n >= 2 * kSlices && n <= 16 * kSlices) beyond.emplace_back(n, own);
        before = error;
      }
      std::printf("    slope from %u to %u: %.2f\n", 2 * kSlices, 16 * kSlices, Slope(beyond));
      EXPECT_LE(Slope(beyond), slope);
      EXPECT_LT(before, 0.001) << "512 shells to the integral";
    }
  }
};
INSTANTIATE_TEST_SUITE_P(Backends, Convergence, testing::ValuesIn(Backends()), BackendName);

// Slices of one texel: the filter rounds nothing, and what is left is the rule of the middles.
View Slab() {
  Coat coat;
  for (uint32_t i = 0; i < kSlices; ++i) {
    const uint32_t h = (i * 2654435761u) >> 24;  // Knuth's multiplicative hash
    const auto coverage = uint8_t(i + 1 == kSlices ? 0 : 20 + h / 2);
    coat.slices.push_back({uint8_t(90 + h / 3), uint8_t(170 - h / 4), 220, coverage});
  }
  coat.length = 0.2;
  coat.selfShadow = 0.2;
  return {"slab of 16 slices", FurredSquare(40, {180, 120, 60, 255}, coat), CameraAt(3, 25, 20, 20)};
}

TEST_P(Convergence, Slab) { ExpectConvergence(Slab(), false, -1.5); }

TEST_P(Convergence, BuiltinAnimal) { ExpectConvergence(Flank(), true, -1.5); }

TEST_P(Convergence, Cat) {
  const View view = CatFlank();
  if (view.model.parts.empty()) GTEST_SKIP() << "the cat is absent from " << FUR_ASSETS_DIR;
  ExpectConvergence(view, true, -1.5);
}

// What no number of shells removes: the target's rounding at every blend.
TEST_P(Convergence, FloorsOfTargets) {
  const View view = Flank();
  const Truth truth = Trace(view, Semantics::Volume);
  std::printf("  256 shells:");
  double errors[3] = {};
  const TargetFormat formats[] = {TargetFormat::Float32, TargetFormat::Float16, TargetFormat::Unorm8};
  for (int i = 0; i < 3; ++i) {
    const RenderSettings s = Settings(Semantics::Volume, 256, formats[i]);
    FloatImage image;
    if (formats[i] == TargetFormat::Unorm8) {
      const Image stored = Render(*device_, view.model, s, view.camera).image;
      image = {kWidth, kHeight, {}};
      for (size_t p = 0; p < stored.pixels.size(); p += 4)
        image.pixels.emplace_back(Decode(stored.pixels[p] / 255.0), Decode(stored.pixels[p + 1] / 255.0),
                                  Decode(stored.pixels[p + 2] / 255.0), 1);
    } else {
      image = Pixels(*device_, view.model, s, view.camera);
    }
    errors[i] = Rmse(image, truth.color, truth.interior);
    std::printf(" %s %.5f", i == 0 ? "RGBA32F" : i == 1 ? "RGBA16F" : "RGBA8", errors[i]);
  }
  std::printf("\n");
  EXPECT_LT(errors[0], errors[1]);
  EXPECT_LT(errors[1], errors[2]);
}

}  // namespace
}  // namespace fur::test

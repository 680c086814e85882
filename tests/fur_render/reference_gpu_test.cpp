// The reference's independent second estimator: the GPU in the limit of many shells, in 32-bit floats, four times as large
// and averaged. On a convex body no fur lies over other fur out of order, so both must agree. Prints what they do.
#include <cmath>
#include <cstdio>

#include "fur/reference.h"
#include "support.h"
#include "../fur/reference_support.h"

namespace fur::test {
namespace {

constexpr uint32_t kShells = 512, kFactor = 4, kWidth = 96, kHeight = 72;

// Several times the picture's size, so that the GPU reads mip 0 nearly everywhere.
FloatImage GpuLimit(TestDevice& device, const Model& model, const RenderSettings& s, const Camera& camera) {
  RenderSettings large = s;
  large.width *= kFactor;
  large.height *= kFactor;
  const FloatImage fine = Pixels(device, model, large, camera);
  FloatImage mean{s.width, s.height, std::vector<glm::vec4>(size_t(s.width) * s.height, glm::vec4(0))};
  if (fine.pixels.empty()) return mean;
  for (uint32_t y = 0; y < large.height; ++y)
    for (uint32_t x = 0; x < large.width; ++x)
      mean.pixels[size_t(y / kFactor) * s.width + x / kFactor] +=
          fine.pixels[size_t(y) * large.width + x] / float(kFactor * kFactor);
  return mean;
}

struct Agreement {
  double mean = 0, rmse = 0, bias = 0;  // of the colour's channels
  uint32_t pixels = 0;
  void Add(const glm::vec4& a, const glm::vec4& b) {
    for (int c = 0; c < 3; ++c) {
      const double d = double(a[c]) - double(b[c]);
      mean += std::abs(d);
      rmse += d * d;
      bias += d;
    }
    ++pixels;
  }
  void Finish() {
    const double n = std::max(1.0, 3.0 * pixels);
    mean /= n;
    bias /= n;
    rmse = std::sqrt(rmse / n);
  }
};

void ExpectAgreement(const std::string& name, const Model& model, Look look, Semantics semantics, const Camera& camera) {
  RenderSettings gpu{.width = kWidth, .height = kHeight, .look = look, .semantics = semantics,
                     .target = TargetFormat::Float32, .shells = kShells, .drawFins = false, .background = {0.3, 0.32, 0.34}};
  ReferenceSettings cpu;
  cpu.width = kWidth;
  cpu.height = kHeight;
  cpu.look = look;
  cpu.semantics = semantics;
  cpu.background = gpu.background;
  cpu.light = gpu.light = look == Look::Seed ? kDemoLight : Light{};
  TestDevice device(Backends()[0]);
  ASSERT_TRUE(device);
  const FloatImage limit = GpuLimit(device, model, gpu, camera);
  const std::vector<glm::dmat4> one{glm::dmat4(1)};
  const Result<ReferenceImage> reference = RenderReference(model, camera, one, cpu);
  ASSERT_TRUE(reference) << reference.error().message;
  Agreement interior, fringe;
  for (size_t i = 0; i < limit.pixels.size(); ++i) {
    const glm::vec4 &a = limit.pixels[i], &b = reference->color.pixels[i];
    if (reference->furOpacity[i] <= 1 / 255.0f) continue;
    (b.a > 0.9999f && reference->skin[i] ? interior : fringe).Add(a, b);
  }
  interior.Finish();
  fringe.Finish();
  std::printf("  %-8s %-7s %-6s interior %4u pixels: mean %.5f, bias %+.5f, RMSE %.5f; fringe %4u: mean %.5f, bias %+.5f, RMSE %.5f\n",
              name.c_str(), look == Look::Seed ? "seed" : "correct", semantics == Semantics::Sheet ? "sheet" : "volume",
              interior.pixels, interior.mean, interior.bias, interior.rmse, fringe.pixels, fringe.mean, fringe.bias, fringe.rmse);
  EXPECT_GT(interior.pixels, 300u);
  EXPECT_GT(fringe.pixels, 50u);
  EXPECT_LE(interior.mean, 0.001) << name;
  EXPECT_LE(fringe.mean, 0.003) << name;
}

void ExpectAgreementInEveryWay(const std::string& name, const Model& model, const Camera& camera) {
  for (const Look look : {Look::Correct, Look::Seed})
    for (const Semantics semantics : {Semantics::Sheet, Semantics::Volume})
      ExpectAgreement(name, model, look, semantics, camera);
}

// Strands that lean, on a texture that varies.
Coat LeaningCoat(double length) {
  Coat coat;
  coat.length = length;
  for (int i = 0; i < 16; ++i)
    coat.slices.push_back({uint8_t(128 + 4 * i), uint8_t(140 - 3 * i), 230, uint8_t(i < 15 ? 70 - 4 * i : 0)});
  return coat;
}

void Tuft(Model* model) {
  FurVolume& v = model->volumes[0];
  for (size_t i = 0; i < v.pixels.size() / 4; ++i)
    if ((i % v.width + i / v.width) % 2) v.pixels[i * 4 + 3] = uint8_t(v.pixels[i * 4 + 3] / 3);
}

TEST(ReferenceAgainstGpu, Sphere) {
  Model model = Sphere(3, LeaningCoat(0.25));
  Tuft(&model);
  ExpectAgreementInEveryWay("sphere", model, CameraAt(4.5, 30, 20));
}

// Strands of their own colours, in every second texel too.
TEST(ReferenceAgainstGpu, SphereOfTintedFur) {
  Coat coat = LeaningCoat(0.25);
  for (uint32_t i = 0; i < 16; ++i) coat.tints.push_back({uint8_t(40 + 10 * i), uint8_t(170 - 6 * i), 128, 0});
  Model model = Sphere(3, coat);
  Tuft(&model);
  for (size_t i = 0; i < model.volumes[0].tint.size(); i += 8) model.volumes[0].tint[i + 2] = 30;
  model.materials[0].fur->params.tint = 0.8;
  const Camera camera = CameraAt(4.5, 30, 20);
  ExpectAgreement("tinted", model, Look::Correct, Semantics::Volume, camera);
  ExpectAgreement("tinted", model, Look::Seed, Semantics::Sheet, camera);
}

// On the lit side, with roots in shade, where clumps show in the interior too.
void ExpectAgreementOfGroom(const std::string& name, double clumping, double wetness) {
  Model model = Sphere(3, LeaningCoat(0.25));
  Tuft(&model);
  FurParams& p = model.materials[0].fur->params;
  p.selfShadow = 0.3;
  p.clumping = clumping;
  p.wetness = wetness;
  const Camera camera = CameraAt(4.5, 215, 20);
  ExpectAgreement(name, model, Look::Correct, Semantics::Sheet, camera);
  ExpectAgreement(name, model, Look::Correct, Semantics::Volume, camera);
  ExpectAgreement(name, model, Look::Seed, Semantics::Sheet, camera);
}

TEST(ReferenceAgainstGpu, SphereOfClumpedFur) { ExpectAgreementOfGroom("clumped", 0.7, 0); }

TEST(ReferenceAgainstGpu, SphereOfWetFur) { ExpectAgreementOfGroom("wet", 0, 0.5); }

TEST(ReferenceAgainstGpu, Cube) { ExpectAgreementInEveryWay("cube", Cube(LeaningCoat(0.4)), CameraAt(7, 30, 20)); }

TEST(ReferenceAgainstGpu, Tetrahedron) { ExpectAgreementInEveryWay("tetra", Tetrahedron(LeaningCoat(0.4)), CameraAt(7, 30, 20)); }

}  // namespace
}  // namespace fur::test

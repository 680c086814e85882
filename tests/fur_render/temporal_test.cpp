// What changes from frame to frame on a turntable, beside what the reference changes. That no fin pops is in
// fin_rules_test.cpp.
#include <cmath>
#include <cstdio>

#include "fur/builtin.h"
#include "fur/reference.h"
#include "models.h"
#include "support.h"

namespace fur::test {
namespace {

constexpr uint32_t kWidth = 160, kHeight = 120;
const std::vector<glm::dmat4> kOne{glm::dmat4(1)};

const Model& Animal() {
  static const Model model = MakeBuiltinAnimal();
  return model;
}

Camera Start() { return FrameBounds(ComputeBounds(Animal()), kOne, 30, double(kWidth) / kHeight); }

RenderSettings Settings() {
  RenderSettings s{.width = kWidth, .height = kHeight, .background = {0.3, 0.32, 0.34}};
  s.target = TargetFormat::Float32;
  return s;
}

double Channels(const glm::vec4& p) { return double(std::abs(p.r) + std::abs(p.g) + std::abs(p.b)) / 3; }

class Turntable {
 public:
  Turntable(TestDevice* device, const RenderSettings& s) : device_(*device), settings_(s) {}
  FloatImage At(double degrees) { return Pixels(device_, Animal(), settings_, TurnCamera(Start(), degrees)); }

 private:
  TestDevice& device_;
  RenderSettings settings_;
};

class Temporal : public OnEachBackend {};
INSTANTIATE_TEST_SUITE_P(Backends, Temporal, testing::ValuesIn(Backends()), BackendName);

FloatImage ReferenceAt(double degrees) {
  ReferenceSettings r;
  r.width = kWidth;
  r.height = kHeight;
  r.background = {0.3, 0.32, 0.34};
  r.samplesPerPixel = 16;
  Result<ReferenceImage> image = RenderReference(Animal(), TurnCamera(Start(), degrees), kOne, r);
  EXPECT_TRUE(image);
  return image ? std::move(image->color) : FloatImage{};
}

const std::vector<FloatImage>& References() {
  static const std::vector<FloatImage> all{ReferenceAt(0), ReferenceAt(0.5), ReferenceAt(1)};
  return all;
}

// Flicker: mean |(I[t+1] - I[t]) - (R[t+1] - R[t])|, docs/accuracy.md. Four samples flicker less than one; both less than
// the reference itself changes.
TEST_P(Temporal, FlickerOnATurntable) {
  const std::vector<FloatImage>& reference = References();
  double flicker[2] = {0, 0}, moved = 0;
  for (const uint32_t samples : {1u, 4u}) {
    RenderSettings s = Settings();
    s.samples = samples;
    Turntable table(device_.get(), s);
    FloatImage before = table.At(0);
    for (size_t t = 1; t < reference.size(); ++t) {
      FloatImage now = table.At(0.5 * double(t));
      for (size_t i = 0; i < now.pixels.size(); ++i) {
        const glm::vec4 truth = reference[t].pixels[i] - reference[t - 1].pixels[i];
        flicker[samples / 4] += Channels(now.pixels[i] - before.pixels[i] - truth);
        if (samples == 1) moved += Channels(truth);
      }
      before = std::move(now);
    }
  }
  const double frames = double(reference.size() - 1) * kWidth * kHeight;
  std::printf("  flicker: %.5f at 1 sample, %.5f at 4; the reference changes by %.5f\n", flicker[0] / frames,
              flicker[1] / frames, moved / frames);
  EXPECT_GT(moved / frames, 1e-3) << "nothing moves";
  EXPECT_LT(flicker[1], flicker[0]);
  EXPECT_LT(flicker[0], moved);
}

}  // namespace
}  // namespace fur::test

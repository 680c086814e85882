// The spring of moving fur against the closed form of the damped oscillator, and at every frame rate alike.
#include "fur/inertia.h"

#include <gtest/gtest.h>

#include <cmath>
#include <complex>

namespace fur {
namespace {

// After the animal has set off with the velocity u at t = 0: y = -u (e^(r1 t) - e^(r2 t)) / (r1 - r2), r the roots of
// r^2 + c r + k = 0.
double Answer(double stiffness, double damping, double u, double t) {
  const std::complex<double> root = std::sqrt(std::complex<double>(damping * damping / 4 - stiffness));
  if (std::abs(root) < 1e-9) return -u * t * std::exp(-damping / 2 * t);
  const std::complex<double> r1 = -damping / 2 + root, r2 = -damping / 2 - root;
  return (-u * (std::exp(r1 * t) - std::exp(r2 * t)) / (r1 - r2)).real();
}

struct Spring {
  double stiffness, damping;
};
constexpr Spring kSprings[] = {{400, 12}, {400, 0}, {400, 40}, {400, 90}, {9, 1}, {1e5, 1e3}, {2e4, 3}};

TEST(Inertia, IsTheClosedFormAtEveryTime) {
  for (const Spring& s : kSprings) {
    for (const double frame : {1.0 / 24, 1.0 / 37, 1.0 / 1000}) {
      Inertia inertia(s.stiffness, s.damping);
      const glm::dvec3 velocity(2, -0.5, 0);
      double t = 0;
      for (int i = 0; i < 60; ++i) {
        inertia.Step(frame, velocity);
        t += frame;
        const glm::dvec3 y = inertia.Displacement();
        ASSERT_NEAR(y.x, Answer(s.stiffness, s.damping, 2, t), 1e-9) << s.stiffness << " " << s.damping << " " << t;
        ASSERT_NEAR(y.y, Answer(s.stiffness, s.damping, -0.5, t), 1e-9);
        ASSERT_EQ(y.z, 0);
      }
    }
  }
}

// Sets off, turns and stops, at times that all the frame rates share.
glm::dvec3 VelocityAt(int sixths) {
  constexpr glm::dvec3 kPath[] = {{1, 0, 0}, {1, 0, 0}, {0, 0, 2}, {-1, 1, 0}, {0, 0, 0}, {0, 0, 0}};
  return kPath[sixths % 6];
}

std::vector<glm::dvec3> AtSixths(const Spring& spring, int framesPerSecond) {
  Inertia inertia(spring.stiffness, spring.damping);
  std::vector<glm::dvec3> seen;
  for (int sixth = 0; sixth < 60; ++sixth) {
    for (int i = 0; i < framesPerSecond / 6; ++i) inertia.Step(1.0 / framesPerSecond, VelocityAt(sixth));
    seen.push_back(inertia.Displacement());
  }
  return seen;
}

TEST(Inertia, DoesNotDependOnTheFrameRate) {
  double most = 0;
  for (const Spring& spring : kSprings) {
    const std::vector<glm::dvec3> expected = AtSixths(spring, 240);
    for (const int rate : {24, 30, 60, 144}) {
      const std::vector<glm::dvec3> got = AtSixths(spring, rate);
      for (size_t i = 0; i < got.size(); ++i)
        ASSERT_LT(glm::length(got[i] - expected[i]), 1e-9) << rate << " frames a second, sixth " << i;
      most = std::max(most, glm::length(got[3]));
    }
  }
  EXPECT_GT(most, 0.01) << "there is hardly anything to compare";
}

TEST(Inertia, OffsetTrailsAndStaysBelowOneLength) {
  Inertia inertia(400, 12);
  inertia.Step(1.0 / 60, {1000, 0, 0});
  const glm::dvec3 offset = inertia.Offset(0.05);
  EXPECT_LT(offset.x, -0.9);
  EXPECT_GT(offset.x, -1);
  for (int i = 0; i < 600; ++i) inertia.Step(1.0 / 60, {1000, 0, 0});
  EXPECT_LT(glm::length(inertia.Offset(0.05)), 1e-6) << "a steady motion is no force";
  EXPECT_EQ(inertia.Offset(0), glm::dvec3(0));
}

TEST(Inertia, IgnoresWhatIsNoTimeAndSurvivesAPause) {
  Inertia inertia(400, 0);
  for (const double seconds : {0.0, -1.0, std::nan("")}) inertia.Step(seconds, {5, 0, 0});
  EXPECT_EQ(inertia.Displacement(), glm::dvec3(0));
  inertia.Step(1e9, {5, 0, 0});
  EXPECT_LT(glm::length(inertia.Displacement()), 1);
}

}  // namespace
}  // namespace fur

// Fur that lags behind a moving animal: one damped spring for each animal.
#pragma once

#include <glm/glm.hpp>

namespace fur {

// y'' = -k y - c y' - A: y the displacement of the tips, world axes and units, k stiffness (1/s^2), c damping (1/s), A the
// animal's acceleration. Integrated in fixed steps of 1/240 s, each by the equation's closed form: where the animal's
// velocity changes at times that two frame rates share, both find the same fur at every time that they share.
class Inertia {
 public:
  static constexpr double kStep = 1.0 / 240;
  static constexpr double kLongestPause = 10;  // seconds of one Step that are integrated; fur is at rest long before

  Inertia(double stiffness, double damping);
  // `seconds` go by, >= 0, in which the animal moves with `velocity` (world units a second). A change of velocity takes
  // effect with the fixed step that it falls into.
  void Step(double seconds, const glm::dvec3& velocity);
  glm::dvec3 Displacement() const;  // now, between two fixed steps too
  // For Motion::offsets: the displacement in fur lengths, bent smoothly so that it stays below 1 however hard the jolt.
  glm::dvec3 Offset(double furLength) const;

 private:
  struct State {
    glm::dvec3 place{0}, speed{0};
  };
  // place' = a place + b speed, speed' = c place + d speed
  struct Transition {
    double a, b, c, d;
    State operator()(const State& s) const { return {s.place * a + s.speed * b, s.place * c + s.speed * d}; }
  };
  Transition After(double seconds) const;

  double stiffness_, damping_;
  Transition step_;
  State state_;
  glm::dvec3 velocity_{0};
  double rest_ = 0;  // seconds since the last fixed step
};

}  // namespace fur

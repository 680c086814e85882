#include "fur/inertia.h"

#include <algorithm>
#include <cmath>

namespace fur {

Inertia::Inertia(double stiffness, double damping)
    : stiffness_(stiffness), damping_(damping), step_(After(kStep)) {}

// With l = c/2 and d = k - l^2: y(t) = e^(-lt) (y0 C + (v0 + l y0) S), y'(t) = e^(-lt) (v0 C - (k y0 + l v0) S), where
// C = cos wt, S = sin(wt)/w for d = w^2 > 0, hyperbolic for d = -w^2 < 0, and their common series in between.
Inertia::Transition Inertia::After(double t) const {
  const double l = damping_ / 2, d = stiffness_ - l * l, w = std::sqrt(std::abs(d));
  double cosine = 1 - d * t * t / 2, sine = t * (1 - d * t * t / 6);
  if (w * std::abs(t) > 1e-4) {
    cosine = d > 0 ? std::cos(w * t) : std::cosh(w * t);
    sine = (d > 0 ? std::sin(w * t) : std::sinh(w * t)) / w;
  }
  const double decay = std::exp(-l * t);
  return {decay * (cosine + l * sine), decay * sine, -decay * stiffness_ * sine, decay * (cosine - l * sine)};
}

void Inertia::Step(double seconds, const glm::dvec3& velocity) {
  if (!(seconds > 0)) return;
  state_.speed -= velocity - velocity_;  // the root runs away, the tip has not moved yet
  velocity_ = velocity;
  rest_ += std::min(seconds, kLongestPause);
  // A sum of frame times is off by rounding: a step that is due but for it is made.
  constexpr double kRounding = 1e-9;
  for (; rest_ > kStep - kRounding; rest_ -= kStep) state_ = step_(state_);
}

glm::dvec3 Inertia::Displacement() const { return After(rest_)(state_).place; }

glm::dvec3 Inertia::Offset(double furLength) const {
  if (!(furLength > 0)) return glm::dvec3(0);
  const glm::dvec3 y = Displacement() / furLength;
  return y / std::sqrt(1 + glm::dot(y, y));
}

}  // namespace fur

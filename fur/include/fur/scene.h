// Where things are: camera, light, and the placement of several animals.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "fur/model.h"

namespace fur {

// A right-handed view, +Y up by default. Everything in double: large translations cancel before they reach a float.
struct Camera {
  glm::dvec3 eye{-1, 2, -3}, target{0}, up{0, 1, 0};
  double fovY = 65;                // vertical, degrees, (0, 180)
  double zNear = 0.1, zFar = 1000;  // distances along the view
};
glm::dmat4 ViewMatrix(const Camera&);                    // world -> view
// View -> clip, depth reversed: 1 at zNear, 0 at zFar. Floats are dense near 0, where perspective crowds what is far away, so
// that planes of 1e-3 and 1e6 go together (N. Reed, "Depth precision visualized", 2015).
glm::dmat4 ProjectionMatrix(const Camera&, double aspect);


// What normals are multiplied with: the inverse transpose of `m`. Where a node flattens its mesh there is none; then the
// cofactors, which are det times that.
glm::dmat3 NormalMatrix(const glm::dmat3& m);

// One directional light. Colours are in the look's own space: raw for look seed, linear for look correct.
struct Light {
  glm::dvec3 direction{1, -1, 1};  // the way the light travels; need not be unit
  glm::dvec3 diffuse{0.85}, ambient{0.18}, specular{0.35};
};
// The published demo's light.
inline constexpr Light kDemoLight{{1, -1, 1}, glm::dvec3(1), glm::dvec3(0.3), glm::dvec3(0.5)};

// A power of two that brings the model to about the size of the published demo's cat (diameter 3.3 units): 1 for it.
// Spacing, near and far plane are multiples of it, so that a fox of 150 units is treated as a cat of 3.
double SceneScale(const Bounds&);

// The published demo's field: rows = ceil(sqrt(count)), half = rows / 2; animal (i, j) stands at
// ((i - half) / half * 8, 0, (j - half) / half * 8), turned about Y by an angle in -180..-120 degrees; one animal stands
// at the origin, turned by -180. Above 100 the spacing stays that of 100 and the field grows along +Z, away from the
// demo's camera. Angles come from SplitMix64 (Steele, Lea, Flood 2014) seeded with 1. Lengths are times `scale`.
std::vector<glm::dmat4> PlaceAnimals(uint32_t count, double scale);

// A camera that just shows all `points` (world space, not empty) from the front left of an animal that looks along -Z, a
// little above. `scale` as for PlaceAnimals: near and far plane.
Camera FramePoints(const std::vector<glm::dvec3>& points, double fovY, double aspect, double scale);

// The same for a box after each placement.
Camera FrameBounds(const Bounds& bounds, const std::vector<glm::dmat4>& placements, double fovY, double aspect);

// The camera turned about the target's vertical axis (`up`).
Camera TurnCamera(const Camera&, double degrees);

}  // namespace fur

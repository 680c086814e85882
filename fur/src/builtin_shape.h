// The built-in animal's body as a signed-distance field, and the facts that painting needs.
#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>

namespace fur::builtin {

enum Region : uint32_t { kTorso, kHead, kEar, kFrontLeg, kHindLeg, kTail, kRegionCount };

// Distances to each region's own shape, negative inside. Regions are not blended with one another.
std::array<double, kRegionCount> RegionDistances(const glm::dvec3& p);

// The whole skin, regions blended smoothly; symmetrical in x. A bound rather than the exact distance.
double Distance(const glm::dvec3& p);
// Unit gradient of Distance.
glm::dvec3 Normal(const glm::dvec3& p);
// The nearest point of the skin along the gradient, by Newton's steps.
glm::dvec3 Project(glm::dvec3 p, int steps);

// The bald parts.
struct Ball {
  glm::dvec3 center, radii;
};
Ball Eye();            // the one at x > 0
glm::dvec3 EyeAxis();  // where it looks, unit
Ball Nose();

// The tail's spine: where a point lies along it, 0 root to 1 tip.
double TailParameter(const glm::dvec3& p);

struct Box {
  glm::dvec3 min, max;
};
Box SkinBox();

}  // namespace fur::builtin

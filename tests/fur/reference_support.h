// Rays through the reference, without pictures.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "models.h"
#include "oracle.h"
#include "reference/integrate.h"

namespace fur::test {

// A model under the reference's integrator. Precise unless a tolerance says otherwise.
class ReferenceScene {
 public:
  ReferenceScene(const Model&, const ReferenceSettings&, const std::vector<glm::dmat4>& placements = {glm::dmat4(1)});
  reference::Radiance Trace(const reference::Ray&, const glm::dvec3& background = glm::dvec3(0)) const;
  // By all prisms and triangles, without Embree.
  reference::Radiance TraceBrute(const reference::Ray&, const glm::dvec3& background = glm::dvec3(0)) const;
  const reference::FurScene& Scene() const { return scene_; }

 private:
  Model model_;
  reference::FurScene scene_;
  std::unique_ptr<reference::Culler> culler_, brute_;
  double tolerance_;
};

reference::Ray RayFrom(const glm::dvec3& origin, const glm::dvec3& towards);

ReferenceSettings Precise(Look, Semantics);

// The tau from height h up to 1 of a coat of constant coverage whose top slice is empty, face-on: between the middles of
// the last two slices coverage falls linearly to 0, and the integral of -ln(1 - a x) over x = 0..1 is 1 + (1 - a) ln(1 - a) / a.
double ConstantCoatAbove(double h, double coverage, uint32_t slices);

// The unit sphere's mesh: an icosahedron, each triangle cut in four `levels` times.
Model Sphere(int levels, const Coat&);

}  // namespace fur::test

// Points on the unit torus.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "random.h"

namespace fur {

// With a grid that finds the ones near a place.
class TorusPoints {
 public:
  explicit TorusPoints(size_t expected);
  void Add(glm::dvec2 p);
  bool AnyWithin(glm::dvec2 p, double radius) const;
  // Index of the nearest of the points; there must be one.
  uint32_t NearestTo(glm::dvec2 p) const;
  const std::vector<glm::dvec2>& all() const { return points_; }

 private:
  size_t CellOf(glm::dvec2 p) const;
  template <class F>
  void ForNear(glm::dvec2 p, double radius, F visit) const;

  int cells_ = 1;
  std::vector<std::vector<uint32_t>> grid_;
  std::vector<glm::dvec2> points_;
};

// Poisson-disc points by dart throwing, on a grid of 2^-20; the radius starts at 0.8 of the hexagonal packing's and
// shrinks a little whenever 24 darts in a row miss, so that the count is met exactly. The first `first` are spread as
// evenly as if they were alone.
TorusPoints ThrowRoots(uint32_t count, uint32_t first, Pcg32* random);

}  // namespace fur

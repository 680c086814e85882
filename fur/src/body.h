// Places on a body, for what is painted by position.
#pragma once

#include <array>
#include <glm/glm.hpp>
#include <vector>

#include "fur/model.h"

namespace fur {

// p in diameters of the model from its middle, x across, y up, z along the body (ahead); h: 0 the lowest point, 1 the
// highest; n: the normal, the same axes. The distances go over the skin, in diameters.
struct Place {
  glm::dvec3 p{0}, n{1, 0, 0};
  double h = 0.5;
  double nose = 0, tail = 0, feet = 0;
};
Place Mix(const std::array<const Place*, 3>& corners, double a, double b, double c);

// A mesh without seams: what stands at one position is one vertex.
struct Skin {
  std::vector<glm::dvec3> positions;
  std::vector<std::array<uint32_t, 3>> triangles;
};

// From the nearest of the sources, whose own distances are given. Over the skin, triangle by triangle as if from one point
// in its plane (Novotni, Klein, "Computing geodesic distances on triangular meshes", WSCG 2002), repeated until nothing
// changes; what no source reaches has the straight distance.
struct Source {
  uint32_t vertex;
  double distance;
};
std::vector<double> SurfaceDistance(const Skin&, const std::vector<Source>&);

// The body's axes (it looks where the first furred material's `front` says) and the places of
// all vertices. Equal positions have equal places, whatever their normals and texture coordinates.
class Body {
 public:
  explicit Body(const Model&);
  const Place& At(size_t part, uint32_t vertex) const { return places_[vertexOf_[part][vertex]]; }
  // Places spread evenly over the skin of the furred materials, or over all if none is.
  const std::vector<Place>& Samples() const { return samples_; }

 private:
  void Weld(const Model&);
  void Measure();
  void Sample();

  Skin skin_;
  std::vector<Place> places_;
  std::vector<std::vector<uint32_t>> vertexOf_;  // by part
  std::vector<uint8_t> furred_;                  // by triangle
  std::vector<Place> samples_;
};

}  // namespace fur

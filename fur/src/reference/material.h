// What fur and skin are made of and how they are lit: the equations of docs/accuracy.md in double precision.
#pragma once

#include <optional>

#include "fur/reference.h"
#include "texture.h"
#include "volume.h"

namespace fur::reference {

// The surface that is lit: world axes, not yet unit.
struct FurFrame {
  glm::dvec3 direction, normal, tangent;
  double handedness = 1;
};
struct SkinFrame {
  glm::dvec3 normal, tangent;
  double handedness = 1;
};

// The light in the look's own space.
struct Lighting {
  Look look;
  Light light;
  glm::dvec3 travel;  // unit
  explicit Lighting(const ReferenceSettings& s);
};

// What a place in the fur reads of the volume.
struct FurPlace {
  glm::dvec2 root{0};    // tiles
  glm::dvec3 strand{0};  // in tangent space, not unit
  double density = 0;    // optical depth for a unit of height, seen face-on
};

class Coat {
 public:
  Coat(const Model&, const Material&, Look);

  FurPlace PlaceAt(const glm::dvec2& tiles, double h) const;
  // Where a strand is longer than the length map says. `length`: of the welded vertices, at this place.
  bool IsCut(const glm::dvec2& uv, double h, double length) const { return hasLengthMap_ && h * length > lengths_.Red(uv); }
  // What the length map says at least between these coordinates.
  double LeastLength(const glm::dvec2& low, const glm::dvec2& high) const;
  glm::dvec3 Shade(const Lighting&, const glm::dvec3& ray, const FurFrame&, const glm::dvec2& uv, const FurPlace&,
                   double h) const;
  double Length() const { return length_; }
  uint32_t Slices() const { return volume_.Slices(); }
  // Between two places, in texels of a slice.
  double Texels(const FurPlace& a, const FurPlace& b) const { return volume_.Texels(b.root - a.root); }

 private:
  glm::dvec3 Albedo(Look, const glm::dvec2& uv, const FurPlace&, double h) const;

  Volume volume_;
  FurParams params_;  // wet
  double length_, falloff_, darkening_;
  bool groomed_;
  Texture color_, lengths_;
  glm::dvec3 factor_;
  bool hasLengthMap_;
};

class Skin {
 public:
  Skin(const Model&, const Material&, Look);
  glm::dvec3 Shade(const Lighting&, const glm::dvec3& ray, const SkinFrame&, const glm::dvec2& uv) const;
  bool DoubleSided() const { return doubleSided_; }

 private:
  glm::dvec3 ShadingNormal(Look, const SkinFrame&, const glm::dvec2& uv) const;
  Texture color_, normal_, specular_;
  glm::dvec3 factor_, gloss_;
  double power_, normalScale_, darkening_;
  bool hasNormalMap_, doubleSided_;
};

}  // namespace fur::reference

// What fur and skin are made of and how they are lit: the equations of docs/accuracy.md in double precision.
#pragma once

#include <optional>

#include "fur/reference.h"
#include "texture.h"

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

class Coat {
 public:
  Coat(const Model&, const Material&, Look);

  // Optical depth for a unit of height, seen face-on. Zero where the strand would be longer than the length map says.
  // `length`: of the welded vertices, at this place.
  double Density(const glm::dvec2& uv, const glm::dvec2& tiles, double h, double length) const;
  glm::dvec3 Shade(const Lighting&, const glm::dvec3& ray, const FurFrame&, const glm::dvec2& uv,
                   const glm::dvec2& tiles, double h) const;
  double Length() const { return params_.length; }
  uint32_t Slices() const { return volume_.layers; }
  // Along a way through the volume, in texels of a slice.
  double Texels(const glm::dvec2& tiles) const;

 private:
  glm::dvec3 Filtered(const std::vector<uint8_t>& pixels, const glm::dvec2& tiles, double h) const;  // rgb, 0..1
  glm::dvec3 Own(const glm::dvec2& tiles, double h) const;  // the strands' factor of the colour
  glm::dvec3 Albedo(Look, const glm::dvec2& uv, const glm::dvec2& tiles, double h) const;

  FurVolume volume_;
  std::vector<uint8_t> coverage_;  // of the volume, the slices of a texel side by side
  FurParams params_;
  double falloff_;
  Texture color_, length_;
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
  double power_, normalScale_;
  bool hasNormalMap_, doubleSided_;
};

}  // namespace fur::reference

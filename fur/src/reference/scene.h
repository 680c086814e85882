// The model's skin and fur in world space, all animals.
#pragma once

#include <array>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "fur/fur_mesh.h"
#include "fur/groom.h"
#include "material.h"
#include "prism.h"

namespace fur::reference {

struct SkinTriangle {
  std::array<glm::dvec3, 3> p;  // counter-clockwise from the front
  uint32_t part = 0, triangle = 0;
  bool doubleSided = false;
};

struct SkinHit {
  double t = 0;  // infinite: none
  uint32_t triangle = 0;
  glm::dvec3 b{0};
  bool Found() const { return t < 1e300; }
};
inline constexpr SkinHit kNoSkin{1e300, 0, {0, 0, 0}};

// Nearest so far and this triangle's.
void Intersect(const SkinTriangle&, uint32_t index, const Ray&, SkinHit* nearest);

// One point of a ray within a prism: how dense the fur is there, and what it takes to light it.
struct FurPoint {
  double h = 0, t = 0;
  double density = 0;  // d tau / d h along this ray
  glm::dvec3 b{0};
  glm::dvec2 uv{0};     // of the model's maps
  FurPlace place;
};

// What it takes to light a prism's fur: world axes, at the three corners.
struct FurCorners {
  std::array<glm::dvec3, 3> direction, lean, normal, tangent;
  std::array<double, 3> handedness;
};

class FurScene {
 public:
  FurScene(const Model&, std::span<const glm::dmat4> placements, const ReferenceSettings&);

  const std::vector<Prism>& Prisms() const { return prisms_; }
  const std::vector<SkinTriangle>& SkinTriangles() const { return skin_; }

  FurPoint Read(const Prism&, const PrismView&, double h) const;
  FurCorners LightingOf(const Prism&) const;
  glm::dvec3 Shade(const Prism&, const FurCorners&, const FurPoint&, const Ray&) const;
  glm::dvec3 Shade(const SkinHit&, const Ray&) const;
  uint32_t Slices(const Prism&) const;
  // How far two points of a prism are apart, in texels of the volume.
  double Texels(const Prism&, const FurPoint&, const FurPoint&) const;

 private:
  struct Part {
    glm::dmat3 linear{1}, normalToWorld{1};
    uint32_t primitive = 0, material = 0;
    FurSway sway;
    bool mirrored = false;  // its transform turns the winding around, and what cross products say
    double Handedness() const { return mirrored ? -1 : 1; }
  };
  void AddPart(const fur::Part&, const glm::dmat4& placement);
  FurSway SwayOf(const Material&, const fur::Part&, const glm::dmat4& placement) const;
  void AddPrisms(const Part&, const glm::dmat4& toWorld);
  // What interpolation needs of a furred triangle's corners, in the order of their reading.
  struct Corners {
    std::array<glm::dvec2, 3> uv, tiles;
    std::array<double, 3> length;
    double uncut = 0;  // no strand is cut by the length map below this height
  };
  static std::vector<Corners> CornersOf(const FurMesh&, const Coat*);
  bool Furred(const Part& part) const { return coats_[part.material] != nullptr; }

  const Model& model_;
  Semantics semantics_;
  Lighting lighting_;
  std::optional<glm::dvec3> furnace_;
  std::optional<glm::dvec3> comb_;
  std::optional<double> bend_;
  double time_, windLength_;
  std::vector<FurMesh> meshes_;
  std::vector<std::unique_ptr<Coat>> coats_;  // of each material; null: bald
  std::vector<std::unique_ptr<Skin>> skins_;
  std::vector<Part> parts_;
  std::vector<Prism> prisms_;
  std::vector<std::vector<Corners>> corners_;  // for each primitive's triangles
  std::vector<SkinTriangle> skin_;
};

}  // namespace fur::reference

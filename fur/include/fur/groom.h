// Where groomed fur stands: the sideways offset c in X(h) = p + h l d + h^k l c (docs/accuracy.md), in double. The shaders
// evaluate the same (shaders_hlsl/fur_sway.hlsli).
#pragma once

#include <glm/glm.hpp>

#include "fur/model.h"
#include "fur/params.h"

namespace fur {

// Of one part of one animal. Object axes, in lengths of the fur.
struct FurSway {
  glm::dvec3 comb{0};     // the comb, and what inertia adds
  double bend = 2;        // k
  glm::dvec3 gravity{0};  // before its part along the fur's direction is taken away
  glm::dvec3 wind{0};     // at its strongest
  glm::dvec3 wave{0};     // wind waves for one unit of length
  double phase = 0;       // waves that went by, modulo kWavesOfAGust
  bool Varies() const { return gravity != glm::dvec3(0) || wind != glm::dvec3(0); }  // from vertex to vertex
};
inline constexpr double kWavesOfAGust = 4;

// `params.windLength` > 0. `partToModel` brings the comb to the part's axes, `placement` gravity and wind too. `time` in
// seconds; `inertia`: offset in world axes, in fur lengths (fur/inertia.h).
FurSway MakeFurSway(const FurParams& params, const glm::dmat4& placement, const glm::dmat4& partToModel, double time,
                    const glm::dvec3& inertia);

// How strong the wind is at a place, 0..1: (1/2 + 1/2 sin 2 pi q) (5/8 + 3/8 sin(2 pi q / 4)), q = wave . p - phase waves
// from the crest. Crests and the gusts over them travel along the wind with frequency x wavelength; fur leans with the wind,
// never against it. The form is ours.
double WindAt(const FurSway&, const glm::dvec3& position);

// c of a root with the unit fur direction d: comb + wind + gravity - (gravity . d) d.
glm::dvec3 TipOffset(const FurSway&, const glm::dvec3& position, const glm::dvec3& direction);

// X(h) of fur of that length.
glm::dvec3 FurPoint(const FurSway&, const glm::dvec3& position, const glm::dvec3& direction, double length,
                    double height);

// What wetness makes of a coat; docs/fur.md. w = 0 changes nothing, to the bit.
double WetLength(double length, double wetness);         // shorter: (1 - 0.35 w)
double WetDarkening(double wetness);                     // exponent of the colour: 1 + w
double WetSpecularScale(double scale, double wetness);   // (1 + 3 w)
double WetSpecularPower(double power, double wetness);   // (1 + 2 w)
double WetClumping(double clumping, double wetness);     // at least w

// A volume of thicker strands: coverage a becomes a^(1 / thickness), which widens their soft edges; before the mips are made,
// so that the coat looks alike from afar. Ours.
FurVolume Thickened(FurVolume, double thickness);

// `length` (red) without fur wherever `furless` (red, nearest texel) is a half or less; the larger size of the two. Without
// `length` it is 1.
Image WithoutFurless(const Image* length, const Image& furless);

// The parameters' shading differs from plain fur's: the pixel shaders' variant GROOM is needed.
bool IsGroomed(const FurParams&);

}  // namespace fur

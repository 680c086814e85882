// The published lighting and the equations of look correct once more, in double, written from the descriptions
// (docs/seed.md, docs/accuracy.md) and not from the shaders: for the square z = 0 of models.h, whose frame is the
// world's.
#pragma once

#include <glm/glm.hpp>

#include "fur/renderer.h"
#include "models.h"

namespace fur::test {

double Decode(double srgb);  // IEC 61966-2-1
double Encode(double linear);

// What the square looks like under a coat.
struct SquareScene {
  Look look = Look::Correct;
  Semantics semantics = Semantics::Sheet;
  Light light;
  Texel color{255, 255, 255, 255};
  Coat coat;
  uint32_t shells = 16;
  glm::dvec3 tangent{1, 0, 0};  // x axis of the packed strands; z is +Z
  // Of a groomed coat: its density, colours, clumping and wetness, and where its clumps are.
  FurParams groom;
  glm::dvec3 eye{0};
  glm::dvec2 tilesAtOrigin{0}, tilesForX{0}, tilesForY{0};  // of the volume, for a unit along an axis
};

// The square of such a scene, 80 wide and 40 tiles of the volume; what the scene says of the tiles is filled in from its mesh.
Model GroomedSquare(SquareScene*);

// The way from the eye through the middle of a pixel, unit.
glm::dvec3 RayThrough(const Camera&, uint32_t width, uint32_t height, uint32_t x, uint32_t y);

// Before blending, in the look's own space, clamped to 0..1 as the target does. `ray`: unit, from the eye.
glm::dvec3 SkinColor(const SquareScene&, const glm::dvec3& ray);
// A skin that shines: `gloss` in the look's space.
glm::dvec3 GlossySkinColor(const SquareScene&, const glm::dvec3& ray, const glm::dvec3& gloss, double power);
// Of shell `shell`; alpha is the opacity.
glm::dvec4 ShellColor(const SquareScene&, const glm::dvec3& ray, uint32_t shell);

// All shells over the skin in exact arithmetic, as stored in the picture: 0..1, sRGB-encoded for look correct.
glm::dvec3 Composite(const SquareScene&, const glm::dvec3& ray);
glm::dvec3 Stored(Look, const glm::dvec3& color);

// The technique shells, docs/accuracy.md: colour and opacity of one midpoint shell, and all of them over the skin, in
// the look's own space, before it is stored. Fur above `end` (height, 0..1) is not there.
glm::dvec4 MidpointShell(const SquareScene&, const glm::dvec3& ray, uint32_t shell);
glm::dvec3 CompositeMidpoints(const SquareScene&, const glm::dvec3& ray, double end = 1);

}  // namespace fur::test

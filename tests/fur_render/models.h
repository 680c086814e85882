// Models whose picture can be computed by hand.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "fur/model.h"
#include "fur/scene.h"

namespace fur::test {

using Texel = std::array<uint8_t, 4>;

Image Plain(const std::string& name, const Texel&);  // 4 x 4 texels of one colour

// A square of the half side `half` around the origin, in the plane z = 0, facing +Z; u to the right, v down.
Primitive Square(double half);

// A bald square of one texture colour without a specular colour.
Model BaldSquare(double half, const Texel& color);

// What grows on the square: one texel for each slice, repeated.
struct Coat {
  std::vector<Texel> slices;  // root first; rgb: packed tangent, a: coverage
  std::vector<Texel> tints;  // of the slices (FurVolume::tint), or none
  double length = 0.03, selfShadow = 0.9, specularPower = 30, specularScale = 0.35;
};
Coat UniformCoat(uint32_t slices, uint8_t coverage, std::array<uint8_t, 3> tangent = {128, 128, 255});
Model FurredSquare(double half, const Texel& color, const Coat&);

// Triangles as they are, each vertex with a normal that points away from the origin; furred.
Model FurredMesh(const std::vector<glm::vec3>& positions, const std::vector<uint32_t>& indices, const Coat&);
Model Tetrahedron(const Coat&);
Model Cube(const Coat&);  // 8 vertices, 12 triangles, so that every edge has two triangles by index

// A roof: two slopes of 45 degrees that meet in an edge along x, whose vertices point up (+Z); u runs along the edge.
Model Roof(const Coat&);

// A camera on the ray from the origin at these angles; 0, 0 looks along -Z at the square's front.
Camera CameraAt(double distance, double yawDegrees, double pitchDegrees, double fovY = 40);

}  // namespace fur::test

// The built-in animal's pictures, painted from the place on the body that each texel shows.
#pragma once

#include "builtin_atlas.h"
#include "fur/model.h"

namespace fur::builtin {

struct SkinImages {
  Image color;      // sRGB
  Image length;     // red: 1 = the whole fur length
  Image direction;  // comb direction, tangent space, rgb * 2 - 1
};
SkinImages PaintSkin(const Atlas& atlas, uint32_t size);

// Iris and pupil on a disc seen from the front: u, v = (0.5, 0.5) is the pole of a ball that looks along +z.
Image PaintEye(uint32_t size);

}  // namespace fur::builtin

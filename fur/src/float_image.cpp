#include "fur/float_image.h"

#include "mips.h"

namespace fur {

void DecodeSrgb(FloatImage* image) {
  for (glm::vec4& p : image->pixels)
    for (int c = 0; c < 3; ++c) p[c] = float(SrgbToLinear(double(p[c])));
}

}  // namespace fur

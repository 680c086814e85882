// The colours of preset four-coats: bear, panther, snow, tiger, by the place on the body.
#include <cmath>

#include "pattern_math.h"
#include "preset_textures.h"
#include "surface_painter.h"

namespace fur {
namespace {

using glm::dvec3;

constexpr uint32_t kSide = 512;

dvec3 Bear(const Place& at) {
  const dvec3 brown(0.50, 0.32, 0.18), dark(0.25, 0.16, 0.10), honey(0.70, 0.50, 0.30);
  const double legs = Step(0.45, 0.1, at.h + 0.1 * Turbulence(at.p * 8.0));
  const double back = Step(0.2, 0.9, at.n.y + 0.4 * Turbulence(at.p * 10.0));
  return glm::mix(glm::mix(brown, honey, 0.6 * back), dark, 0.8 * legs);
}

// Black, with the faint rosettes that a panther shows against the light.
dvec3 Panther(const Place& at) {
  const dvec3 black(0.06, 0.055, 0.065), ghost(0.105, 0.095, 0.10);
  return glm::mix(black, ghost, Step(0.05, 0.35, std::abs(Noise(at.p * 24.0)) * 1.2 - 0.1));
}

// White with grey clouds, fewer on the belly.
dvec3 Snow(const Place& at) {
  const dvec3 white(0.93, 0.94, 0.95), grey(0.42, 0.44, 0.48);
  const double cloud = Step(0.10, 0.38, Turbulence(at.p * 26.0)) * Step(-0.7, 0.0, at.n.y);
  return glm::mix(white, grey, 0.85 * cloud);
}

// Orange above, cream below; black bands around the body that thin out downwards and waver.
dvec3 Tiger(const Place& at) {
  const dvec3 orange(0.92, 0.50, 0.12), cream(0.96, 0.91, 0.82), black(0.05, 0.045, 0.04);
  const double belly = Step(-0.2, -0.75, at.n.y + 0.3 * Turbulence(at.p * 9.0));
  const double waver = 0.018 * Turbulence(at.p * dvec3(9, 9, 5)) + 0.06 * std::abs(at.p.x);
  // Bands across the body; where the skin faces along it (face, rump) they are level instead.
  const double across = std::sin((at.p.z + waver) * 95 + 1.5 * at.p.y), level = std::sin((at.p.y + waver) * 110);
  const double facing = Step(0.55, 0.9, std::abs(at.n.z));
  const double width = 0.62 - 0.45 * Step(0.35, 0.95, at.h) + 0.25 * Noise(at.p * 11.0) + 0.4 * facing;
  const double stripe = Step(width - 0.18, width + 0.18, glm::mix(across, level, facing));
  return glm::mix(glm::mix(orange, cream, belly), black, stripe * (1 - 0.5 * belly));
}

dvec3 PlainColor(FourCoat coat, const Place& at) {
  switch (coat) {
    case FourCoat::Panther: return Panther(at);
    case FourCoat::Snow: return Snow(at);
    case FourCoat::Tiger: return Tiger(at);
    case FourCoat::Bear: break;
  }
  return Bear(at);
}

// With streaks that run along the body and down the limbs, so that a coat whose hairs are too thin to be seen is not
// flat.
dvec3 CoatColor(FourCoat coat, const Place& at) {
  const double along = Noise(at.p * dvec3(130, 130, 34)), down = Noise(at.p * dvec3(130, 30, 130));
  return PlainColor(coat, at) * (1 + 0.22 * glm::mix(along, down, Step(0.5, 0.3, at.h)));
}

}  // namespace

Image PaintCoat(const Model& model, uint32_t material, FourCoat coat) {
  const dvec3 plain = CoatColor(coat, Place{});
  return PaintSurface(model, Body(model), material, kSide, plain,
                      [&](const Place& at) { return CoatColor(coat, at); });
}

}  // namespace fur

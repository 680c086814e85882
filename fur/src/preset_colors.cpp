// The colours of preset four-coats: bear, panther, snow, tiger, by the place on the body.
#include <algorithm>
#include <array>
#include <cmath>

#include "preset_textures.h"

namespace fur {
namespace {

using glm::dvec2;
using glm::dvec3;

constexpr uint32_t kSide = 512;

double Step(double from, double to, double x) {
  const double t = std::clamp((x - from) / (to - from), 0.0, 1.0);
  return t * t * (3 - 2 * t);
}

double Hash(int x, int y, int z) {
  uint32_t h = uint32_t(x) * 0x9e3779b1u ^ uint32_t(y) * 0x85ebca77u ^ uint32_t(z) * 0xc2b2ae3du;
  h = (h ^ (h >> 15)) * 0x2c1b3c6du;
  h = (h ^ (h >> 12)) * 0x297a2d39u;
  return (h ^ (h >> 15)) * 0x1p-32;
}

// Value noise on a lattice, smooth, in -1..1; |p| below 2^30.
double Noise(const dvec3& p) {
  const dvec3 cell = glm::floor(p), f = p - cell, s = f * f * (3.0 - 2.0 * f);
  const int x = int(cell.x), y = int(cell.y), z = int(cell.z);
  const auto row = [&](int dy, int dz) { return glm::mix(Hash(x, y + dy, z + dz), Hash(x + 1, y + dy, z + dz), s.x); };
  return glm::mix(glm::mix(row(0, 0), row(1, 0), s.y), glm::mix(row(0, 1), row(1, 1), s.y), s.z) * 2 - 1;
}
double Turbulence(const dvec3& p) { return (Noise(p) + 0.5 * Noise(p * 2.1)) / 1.5; }

// A place on the body: p in diameters of the model from its middle, x across, y up, z along the body; h: 0 the lowest
// point, 1 the highest; n: unit normal, the same axes.
struct Place {
  dvec3 p, n;
  double h;
};

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

// The body's own axes: the longer horizontal one is along it.
class Body {
 public:
  explicit Body(const Model& model) : bounds_(ComputeBounds(model)) {
    const dvec3 size = bounds_.max - bounds_.min;
    alongX_ = size.x > size.z;
    scale_ = bounds_.Diameter() > 0 ? 1 / bounds_.Diameter() : 1;
    height_ = size.y > 0 ? size.y : 1;
  }
  Place At(const dvec3& position, const dvec3& normal) const {
    const double length = glm::length(normal);
    return {Turned((position - bounds_.Center()) * scale_), Turned(length > 0 ? normal / length : dvec3(0, 1, 0)),
            (position.y - bounds_.min.y) / height_};
  }

 private:
  dvec3 Turned(const dvec3& v) const { return alongX_ ? dvec3(-v.z, v.y, v.x) : v; }
  Bounds bounds_;
  bool alongX_ = false;
  double scale_ = 1, height_ = 1;
};

struct Corner {
  dvec2 uv;  // in texels
  Place place;
};

class Painter {
 public:
  explicit Painter(FourCoat coat) : coat_(coat), colors_(kSide * kSide), painted_(kSide * kSide, 0) {}

  // Every texel whose centre is inside, or a little outside, so that filtering finds no holes.
  void Paint(std::array<Corner, 3> t) {
    const dvec2 low = glm::floor(glm::min(glm::min(t[0].uv, t[1].uv), t[2].uv) / double(kSide)) * double(kSide);
    for (Corner& c : t) c.uv -= low;  // whole tiles: the texture wraps around
    const dvec2 from = glm::floor(glm::min(glm::min(t[0].uv, t[1].uv), t[2].uv)) - 1.0;
    // A triangle over many tiles covers the whole texture anyway.
    const dvec2 to = glm::min(glm::ceil(glm::max(glm::max(t[0].uv, t[1].uv), t[2].uv)) + 1.0, from + 2.0 * kSide);
    const dvec2 ab = t[1].uv - t[0].uv, ac = t[2].uv - t[0].uv;
    const double area = ab.x * ac.y - ab.y * ac.x;
    if (!(std::abs(area) > 1e-12)) return;
    for (double y = from.y; y <= to.y; ++y)
      for (double x = from.x; x <= to.x; ++x) {
        const dvec2 p = dvec2(x + 0.5, y + 0.5) - t[0].uv;
        const double b = (p.x * ac.y - p.y * ac.x) / area, c = (ab.x * p.y - ab.y * p.x) / area;
        constexpr double kSlack = 0.02;
        if (b < -kSlack || c < -kSlack || b + c > 1 + kSlack) continue;
        const double a = 1 - b - c;
        const Place &u = t[0].place, &v = t[1].place, &w = t[2].place;
        Set(int(x), int(y),
            CoatColor(coat_, {u.p * a + v.p * b + w.p * c, u.n * a + v.n * b + w.n * c, u.h * a + v.h * b + w.h * c}));
      }
  }

  // Grows the painted area outwards, so that mips and filtering do not mix with what was never painted.
  Image Finish() {
    for (int pass = 0; pass < 24; ++pass) Grow();
    const dvec3 plain = CoatColor(coat_, {dvec3(0), dvec3(1, 0, 0), 0.5});
    Image out{"coat", kSide, kSide, {}};
    for (size_t i = 0; i < colors_.size(); ++i) {
      const dvec3 c = glm::clamp(painted_[i] ? colors_[i] : plain, 0.0, 1.0) * 255.0;
      out.pixels.insert(out.pixels.end(),
                        {uint8_t(std::lround(c.r)), uint8_t(std::lround(c.g)), uint8_t(std::lround(c.b)), 255});
    }
    return out;
  }

 private:
  static size_t Index(int x, int y) { return size_t(y & int(kSide - 1)) * kSide + size_t(x & int(kSide - 1)); }
  void Set(int x, int y, const dvec3& color) {
    colors_[Index(x, y)] = color;
    painted_[Index(x, y)] = 1;
  }
  void Grow() {
    const std::vector<uint8_t> before = painted_;
    for (int y = 0; y < int(kSide); ++y)
      for (int x = 0; x < int(kSide); ++x) {
        if (before[Index(x, y)]) continue;
        for (const auto& [dx, dy] : {std::pair{1, 0}, {-1, 0}, {0, 1}, {0, -1}})
          if (before[Index(x + dx, y + dy)]) Set(x, y, colors_[Index(x + dx, y + dy)]);
      }
  }

  FourCoat coat_;
  std::vector<dvec3> colors_;
  std::vector<uint8_t> painted_;
};

}  // namespace

Image PaintCoat(const Model& model, uint32_t material, FourCoat coat) {
  const Body body(model);
  Painter painter(coat);
  for (const Part& part : model.parts) {
    const Primitive& primitive = model.primitives[part.primitive];
    if (primitive.material != material) continue;
    for (size_t i = 0; i + 2 < primitive.indices.size(); i += 3) {
      std::array<Corner, 3> corners;
      for (size_t k = 0; k < 3; ++k) {
        const Vertex& v = primitive.vertices[primitive.indices[i + k]];
        const dvec3 position(part.transform * glm::dvec4(glm::dvec3(v.position), 1));
        corners[k] = {dvec2(v.uv) * double(kSide), body.At(position, glm::dmat3(part.transform) * dvec3(v.normal))};
      }
      painter.Paint(corners);
    }
  }
  return painter.Finish();
}

}  // namespace fur

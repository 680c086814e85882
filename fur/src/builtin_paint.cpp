#include "builtin_paint.h"

#include <algorithm>
#include <cmath>

#include "builtin_shape.h"

namespace fur::builtin {
namespace {

using glm::dvec2;
using glm::dvec3;

double Step(double from, double to, double x) {
  const double t = std::clamp((x - from) / (to - from), 0.0, 1.0);
  return t * t * (3 - 2 * t);
}

double Hash(int x, int y, int z) {
  uint32_t h = static_cast<uint32_t>(x) * 0x8da6b343u ^ static_cast<uint32_t>(y) * 0xd8163841u ^
               static_cast<uint32_t>(z) * 0xcb1ab31fu;
  h = (h ^ (h >> 15)) * 0x2c1b3c6du;
  h = (h ^ (h >> 12)) * 0x297a2d39u;
  return static_cast<double>(h ^ (h >> 15)) * 0x1p-32;
}

// Value noise on a lattice, smooth, in -1..1.
double Noise(const dvec3& p) {
  const dvec3 cell = glm::floor(p), f = p - cell, s = f * f * (3.0 - 2.0 * f);
  const int x = static_cast<int>(cell.x), y = static_cast<int>(cell.y), z = static_cast<int>(cell.z);
  const auto row = [&](int dy, int dz) { return glm::mix(Hash(x, y + dy, z + dz), Hash(x + 1, y + dy, z + dz), s.x); };
  return glm::mix(glm::mix(row(0, 0), row(1, 0), s.y), glm::mix(row(0, 1), row(1, 1), s.y), s.z) * 2 - 1;
}
double Turbulence(const dvec3& p) { return (Noise(p) + 0.5 * Noise(p * 2.1) + 0.25 * Noise(p * 4.3)) / 1.75; }

// What of the body a point belongs to, each 0..1 and smooth.
struct Place {
  dvec3 p, n;
  double head, ear, leg, tail;
};

Place Locate(const dvec3& p, const dvec3& n) {
  const auto d = RegionDistances(p);
  const auto near = [&](Region r, double width) { return Step(width, 0, d[r]); };
  return {p,
          n,
          near(kHead, 0.08),
          near(kEar, 0.03) * Step(1.17, 1.23, p.y),
          std::max(near(kFrontLeg, 0.06), near(kHindLeg, 0.06)) * Step(0.50, 0.36, p.y),
          near(kTail, 0.05)};
}

double InsideEar(const Place& at) { return at.ear * Step(0.15, 0.6, at.n.z); }

// Tabby markings: bands across the back that thin out down the flanks.
double Stripes(const Place& at) {
  const double wobble = 0.05 * Turbulence(at.p * 6.0) + 0.10 * std::abs(at.p.x);
  const double wave = std::sin((at.p.z + wobble) * 46);
  const double width = 0.15 + 0.75 * Step(0.84, 0.55, at.p.y);  // narrower further down
  const double band = Step(width - 0.35, width + 0.35, wave);
  const double spine = Step(0.05, 0.012, std::abs(at.p.x + 0.01 * Noise(at.p * 9.0))) * Step(0.2, 0.8, at.n.y);
  return std::max(band * Step(0.50, 0.66, at.p.y), spine * 0.9) * (1 - at.head) * (1 - at.tail) * (1 - at.leg);
}

// Rings on the tail, stripes on the forehead and outside the legs.
double Markings(const Place& at) {
  const double t = TailParameter(at.p);
  const double rings = at.tail * Step(0.0, 0.6, std::sin(t * 44 + Noise(at.p * 8.0) * 0.8)) * Step(0.08, 0.2, t);
  const double brow = at.head * (1 - at.ear) * Step(1.12, 1.19, at.p.y) * Step(-0.1, 0.25, at.n.y + at.n.z * 0.4) *
                      Step(0.1, 0.7, std::cos(at.p.x * 62 + 0.6 * Noise(at.p * 7.0))) *
                      Step(0.20, 0.13, std::abs(at.p.x));
  const double x = std::abs(at.p.x);
  const double cheek = at.head * Step(0.16, 0.23, x) * Step(0.66, 0.56, at.p.z) *
                       Step(0.2, 0.8, std::sin(at.p.y * 58 + at.p.z * 20)) * Step(1.10, 1.02, at.p.y);
  const double bars = at.leg * Step(0.2, 0.9, std::sin(at.p.y * 52 + Noise(at.p * 7.0))) * Step(0.12, 0.2, at.p.y) *
                      Step(-0.1, 0.5, at.n.x * (at.p.x < 0 ? -1 : 1));
  return std::max({rings, brow * 0.85, cheek * 0.5, bars * 0.55});
}

// Cream: belly, chest, throat, chin, muzzle, the spots over the eyes, the tail's tip.
double Cream(const Place& at) {
  const double fuzz = 0.06 * Turbulence(at.p * 9.0), x = std::abs(at.p.x);
  const double belly =
      Step(0.0, -0.55, at.n.y + fuzz * 3) * Step(0.30, 0.40, at.p.y) * (1 - at.tail) * Step(1.02, 0.92, at.p.y);
  const double chest = Step(0.30, 0.62, at.n.z + fuzz - x * 1.3) * Step(0.20, 0.30, at.p.z) * Step(1.0, 0.88, at.p.y) *
                       Step(0.40, 0.5, at.p.y);
  const double muzzle = at.head * Step(0.70, 0.775, at.p.z - 0.35 * std::max(0.0, at.p.y - 1.0) + fuzz * 0.5) *
                        Step(1.035, 0.975, at.p.y - 0.0 + fuzz * 0.4);
  const double jaw = at.head * Step(0.96, 0.90, at.p.y + fuzz);
  const dvec3 eye = Eye().center;
  const double brow = Step(0.075, 0.03, glm::length(dvec3(x, at.p.y, at.p.z) - eye - dvec3(-0.03, 0.085, 0.02)));
  const double tip = at.tail * Step(0.80, 0.90, TailParameter(at.p) + fuzz);
  return std::max({belly, chest, muzzle, jaw, brow * 0.7, tip});
}

// A line from the nose down and two corners that smile.
double Mouth(const Place& at) {
  const double x = std::abs(at.p.x), front = Step(0.80, 0.84, at.p.z);
  const double lip = 0.922 + 4.5 * x * x;
  const double corners = Step(0.011, 0.005, std::abs(at.p.y - lip)) * Step(0.085, 0.065, x);
  const double groove = Step(0.008, 0.004, x) * Step(0.915, 0.925, at.p.y) * Step(0.98, 0.97, at.p.y);
  return std::max(corners * Step(0.76, 0.80, at.p.z), groove * front) * at.head;
}

dvec3 ColorAt(const Place& at) {
  const dvec3 orange{0.84, 0.49, 0.20}, rust{0.66, 0.33, 0.12}, dark{0.27, 0.14, 0.07}, cream{0.97, 0.91, 0.80};
  const double back = Step(0.1, 0.9, at.n.y) * Step(0.6, 0.8, at.p.y) * (1 - at.head * 0.6);
  dvec3 color = glm::mix(orange, rust, 0.65 * back + 0.18 * Turbulence(at.p * 5.0));
  color = glm::mix(color, dark, 0.80 * std::max(Stripes(at), Markings(at)));
  color = glm::mix(color, cream, Cream(at));
  const double socks = at.leg * Step(0.20, 0.13, at.p.y + 0.03 * Turbulence(at.p * 12.0));
  color = glm::mix(color, cream, socks);
  color = glm::mix(color, dark, at.ear * Step(1.36, 1.46, at.p.y) * 0.9);
  color = glm::mix(color, dvec3(0.93, 0.72, 0.62), InsideEar(at) * Step(1.46, 1.38, at.p.y) * 0.9);
  color = glm::mix(color, dark * 0.7, 0.85 * Mouth(at));
  const double x = std::abs(at.p.x);
  const dvec3 toEye = dvec3(x, at.p.y, at.p.z) - Eye().center;
  const double liner = Step(0.079, 0.070, glm::length(toEye));
  color = glm::mix(color, dark * 0.5, liner);
  return color * (1 + 0.07 * Turbulence(at.p * 22.0));
}

double LengthAt(const Place& at) {
  double length = 0.78;
  const double x = std::abs(at.p.x);
  const double ruff = Step(0.15, 0.7, at.n.z) * Step(0.22, 0.32, at.p.z) * Step(0.45, 0.58, at.p.y) * (1 - at.head);
  length = glm::mix(length, 1.0, ruff);
  length = glm::mix(length, 0.50, at.head);
  // Cheek tufts.
  length = glm::mix(length, 0.85, at.head * Step(0.17, 0.26, x) * Step(1.10, 1.0, at.p.y) * Step(0.72, 0.62, at.p.z));
  length = glm::mix(length, 0.18, at.head * Step(0.70, 0.80, at.p.z));
  length = glm::mix(length, 0.36, at.leg);
  length = glm::mix(length, 0.20, at.leg * Step(0.18, 0.09, at.p.y));
  length = glm::mix(length, 0.30, at.ear);
  length = glm::mix(length, 0.16, InsideEar(at));
  length = glm::mix(length, 1.0, at.tail * Step(0.05, 0.35, TailParameter(at.p)));
  length *= 0.9 + 0.15 * Turbulence(at.p * 8.0);
  length *= Step(0.004, 0.03, at.p.y);  // bald soles
  length *= 1 - 0.7 * Mouth(at);
  const double eye = glm::length(dvec3(x, at.p.y, at.p.z) - Eye().center);
  const double nose = glm::length((at.p - Nose().center) / Nose().radii);
  return std::clamp(length * Step(0.072, 0.13, eye) * Step(1.1, 2.2, nose), 0.0, 1.0);
}

// The comb direction in the texel's own tangent frame; about 45 degrees of lean where the hair has somewhere to go.
dvec3 TangentComb(const Place& at, const dvec3& tangent, double handedness) {
  const dvec3 d = glm::normalize(at.n + 0.75 * CombDirection(at.p, at.n));
  const dvec3 t = glm::normalize(tangent - at.n * glm::dot(at.n, tangent));
  return {glm::dot(d, t), handedness * glm::dot(d, glm::cross(at.n, t)), glm::dot(d, at.n)};
}

Image MakeImage(const char* name, uint32_t size) {
  return {name, size, size, std::vector<uint8_t>(size_t{size} * size * 4, 255)};
}

void Store(Image* image, size_t texel, const dvec3& rgb) {
  for (int c = 0; c < 3; ++c) {
    image->pixels[texel * 4 + c] = static_cast<uint8_t>(std::clamp(rgb[c], 0.0, 1.0) * 255 + 0.5);
  }
}

// Visits the texels whose centres lie in the triangle, with their barycentrics.
template <class F>
void ForTexels(const std::array<dvec2, 3>& p, int size, F visit) {
  const dvec2 low = glm::min(p[0], glm::min(p[1], p[2])), high = glm::max(p[0], glm::max(p[1], p[2]));
  const auto cross = [](dvec2 a, dvec2 b) { return a.x * b.y - a.y * b.x; };
  const double area = cross(p[1] - p[0], p[2] - p[0]);
  if (std::abs(area) < 1e-12) return;
  for (int y = std::max(0, static_cast<int>(low.y)); y <= std::min(size - 1, static_cast<int>(high.y)); ++y) {
    for (int x = std::max(0, static_cast<int>(low.x)); x <= std::min(size - 1, static_cast<int>(high.x)); ++x) {
      const dvec2 q{x + 0.5, y + 0.5};
      const dvec3 b{cross(p[1] - q, p[2] - q) / area, cross(p[2] - q, p[0] - q) / area,
                    cross(p[0] - q, p[1] - q) / area};
      if (b.x >= -1e-9 && b.y >= -1e-9 && b.z >= -1e-9) visit(static_cast<size_t>(y) * size + x, b);
    }
  }
}

// Spreads painted texels into the gutters, so that filtering at a chart's border meets its own colours.
void FillGutters(Image* image, std::vector<uint8_t> painted, int rings) {
  const int n = static_cast<int>(image->width);
  for (int ring = 0; ring < rings; ++ring) {
    const std::vector<uint8_t> before = painted;
    for (int i = 0; i < n * n; ++i) {
      if (before[i]) continue;
      for (const int step : {-1, 1, -n, n, -n - 1, -n + 1, n - 1, n + 1}) {
        const int from = i + step;
        if (from < 0 || from >= n * n || std::abs(from % n - i % n) > 1 || !before[from]) continue;
        std::copy_n(image->pixels.begin() + from * 4, 4, image->pixels.begin() + i * 4);
        painted[i] = 1;
        break;
      }
    }
  }
}

}  // namespace

SkinImages PaintSkin(const Atlas& atlas, uint32_t size) {
  SkinImages images{MakeImage("builtin_color", size), MakeImage("builtin_length", size),
                    MakeImage("builtin_direction", size)};
  std::vector<uint8_t> painted(size_t{size} * size, 0);
  for (size_t t = 0; t < atlas.indices.size(); t += 3) {
    const std::array<const Vertex*, 3> v = {&atlas.vertices[atlas.indices[t]], &atlas.vertices[atlas.indices[t + 1]],
                                            &atlas.vertices[atlas.indices[t + 2]]};
    const std::array<dvec2, 3> uv = {dvec2(v[0]->uv) * double(size), dvec2(v[1]->uv) * double(size),
                                     dvec2(v[2]->uv) * double(size)};
    ForTexels(uv, static_cast<int>(size), [&](size_t texel, const dvec3& b) {
      const auto blend = [&](auto get) { return get(*v[0]) * b.x + get(*v[1]) * b.y + get(*v[2]) * b.z; };
      const dvec3 n = glm::normalize(blend([](const Vertex& w) { return dvec3(w.normal); }));
      const Place at = Locate(blend([](const Vertex& w) { return dvec3(w.position); }), n);
      const dvec3 tangent = blend([](const Vertex& w) { return dvec3(w.tangent); });
      Store(&images.color, texel, ColorAt(at));
      Store(&images.length, texel, dvec3(LengthAt(at)));
      Store(&images.direction, texel, TangentComb(at, tangent, v[0]->tangent.w) * 0.5 + 0.5);
      painted[texel] = 1;
    });
  }
  for (Image* image : {&images.color, &images.length, &images.direction}) FillGutters(image, painted, 8);
  return images;
}

Image PaintEye(uint32_t size) {
  Image image = MakeImage("builtin_eye", size);
  for (uint32_t y = 0; y < size; ++y) {
    for (uint32_t x = 0; x < size; ++x) {
      const dvec2 q = (dvec2(x, y) + 0.5) / double(size) * 2.0 - 1.0;
      const double r = glm::length(q), around = std::atan2(q.y, q.x);
      const double fibre = 0.5 + 0.5 * Noise({std::cos(around) * 9, std::sin(around) * 9, r * 2});
      dvec3 color = glm::mix(dvec3(0.95, 0.66, 0.16), dvec3(0.62, 0.30, 0.05), Step(0.35, 0.85, r) * 0.7 + 0.3 * fibre);
      color = glm::mix(color, dvec3(0.03, 0.02, 0.02), Step(0.78, 0.88, r));                       // rim
      color = glm::mix(color, dvec3(0.01), Step(1.05, 0.90, glm::length(q / dvec2(0.50, 0.60))));  // pupil
      color = glm::mix(color, dvec3(1), Step(0.17, 0.11, glm::length(q - dvec2(-0.20, -0.24))));   // a painted glint
      Store(&image, size_t{y} * size + x, color);
    }
  }
  return image;
}

}  // namespace fur::builtin

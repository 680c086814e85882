// Primitive distances and smooth unions follow Quilez, "Distance functions" and "Smooth minimum"
// (iquilezles.org/articles/distfunctions, /smin).
#include "builtin_shape.h"

#include <algorithm>
#include <cmath>

namespace fur::builtin {
namespace {

using glm::dvec3;

double SmoothMin(double a, double b, double k) {
  const double h = std::max(k - std::abs(a - b), 0.0) / k;
  return std::min(a, b) - h * h * k / 4;
}
double SmoothMax(double a, double b, double k) { return -SmoothMin(-a, -b, k); }

double Ellipsoid(const dvec3& p, const dvec3& center, const dvec3& radii) {
  const dvec3 q = p - center;
  const double k0 = glm::length(q / radii), k1 = glm::length(q / (radii * radii));
  return k1 > 1e-9 ? k0 * (k0 - 1) / k1 : -std::min({radii.x, radii.y, radii.z});
}

// A sphere swept from a (radius ra) to b (radius rb).
double RoundCone(const dvec3& p, const dvec3& a, const dvec3& b, double ra, double rb) {
  const dvec3 ba = b - a, pa = p - a;
  const double l2 = glm::dot(ba, ba), rr = ra - rb, a2 = l2 - rr * rr, il2 = 1 / l2;
  const double y = glm::dot(pa, ba), z = y - l2;
  const dvec3 d = pa * l2 - ba * y;
  const double x2 = glm::dot(d, d), y2 = y * y * l2, z2 = z * z * l2;
  const double k = (rr > 0 ? 1 : rr < 0 ? -1 : 0) * rr * rr * x2;
  if ((z > 0 ? 1 : -1) * a2 * z2 > k) return std::sqrt(x2 + z2) * il2 - rb;
  if ((y > 0 ? 1 : -1) * a2 * y2 < k) return std::sqrt(x2 + y2) * il2 - ra;
  return (std::sqrt(x2 * a2 * il2) + y * rr) * il2 - ra;
}

double Torso(const dvec3& p) {
  double d = RoundCone(p, {0, 0.63, 0.22}, {0, 0.66, -0.36}, 0.225, 0.215);
  d = SmoothMin(d, Ellipsoid(p, {0, 0.63, 0.34}, {0.185, 0.23, 0.17}), 0.10);          // chest
  d = SmoothMin(d, RoundCone(p, {0, 0.74, 0.30}, {0, 0.96, 0.50}, 0.17, 0.15), 0.14);  // neck
  return d;
}

double Head(const dvec3& p) {
  double d = Ellipsoid(p, {0, 1.06, 0.58}, {0.275, 0.235, 0.245});
  d = SmoothMin(d, Ellipsoid(p, {0.15, 0.975, 0.60}, {0.15, 0.115, 0.145}), 0.08);  // cheek
  d = SmoothMin(d, RoundCone(p, {0, 0.985, 0.72}, {0, 0.955, 0.875}, 0.125, 0.062), 0.07);
  d = SmoothMin(d, Ellipsoid(p, {0.045, 0.945, 0.85}, {0.055, 0.045, 0.065}), 0.04);  // whisker pad
  d = SmoothMin(d, Ellipsoid(p, {0, 0.90, 0.80}, {0.055, 0.035, 0.075}), 0.04);       // chin
  // A shallow socket around the eye.
  return SmoothMax(d, 0.062 - glm::length(p - Eye().center - EyeAxis() * 0.045), 0.04);
}

// A flattened cone, hollowed from the front; turned a little outwards.
double Ear(const dvec3& p) {
  const dvec3 base{0.165, 1.20, 0.53};
  const dvec3 axis = glm::normalize(dvec3(0.30, 1, -0.10)), front = glm::normalize(dvec3(0.42, 0.0, 1));
  const dvec3 side = glm::normalize(glm::cross(axis, front)), facing = glm::cross(side, axis);
  const dvec3 q{glm::dot(p - base, side), glm::dot(p - base, axis), glm::dot(p - base, facing)};
  const dvec3 flat{q.x, q.y, q.z * 1.55};
  const double outer = RoundCone(flat, {0, 0, 0}, {0, 0.255, 0}, 0.130, 0.044) / 1.4;
  const double hollow =
      RoundCone(dvec3(q.x, q.y, (q.z - 0.092) * 1.25), {0, 0.05, 0}, {0, 0.19, 0}, 0.080, 0.024) / 1.2;
  return SmoothMax(outer, -hollow, 0.03);
}

double FrontLeg(const dvec3& p) {
  double d = RoundCone(p, {0.125, 0.56, 0.27}, {0.135, 0.30, 0.27}, 0.115, 0.075);
  d = SmoothMin(d, RoundCone(p, {0.135, 0.30, 0.27}, {0.135, 0.08, 0.29}, 0.075, 0.062), 0.05);
  return SmoothMin(d, Ellipsoid(p, {0.138, 0.058, 0.325}, {0.078, 0.058, 0.105}), 0.04);
}

double HindLeg(const dvec3& p) {
  double d = RoundCone(p, {0.115, 0.57, -0.36}, {0.15, 0.36, -0.31}, 0.165, 0.10);
  d = SmoothMin(d, RoundCone(p, {0.15, 0.36, -0.32}, {0.15, 0.21, -0.455}, 0.092, 0.062), 0.06);
  d = SmoothMin(d, RoundCone(p, {0.15, 0.21, -0.455}, {0.15, 0.07, -0.435}, 0.062, 0.058), 0.05);
  return SmoothMin(d, Ellipsoid(p, {0.152, 0.058, -0.385}, {0.076, 0.058, 0.108}), 0.04);
}

struct Knot {
  dvec3 p;
  double radius;
};
constexpr std::array<Knot, 7> kSpine = {{{{0, 0.73, -0.50}, 0.075},
                                         {{0, 0.69, -0.68}, 0.078},
                                         {{0, 0.69, -0.84}, 0.092},
                                         {{0, 0.76, -0.98}, 0.106},
                                         {{0, 0.88, -1.07}, 0.110},
                                         {{0, 1.02, -1.11}, 0.088},
                                         {{0, 1.17, -1.10}, 0.030}}};

double Tail(const dvec3& p) {
  double d = 1e9;
  for (size_t i = 0; i + 1 < kSpine.size(); ++i) {
    d = SmoothMin(d, RoundCone(p, kSpine[i].p, kSpine[i + 1].p, kSpine[i].radius, kSpine[i + 1].radius), 0.03);
  }
  return d;
}

dvec3 Folded(const dvec3& p) { return {std::abs(p.x), p.y, p.z}; }

}  // namespace

std::array<double, kRegionCount> RegionDistances(const dvec3& p) {
  const dvec3 q = Folded(p);
  return {Torso(q), Head(q), Ear(q), FrontLeg(q), HindLeg(q), Tail(q)};
}

double Distance(const dvec3& p) {
  const auto r = RegionDistances(p);
  double d = SmoothMin(r[kTorso], r[kHead], 0.10);
  d = SmoothMin(d, r[kFrontLeg], 0.09);
  d = SmoothMin(d, r[kHindLeg], 0.10);
  d = SmoothMin(d, r[kTail], 0.08);
  d = SmoothMin(d, r[kEar], 0.05);
  return SmoothMax(d, 0.004 - p.y, 0.03);  // flat soles
}

// Four samples at a tetrahedron's corners (Quilez, "Normals for an SDF").
dvec3 Normal(const dvec3& p) {
  constexpr double kStep = 1e-4;
  dvec3 sum{0};
  for (const dvec3 k : {dvec3(1, -1, -1), dvec3(-1, -1, 1), dvec3(-1, 1, -1), dvec3(1, 1, 1)}) {
    sum += k * Distance(p + k * kStep);
  }
  const double length = glm::length(sum);
  return length > 0 ? sum / length : dvec3(0, 1, 0);
}

dvec3 Project(dvec3 p, int steps) {
  for (int i = 0; i < steps; ++i) p -= Normal(p) * Distance(p);
  return p;
}

Ball Eye() { return {{0.115, 1.050, 0.748}, {0.064, 0.064, 0.064}}; }
dvec3 EyeAxis() { return glm::normalize(dvec3(0.26, 0.05, 1)); }
Ball Nose() { return {{0, 0.985, 0.925}, {0.042, 0.030, 0.030}}; }

double TailParameter(const dvec3& p) {
  double best = 1e9, at = 0;
  const double segments = static_cast<double>(kSpine.size() - 1);
  for (size_t i = 0; i + 1 < kSpine.size(); ++i) {
    const dvec3 ab = kSpine[i + 1].p - kSpine[i].p;
    const double t = std::clamp(glm::dot(p - kSpine[i].p, ab) / glm::dot(ab, ab), 0.0, 1.0);
    const double d = glm::length(p - kSpine[i].p - ab * t);
    if (d < best) best = d, at = (static_cast<double>(i) + t) / segments;
  }
  return at;
}

Box SkinBox() { return {{-0.42, -0.03, -1.27}, {0.42, 1.56, 1.00}}; }

}  // namespace fur::builtin

#include "prism.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace fur::reference {
namespace {

glm::dvec3 ToRay(const Ray& ray, const glm::dvec3& v) {
  return {glm::dot(ray.right, v), glm::dot(ray.up, v), glm::dot(ray.direction, v)};
}

constexpr int kMostHalvings = 52;
constexpr int kMostSplits = 24;  // of [0, 1] in search of two roots
// Twice a shell's area as the ray sees it, relative to the square of its extent, that is nothing but rounding.
constexpr double kNoArea = 1e-12;

}  // namespace

void Ray::SetDirection(const glm::dvec3& unit) {
  direction = unit;
  const glm::dvec3 size = glm::abs(unit);
  const glm::dvec3 side = size.x < size.y && size.x < size.z ? glm::dvec3(1, 0, 0)
                          : size.y < size.z                  ? glm::dvec3(0, 1, 0)
                                                             : glm::dvec3(0, 0, 1);
  right = glm::normalize(glm::cross(side, unit));
  up = glm::cross(unit, right);
}

glm::dvec3 Prism::At(uint32_t corner, double h) const {
  return p[corner] + a[corner] * h + c[corner] * (bend == 1 ? h : std::pow(h, bend));
}

PrismView::PrismView(const Prism& prism, const Ray& ray) : bend_(prism.bend), combed_(prism.bend != 1) {
  for (size_t i = 0; i < 3; ++i) {
    q_[i] = ToRay(ray, prism.p[i] - ray.origin);
    a_[i] = ToRay(ray, combed_ ? prism.a[i] : prism.a[i] + prism.c[i]);
    c_[i] = combed_ ? ToRay(ray, prism.c[i]) : glm::dvec3(0);
  }
  double extent = 0;
  for (size_t i = 0; i < 3; ++i)
    for (const glm::dvec3& side : {q_[i] - q_[(i + 1) % 3], a_[i], c_[i]})
      extent = std::max(extent, glm::dot(side, side));
  noArea_ = kNoArea * extent;
  for (size_t i = 0; i < 3; ++i) edges_[i] = Across((i + 1) % 3, (i + 2) % 3, 0, 1);
}

void PrismView::FindNormals() {
  for (size_t i = 0; i < 3; ++i)
    for (int axis = 0; axis < 2; ++axis) {
      const Edge e = Across(i, (i + 1) % 3, (axis + 1) % 3, (axis + 2) % 3);
      for (size_t k = 0; k < e.size(); ++k) normal_[size_t(axis)][k] += e[k];
    }
}

// x_i y_j - x_j y_i of the corners i and j in these two axes. Antisymmetric to the last bit, so that neighbours agree on
// their common wall.
PrismView::Edge PrismView::Across(size_t i, size_t j, int x, int y) const {
  const auto cross = [&](const glm::dvec3& a, const glm::dvec3& b) { return a[x] * b[y] - b[x] * a[y]; };
  if (!combed_)
    return {cross(q_[i], q_[j]), cross(q_[i], a_[j]) + cross(a_[i], q_[j]), 0, cross(a_[i], a_[j]), 0, 0};
  return {cross(q_[i], q_[j]), cross(q_[i], a_[j]) + cross(a_[i], q_[j]), cross(q_[i], c_[j]) + cross(c_[i], q_[j]),
          cross(a_[i], a_[j]), cross(a_[i], c_[j]) + cross(c_[i], a_[j]), cross(c_[i], c_[j])};
}

PrismView::Point PrismView::At(double h) const {
  const double g = Power(h);
  Point point;
  const std::array<double, 3> f{Value(edges_[0], h, g), Value(edges_[1], h, g), Value(edges_[2], h, g)};
  const double d = f[0] + f[1] + f[2];
  if (!(std::abs(d) > noArea_)) return point;
  const double scale = 1 / d;
  for (size_t i = 0; i < 3; ++i) {
    point.b[int(i)] = f[i] * scale;
    point.t += point.b[int(i)] * (q_[i].z + a_[i].z * h + (combed_ ? c_[i].z * g : 0));
  }
  // d is the third component of the shell's normal.
  const double x = Value(normal_[0], h, g), y = Value(normal_[1], h, g);
  point.secant = std::sqrt(x * x + y * y + d * d) * std::abs(scale);
  point.valid = std::isfinite(point.t) && std::isfinite(point.secant);
  return point;
}

double PrismView::Slope(double h) const {
  const double g = Power(h);
  // dg/dh, with 0 at the root for bent fur.
  const double dg = combed_ ? (h > 0 ? bend_ * g / h : 0) : 1;
  std::array<double, 3> f, df;
  for (size_t i = 0; i < 3; ++i) {
    const Edge& e = edges_[i];
    f[i] = Value(e, h, g);
    df[i] = e[1] + 2 * h * e[3];
    if (combed_) df[i] += g * e[4] + dg * (e[2] + h * e[4] + 2 * g * e[5]);
  }
  const double d = f[0] + f[1] + f[2], dd = df[0] + df[1] + df[2];
  if (!(std::abs(d) > noArea_)) return 0;
  double slope = 0;
  for (size_t i = 0; i < 3; ++i) {
    const double b = f[i] / d, db = (df[i] - b * dd) / d;
    const double z = q_[i].z + a_[i].z * h + (combed_ ? c_[i].z * g : 0), dz = a_[i].z + (combed_ ? c_[i].z * dg : 0);
    slope += db * z + b * dz;
  }
  return slope;
}

// The prism's picture along the ray must hold the ray. Bent fur leaves the hull of its two ends.
bool PrismView::MayMeet() const {
  glm::dvec2 low(1e300), high(-1e300);
  for (size_t i = 0; i < 3; ++i) {
    const glm::dvec2 root(q_[i]), tip = root + glm::dvec2(a_[i]);
    low = glm::min(low, glm::min(root, tip));
    high = glm::max(high, glm::max(root, tip));
    if (!combed_) continue;
    // a h + c g with 0 <= g <= 1: the corners of that box.
    const glm::dvec2 bent(c_[i]);
    low = glm::min(low, glm::min(root + bent, tip + bent));
    high = glm::max(high, glm::max(root + bent, tip + bent));
  }
  return low.x <= 0 && low.y <= 0 && high.x >= 0 && high.y >= 0;
}

// All roots of F in (0, 1) for bent fur: halves until interval arithmetic shows none or F to be monotone.
void PrismView::Isolate(const Edge& e, double h0, double h1, int depth, Cuts* roots) const {
  const double g0 = Power(h0), g1 = Power(h1), m = (h0 + h1) / 2, r = (h1 - h0) / 2;
  const double s0 = h0 > 0 ? bend_ * g0 / h0 : 0, s1 = bend_ * g1 / h1;
  // |dF/dh| and F's range from the ranges of h, g and dg/dh: centre and radius of each.
  const double gm = (g0 + g1) / 2, gr = std::abs(g1 - g0) / 2;
  const double sm = (s0 + s1) / 2, sr = std::abs(s1 - s0) / 2;
  const double inner = e[2] + m * e[4] + 2 * gm * e[5], innerR = r * std::abs(e[4]) + 2 * gr * std::abs(e[5]);
  const double slope = e[1] + 2 * m * e[3] + gm * e[4] + sm * inner;
  const double slopeR = 2 * r * std::abs(e[3]) + gr * std::abs(e[4]) + sr * std::abs(inner) + (std::abs(sm) + sr) * innerR;
  const double f0 = Value(e, h0, g0), f1 = Value(e, h1, g1);
  const bool monotone = std::abs(slope) > slopeR;
  const double most = (std::abs(slope) + slopeR) * (h1 - h0);
  if (std::abs(f0) > most) return;
  if (monotone || depth == kMostSplits) {
    if ((f0 < 0) == (f1 < 0)) return;
    double low = h0, high = h1;
    for (int i = 0; i < 2 * kMostHalvings && high - low > 1e-16; ++i) {
      const double middle = (low + high) / 2;
      if (middle <= low || middle >= high) break;
      ((Value(e, middle, Power(middle)) < 0) == (f0 < 0) ? low : high) = middle;
    }
    roots->Add((low + high) / 2);
    return;
  }
  Isolate(e, h0, m, depth + 1, roots);
  Isolate(e, m, h1, depth + 1, roots);
}

void PrismView::AddRoots(const Edge& e, Cuts* roots) const {
  if (combed_) {
    // A wall that holds the ray, or one without an area, is noise all the way up.
    const bool noise = std::all_of(e.begin(), e.end(), [&](double x) { return std::abs(x) <= noArea_; });
    if (!noise) Isolate(e, 0, 1, 0, roots);
    return;
  }
  const double a = e[3], b = e[1], c = e[0], discriminant = b * b - 4 * a * c;
  if (!(discriminant >= 0)) return;
  // Without cancellation: Numerical Recipes, section 5.6.
  const double q = -0.5 * (b + std::copysign(std::sqrt(discriminant), b));
  for (const double root : {q / a, c / q})
    if (root > 0 && root < 1) roots->Add(root);  // not for NaN
}

// A ray exactly in the wall between two prisms belongs to one of them: as if it were a little to the right, and less up
// (Edelsbrunner and Muecke, Simulation of Simplicity, 1990).
double PrismView::Side(size_t i, double h, double g) const {
  const double f = Value(edges_[i], h, g);
  if (f != 0) return f;
  const size_t j = (i + 1) % 3, k = (i + 2) % 3;
  const glm::dvec3 along = (q_[k] - q_[j]) + (a_[k] - a_[j]) * h + (c_[k] - c_[j]) * g;
  return along.y != 0 ? -along.y : along.x;
}

bool PrismView::Inside(double h) const {
  const double g = Power(h);
  const double f0 = Side(0, h, g), f1 = Side(1, h, g), f2 = Side(2, h, g);
  return (f0 > 0 && f1 > 0 && f2 > 0) || (f0 < 0 && f1 < 0 && f2 < 0);
}

// Where the fur folds over, t turns around within the prism: split there.
void PrismView::AddMonotone(double h0, double h1, std::vector<Interval>* out) const {
  constexpr int kProbes = 4;
  const double inset = (h1 - h0) * 1e-9;
  double from = h0, previous = h0 + inset;
  bool rising = Slope(previous) > 0;
  for (int i = 1; i <= kProbes; ++i) {
    const double probe = i == kProbes ? h1 - inset : h0 + (h1 - h0) * i / kProbes;
    const bool rises = Slope(probe) > 0;
    if (rises != rising) {
      double low = previous, high = probe;
      for (int k = 0; k < kMostHalvings; ++k) {
        const double middle = (low + high) / 2;
        ((Slope(middle) > 0) == rising ? low : high) = middle;
      }
      out->push_back({from, low});
      from = high;
      rising = rises;
    }
    previous = probe;
  }
  out->push_back({from, h1});
}

void PrismView::Intervals(std::vector<Interval>* out) const {
  if (!MayMeet()) return;
  Cuts cuts;
  cuts.Add(0);
  for (const Edge& e : edges_) AddRoots(e, &cuts);
  cuts.Add(1);
  std::sort(cuts.h.begin(), cuts.h.begin() + cuts.count);
  for (size_t i = 0; i + 1 < cuts.count; ++i)
    if (cuts.h[i + 1] > cuts.h[i] && Inside((cuts.h[i] + cuts.h[i + 1]) / 2)) AddMonotone(cuts.h[i], cuts.h[i + 1], out);
}

// Newton's steps, halving instead wherever they leave the bracket.
double PrismView::Solve(double t, double h0, double h1) const {
  double low = std::min(h0, h1), high = std::max(h0, h1);
  const bool rising = At(high).t > At(low).t;
  double h = (low + high) / 2;
  for (int i = 0; i < 2 * kMostHalvings; ++i) {
    const Point point = At(h);
    ((point.t < t) == rising ? low : high) = h;
    double next = h - (point.t - t) / Slope(h);
    if (!(next > low && next < high)) next = (low + high) / 2;
    if (std::abs(next - h) <= 1e-15 || next <= low || next >= high) return next;
    h = next;
  }
  return h;
}

}  // namespace fur::reference

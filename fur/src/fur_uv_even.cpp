#include "fur_uv_even.h"

#include <algorithm>
#include <cmath>
#include <deque>

namespace fur::furuv {
namespace {

using glm::dmat2;
using glm::dvec2;

// Chosen on the test models: at 0 (the symmetric Dirichlet energy alone) the ratio p95 / p5 of the scale is 1.42 on the
// cat and 1.56 on Spot, at 8 it is 1.2 on both, while the ratio of the singular values (its p95) grows from 2.3 to 2.6.
constexpr double kAreaWeight = 8;
constexpr int kMostRounds = 100;
constexpr double kEnough = 1e-4;  // of what an isometry would save

double Dot(const Columns& a, const Columns& b) { return (a.array() * b.array()).sum(); }

// The smallest t > 0 with a + b t + c t^2 = 0, for a > 0; infinite where there is none.
double FirstRoot(double a, double b, double c) {
  const double d = b * b - 4 * a * c;
  if (!(d >= 0)) return HUGE_VAL;
  // Written so that nothing cancels where c is near 0.
  const double q = -b + (b < 0 ? std::sqrt(d) : -std::sqrt(d));
  const double first = q > 0 ? 2 * a / q : HUGE_VAL;
  const double second = c != 0 && q / (2 * c) > 0 ? q / (2 * c) : HUGE_VAL;
  return std::min(first, second);
}

// L-BFGS (Nocedal and Wright 2006, algorithm 7.4) with the Laplacian for the first guess of the Hessian, as in
// Kovalsky, Galun, Lipman 2016, "Accelerated quadratic proxy for geometric optimization"; steps end before the first
// triangle that would turn over (Smith and Schaefer 2015, section 4.2).
class Descent {
 public:
  Descent(const Chart& chart, const std::vector<Rest>& rest, const HeldLaplacian& laplacian, std::vector<dvec2>* uv)
      : chart_(chart), laplacian_(laplacian), uv_(*uv) {
    for (size_t t = 0; t < rest.size(); ++t) {
      if (!rest[t].solid) continue;
      const dvec2 x1 = rest[t].at[1], x2 = rest[t].at[2];
      solid_.push_back({chart.triangles[t], glm::inverse(dmat2(x1, x2)), x1.x * x2.y / 2});
    }
  }

  void Run() {
    std::erase_if(solid_, [&](const Solid& s) { return !(glm::determinant(JacobianOf(s, uv_)) > 0); });
    Descend(kMostRounds);
  }

  // True when nothing is turned over any more.
  bool Unfold() {
    constexpr int kOuterRounds = 20, kInnerRounds = 20;
    for (int round = 0; round < kOuterRounds; ++round) {
      const double least = LeastDeterminant();
      if (least > 0) break;
      soft_ = std::max(0.2 * -least, 1e-3);
      Descend(kInnerRounds);
    }
    soft_ = 0;
    return LeastDeterminant() > 0;
  }

 private:
  struct Solid {
    Triangle v;
    dmat2 fromRest;  // inverse of the rest edges
    double area;
  };
  struct Pair {
    Columns step, change;
    double product;
  };

  void Descend(int rounds) {
    pairs_.clear();
    Columns gradient;
    double energy = Evaluate(uv_, &gradient);
    for (int round = 0; round < rounds && std::isfinite(energy); ++round) {
      const Columns step = Direction(gradient);
      const double slope = Dot(step, gradient);
      if (!(slope < 0)) break;
      std::vector<dvec2> next;
      Columns newGradient;
      const auto [length, lower] = Search(step, slope, energy, &next, &newGradient);
      if (!(length > 0)) {
        if (pairs_.empty()) break;
        pairs_.clear();  // once more, without what may have misled
        continue;
      }
      Remember(step * length, newGradient - gradient);
      uv_ = std::move(next);
      gradient = std::move(newGradient);
      const bool enough = energy - lower < kEnough * (energy - Least());
      energy = lower;
      if (enough) break;
    }
  }

  static dmat2 JacobianOf(const Solid& s, const std::vector<dvec2>& uv) {
    return dmat2(uv[s.v[1]] - uv[s.v[0]], uv[s.v[2]] - uv[s.v[0]]) * s.fromRest;
  }

  double LeastDeterminant() const {
    double least = HUGE_VAL;
    for (const Solid& s : solid_) least = std::min(least, glm::determinant(JacobianOf(s, uv_)));
    return least;
  }

  // What an isometry has.
  double Least() const {
    double area = 0;
    for (const Solid& s : solid_) area += s.area;
    return area * (4 + 2 * kAreaWeight);
  }

  // Infinite where a triangle is turned over.
  double Evaluate(const std::vector<dvec2>& uv, Columns* gradient) const {
    *gradient = Columns::Zero(laplacian_.Rows(), 2);
    double energy = 0;
    for (const Solid& s : solid_) {
      const dmat2 j = JacobianOf(s, uv);
      const double det = glm::determinant(j);
      if (!(det > 0) && soft_ == 0) return HUGE_VAL;
      const double root = std::sqrt(det * det + soft_ * soft_);
      const double positive = soft_ == 0 ? det : det > 0 ? (det + root) / 2 : soft_ * soft_ / (2 * (root - det));
      const double slope = soft_ == 0 ? 1 : positive / root;
      const double square = glm::dot(j[0], j[0]) + glm::dot(j[1], j[1]);
      const double inverse = 1 / positive, inverse2 = inverse * inverse;
      energy += s.area * (square * (1 + inverse2) + kAreaWeight * (positive + inverse));
      const dmat2 cofactor(j[1].y, -j[1].x, -j[0].y, j[0].x);  // d det / dJ
      const double byDet = slope * (kAreaWeight * (1 - inverse2) - 2 * square * inverse2 * inverse);
      const dmat2 byJ = s.area * ((2 + 2 * inverse2) * j + byDet * cofactor);
      const dmat2 byEdges = byJ * glm::transpose(s.fromRest);
      Add(s.v[1], byEdges[0], gradient);
      Add(s.v[2], byEdges[1], gradient);
      Add(s.v[0], -byEdges[0] - byEdges[1], gradient);
    }
    return energy;
  }

  void Add(uint32_t vertex, const dvec2& value, Columns* gradient) const {
    if (laplacian_.RowOf(vertex) != kNone) AddTo(gradient, laplacian_.RowOf(vertex), value);
  }

  Columns Direction(const Columns& gradient) const {
    Columns q = gradient;
    std::vector<double> alpha(pairs_.size());
    for (size_t i = pairs_.size(); i-- > 0;) {
      alpha[i] = Dot(pairs_[i].step, q) / pairs_[i].product;
      q -= alpha[i] * pairs_[i].change;
    }
    q = laplacian_.Solve(q);
    if (!pairs_.empty()) q *= scale_;
    for (size_t i = 0; i < pairs_.size(); ++i)
      q += (alpha[i] - Dot(pairs_[i].change, q) / pairs_[i].product) * pairs_[i].step;
    return -q;
  }

  void Remember(Columns step, Columns change) {
    constexpr size_t kPairs = 6;
    const double product = Dot(step, change), curvature = Dot(change, laplacian_.Solve(change));
    if (!(product > 0) || !(curvature > 0)) return;
    scale_ = product / curvature;
    pairs_.push_back({std::move(step), std::move(change), product});
    if (pairs_.size() > kPairs) pairs_.pop_front();
  }

  dvec2 StepOf(const Columns& step, uint32_t vertex) const {
    const uint32_t row = laplacian_.RowOf(vertex);
    return row == kNone ? dvec2(0) : dvec2(step(row, 0), step(row, 1));
  }

  double LongestStep(const Columns& step) const {
    double longest = HUGE_VAL;
    for (const Solid& s : solid_) {
      const dvec2 e = uv_[s.v[1]] - uv_[s.v[0]], f = uv_[s.v[2]] - uv_[s.v[0]], origin = StepOf(step, s.v[0]);
      const dvec2 de = StepOf(step, s.v[1]) - origin, df = StepOf(step, s.v[2]) - origin;
      longest = std::min(longest, FirstRoot(Cross(e, f), Cross(e, df) + Cross(de, f), Cross(de, df)));
    }
    return longest;
  }

  // Backtracking (algorithm 3.1). Length 0 where no step helps.
  std::pair<double, double> Search(const Columns& step, double slope, double energy, std::vector<dvec2>* next,
                                   Columns* gradient) const {
    constexpr double kSafe = 0.8, kArmijo = 1e-4;
    double length = std::min(1.0, soft_ > 0 ? 1.0 : kSafe * LongestStep(step));
    for (int attempt = 0; attempt < 20; ++attempt, length /= 2) {
      *next = uv_;
      for (uint32_t v = 0; v < uv_.size(); ++v) (*next)[v] += length * StepOf(step, v);
      const double now = Evaluate(*next, gradient);
      if (now <= energy + kArmijo * length * slope) return {length, now};
    }
    return {0, energy};
  }

  const Chart& chart_;
  const HeldLaplacian& laplacian_;
  std::vector<dvec2>& uv_;
  std::vector<Solid> solid_;
  std::deque<Pair> pairs_;
  double scale_ = 1;
  double soft_ = 0;  // > 0: folds are allowed, at a price
};

}  // namespace

bool Unfold(const Chart& chart, const std::vector<Rest>& rest, const HeldLaplacian& laplacian, std::vector<dvec2>* uv) {
  return Descent(chart, rest, laplacian, uv).Unfold();
}

void EvenOut(const Chart& chart, const std::vector<Rest>& rest, const HeldLaplacian& laplacian,
             std::vector<dvec2>* uv) {
  Descent(chart, rest, laplacian, uv).Run();
}

}  // namespace fur::furuv

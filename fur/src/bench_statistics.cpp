#include <algorithm>
#include <cmath>

#include "fur/bench.h"

namespace fur {
namespace {

double Quantile(const std::vector<double>& sorted, double share) {
  if (sorted.empty()) return 0;
  const double at = double(sorted.size() - 1) * share;
  const auto below = size_t(at);
  const size_t above = std::min(below + 1, sorted.size() - 1);
  return sorted[below] + (sorted[above] - sorted[below]) * (at - double(below));
}

// P(Binomial(n, 1/2) < k), by logarithms of the coefficients.
double BinomialBelow(size_t n, size_t k) {
  double sum = 0;
  for (size_t i = 0; i < k; ++i)
    sum += std::exp(std::lgamma(double(n) + 1) - std::lgamma(double(i) + 1) - std::lgamma(double(n - i) + 1) -
                    double(n) * std::log(2.0));
  return sum;
}

}  // namespace

double Median(std::vector<double> values) { return Summarise(std::move(values)).median; }

BenchSummary Summarise(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return {Quantile(values, 0.5), Quantile(values, 0.25), Quantile(values, 0.75)};
}

BenchRatio PairedRatio(std::span<const double> a, std::span<const double> b, double wanted) {
  std::vector<double> ratios;
  for (size_t i = 0; i < std::min(a.size(), b.size()); ++i) ratios.push_back(a[i] / b[i]);
  if (ratios.empty()) return {};
  std::sort(ratios.begin(), ratios.end());
  const size_t n = ratios.size();
  size_t k = 1;
  while (k + 1 <= (n + 1) / 2 && 1 - 2 * BinomialBelow(n, k + 1) >= wanted) ++k;
  return {Quantile(ratios, 0.5), ratios[k - 1], ratios[n - k], std::max(0.0, 1 - 2 * BinomialBelow(n, k))};
}

std::vector<bool> ParetoFront(std::span<const BenchPoint> points) {
  std::vector<bool> front(points.size(), true);
  for (size_t i = 0; i < points.size(); ++i)
    for (const BenchPoint& other : points) {
      const bool asGood = other.x <= points[i].x && other.y <= points[i].y;
      if (asGood && (other.x < points[i].x || other.y < points[i].y)) front[i] = false;
    }
  return front;
}

}  // namespace fur

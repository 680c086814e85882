// Wang, Bovik, Sheikh, Simoncelli, "Image Quality Assessment: From Error Visibility to Structural Similarity", IEEE
// Trans. Image Processing 13(4), 2004, section III.
#include <algorithm>
#include <cmath>

#include "compare_internal.h"

namespace fur {
namespace {

constexpr int kRadius = 5;
constexpr double kSigma = 1.5;
constexpr float kC1 = 0.01f * 0.01f, kC2 = 0.03f * 0.03f;  // (K L)^2, L = 1

Kernel Window() {
  std::vector<double> weights;
  double sum = 0;
  for (int i = -kRadius; i <= kRadius; ++i) {
    weights.push_back(std::exp(-i * i / (2 * kSigma * kSigma)));
    sum += weights.back();
  }
  Kernel kernel;
  for (const double w : weights) kernel.push_back(float(w / sum));
  return kernel;
}

// The windowed mean of a[i] b[i].
Plane MeanProduct(const Plane& a, const Plane& b, const Kernel& window) {
  Plane product = a;
  for (size_t i = 0; i < product.values.size(); ++i) product.values[i] *= b.values[i];
  return FilterColumns(FilterRows(product, window), window);
}

}  // namespace

Plane SsimMap(const Plane& a, const Plane& b) {
  const Kernel window = Window();
  // Variances do not change with the mean, but their floats do: both are moved by the same amount.
  double middle = 0;
  for (size_t i = 0; i < a.values.size(); ++i) middle += (double(a.values[i]) + double(b.values[i])) / 2;
  const float shift = float(middle / double(std::max<size_t>(a.values.size(), 1)));
  Plane x = a, y = b;
  for (float& v : x.values) v -= shift;
  for (float& v : y.values) v -= shift;
  const Plane mx = FilterColumns(FilterRows(x, window), window), my = FilterColumns(FilterRows(y, window), window);
  const Plane xx = MeanProduct(x, x, window), yy = MeanProduct(y, y, window), xy = MeanProduct(x, y, window);
  Plane out{a.width, a.height, std::vector<float>(a.values.size())};
  for (size_t i = 0; i < out.values.size(); ++i) {
    const float ux = mx.values[i], uy = my.values[i], muX = ux + shift, muY = uy + shift;
    const float vx = std::max(xx.values[i] - ux * ux, 0.0f), vy = std::max(yy.values[i] - uy * uy, 0.0f);
    const float covariance = xy.values[i] - ux * uy;
    out.values[i] = (2 * muX * muY + kC1) * (2 * covariance + kC2) / ((muX * muX + muY * muY + kC1) * (vx + vy + kC2));
  }
  return out;
}

double SsimMean(const Plane& map) {
  const uint32_t border = map.width > 2 * kRadius && map.height > 2 * kRadius ? kRadius : 0;
  double sum = 0;
  for (uint32_t y = border; y < map.height - border; ++y)
    for (uint32_t x = border; x < map.width - border; ++x) sum += double(map.values[size_t(y) * map.width + x]);
  return sum / (double(map.width - 2 * border) * double(map.height - 2 * border));
}

}  // namespace fur

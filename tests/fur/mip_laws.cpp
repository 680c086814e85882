#include "mip_laws.h"

#include <algorithm>
#include <cmath>

namespace fur::test {
namespace {

constexpr double kMost = 0.999;

// Calls f(x, y) for the texels of mip 0 below one of `level`.
template <class F>
void ForBox(uint32_t x, uint32_t y, uint32_t level, F f) {
  for (uint32_t v = y << level; v < (y + 1) << level; ++v)
    for (uint32_t u = x << level; u < (x + 1) << level; ++u) f(u, v);
}

template <class F>
Stack ForTexels(const Stack& s, uint32_t level, F coverage) {
  Stack out(s.width >> level, s.height >> level, s.layers);
  for (uint32_t j = 0; j < s.layers; ++j)
    for (uint32_t y = 0; y < out.height; ++y)
      for (uint32_t x = 0; x < out.width; ++x) out.coverage[out.Index(x, y, j)] = coverage(x, y, j);
  return out;
}

template <class F>
double BoxMean(uint32_t x, uint32_t y, uint32_t level, F f) {
  double sum = 0;
  ForBox(x, y, level, [&](uint32_t u, uint32_t v) { sum += f(u, v); });
  return sum / double(1u << (2 * level));
}

Stack Mean(const Stack& s, uint32_t level) {
  return ForTexels(s, level, [&](uint32_t x, uint32_t y, uint32_t j) {
    return BoxMean(x, y, level, [&](uint32_t u, uint32_t v) { return s.coverage[s.Index(u, v, j)]; });
  });
}

Stack OpticalDepth(const Stack& s, uint32_t level) {
  return ForTexels(s, level, [&](uint32_t x, uint32_t y, uint32_t j) {
    return 1 - std::exp(BoxMean(x, y, level, [&](uint32_t u, uint32_t v) {
             return std::log(1 - std::min(s.coverage[s.Index(u, v, j)], kMost));
           }));
  });
}

double ShareAbove(const Stack& s, uint32_t layer, double scale) {
  const size_t texels = size_t(s.width) * s.height;
  size_t above = 0;
  for (size_t i = 0; i < texels; ++i) above += s.coverage[layer * texels + i] * scale > 0.5;
  return double(above) / double(texels);
}

// Castano, "Computing Alpha Mipmaps" (2010): each slice is scaled so that as much of it passes an alpha test at 0.5 as
// at mip 0.
Stack CoveragePreserving(const Stack& s, uint32_t level) {
  Stack out = Mean(s, level);
  const size_t texels = size_t(out.width) * out.height;
  for (uint32_t j = 0; j < s.layers; ++j) {
    const double goal = ShareAbove(s, j, 1);
    if (goal == 0) continue;
    double low = 0, high = 16;
    for (int i = 0; i < 30; ++i) (ShareAbove(out, j, (low + high) / 2) < goal ? low : high) = (low + high) / 2;
    for (size_t i = 0; i < texels; ++i)
      out.coverage[j * texels + i] = std::min(1.0, out.coverage[j * texels + i] * high);
  }
  return out;
}

// What is left of a ray that comes down to a slice, at each texel of each slice: prod_{k>j} (1 - a_k(x + s (k - j))).
Stack Visibility(const Stack& s, Shear shear) {
  Stack v(s.width, s.height, s.layers);
  for (uint32_t j = s.layers; j-- > 0;)
    for (uint32_t y = 0; y < s.height; ++y)
      for (uint32_t x = 0; x < s.width; ++x) {
        const int ux = int(x) + int(shear.x), uy = int(y) + int(shear.y);
        v.coverage[v.Index(x, y, j)] =
            j + 1 == s.layers ? 1 : v.Wrapped(ux, uy, j + 1) * (1 - s.Wrapped(ux, uy, j + 1));
      }
  return v;
}

Stack MeanVisibility(const Stack& s, std::span<const int> shears) {
  Stack sum(s.width, s.height, s.layers);
  for (const int shear : shears)
    for (const Shear& turned : Turned(shear)) {
      const Stack v = Visibility(s, turned);
      const double weight = 1.0 / double(shears.size() * Turned(shear).size());
      for (size_t i = 0; i < sum.coverage.size(); ++i) sum.coverage[i] += v.coverage[i] * weight;
    }
  return sum;
}

// The mean of coverage weighted by how visible each texel is from above, to the given power. At shear 0 and power 1 the
// mean of v a over the mean of v is 1 - M_j / M_(j+1): the cumulative transmittance becomes exact.
Stack Visible(const Stack& s, uint32_t level, std::span<const int> shears, double power = 1) {
  const Stack v = MeanVisibility(s, shears);
  return ForTexels(s, level, [&](uint32_t x, uint32_t y, uint32_t j) {
    double weight = 0, sum = 0, plain = 0;
    ForBox(x, y, level, [&](uint32_t ux, uint32_t uy) {
      const size_t i = s.Index(ux, uy, j);
      const double w = std::pow(v.coverage[i], power);
      weight += w, sum += w * s.coverage[i], plain += s.coverage[i];
    });
    return weight > 1e-12 ? sum / weight : plain / double(1u << (2 * level));
  });
}

Stack Blend(const Stack& a, const Stack& b, double t) {
  Stack out = a;
  for (size_t i = 0; i < out.coverage.size(); ++i) out.coverage[i] += t * (b.coverage[i] - a.coverage[i]);
  return out;
}

// 1 - M_j / M_(j+1) with M averaged over shears, each seen from its own slice.
Stack AveragedCumulative(const Stack& s, uint32_t level, std::span<const int> shears) {
  const Stack v = MeanVisibility(s, shears);
  const Stack m = ForTexels(s, level, [&](uint32_t x, uint32_t y, uint32_t j) {  // M_(j+1)
    return BoxMean(x, y, level, [&](uint32_t u, uint32_t w) { return v.coverage[v.Index(u, w, j)]; });
  });
  Stack out = Visible(s, level, shears);
  for (uint32_t j = 1; j < s.layers; ++j)
    for (uint32_t y = 0; y < out.height; ++y)
      for (uint32_t x = 0; x < out.width; ++x) {
        const double above = m.coverage[m.Index(x, y, j)], below = m.coverage[m.Index(x, y, j - 1)];
        out.coverage[out.Index(x, y, j)] = above > 1e-12 ? std::clamp(1 - below / above, 0.0, kMost) : kMost;
      }
  return out;
}

// Least squares over the shears, from the top down: with V what the mip's own slices above let through (bilinear taps),
// M what mip 0 lets through down to and including slice j and w what slice j shows,
//   minimise sum of  ((1 - A) V - M)^2 + both (A V - w)^2.
Stack LeastSquares(const Stack& s, uint32_t level, std::span<const int> shears, double both) {
  Stack out(s.width >> level, s.height >> level, s.layers);
  Stack top(out.width, out.height, s.layers), bottom = top;
  std::vector<std::pair<Shear, double>> rays;
  for (const int shear : shears)
    for (const Shear& t : Turned(shear)) rays.push_back({t, 1.0 / double(Turned(shear).size())});
  std::vector<Stack> m, w;
  for (const auto& ray : rays) {
    const Stack v = Visibility(s, ray.first);
    const auto mean = [&](auto f) {
      return ForTexels(s, level, [&](uint32_t x, uint32_t y, uint32_t j) {
        return BoxMean(x, y, level, [&](uint32_t a, uint32_t b) { return f(v.Index(a, b, j)); });
      });
    };
    m.push_back(mean([&](size_t i) { return v.coverage[i] * (1 - s.coverage[i]); }));
    w.push_back(mean([&](size_t i) { return v.coverage[i] * s.coverage[i]; }));
  }
  const double scale = 1.0 / double(1u << level);
  for (uint32_t j = s.layers; j-- > 0;)
    for (uint32_t y = 0; y < out.height; ++y)
      for (uint32_t x = 0; x < out.width; ++x) {
        double dot = 0, square = 0;
        const size_t i = out.Index(x, y, j);
        for (size_t r = 0; r < rays.size(); ++r) {
          double v = 1;
          for (uint32_t k = j + 1; k < s.layers; ++k) {
            const double d = scale * (k - j);
            v *= 1 - out.Bilinear(x + rays[r].first.x * d, y + rays[r].first.y * d, k);
          }
          dot += rays[r].second * v * ((v - m[r].coverage[i]) + both * w[r].coverage[i]);
          square += rays[r].second * v * v * (1 + both);
        }
        out.coverage[i] = square > 1e-12 ? std::clamp(dot / square, 0.0, kMost) : kMost;
      }
  return out;
}

constexpr int kStraight[] = {0}, kThree[] = {0, 2, 8}, kFive[] = {0, 1, 2, 4, 8}, kSlanted[] = {1, 2, 4, 8};

}  // namespace

std::vector<MipLaw> CandidateLaws() {
  using S = const Stack&;
  return {
      {"mean coverage", [](S s, uint32_t m) { return Mean(s, m); }},
      {"mean optical depth", [](S s, uint32_t m) { return OpticalDepth(s, m); }},
      {"coverage preserving", [](S s, uint32_t m) { return CoveragePreserving(s, m); }},
      {"cumulative at shear 0", [](S s, uint32_t m) { return CumulativeMip(s, m); }},
      {"half mean, half cumulative", [](S s, uint32_t m) { return Blend(Mean(s, m), CumulativeMip(s, m), 0.5); }},
      {"visibility^1/2 at shear 0", [](S s, uint32_t m) { return Visible(s, m, kStraight, 0.5); }},
      {"averaged M over 0 2 8", [](S s, uint32_t m) { return AveragedCumulative(s, m, kThree); }},
      {"least squares M over 0 2 8", [](S s, uint32_t m) { return LeastSquares(s, m, kThree, 0); }},
      {"least squares M, w over 0 2 8", [](S s, uint32_t m) { return LeastSquares(s, m, kThree, 1); }},
      {"visible from 0 2 8", [](S s, uint32_t m) { return Visible(s, m, kThree); }},
      {"visible from 0 1 2 4 8", [](S s, uint32_t m) { return Visible(s, m, kFive); }},
      {"visible from 1 2 4 8", [](S s, uint32_t m) { return Visible(s, m, kSlanted); }},
  };
}

Stack CumulativeMip(const Stack& s, uint32_t level) { return Visible(s, level, kStraight); }

}  // namespace fur::test

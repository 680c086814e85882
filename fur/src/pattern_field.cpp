#include "pattern_field.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "bake_math.h"
#include "pattern_math.h"
#include "random.h"

namespace fur {
namespace {

using glm::dvec3;

constexpr size_t kBuckets = 4096;

dvec3 Shift(uint32_t seed) { return dvec3(seed % 89, seed % 97, seed % 83) * 31.7; }

double CoordinateOf(BodyCoordinate coordinate, const Place& at) {
  switch (coordinate) {
    case BodyCoordinate::Height: return at.h;
    case BodyCoordinate::Up: return at.n.y;
    case BodyCoordinate::Front: return at.n.z;
    case BodyCoordinate::Inward: return -at.n.x * at.p.x / (std::abs(at.p.x) + 0.01);  // no step in the middle
    case BodyCoordinate::Side: return std::abs(at.p.x);
    case BodyCoordinate::Along: return at.nose / std::max(at.nose + at.tail, 1e-9);
    case BodyCoordinate::Nose: return at.nose;
    case BodyCoordinate::Tail: return at.tail;
    case BodyCoordinate::Feet: break;
  }
  return at.feet;
}

}  // namespace

Sites::Sites(const std::vector<Place>& samples, double distance, uint32_t seed) : cell_(distance), buckets_(kBuckets) {
  std::vector<uint32_t> order(samples.size());
  for (uint32_t i = 0; i < order.size(); ++i) order[i] = i;
  Pcg32 random(seed);
  for (size_t i = order.size(); i > 1; --i) std::swap(order[i - 1], order[size_t(random.Uniform() * double(i))]);
  for (const uint32_t i : order) {
    if (Find(samples[i]).first < distance) continue;
    buckets_[Bucket(CellOf(samples[i].p))].push_back(uint32_t(sites_.size()));
    sites_.push_back(samples[i]);
  }
}

std::array<int, 3> Sites::CellOf(const dvec3& p) const {
  const dvec3 c = glm::floor(p / cell_);
  return {int(c.x), int(c.y), int(c.z)};
}

size_t Sites::Bucket(const std::array<int, 3>& c) const { return size_t(Hash(c[0], c[1], c[2]) * kBuckets); }

Sites::Nearest Sites::Find(const Place& at) const {
  Nearest nearest{HUGE_VAL, HUGE_VAL};
  const std::array<int, 3> cell = CellOf(at.p);
  for (int z = -2; z <= 2; ++z)
    for (int y = -2; y <= 2; ++y)
      for (int x = -2; x <= 2; ++x) {
        const std::array<int, 3> near{cell[0] + x, cell[1] + y, cell[2] + z};
        for (const uint32_t i : buckets_[Bucket(near)]) {
          const Place& site = sites_[i];
          // Other cells share the bucket; the other side of an ear or a leg is far away over the skin.
          if (CellOf(site.p) != near || glm::dot(site.n, at.n) < -0.3) continue;
          const double d = glm::length(site.p - at.p);
          if (d < nearest.first) {
            nearest.second = nearest.first;
            nearest.first = d;
          } else if (d < nearest.second) {
            nearest.second = d;
          }
        }
      }
  return nearest;
}

PatternField::PatternField(const MarkingLayer& layer, const Body& body) : layer_(layer) {
  if (layer.pattern == Pattern::Spots || layer.pattern == Pattern::Rosettes)
    sites_ = Sites(body.Samples(), layer.scale, layer.seed);
  if (layer.pattern == Pattern::Solid) return;
  for (const Place& at : body.Samples()) quantiles_.push_back(Value(at));
  std::sort(quantiles_.begin(), quantiles_.end());
}

double PatternField::Weight(const Place& at) const {
  const double strength = layer_.opacity * Smooth(Ramps(layer_.where, at));
  if (strength <= 0) return 0;
  const double taper = std::clamp(Ramps(layer_.taper, at), 0.0, 1.0);
  if (layer_.pattern == Pattern::Solid) return strength * Smooth(taper);
  const double coverage = layer_.coverage * taper;
  // Narrower where little is covered, or little is left: the mean over all ranks stays the coverage.
  const double soft = std::min({layer_.softness, 2 * coverage, 2 * (1 - coverage)});
  const double over = Rank(at) - (1 - coverage);
  if (soft < 1e-9) return over > 0 ? strength : 0;
  return strength * Smooth(over / soft + 0.5);
}

double PatternField::Rank(const Place& at) const {
  if (quantiles_.empty()) return 1;
  const double value = Value(at);
  const auto it = std::upper_bound(quantiles_.begin(), quantiles_.end(), value);
  const auto below = double(it - quantiles_.begin());
  if (it == quantiles_.begin() || it == quantiles_.end()) return below / double(quantiles_.size());
  const double low = *(it - 1), high = *it;
  const double part = high > low ? (value - low) / (high - low) : 0;
  return (below - 0.5 + part) / double(quantiles_.size());
}

// The least of the ramps, not smoothed, moved by noise.
double PatternField::Ramps(const std::vector<BodyRamp>& ramps, const Place& at) const {
  if (ramps.empty()) return 1;
  double least = HUGE_VAL;
  for (const BodyRamp& ramp : ramps)
    least = std::min(least, (CoordinateOf(ramp.coordinate, at) - ramp.from) / (ramp.to - ramp.from));
  constexpr double kRaggedScale = 0.035;
  return least + layer_.ragged * Turbulence(at.p / kRaggedScale + Shift(layer_.seed));
}

double PatternField::Value(const Place& at) const {
  switch (layer_.pattern) {
    case Pattern::Stripes: return Stripes(at);
    case Pattern::Rosettes: return Broken(-std::abs(Ring(at) - layer_.ring), 0.5, at);
    case Pattern::Spots: return Broken(-Ring(at), 0.4, at);
    case Pattern::Patches: return Turbulence(at.p / layer_.scale + Shift(layer_.seed));
    case Pattern::Streaks: return Streaks(at);
    case Pattern::Solid: break;
  }
  return 0;
}

double PatternField::Broken(double value, double strength, const Place& at) const {
  constexpr double kGrain = 0.35;  // scales
  return value + strength * layer_.irregular * Turbulence(at.p / (kGrain * layer_.scale));
}

// 0 at a site, 1 half way to the next: rings in it never cross from one site to another (Worley, "A Cellular Texture Basis
// Function", SIGGRAPH 96: the two nearest).
double PatternField::Ring(const Place& at) const {
  const Sites::Nearest nearest = sites_.Find(at);
  if (nearest.first == HUGE_VAL) return 1;
  if (nearest.second == HUGE_VAL) return std::min(nearest.first / layer_.scale, 1.0);
  return 2 * nearest.first / (nearest.first + nearest.second);
}

// A wave along the body, made of overlapping pieces in a lattice, each with a phase of its own: where phases disagree a
// stripe forks or ends (kernels in a lattice after Lagae et al., "Procedural Noise using Sparse Gabor Convolution",
// SIGGRAPH 2009). Along the body a piece has some waves; across it, it is as long as a stripe.
double PatternField::Stripes(const Place& at) const {
  constexpr double kWaves = 2;
  const double across = 1 / (layer_.length * layer_.scale), along = 1 / layer_.scale;
  const dvec3 q = dvec3(at.p.x * across, at.p.y * across, at.nose * along / kWaves) + Shift(layer_.seed);
  const dvec3 base = glm::floor(q);
  const double phase = at.nose * along;
  double sum = 0, weights = 1e-6;
  for (int z = -1; z <= 1; ++z)
    for (int y = -1; y <= 1; ++y)
      for (int x = -1; x <= 1; ++x) {
        const dvec3 cell = base + dvec3(x, y, z);
        const int cx = int(cell.x), cy = int(cell.y), cz = int(cell.z);
        const dvec3 site = cell + dvec3(Hash(cx, cy, cz), Hash(cx + 7919, cy, cz), Hash(cx, cy + 7919, cz));
        const double far = glm::dot(q - site, q - site);
        if (far >= 1) continue;
        const double weight = (1 - far) * (1 - far);
        const double own = layer_.irregular * (Hash(cx, cy, cz + 7919) - 0.5);
        sum += weight * CosSinTurns(phase + own).x;
        weights += weight;
      }
  return sum / weights + 0.35 * layer_.irregular * Turbulence(at.p / (2 * layer_.scale));
}

// Along the body; on the limbs down.
double PatternField::Streaks(const Place& at) const {
  const double fine = 1 / layer_.scale, coarse = fine / layer_.length;
  const double along = Noise(dvec3(at.p.x * fine, at.p.y * fine, at.nose * coarse) + Shift(layer_.seed));
  const double down = Noise(dvec3(at.p.x * fine, at.p.y * coarse, at.p.z * fine) + Shift(layer_.seed));
  return glm::mix(along, down, Step(0.5, 0.3, at.h));
}

}  // namespace fur

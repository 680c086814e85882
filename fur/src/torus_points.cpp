#include "torus_points.h"

#include <algorithm>
#include <cmath>

#include "bake_math.h"

namespace fur {

using glm::dvec2;

TorusPoints::TorusPoints(size_t expected) {
  cells_ = std::max(1, static_cast<int>(std::sqrt(static_cast<double>(expected))));
  grid_.resize(static_cast<size_t>(cells_) * cells_);
}

void TorusPoints::Add(dvec2 p) {
  grid_[CellOf(p)].push_back(static_cast<uint32_t>(points_.size()));
  points_.push_back(p);
}

bool TorusPoints::AnyWithin(dvec2 p, double radius) const {
  bool found = false;
  ForNear(p, radius, [&](uint32_t i) {
    const dvec2 d = Nearest(points_[i] - p);
    found = found || glm::dot(d, d) < radius * radius;
  });
  return found;
}

uint32_t TorusPoints::NearestTo(dvec2 p) const {
  for (double radius = 1.0 / cells_;; radius *= 2) {
    uint32_t best = 0;
    double distance = radius < 1 ? radius * radius : 4;  // 4: farther than anything on the torus
    bool found = false;
    ForNear(p, radius, [&](uint32_t i) {
      const dvec2 d = Nearest(points_[i] - p);
      const double square = glm::dot(d, d);
      if (square < distance || (square == distance && found && i < best)) best = i, distance = square, found = true;
    });
    if (found || radius > 4) return best;
  }
}

size_t TorusPoints::CellOf(dvec2 p) const {
  const int x = std::min(cells_ - 1, static_cast<int>(p.x * cells_));
  const int y = std::min(cells_ - 1, static_cast<int>(p.y * cells_));
  return static_cast<size_t>(y) * cells_ + x;
}

template <class F>
void TorusPoints::ForNear(dvec2 p, double radius, F visit) const {
  const int reach = std::min(cells_ / 2, static_cast<int>(radius * cells_) + 1);
  const int cx = static_cast<int>(p.x * cells_), cy = static_cast<int>(p.y * cells_);
  for (int y = cy - reach; y <= cy + reach; ++y) {
    for (int x = cx - reach; x <= cx + reach; ++x) {
      const int wx = ((x % cells_) + cells_) % cells_, wy = ((y % cells_) + cells_) % cells_;
      for (uint32_t i : grid_[static_cast<size_t>(wy) * cells_ + wx]) visit(i);
    }
  }
}

TorusPoints ThrowRoots(uint32_t count, uint32_t first, Pcg32* random) {
  const auto packed = [](uint32_t n) { return 0.8 * std::sqrt(1.1547 / std::max(1u, n)); };
  TorusPoints roots(count);
  double radius = packed(first);
  for (uint32_t misses = 0; roots.all().size() < count;) {
    if (roots.all().size() == first) radius = std::min(radius, packed(count));
    const double x = std::ldexp(random->Next() >> 12, -20), y = std::ldexp(random->Next() >> 12, -20);
    if (!roots.AnyWithin({x, y}, radius)) {
      roots.Add({x, y});
      misses = 0;
    } else if (++misses % 24 == 0) {
      radius *= 0.98;
    }
  }
  return roots;
}

}  // namespace fur

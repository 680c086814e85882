#include "strand_raster.h"

#include <algorithm>
#include <cmath>

namespace fur {

using glm::dvec2;

// A tangent line that touches both discs has a normal n with n.a + ra = n.b + rb; so n.u = (ra - rb) / |b - a|, u the
// direction from a to b. No such line: one disc holds the other.
Footprint::Hull Footprint::MakeHull(const SweptDisc& p) {
  Hull hull{
      p, {}, false, std::min(p.a.y - p.radiusA, p.b.y - p.radiusB), std::max(p.a.y + p.radiusA, p.b.y + p.radiusB)};
  const dvec2 d = p.b - p.a;
  const double length = std::sqrt(glm::dot(d, d));
  if (length <= std::abs(p.radiusA - p.radiusB)) return hull;
  const dvec2 u = d / length;
  const double along = (p.radiusA - p.radiusB) / length, across = std::sqrt(std::max(0.0, 1 - along * along));
  const dvec2 side = dvec2(-u.y, u.x) * across, n1 = u * along + side, n2 = u * along - side;
  hull.corners[0] = p.a + n1 * p.radiusA, hull.corners[1] = p.b + n1 * p.radiusB;
  hull.corners[2] = p.b + n2 * p.radiusB, hull.corners[3] = p.a + n2 * p.radiusA;
  hull.hasQuad = true;
  return hull;
}

// The hull is convex, so that a line cuts it in one interval: from the least to the largest x of its three parts.
bool Footprint::Cut(const Hull& hull, double y, Interval* cut) {
  if (y <= hull.low || y >= hull.high) return false;
  double from = 1e300, to = -1e300;
  const auto take = [&](double x0, double x1) { from = std::min(from, x0), to = std::max(to, x1); };
  const auto disc = [&](dvec2 c, double r) {
    const double square = r * r - (y - c.y) * (y - c.y);
    if (square > 0) take(c.x - std::sqrt(square), c.x + std::sqrt(square));
  };
  disc(hull.piece.a, hull.piece.radiusA);
  disc(hull.piece.b, hull.piece.radiusB);
  for (int i = 0; hull.hasQuad && i < 4; ++i) {
    const dvec2 p = hull.corners[i], q = hull.corners[(i + 1) % 4];
    if ((p.y < y) == (q.y < y)) continue;
    const double x = p.x + (q.x - p.x) * ((y - p.y) / (q.y - p.y));
    take(x, x);
  }
  *cut = {from, to};
  return from < to;
}

void Footprint::SetBox() {
  double left = 1e300, right = -1e300, low = 1e300, high = -1e300;
  for (const Hull& h : hulls_) {
    left = std::min({left, h.piece.a.x - h.piece.radiusA, h.piece.b.x - h.piece.radiusB});
    right = std::max({right, h.piece.a.x + h.piece.radiusA, h.piece.b.x + h.piece.radiusB});
    low = std::min(low, h.low), high = std::max(high, h.high);
  }
  x0_ = static_cast<int>(std::floor(left));
  y0_ = static_cast<int>(std::floor(low / rowHeight_));
  width_ = static_cast<int>(std::floor(right)) - x0_ + 1;
  height_ = static_cast<int>(std::floor(high / rowHeight_)) - y0_ + 1;
  cells_.assign(size_t(width_) * size_t(height_), Cell{});
}

template <class F>
void Footprint::ForCells(const Interval& interval, int row, F add) {
  Cell* const cells = &cells_[size_t(row - y0_) * size_t(width_)];
  const int last = std::min(x0_ + width_ - 1, static_cast<int>(std::floor(interval.to)));
  for (int x = std::max(x0_, static_cast<int>(std::floor(interval.from))); x <= last; ++x)
    add(cells[x - x0_], std::min(interval.to, x + 1.0) - std::max(interval.from, x + 0.0));
}

void Footprint::CoverLine(double y, int row, double part) {
  line_.clear();
  for (const Hull& hull : hulls_) {
    Interval cut{};
    if (!Cut(hull, y, &cut)) continue;
    line_.push_back(cut);
    ForCells(cut, row, [&](Cell& cell, double overlap) {
      const double share = overlap * part;
      cell.weight += share;
      cell.direction += hull.piece.direction * share;
      cell.along += hull.piece.along * share;
    });
  }
  std::sort(line_.begin(), line_.end(), [](const Interval& a, const Interval& b) { return a.from < b.from; });
  for (size_t i = 0; i < line_.size();) {
    Interval merged = line_[i];
    for (++i; i < line_.size() && line_[i].from <= merged.to; ++i) merged.to = std::max(merged.to, line_[i].to);
    ForCells(merged, row, [&](Cell& cell, double overlap) { cell.share = std::min(1.0, cell.share + overlap * part); });
  }
}

void Footprint::Cover(std::span<const SweptDisc> pieces) {
  hulls_.clear();
  width_ = height_ = 0;
  double radius = 0;
  for (const SweptDisc& piece : pieces) {
    hulls_.push_back(MakeHull(piece));
    radius = std::max({radius, piece.radiusA, piece.radiusB});
  }
  if (!(radius > 0)) return;
  SetBox();
  int lines = 32;  // in a row of cells
  while (lines < 64 && radius * lines < 8 * rowHeight_) lines *= 2;
  for (int row = y0_; row < y0_ + height_; ++row)
    for (int i = 0; i < lines; ++i) CoverLine((row + (i + 0.5) / lines) * rowHeight_, row, 1.0 / lines);
}

}  // namespace fur

#include "unwrap_pieces.h"

#include <algorithm>
#include <cmath>
#include <deque>
#include <map>

namespace fur {
namespace {

using glm::dvec2;

// Cells of a fine grid that a piece covers.
class Claims {
 public:
  explicit Claims(double cell) : cell_(cell) {}

  // Takes the cells whose centres lie inside, unless one of them is taken.
  bool Take(const std::array<dvec2, 3>& t) {
    const dvec2 ab = t[1] - t[0], ac = t[2] - t[0];
    const double area = ab.x * ac.y - ab.y * ac.x;
    std::vector<std::pair<int, int>> cells;
    const dvec2 from = glm::floor(glm::min(glm::min(t[0], t[1]), t[2]) / cell_);
    const dvec2 to = glm::floor(glm::max(glm::max(t[0], t[1]), t[2]) / cell_);
    for (double y = from.y; y <= to.y && area != 0; ++y)
      for (double x = from.x; x <= to.x; ++x) {
        const dvec2 p = dvec2(x + 0.5, y + 0.5) * cell_ - t[0];
        const double b = (p.x * ac.y - p.y * ac.x) / area, c = (ab.x * p.y - ab.y * p.x) / area;
        constexpr double kOnEdge = 1e-6;
        if (std::min({b, c, 1 - b - c}) <= kOnEdge) continue;
        if (taken_.contains({int(x), int(y)})) return false;
        cells.emplace_back(int(x), int(y));
      }
    for (const auto& cell : cells) taken_[cell] = true;
    return true;
  }

 private:
  double cell_;
  std::map<std::pair<int, int>, bool> taken_;
};

class Cutter {
 public:
  Cutter(std::span<const uint32_t> indices, std::span<const dvec2> uv, std::span<const uint32_t> chartOf)
      : indices_(indices), uv_(uv), chartOf_(chartOf), pieces_(indices.size() / 3, kNone), at_(uv.size()) {
    dvec2 extent(0);
    for (const dvec2& p : uv) extent = glm::max(extent, p);
    constexpr double kCells = 1024;
    cell_ = std::max({extent.x, extent.y, 1e-30}) / kCells;
    for (uint32_t t = 0; t < pieces_.size(); ++t)
      for (size_t k = 0; k < 3; ++k) at_[indices[t * 3 + k]].push_back(t);
  }

  std::vector<uint32_t> Run() {
    uint32_t count = 0;
    for (uint32_t t = 0; t < pieces_.size(); ++t)
      if (pieces_[t] == kNone) Flood(t, count++);
    return pieces_;
  }

 private:
  static constexpr uint32_t kNone = ~0u;

  // Breadth first, so that pieces are round.
  void Flood(uint32_t first, uint32_t piece) {
    Claims claims(cell_);
    std::deque<uint32_t> open{first};
    std::vector<uint8_t> tried(pieces_.size(), 0);
    tried[first] = 1;
    while (!open.empty()) {
      const uint32_t t = open.front();
      open.pop_front();
      if (IsMirrored(t) != IsMirrored(first) || !claims.Take(Corners(t))) continue;
      pieces_[t] = piece;
      for (size_t k = 0; k < 3; ++k)
        for (const uint32_t next : at_[indices_[size_t{t} * 3 + k]]) {
          if (tried[next] || pieces_[next] != kNone || ChartOf(next) != ChartOf(t)) continue;
          tried[next] = 1;
          open.push_back(next);
        }
    }
  }

  std::array<dvec2, 3> Corners(uint32_t t) const {
    const uint32_t* v = &indices_[size_t{t} * 3];
    return {uv_[v[0]], uv_[v[1]], uv_[v[2]]};
  }
  // A triangle that folds over lies on its neighbours.
  bool IsMirrored(uint32_t t) const {
    const std::array<dvec2, 3> c = Corners(t);
    return (c[1].x - c[0].x) * (c[2].y - c[0].y) < (c[1].y - c[0].y) * (c[2].x - c[0].x);
  }
  uint32_t ChartOf(uint32_t t) const { return chartOf_[indices_[size_t{t} * 3]]; }

  std::span<const uint32_t> indices_;
  std::span<const dvec2> uv_;
  std::span<const uint32_t> chartOf_;
  std::vector<uint32_t> pieces_;
  std::vector<std::vector<uint32_t>> at_;  // triangles by vertex
  double cell_ = 1;
};

}  // namespace

std::vector<uint32_t> FindPieces(std::span<const uint32_t> indices, std::span<const dvec2> uv,
                                 std::span<const uint32_t> chartOf) {
  return Cutter(indices, uv, chartOf).Run();
}

}  // namespace fur

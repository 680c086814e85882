#include "triangle_order.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <queue>
#include <tuple>

#include "fur/topology.h"

namespace fur {
namespace {

// A corner is a position in the index list; it stands for the edge from it to the next corner of its triangle.
uint32_t Next(uint32_t corner) { return corner % 3 == 2 ? corner - 2 : corner + 1; }

std::vector<uint32_t> Welded(std::span<const FurVertex> vertices, std::span<const uint32_t> indices) {
  std::vector<Vertex> points(vertices.size());
  for (size_t i = 0; i < points.size(); ++i) points[i].position = glm::vec3(vertices[i].position);
  const Weld weld = WeldByPosition(points);
  std::vector<uint32_t> welded;
  for (const uint32_t i : indices) welded.push_back(weld.representative[weld.welded[i]]);
  return welded;
}

// The corners of all triangles that are not degenerate, those of one edge next to each other, in the list's order.
struct Side {
  uint32_t low, high, corner;
  bool SameEdge(const Side& o) const { return low == o.low && high == o.high; }
};
std::vector<Side> SidesByEdge(std::span<const uint32_t> welded) {
  std::vector<Side> sides;
  for (uint32_t c = 0; c < welded.size(); ++c) {
    const uint32_t a = welded[c], b = welded[Next(c)], opposite = welded[Next(Next(c))];
    if (a != b && b != opposite && opposite != a) sides.push_back({std::min(a, b), std::max(a, b), c});
  }
  std::sort(sides.begin(), sides.end(), [](const Side& a, const Side& b) {
    return std::tie(a.low, a.high, a.corner) < std::tie(b.low, b.high, b.corner);
  });
  return sides;
}

// Kahn, "Topological sorting of large networks", CACM 1962: what waits for nothing comes next, by rank.
class Sorter {
 public:
  // `byRank`: the triangle of each rank; ranks are the order where relations leave a choice.
  explicit Sorter(std::vector<uint32_t> byRank)
      : byRank_(std::move(byRank)),
        rank_(byRank_.size()),
        firstNearer_(byRank_.size() + 1, 0),
        waitsFor_(byRank_.size(), 0),
        placed_(byRank_.size(), false) {
    for (uint32_t r = 0; r < byRank_.size(); ++r) rank_[byRank_[r]] = r;
  }

  template <class Relations>
  std::vector<uint32_t> Run(const Relations& relations) {
    for (const auto& r : relations) {
      ++firstNearer_[r.farther + 1];
      ++waitsFor_[r.nearer];
    }
    for (size_t i = 1; i < firstNearer_.size(); ++i) firstNearer_[i] += firstNearer_[i - 1];
    nearer_.resize(relations.size());
    std::vector<uint32_t> next(firstNearer_.begin(), firstNearer_.end() - 1);
    for (const auto& r : relations) nearer_[next[r.farther]++] = r.nearer;
    for (uint32_t t = 0; t < rank_.size(); ++t)
      if (waitsFor_[t] == 0) ready_.push(rank_[t]);
    while (order_.size() < rank_.size()) Place(NextTriangle());
    return std::move(order_);
  }

 private:
  uint32_t NextTriangle() {
    while (!ready_.empty()) {
      const uint32_t triangle = byRank_[ready_.top()];
      ready_.pop();
      if (!placed_[triangle]) return triangle;
    }
    while (placed_[byRank_[firstLeft_]]) ++firstLeft_;  // all that is left waits for a circle
    return byRank_[firstLeft_];
  }

  void Place(uint32_t triangle) {
    placed_[triangle] = true;
    order_.push_back(triangle);
    for (uint32_t i = firstNearer_[triangle]; i < firstNearer_[triangle + 1]; ++i)
      if (--waitsFor_[nearer_[i]] == 0) ready_.push(rank_[nearer_[i]]);
  }

  std::vector<uint32_t> byRank_, rank_, firstNearer_, nearer_, waitsFor_;
  std::vector<bool> placed_;
  std::priority_queue<uint32_t, std::vector<uint32_t>, std::greater<>> ready_;  // ranks
  size_t firstLeft_ = 0;
  std::vector<uint32_t> order_;
};

}  // namespace

TriangleOrder::TriangleOrder(std::span<const FurVertex> vertices, std::span<const uint32_t> indices) {
  for (const FurVertex& v : vertices) {
    const double length = v.position.w;
    roots_.push_back({glm::dvec3(v.position), glm::dvec3(v.direction) * length, length});
  }
  corners_.assign(indices.begin(), indices.end() - ptrdiff_t(indices.size() % 3));
  for (size_t i = 0; i + 2 < indices.size(); i += 3)
    middles_.push_back(
        (roots_[indices[i]].position + roots_[indices[i + 1]].position + roots_[indices[i + 2]].position) / 3.0);
  const std::vector<uint32_t> welded = Welded(vertices, indices.first(middles_.size() * 3));
  const std::vector<Side> sides = SidesByEdge(welded);
  for (size_t first = 0, end = 0; first < sides.size(); first = end) {
    while (end < sides.size() && sides[end].SameEdge(sides[first])) ++end;
    for (size_t i = first; i + 1 < end; ++i) AddWall(sides[i].corner, sides[i + 1].corner, welded);
    if (end - first > 2) AddWall(sides[end - 1].corner, sides[first].corner, welded);
  }
}

void TriangleOrder::AddWall(uint32_t corner0, uint32_t corner1, std::span<const uint32_t> welded) {
  walls_.push_back({welded[corner0], welded[Next(corner0)], welded[Next(Next(corner0))], welded[Next(Next(corner1))],
                    corner0 / 3, corner1 / 3});
}

std::vector<TriangleOrder::Relation> TriangleOrder::Relations(const glm::dvec3& eye, const glm::dvec3& comb) const {
  std::vector<Relation> relations;
  for (const Wall& w : walls_) {
    const Root &a = roots_[w.end0], &b = roots_[w.end1];
    const glm::dvec3 toTip = a.toTip + b.toTip + comb * (a.length + b.length);
    const glm::dvec3 across = glm::cross(b.position - a.position, toTip);
    const double side0 = glm::dot(across, roots_[w.corner0].position - a.position);
    const double side1 = glm::dot(across, roots_[w.corner1].position - a.position);
    const double eyeSide = glm::dot(across, eye - a.position);
    // The eye in the wall sees both; triangles on one side of it are folded, and the wall does not part them.
    if (!(side0 * side1 < 0) || !(eyeSide < 0 || eyeSide > 0)) continue;
    const bool zeroIsNearer = (side0 > 0) == (eyeSide > 0);
    relations.push_back(zeroIsNearer ? Relation{w.triangle1, w.triangle0} : Relation{w.triangle0, w.triangle1});
  }
  return relations;
}

std::vector<uint32_t> TriangleOrder::FarthestFirst(const glm::dvec3& eye) const {
  std::vector<std::pair<double, uint32_t>> keys;
  bool finite = true;
  for (uint32_t t = 0; t < middles_.size(); ++t) {
    const glm::dvec3 d = middles_[t] - eye;
    keys.emplace_back(-glm::dot(d, d), t);
    finite = finite && std::isfinite(keys.back().first);
  }
  if (finite) std::sort(keys.begin(), keys.end());
  std::vector<uint32_t> order;
  for (const auto& [distance, triangle] : keys) order.push_back(triangle);
  return order;
}

bool TriangleOrder::SeenFromBehind(uint32_t triangle, const glm::dvec3& eye, const glm::dvec3& comb,
                                   double length) const {
  glm::dvec3 p[3], toTip(0);
  for (size_t i = 0; i < 3; ++i) {
    const Root& r = roots_[corners_[size_t{3} * triangle + i]];
    p[i] = r.position + (r.toTip + comb * r.length) * (length / 2);
    toTip += r.toTip;
  }
  const glm::dvec3 normal = glm::cross(p[1] - p[0], p[2] - p[0]);
  return (glm::dot(normal, eye - p[0]) < 0) == (glm::dot(normal, toTip) > 0);
}

std::vector<uint32_t> TriangleOrder::BackToFront(const glm::dvec3& eye, const glm::dvec3& comb) const {
  return Sorter(FarthestFirst(eye)).Run(Relations(eye, comb));
}

}  // namespace fur

#include "fur_uv_flatten.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <set>

#include "fur_uv_even.h"
#include "fur_uv_laplacian.h"

namespace fur::furuv {
namespace {

using glm::dvec2;
using glm::dvec3;

class Flattener {
 public:
  explicit Flattener(const Chart& chart) : chart_(chart), rest_(RestOf(chart)) {
    std::vector<bool> held(chart.positions.size());
    held[0] = true;  // the energy does not see translations
    laplacian_.emplace(chart, rest_, held);
  }

  // The model's UVs scaled to the chart's area, mirrored where most of it is.
  std::optional<std::vector<dvec2>> FromModel() const {
    std::vector<dvec2> uv = chart_.modelUv;
    double sum = 0, absolute = 0;
    for (const Triangle& t : chart_.triangles) {
      const double area = SignedArea(uv, t);
      sum += area;
      absolute += std::abs(area);
    }
    if (!(absolute > 0) || !std::isfinite(absolute)) return {};
    const double scale = std::sqrt(chart_.area / absolute);
    for (dvec2& p : uv) p *= dvec2(sum < 0 ? -scale : scale, scale);
    return uv;
  }

  // Seen along the mean normal.
  std::vector<dvec2> Projected() const {
    dvec3 normal{0};
    for (const Triangle& t : chart_.triangles) {
      const dvec3& p = chart_.positions[t[0]];
      normal += glm::cross(chart_.positions[t[1]] - p, chart_.positions[t[2]] - p);
    }
    const double length = glm::length(normal);
    normal = length > 0 ? normal / length : dvec3(0, 0, 1);
    const dvec3 u = glm::normalize(glm::cross(std::abs(normal.y) < 0.9 ? dvec3(0, 1, 0) : dvec3(1, 0, 0), normal));
    const dvec3 v = glm::cross(normal, u);
    std::vector<dvec2> uv;
    for (const dvec3& p : chart_.positions) uv.emplace_back(glm::dot(u, p), glm::dot(v, p));
    return uv;
  }

  // The longest border on a circle, the rest by the weights: no fold in a chart with one border (Tutte 1963, "How to
  // draw a graph"; Floater 1997 for positive weights).
  std::optional<std::vector<dvec2>> FromCircle() const {
    const std::vector<uint32_t> loop = LongestBorder();
    if (loop.size() < 3) return {};
    std::vector<bool> held(chart_.positions.size());
    std::vector<dvec2> uv(chart_.positions.size(), dvec2(0));
    double length = 0;
    for (size_t i = 0; i < loop.size(); ++i) length += BorderEdge(loop, i);
    const double radius = std::sqrt(chart_.area / kPi);
    double at = 0;
    for (size_t i = 0; i < loop.size(); at += BorderEdge(loop, i++)) {
      const double angle = 2 * kPi * at / length;
      uv[loop[i]] = radius * dvec2(std::cos(angle), std::sin(angle));
      held[loop[i]] = true;
    }
    const HeldLaplacian laplacian(chart_, rest_, held);
    if (!laplacian.Ok()) return {};
    Columns right = Columns::Zero(laplacian.Rows(), 2);
    for (size_t t = 0; t < rest_.size(); ++t) {
      for (size_t i = 0; i < 3; ++i) {
        const uint32_t a = chart_.triangles[t][i], b = chart_.triangles[t][(i + 1) % 3];
        if (held[b] && !held[a]) AddTo(&right, laplacian.RowOf(a), rest_[t].weight[i] * uv[b]);
        if (held[a] && !held[b]) AddTo(&right, laplacian.RowOf(b), rest_[t].weight[i] * uv[a]);
      }
    }
    laplacian.Scatter(laplacian.Solve(right), &uv);
    return uv;
  }

  bool HasBorder() const {
    std::map<std::pair<uint32_t, uint32_t>, int> edges;
    for (const Triangle& t : chart_.triangles) {
      for (size_t i = 0; i < 3; ++i) ++edges[std::minmax(t[i], t[(i + 1) % 3])];
    }
    return std::any_of(edges.begin(), edges.end(), [](const auto& edge) { return edge.second == 1; });
  }

  // The local/global iterations.
  Flat Relax(std::vector<dvec2> uv) const {
    constexpr int kMostRounds = 300;
    constexpr double kEnough = 1e-6;
    if (!laplacian_->Ok()) return Judge(std::move(uv));
    std::vector<dvec2> rotation(rest_.size(), dvec2(1, 0));
    double energy = HUGE_VAL;
    for (int round = 0; round < kMostRounds; ++round) {
      FitRotations(uv, &rotation);
      const double now = Energy(uv, rotation);
      if (!(now < energy * (1 - kEnough))) break;
      energy = now;
      Columns right = Columns::Zero(laplacian_->Rows(), 2);
      for (size_t t = 0; t < rest_.size(); ++t) AddTargets(t, rotation[t], uv[0], &right);
      laplacian_->Scatter(laplacian_->Solve(right), &uv);
    }
    return Judge(std::move(uv));
  }

  Flat Even(std::vector<dvec2> uv) const {
    if (laplacian_->Ok()) EvenOut(chart_, rest_, *laplacian_, &uv);
    return Judge(std::move(uv));
  }

  Flat Open(std::vector<dvec2> uv) const {
    if (laplacian_->Ok()) Unfold(chart_, rest_, *laplacian_, &uv);
    return Judge(std::move(uv));
  }

  Flat Judge(std::vector<dvec2> uv) const {
    Flat flat{.uv = std::move(uv)};
    for (size_t t = 0; t < rest_.size(); ++t)
      flat.flipped += rest_[t].solid && !(SignedArea(flat.uv, chart_.triangles[t]) > 0) ? 1 : 0;
    std::vector<dvec2> rotation(rest_.size(), dvec2(1, 0));
    FitRotations(flat.uv, &rotation);
    flat.energy = Energy(flat.uv, rotation);
    return flat;
  }

 private:
  static constexpr double kPi = 3.14159265358979323846;

  // A rotation is (cos, sin).
  static dvec2 Rotated(const dvec2& r, const dvec2& v) { return {r.x * v.x - r.y * v.y, r.y * v.x + r.x * v.y}; }
  dvec2 RestEdge(size_t t, size_t i) const { return rest_[t].at[(i + 1) % 3] - rest_[t].at[i]; }

  // Local step: the closest rotation in the plane, in closed form (equation 6 by signed SVD comes to the same).
  void FitRotations(const std::vector<dvec2>& uv, std::vector<dvec2>* rotation) const {
    for (size_t t = 0; t < rest_.size(); ++t) {
      dvec2 sum{0};
      for (size_t i = 0; i < 3; ++i) {
        const dvec2 x = RestEdge(t, i), u = uv[chart_.triangles[t][(i + 1) % 3]] - uv[chart_.triangles[t][i]];
        sum += rest_[t].weight[i] * dvec2(glm::dot(x, u), Cross(x, u));
      }
      const double length = glm::length(sum);
      if (length > 0) (*rotation)[t] = sum / length;
    }
  }

  double Energy(const std::vector<dvec2>& uv, const std::vector<dvec2>& rotation) const {
    double energy = 0;
    for (size_t t = 0; t < rest_.size(); ++t) {
      for (size_t i = 0; i < 3; ++i) {
        const dvec2 u = uv[chart_.triangles[t][(i + 1) % 3]] - uv[chart_.triangles[t][i]];
        const dvec2 off = u - Rotated(rotation[t], RestEdge(t, i));
        energy += rest_[t].weight[i] * glm::dot(off, off) / 2;
      }
    }
    return energy;
  }

  // Global step: the right side of equation 7; vertex 0 stays where it is.
  void AddTargets(size_t t, const dvec2& rotation, const dvec2& origin, Columns* right) const {
    for (size_t i = 0; i < 3; ++i) {
      const uint32_t a = laplacian_->RowOf(chart_.triangles[t][i]);
      const uint32_t b = laplacian_->RowOf(chart_.triangles[t][(i + 1) % 3]);
      const dvec2 target = rest_[t].weight[i] * Rotated(rotation, RestEdge(t, i));
      const dvec2 held = rest_[t].weight[i] * origin;
      if (a != kNone) AddTo(right, a, b == kNone ? held - target : -target);
      if (b != kNone) AddTo(right, b, a == kNone ? held + target : target);
    }
  }

  double BorderEdge(const std::vector<uint32_t>& loop, size_t i) const {
    return glm::length(chart_.positions[loop[(i + 1) % loop.size()]] - chart_.positions[loop[i]]);
  }

  // Counter-clockwise, for the triangles are; without repetitions: a border that meets itself is several. Empty where
  // no border closes.
  std::vector<uint32_t> LongestBorder() const {
    std::set<std::pair<uint32_t, uint32_t>> directed;
    for (const Triangle& t : chart_.triangles) {
      for (size_t i = 0; i < 3; ++i) directed.emplace(t[i], t[(i + 1) % 3]);
    }
    std::multimap<uint32_t, uint32_t> next;
    for (const auto& edge : directed) {
      if (edge.first != edge.second && !directed.contains({edge.second, edge.first})) next.insert(edge);
    }
    std::vector<uint32_t> best, path, place(chart_.positions.size(), kNone);  // place: in the path
    double longest = 0;
    const auto shorten = [&](size_t length) {
      for (; path.size() > length; path.pop_back()) place[path.back()] = kNone;
    };
    const auto append = [&](uint32_t vertex) {
      place[vertex] = static_cast<uint32_t>(path.size());
      path.push_back(vertex);
    };
    while (!next.empty()) {
      if (path.empty()) append(next.begin()->first);
      const auto it = next.find(path.back());
      if (it == next.end()) {
        shorten(path.size() - 1);
        continue;
      }
      const uint32_t to = it->second;
      next.erase(it);
      if (place[to] == kNone) {
        append(to);
        continue;
      }
      const std::vector<uint32_t> loop(path.begin() + place[to], path.end());
      shorten(place[to] + 1);
      double length = 0;
      for (size_t i = 0; i < loop.size(); ++i) length += BorderEdge(loop, i);
      if (length > longest) {
        longest = length;
        best = loop;
      }
    }
    return best;
  }

  const Chart& chart_;
  std::vector<Rest> rest_;
  std::optional<HeldLaplacian> laplacian_;
};

bool Better(const Flat& a, const Flat& b) {
  return a.flipped != b.flipped ? a.flipped < b.flipped : a.energy < b.energy;
}

bool Finite(const std::vector<dvec2>& uv) {
  return std::all_of(uv.begin(), uv.end(), [](const dvec2& p) { return std::isfinite(p.x) && std::isfinite(p.y); });
}

// The chart's area in the plane is made that on the skin (the method shrinks what is curved); its corner goes to 0.
void Normalize(const Chart& chart, Flat* flat) {
  double area = 0;
  for (const Triangle& t : chart.triangles) area += std::abs(SignedArea(flat->uv, t));
  const double scale = area > 0 ? std::sqrt(chart.area / area) : 1;
  dvec2 low = flat->uv[0];
  for (const dvec2& p : flat->uv) low = glm::min(low, p);
  for (dvec2& p : flat->uv) p = (p - low) * scale;
}

}  // namespace

Flat FlattenChart(const Chart& chart) {
  const Flattener flattener(chart);
  const std::optional<std::vector<dvec2>> model = flattener.FromModel();
  std::optional<Flat> best;
  const auto consider = [&](Flat flat) {
    if (Finite(flat.uv) && (!best || Better(flat, *best))) best = std::move(flat);
  };
  const auto folded = [&] { return !best || best->flipped > 0; };
  if (flattener.HasBorder()) {
    if (model) consider(flattener.Relax(*model));
    if (best && folded()) consider(flattener.Open(best->uv));
    if (folded()) {
      if (const std::optional<std::vector<dvec2>> circle = flattener.FromCircle()) {
        consider(flattener.Open(flattener.Relax(*circle).uv));
      }
    }
    if (folded()) consider(flattener.Relax(flattener.Projected()));
    if (best) best = flattener.Even(std::move(best->uv));
  }
  // Worse than the model's own, or closed, so that every flat map of it folds: nothing is gained.
  if (model && folded()) {
    Flat kept = flattener.Judge(*model);
    kept.kept = true;
    if (!best || best->flipped > kept.flipped || !Finite(best->uv)) best = std::move(kept);
  }
  if (!best) best = flattener.Judge(flattener.Projected());
  Normalize(chart, &*best);
  return std::move(*best);
}

std::optional<Flat> RelaxModelUv(const Chart& chart) {
  const Flattener flattener(chart);
  const std::optional<std::vector<dvec2>> model = flattener.FromModel();
  if (!model) return {};
  return flattener.Relax(*model);
}

}  // namespace fur::furuv

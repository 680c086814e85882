#include "builtin_atlas.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numeric>

#include "builtin_shape.h"

namespace fur::builtin {
namespace {

using glm::dvec2;
using glm::dvec3;

constexpr uint32_t kNone = ~0u;
constexpr double kGutterTexels = 5;

uint32_t NextCorner(uint32_t c) { return c % 3 == 2 ? c - 2 : c + 1; }

// For each corner (the edge from it to the next): the triangle on the other side.
std::vector<uint32_t> NeighborTriangles(const std::vector<uint32_t>& indices) {
  std::map<std::pair<uint32_t, uint32_t>, uint32_t> directed;
  for (uint32_t c = 0; c < indices.size(); ++c) directed[{indices[c], indices[NextCorner(c)]}] = c / 3;
  std::vector<uint32_t> neighbors(indices.size(), kNone);
  for (uint32_t c = 0; c < indices.size(); ++c) {
    const auto it = directed.find({indices[NextCorner(c)], indices[c]});
    if (it != directed.end()) neighbors[c] = it->second;
  }
  return neighbors;
}

uint32_t RegionOf(const dvec3& p) {
  const auto d = RegionDistances(p);
  return static_cast<uint32_t>(std::min_element(d.begin(), d.end()) - d.begin());
}

// 0..5: +x -x +y -y +z -z.
uint32_t DominantAxis(const dvec3& n) {
  const dvec3 a = glm::abs(n);
  const int axis = a.x >= a.y && a.x >= a.z ? 0 : a.y >= a.z ? 1 : 2;
  return static_cast<uint32_t>(axis * 2 + (n[axis] < 0 ? 1 : 0));
}

// Charts are connected patches of one region that face one of a few ways: the six axes, or two halves where that is
// enough to unroll the part.
class Charts {
 public:
  Charts(const Mesh& mesh) : mesh_(mesh), neighbors_(NeighborTriangles(mesh.indices)) {
    Classify();
    for (int round = 0; round < 4; ++round) Smooth();
    while (Connect(), MergeSmall()) {
    }
  }
  uint32_t Count() const { return count_; }
  uint32_t ChartOf(uint32_t triangle) const { return chart_[triangle]; }

 private:
  uint32_t TriangleCount() const { return static_cast<uint32_t>(mesh_.indices.size() / 3); }

  void Classify() {
    for (uint32_t t = 0; t < TriangleCount(); ++t) {
      dvec3 center{0}, normal{0};
      for (uint32_t c = 3 * t; c < 3 * t + 3; ++c) {
        center += mesh_.positions[mesh_.indices[c]] / 3.0;
        normal += mesh_.normals[mesh_.indices[c]];
      }
      label_.push_back(LabelOf(center, normal));
    }
  }

  static uint32_t LabelOf(const dvec3& p, const dvec3& n) {
    uint32_t region = RegionOf(p);
    if ((region == kFrontLeg || region == kHindLeg) && p.y > 0.48) region = kTorso;  // shoulders and thighs
    const uint32_t side = p.x < 0 ? 1 : 0;
    uint32_t facing = DominantAxis(n);
    const bool leg = region == kFrontLeg || region == kHindLeg;
    if (leg && facing == 2) facing = 4;  // the paw's back goes with its front
    if (region == kTail) facing = n.x > 0 ? 6 : 7;
    if (region == kEar) facing = n.z > 0 ? 6 : 7;
    const bool paired = region == kEar || leg;
    return (region * 8 + facing) * 2 + (paired ? side : 0);
  }

  // A triangle with two neighbours of one other label joins them: borders lose their teeth.
  void Smooth() {
    std::vector<uint32_t> next = label_;
    for (uint32_t t = 0; t < TriangleCount(); ++t) {
      std::array<uint32_t, 3> l;
      for (uint32_t i = 0; i < 3; ++i) l[i] = LabelAcross(3 * t + i);
      for (uint32_t i = 0; i < 3; ++i) {
        if (l[i] == l[(i + 1) % 3]) next[t] = l[i];
      }
    }
    label_ = std::move(next);
  }
  uint32_t LabelAcross(uint32_t corner) const {
    const uint32_t n = neighbors_[corner];
    return label_[n == kNone ? corner / 3 : n];
  }

  void Connect() {
    chart_.assign(TriangleCount(), kNone);
    count_ = 0;
    for (uint32_t seed = 0; seed < TriangleCount(); ++seed) {
      if (chart_[seed] == kNone) Flood(seed, count_++);
    }
  }
  void Flood(uint32_t seed, uint32_t chart) {
    std::vector<uint32_t> stack{seed};
    chart_[seed] = chart;
    while (!stack.empty()) {
      const uint32_t t = stack.back();
      stack.pop_back();
      for (uint32_t c = 3 * t; c < 3 * t + 3; ++c) {
        const uint32_t n = neighbors_[c];
        if (n == kNone || chart_[n] != kNone || label_[n] != label_[t]) continue;
        chart_[n] = chart;
        stack.push_back(n);
      }
    }
  }

  // Charts of few triangles take the label of the neighbour with the longest common border. True if any did.
  bool MergeSmall() {
    constexpr uint32_t kSmall = 24;
    std::vector<uint32_t> sizes(count_, 0);
    for (uint32_t chart : chart_) ++sizes[chart];
    const auto smallest = static_cast<uint32_t>(std::min_element(sizes.begin(), sizes.end()) - sizes.begin());
    if (sizes[smallest] >= kSmall || count_ < 2) return false;
    std::map<uint32_t, uint32_t> border;
    for (uint32_t c = 0; c < mesh_.indices.size(); ++c) {
      if (chart_[c / 3] == smallest && neighbors_[c] != kNone && chart_[neighbors_[c]] != smallest) {
        ++border[label_[neighbors_[c]]];
      }
    }
    if (border.empty()) return false;
    const auto best = std::max_element(border.begin(), border.end(),
                                       [](const auto& a, const auto& b) { return a.second < b.second; });
    for (uint32_t t = 0; t < TriangleCount(); ++t) {
      if (chart_[t] == smallest) label_[t] = best->first;
    }
    return true;
  }

  const Mesh& mesh_;
  std::vector<uint32_t> neighbors_, label_, chart_;
  uint32_t count_ = 0;
};

// One chart laid flat: its own vertices, in units of length.
struct Flat {
  std::vector<uint32_t> source;  // mesh vertex of each
  std::vector<dvec2> uv;
  std::vector<uint32_t> indices;
  dvec2 size{0};
};

std::vector<Flat> SplitCharts(const Mesh& mesh, const Charts& charts) {
  std::vector<Flat> flats(charts.Count());
  std::vector<std::map<uint32_t, uint32_t>> known(charts.Count());
  for (uint32_t c = 0; c < mesh.indices.size(); ++c) {
    const uint32_t chart = charts.ChartOf(c / 3);
    Flat& flat = flats[chart];
    const auto [it, isNew] = known[chart].try_emplace(mesh.indices[c], static_cast<uint32_t>(flat.source.size()));
    if (isNew) flat.source.push_back(mesh.indices[c]);
    flat.indices.push_back(it->second);
  }
  return flats;
}

// Projected along the chart's mean normal, u along its mean comb direction: strands that bend along +u then lie the
// natural way. u x v = normal, so no chart is mirrored.
void ProjectChart(const Mesh& mesh, Flat* flat) {
  dvec3 normal{0}, comb{0};
  for (uint32_t v : flat->source) {
    normal += mesh.normals[v];
    comb += CombDirection(mesh.positions[v], mesh.normals[v]);
  }
  normal = glm::normalize(normal);
  comb -= normal * glm::dot(normal, comb);
  if (glm::length(comb) < 1e-6) comb = glm::cross(normal, std::abs(normal.x) < 0.9 ? dvec3(1, 0, 0) : dvec3(0, 1, 0));
  const dvec3 u = glm::normalize(comb), v = glm::cross(normal, u);
  for (uint32_t s : flat->source) flat->uv.emplace_back(glm::dot(u, mesh.positions[s]), glm::dot(v, mesh.positions[s]));
}

double UvArea(const Flat& flat, size_t t) {
  const dvec2 a = flat.uv[flat.indices[t]], b = flat.uv[flat.indices[t + 1]], c = flat.uv[flat.indices[t + 2]];
  return ((b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x)) / 2;
}

double TrueArea(const Mesh& mesh, const Flat& flat, size_t t) {
  const auto p = [&](size_t i) { return mesh.positions[flat.source[flat.indices[t + i]]]; };
  return glm::length(glm::cross(p(1) - p(0), p(2) - p(0))) / 2;
}

// Position-based constraints (Mueller et al. 2007, "Position Based Dynamics", sections 3.3 and 4): every edge is pulled
// to its true length ...
void PullEdges(const Mesh& mesh, Flat* flat) {
  for (uint32_t c = 0; c < flat->indices.size(); ++c) {
    const uint32_t a = flat->indices[c], b = flat->indices[NextCorner(c)];
    const double want = glm::length(mesh.positions[flat->source[a]] - mesh.positions[flat->source[b]]);
    const dvec2 d = flat->uv[b] - flat->uv[a];
    const double have = glm::length(d);
    if (have < 1e-9) continue;
    const dvec2 move = d * (0.25 * (1 - want / have));
    flat->uv[a] += move;
    flat->uv[b] -= move;
  }
}

// ... and every triangle that is much too small, or turned over, is opened along the gradient of its signed area.
void OpenTriangles(const Mesh& mesh, Flat* flat) {
  for (size_t t = 0; t < flat->indices.size(); t += 3) {
    const double want = TrueArea(mesh, *flat, t), have = UvArea(*flat, t);
    if (have > 0.6 * want) continue;
    std::array<dvec2, 3> gradient;
    double sum = 1e-12;
    for (size_t i = 0; i < 3; ++i) {
      const dvec2 edge = flat->uv[flat->indices[t + (i + 2) % 3]] - flat->uv[flat->indices[t + (i + 1) % 3]];
      gradient[i] = dvec2(-edge.y, edge.x) / 2.0;
      sum += glm::dot(gradient[i], gradient[i]);
    }
    for (size_t i = 0; i < 3; ++i) flat->uv[flat->indices[t + i]] += gradient[i] * ((0.7 * want - have) / sum * 0.6);
  }
}

void Unstretch(const Mesh& mesh, Flat* flat, int rounds) {
  for (int round = 0; round < rounds; ++round) {
    PullEdges(mesh, flat);
    OpenTriangles(mesh, flat);
  }
}

// The area in the plane is made that on the body, and the chart moved to the origin.
void Normalize(const Mesh& mesh, Flat* flat) {
  double area = 0, flatArea = 0;
  for (size_t t = 0; t < flat->indices.size(); t += 3) {
    area += TrueArea(mesh, *flat, t);
    flatArea += UvArea(*flat, t);
  }
  const double scale = std::sqrt(area / std::max(1e-12, flatArea));
  dvec2 low{1e9}, high{-1e9};
  for (dvec2& uv : flat->uv) {
    uv *= scale;
    low = glm::min(low, uv);
    high = glm::max(high, uv);
  }
  for (dvec2& uv : flat->uv) uv -= low;
  flat->size = high - low;
}

// Shelves, tallest chart first, for a square of width 1 at the given scale. False if they do not fit.
bool PackShelves(const std::vector<Flat>& flats, const std::vector<size_t>& order, double scale, double gutter,
                 std::vector<dvec2>* origins) {
  dvec2 pen{gutter};
  double shelf = 0;
  for (size_t i : order) {
    const dvec2 size = flats[i].size * scale;
    if (pen.x + size.x + gutter > 1) {
      pen = {gutter, pen.y + shelf + gutter};
      shelf = 0;
    }
    if (pen.x + size.x + gutter > 1 || pen.y + size.y + gutter > 1) return false;
    (*origins)[i] = pen;
    pen.x += size.x + gutter;
    shelf = std::max(shelf, size.y);
  }
  return true;
}

double Pack(const std::vector<Flat>& flats, double gutter, std::vector<dvec2>* origins) {
  std::vector<size_t> order(flats.size());
  std::iota(order.begin(), order.end(), 0u);
  std::stable_sort(order.begin(), order.end(), [&](size_t a, size_t b) { return flats[a].size.y > flats[b].size.y; });
  double good = 1e-3, bad = 10;
  for (int i = 0; i < 40; ++i) {
    const double middle = (good + bad) / 2;
    (PackShelves(flats, order, middle, gutter, origins) ? good : bad) = middle;
  }
  (void)PackShelves(flats, order, good, gutter, origins);
  return good;
}

}  // namespace

Atlas MakeAtlas(const Mesh& mesh, uint32_t size) {
  const Charts charts(mesh);
  std::vector<Flat> flats = SplitCharts(mesh, charts);
  for (Flat& flat : flats) {
    ProjectChart(mesh, &flat);
    Unstretch(mesh, &flat, 80);
    Normalize(mesh, &flat);
  }
  std::vector<dvec2> origins(flats.size());
  Atlas atlas;
  atlas.charts = charts.Count();
  atlas.uvPerUnit = Pack(flats, kGutterTexels / size, &origins);
  for (size_t i = 0; i < flats.size(); ++i) {
    const auto base = static_cast<uint32_t>(atlas.vertices.size());
    for (size_t v = 0; v < flats[i].source.size(); ++v) {
      const uint32_t s = flats[i].source[v];
      const glm::vec2 uv(origins[i] + flats[i].uv[v] * atlas.uvPerUnit);
      atlas.vertices.push_back(
          {.position = glm::vec3(mesh.positions[s]), .normal = glm::vec3(mesh.normals[s]), .uv = uv});
    }
    for (uint32_t index : flats[i].indices) atlas.indices.push_back(base + index);
  }
  FillTangents(&atlas.vertices, atlas.indices);
  return atlas;
}

void FillTangents(std::vector<Vertex>* vertices, const std::vector<uint32_t>& indices) {
  std::vector<dvec3> du(vertices->size(), dvec3(0)), dv(vertices->size(), dvec3(0));
  for (size_t t = 0; t + 2 < indices.size(); t += 3) {
    const Vertex &a = (*vertices)[indices[t]], &b = (*vertices)[indices[t + 1]], &c = (*vertices)[indices[t + 2]];
    const dvec3 e1 = dvec3(b.position) - dvec3(a.position), e2 = dvec3(c.position) - dvec3(a.position);
    const dvec2 s = dvec2(b.uv) - dvec2(a.uv), r = dvec2(c.uv) - dvec2(a.uv);
    const double det = s.x * r.y - s.y * r.x;
    if (std::abs(det) < 1e-18) continue;
    for (size_t i = t; i < t + 3; ++i) {
      du[indices[i]] += (e1 * r.y - e2 * s.y) / det;
      dv[indices[i]] += (e2 * s.x - e1 * r.x) / det;
    }
  }
  for (size_t v = 0; v < vertices->size(); ++v) {
    const dvec3 n = (*vertices)[v].normal;
    dvec3 t = du[v] - n * glm::dot(n, du[v]);
    if (glm::length(t) < 1e-9) t = glm::cross(n, std::abs(n.y) < 0.9 ? dvec3(0, 1, 0) : dvec3(1, 0, 0));
    t = glm::normalize(t);
    const float w = glm::dot(glm::cross(n, t), dv[v]) < 0 ? -1.0f : 1.0f;
    (*vertices)[v].tangent = glm::vec4(glm::vec3(t), w);
  }
}

dvec3 CombDirection(const dvec3& p, const dvec3& normal) {
  const auto d = RegionDistances(p);
  const std::array<dvec3, kRegionCount> along = {
      dvec3(0, -0.35, -1), dvec3(0, 0.1, -1),   dvec3(0, 1, -0.2),
      dvec3(0, -1, -0.1),  dvec3(0, -1, -0.15), dvec3(0, p.z < -0.9 ? 1 : -0.1, p.z < -1.0 ? 0.05 : -1)};
  dvec3 sum{0};
  for (uint32_t r = 0; r < kRegionCount; ++r) sum += along[r] * std::exp(-18 * std::max(0.0, d[r]));
  sum /= glm::length(sum);
  const dvec3 tangential = sum - normal * glm::dot(normal, sum);
  return tangential;
}

}  // namespace fur::builtin

#include "fur_uv_charts.h"

#include <algorithm>
#include <bit>
#include <map>

#include "union_find.h"

namespace fur::furuv {
namespace {

using glm::dvec2;
using glm::dvec3;

// x + 0 turns -0 into 0 and leaves everything else alone.
uint32_t Bits(float x) { return std::bit_cast<uint32_t>(x + 0.0f); }

// For each vertex the first one with the same position and model UV: an unindexed mesh has the charts of an indexed
// one.
std::vector<uint32_t> WeldByPositionAndUv(const std::vector<Vertex>& vertices) {
  std::map<std::array<uint32_t, 5>, uint32_t> first;
  std::vector<uint32_t> welded(vertices.size());
  for (uint32_t i = 0; i < vertices.size(); ++i) {
    const Vertex& v = vertices[i];
    const std::array<uint32_t, 5> key{Bits(v.position.x), Bits(v.position.y), Bits(v.position.z), Bits(v.uv.x),
                                      Bits(v.uv.y)};
    welded[i] = first.try_emplace(key, i).first->second;
  }
  return welded;
}

dvec3 FaceNormal(const Chart& chart, const Triangle& t) {
  return glm::cross(chart.positions[t[1]] - chart.positions[t[0]], chart.positions[t[2]] - chart.positions[t[0]]) / 2.0;
}

// Turns triangles so that neighbours agree, then whole patches so that most of the skin agrees with its normals. A
// triangle is not judged by its own normals: on a sliver or a sharp fold they may point anywhere.
class Orienter {
 public:
  explicit Orienter(Chart* chart) : chart_(*chart) {}

  void Run() {
    CollectEdges();
    std::vector<bool> seen(chart_.triangles.size());
    for (uint32_t t = 0; t < chart_.triangles.size(); ++t) {
      if (!seen[t]) TurnPatch(Flood(t, &seen));
    }
  }

 private:
  void CollectEdges() {
    for (uint32_t t = 0; t < chart_.triangles.size(); ++t) {
      for (uint32_t i = 0; i < 3; ++i) edges_[Key(t, i)].push_back(t);
    }
  }

  std::pair<uint32_t, uint32_t> Key(uint32_t t, uint32_t i) const {
    return std::minmax(chart_.triangles[t][i], chart_.triangles[t][(i + 1) % 3]);
  }

  bool Has(uint32_t t, uint32_t from, uint32_t to) const {
    const Triangle& v = chart_.triangles[t];
    return (v[0] == from && v[1] == to) || (v[1] == from && v[2] == to) || (v[2] == from && v[0] == to);
  }

  std::vector<uint32_t> Flood(uint32_t first, std::vector<bool>* seen) {
    std::vector<uint32_t> patch{first};
    (*seen)[first] = true;
    for (size_t at = 0; at < patch.size(); ++at) {
      const uint32_t t = patch[at];
      for (uint32_t i = 0; i < 3; ++i) {
        const std::vector<uint32_t>& around = edges_.at(Key(t, i));
        if (around.size() != 2) continue;  // no side of a crowded edge is more of a neighbour than another
        const uint32_t other = around[0] == t ? around[1] : around[0];
        if ((*seen)[other]) continue;
        (*seen)[other] = true;
        if (Has(other, chart_.triangles[t][i], chart_.triangles[t][(i + 1) % 3])) Turn(other);
        patch.push_back(other);
      }
    }
    return patch;
  }

  void TurnPatch(const std::vector<uint32_t>& patch) {
    double agreement = 0;
    for (uint32_t t : patch) {
      const Triangle& v = chart_.triangles[t];
      const dvec3 normals = chart_.normals[v[0]] + chart_.normals[v[1]] + chart_.normals[v[2]];
      agreement += glm::dot(FaceNormal(chart_, v), normals);
    }
    if (agreement < 0) std::for_each(patch.begin(), patch.end(), [&](uint32_t t) { Turn(t); });
  }

  void Turn(uint32_t t) { std::swap(chart_.triangles[t][1], chart_.triangles[t][2]); }

  Chart& chart_;
  std::map<std::pair<uint32_t, uint32_t>, std::vector<uint32_t>> edges_;  // undirected, with their triangles
};

}  // namespace

double AreaOf(const Chart& chart, const Triangle& t) { return glm::length(FaceNormal(chart, t)); }

Charts FindCharts(const Primitive& primitive) {
  const std::vector<Vertex>& vertices = primitive.vertices;
  const std::vector<uint32_t>& indices = primitive.indices;
  const std::vector<uint32_t> welded = WeldByPositionAndUv(vertices);
  UnionFind groups(vertices.size());
  for (size_t i = 0; i + 2 < indices.size(); i += 3) {
    groups.Join(welded[indices[i]], welded[indices[i + 1]]);
    groups.Join(welded[indices[i]], welded[indices[i + 2]]);
  }

  Charts out;
  out.chartOf.assign(vertices.size(), kNone);
  out.vertexOf.assign(vertices.size(), kNone);
  std::vector<uint32_t> chartOfGroup(vertices.size(), kNone);
  const auto place = [&](uint32_t w, uint32_t group) {
    if (out.vertexOf[w] == kNone) {
      Chart& chart = out.charts[out.chartOf[w] = chartOfGroup[group]];
      out.vertexOf[w] = static_cast<uint32_t>(chart.positions.size());
      chart.positions.emplace_back(vertices[w].position);
      chart.modelUv.emplace_back(vertices[w].uv);
      chart.normals.emplace_back(0);
    }
    return out.vertexOf[w];
  };
  std::vector<bool> used(vertices.size());
  for (size_t i = 0; i + 2 < indices.size(); i += 3) {
    const uint32_t group = groups.Root(welded[indices[i]]);
    if (chartOfGroup[group] == kNone) {
      chartOfGroup[group] = static_cast<uint32_t>(out.charts.size());
      out.charts.emplace_back();
    }
    Triangle t{};
    for (size_t k = 0; k < 3; ++k) {
      t[k] = place(welded[indices[i + k]], group);
      used[indices[i + k]] = true;
    }
    out.charts[chartOfGroup[group]].triangles.push_back(t);
  }
  for (uint32_t v = 0; v < vertices.size(); ++v) {
    if (!used[v]) continue;
    out.chartOf[v] = out.chartOf[welded[v]];
    out.vertexOf[v] = out.vertexOf[welded[v]];
    out.charts[out.chartOf[v]].normals[out.vertexOf[v]] += dvec3(vertices[v].normal);
  }
  for (Chart& chart : out.charts) {
    Orienter(&chart).Run();
    for (const Triangle& t : chart.triangles) chart.area += AreaOf(chart, t);
  }
  return out;
}

}  // namespace fur::furuv

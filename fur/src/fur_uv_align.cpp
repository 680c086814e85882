#include "fur_uv_align.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <map>
#include <queue>

namespace fur::furuv {
namespace {

using glm::dvec2;
using glm::dvec3;
using Turn = std::complex<double>;  // a direction in a tangent plane, or the turn between two

// Where fur is to lean, by default: towards the tail of an animal that looks along +z, as glTF's assets do, or down; of
// these the box's longest side.
dvec3 LeanDirection(const Primitive& primitive) {
  dvec3 low{HUGE_VAL}, high{-HUGE_VAL};
  for (uint32_t i : primitive.indices) {
    low = glm::min(low, dvec3(primitive.vertices[i].position));
    high = glm::max(high, dvec3(primitive.vertices[i].position));
  }
  const dvec3 size = high - low;
  if (size.z >= size.x && size.z >= size.y) return {0, 0, -1};
  return size.y >= size.x ? dvec3(0, -1, 0) : dvec3(1, 0, 0);
}

// Half the length of the border at each vertex: the share of a seam that it stands for.
std::vector<double> BorderShares(const Chart& chart) {
  std::map<std::pair<uint32_t, uint32_t>, int> edges;
  for (const Triangle& t : chart.triangles) {
    for (size_t i = 0; i < 3; ++i) ++edges[std::minmax(t[i], t[(i + 1) % 3])];
  }
  std::vector<double> shares(chart.positions.size());
  for (const auto& [edge, count] : edges) {
    if (count != 1) continue;
    const double half = glm::length(chart.positions[edge.first] - chart.positions[edge.second]) / 2;
    shares[edge.first] += half;
    shares[edge.second] += half;
  }
  return shares;
}

// Charts are nodes, seams are edges that know by which turn their charts should differ: angular synchronisation
// (Singer 2011, "Angular synchronization by eigenvectors and semidefinite programming"), here by taking the chart
// that is most decided first and then giving each in turn its best angle.
class Aligner {
 public:
  Aligner(const Primitive& primitive, const Charts& charts, std::span<const uint32_t> weld,
          const std::vector<std::vector<dvec2>>& uvs)
      : primitive_(primitive), charts_(charts), seams_(charts.charts.size()), wish_(charts.charts.size()) {
    for (size_t c = 0; c < charts.charts.size(); ++c) {
      frames_.push_back(FramesOf(charts.charts[c], uvs[c]));
      shares_.push_back(BorderShares(charts.charts[c]));
    }
    AddSeams(weld);
    AddWishes();
  }

  std::vector<Turn> Run() {
    Place();
    constexpr int kRounds = 30;
    for (int round = 0; round < kRounds; ++round) {
      for (size_t c = 0; c < turn_.size(); ++c) Decide(c);
    }
    return turn_;
  }

 private:
  // The direction of t in the plane of n, against an arbitrary but fixed axis of that plane.
  static Turn InPlane(const dvec3& n, const dvec3& t) {
    const dvec3 x = glm::cross(std::abs(n.y) < 0.9 * glm::length(n) ? dvec3(0, 1, 0) : dvec3(1, 0, 0), n);
    const Turn turn(glm::dot(t, x) * glm::length(n), glm::dot(t, glm::cross(n, x)));
    const double length = std::abs(turn);
    return length > 0 ? turn / length : Turn(0);
  }

  void AddSeams(std::span<const uint32_t> weld) {
    std::vector<std::vector<uint32_t>> at(primitive_.vertices.size());  // welded: one vertex of each chart there
    for (uint32_t v = 0; v < primitive_.vertices.size(); ++v) {
      const auto same = [&](uint32_t o) {
        return charts_.chartOf[o] == charts_.chartOf[v] && charts_.vertexOf[o] == charts_.vertexOf[v];
      };
      std::vector<uint32_t>& here = at[weld[v]];
      if (charts_.chartOf[v] != kNone && std::none_of(here.begin(), here.end(), same)) here.push_back(v);
    }
    for (const std::vector<uint32_t>& here : at) {
      if (here.size() < 2) continue;
      dvec3 normal{0};
      for (uint32_t v : here) normal += charts_.charts[charts_.chartOf[v]].normals[charts_.vertexOf[v]];
      for (uint32_t a : here) {
        for (uint32_t b : here) AddSeam(a, b, normal);
      }
    }
  }

  void AddSeam(uint32_t a, uint32_t b, const dvec3& normal) {
    const uint32_t chartA = charts_.chartOf[a], chartB = charts_.chartOf[b];
    if (chartA == chartB) return;
    const uint32_t inA = charts_.vertexOf[a], inB = charts_.vertexOf[b];
    const double weight = std::min(shares_[chartA][inA], shares_[chartB][inB]);
    const Turn between = InPlane(normal, frames_[chartA][inA].du) * std::conj(InPlane(normal, frames_[chartB][inB].du));
    seams_[chartA][chartB] += weight * between;
  }

  // What a chart would do alone: u along the lean's projection. It counts little against the seams, as a leg's front
  // and back both have to follow a lean that only its sides see.
  void AddWishes() {
    constexpr double kWeight = 0.1;
    const dvec3 lean = LeanDirection(primitive_);
    for (size_t c = 0; c < wish_.size(); ++c) {
      const Chart& chart = charts_.charts[c];
      double border = 0, area = 0;
      for (const Triangle& t : chart.triangles) {
        const double share = AreaOf(chart, t) / 3;
        for (uint32_t v : t) {
          const dvec3 n = chart.normals[v];
          const double length = glm::length(n);
          if (!(length > 0)) continue;
          const dvec3 along = lean - n * (glm::dot(lean, n) / (length * length));
          wish_[c] += share * glm::length(along) * InPlane(n, frames_[c][v].du) * std::conj(InPlane(n, along));
          area += share;
        }
      }
      for (double share : shares_[c]) border += share;
      if (area > 0) wish_[c] *= kWeight * (border > 0 ? border : std::sqrt(area)) / area;
    }
  }

  Turn Pull(size_t chart) const {
    Turn sum = wish_[chart];
    for (const auto& [other, seam] : seams_[chart]) sum += seam * turn_[other];
    return sum;
  }

  void Decide(size_t chart) {
    const Turn pull = Pull(chart);
    const double length = std::abs(pull);
    turn_[chart] = length > 0 ? pull / length : turn_[chart] == Turn(0) ? Turn(1) : turn_[chart];
  }

  // Charts that are not placed yet have turn 0 and pull nobody.
  void Place() {
    turn_.assign(seams_.size(), Turn(0));
    std::priority_queue<std::pair<double, size_t>> queue;
    for (size_t c = 0; c < seams_.size(); ++c) queue.emplace(std::abs(wish_[c]), c);
    while (!queue.empty()) {
      const size_t chart = queue.top().second;
      queue.pop();
      if (turn_[chart] != Turn(0)) continue;  // an older, weaker entry of it
      Decide(chart);
      for (const auto& [other, seam] : seams_[chart]) {
        if (turn_[other] == Turn(0)) queue.emplace(std::abs(Pull(other)), other);
      }
    }
  }

  const Primitive& primitive_;
  const Charts& charts_;
  std::vector<std::vector<Frame>> frames_;
  std::vector<std::vector<double>> shares_;
  std::vector<std::map<uint32_t, Turn>> seams_;  // for each chart: its turn over the neighbour's, times the length
  std::vector<Turn> wish_, turn_;
};

}  // namespace

std::vector<Frame> FramesOf(const Chart& chart, const std::vector<dvec2>& uv) {
  struct Side {
    Frame frame;
    double area = 0;
  };
  std::vector<std::array<Side, 2>> sides(uv.size());
  for (const Triangle& t : chart.triangles) {
    const dvec3 e = chart.positions[t[1]] - chart.positions[t[0]], f = chart.positions[t[2]] - chart.positions[t[0]];
    const dvec2 a = uv[t[1]] - uv[t[0]], b = uv[t[2]] - uv[t[0]];
    const double det = Cross(a, b);
    // A sliver's derivative may be anything.
    if (!(std::abs(det) > 1e-9 * (glm::dot(a, a) + glm::dot(b, b)))) continue;
    const double area = AreaOf(chart, t);
    for (uint32_t v : t) {
      Side& side = sides[v][det < 0 ? 1 : 0];
      side.frame.du += (e * b.y - f * a.y) * (area / det);
      side.frame.dv += (f * a.x - e * b.x) * (area / det);
      side.area += area;
    }
  }
  std::vector<Frame> frames;
  for (const auto& [upright, mirrored] : sides) {
    frames.push_back(mirrored.area > upright.area ? mirrored.frame : upright.frame);
  }
  return frames;
}

void AlignCharts(const Primitive& primitive, const Charts& charts, std::span<const uint32_t> weld,
                 std::vector<std::vector<dvec2>>* uvs) {
  const std::vector<Turn> turns = Aligner(primitive, charts, weld, *uvs).Run();
  for (size_t c = 0; c < turns.size(); ++c) {
    for (dvec2& p : (*uvs)[c]) {
      const Turn turned = turns[c] * Turn(p.x, p.y);
      p = {turned.real(), turned.imag()};
    }
  }
}

}  // namespace fur::furuv

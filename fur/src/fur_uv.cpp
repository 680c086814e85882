#include "fur/fur_uv.h"

#include <algorithm>
#include <numeric>

#include "fur/topology.h"
#include "fur_uv_align.h"
#include "fur_uv_flatten.h"

namespace fur {
namespace {

using furuv::Chart;
using furuv::Charts;
using furuv::Frame;
using glm::dvec2;
using glm::dvec3;

dvec3 UnitNormal(const Vertex& vertex) {
  const dvec3 n(vertex.normal);
  const double length = glm::length(n);
  return length > 0 ? n / length : dvec3(0, 0, 1);
}

// t made perpendicular to n; any direction where nothing is left of it.
dvec3 TangentAt(const dvec3& n, dvec3 t) {
  const double before = glm::length(t);
  t -= n * glm::dot(n, t);
  if (!(glm::length(t) > 1e-9 * before)) t = glm::cross(n, std::abs(n.y) < 0.9 ? dvec3(0, 1, 0) : dvec3(1, 0, 0));
  // Twice: the first leaves something along n where t was nearly n.
  t = glm::normalize(t);
  return glm::normalize(t - n * glm::dot(n, t));
}

void ToOrigin(std::vector<dvec2>* uv) {
  dvec2 low = uv->front();
  for (const dvec2& p : *uv) low = glm::min(low, p);
  for (dvec2& p : *uv) p -= low;
}

}  // namespace

FurUv MakeFurUv(const Primitive& primitive) {
  const Charts charts = furuv::FindCharts(primitive);
  FurUv out;
  out.charts = static_cast<uint32_t>(charts.charts.size());
  std::vector<std::vector<dvec2>> uvs;
  for (const Chart& chart : charts.charts) {
    furuv::Flat flat = furuv::FlattenChart(chart);
    out.keptCharts += flat.kept ? 1 : 0;
    uvs.push_back(std::move(flat.uv));
  }
  furuv::AlignCharts(primitive, charts, WeldByPosition(primitive.vertices).welded, &uvs);
  std::vector<std::vector<Frame>> frames;
  for (size_t c = 0; c < uvs.size(); ++c) {
    ToOrigin(&uvs[c]);
    frames.push_back(furuv::FramesOf(charts.charts[c], uvs[c]));
  }
  for (size_t v = 0; v < primitive.vertices.size(); ++v) {
    const uint32_t chart = charts.chartOf[v], in = charts.vertexOf[v];
    const Frame frame = chart == furuv::kNone ? Frame{} : frames[chart][in];
    const dvec3 n = UnitNormal(primitive.vertices[v]);
    out.uv.push_back(chart == furuv::kNone ? dvec2(0) : uvs[chart][in]);
    out.tangent.push_back(TangentAt(n, frame.du));
    out.handedness.push_back(glm::dot(glm::cross(n, out.tangent.back()), frame.dv) < 0 ? -1.0f : 1.0f);
  }
  return out;
}

UvSpread MeasureSpread(const Primitive& primitive, std::span<const dvec2> uv) {
  struct Sample {
    double scale, area;
  };
  UvSpread out;
  std::vector<Sample> samples;
  double total = 0, leftArea = 0;
  uint32_t lefts = 0, rights = 0;
  for (size_t i = 0; i + 2 < primitive.indices.size(); i += 3) {
    const uint32_t a = primitive.indices[i], b = primitive.indices[i + 1], c = primitive.indices[i + 2];
    const std::vector<Vertex>& v = primitive.vertices;
    const dvec3 p(v[a].position);
    const dvec3 face = glm::cross(dvec3(v[b].position) - p, dvec3(v[c].position) - p) / 2.0;
    const double area = glm::length(face), flat = furuv::Cross(uv[b] - uv[a], uv[c] - uv[a]) / 2;
    if (!(area > 0)) continue;
    samples.push_back({std::sqrt(std::abs(flat) / area), area});
    total += area;
    const bool left = glm::dot(face, dvec3(v[a].normal + v[b].normal + v[c].normal)) * flat < 0;
    leftArea += left ? area : 0;
    lefts += left ? 1 : 0;
    rights += left || flat == 0 ? 0 : 1;
  }
  out.flipped = leftArea > total / 2 ? rights : lefts;
  std::stable_sort(samples.begin(), samples.end(), [](const Sample& x, const Sample& y) { return x.scale < y.scale; });
  const auto percentile = [&](double share) {
    double below = 0;
    for (const Sample& s : samples) {
      if ((below += s.area) >= share * total) return s.scale;
    }
    return samples.empty() ? 0 : samples.back().scale;
  };
  out.p5 = percentile(0.05);
  out.median = percentile(0.5);
  out.p95 = percentile(0.95);
  return out;
}

}  // namespace fur

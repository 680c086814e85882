#include "fur_uv_laplacian.h"

#include <algorithm>

namespace fur::furuv {
namespace {

using glm::dvec2;
using glm::dvec3;

// The cotangent of the angle between two edges. With cotangents as weights the energy below is the integral of
// |J - R|^2 (Liu et al. 2008, equation 3). The floor keeps every weight positive where an angle is obtuse: the matrix
// is then positive definite and Tutte's theorem holds; the ceiling keeps slivers from drowning everything else.
double Cotangent(const dvec3& a, const dvec3& b) {
  constexpr double kFloor = 0.02, kCeiling = 200;
  const double along = glm::dot(a, b), across = glm::length(glm::cross(a, b));
  if (!(across > 0)) return along > 0 ? kCeiling : kFloor;
  return std::clamp(along / across, kFloor, kCeiling);
}

Rest RestOf(const Chart& chart, const Triangle& t) {
  const std::array<dvec3, 3> p{chart.positions[t[0]], chart.positions[t[1]], chart.positions[t[2]]};
  const dvec3 e = p[1] - p[0], f = p[2] - p[0];
  Rest rest;
  const double base = glm::length(e);
  rest.at[1] = {base, 0};
  if (base > 0) {
    rest.at[2] = {glm::dot(e, f) / base, glm::length(glm::cross(e, f)) / base};
  } else {
    rest.at[2] = {glm::length(f), 0};
  }
  const double longest = glm::dot(e, e) + glm::dot(f, f);
  rest.solid = rest.at[1].x * rest.at[2].y > 1e-8 * longest;
  for (size_t i = 0; i < 3; ++i) {
    const dvec3 &apex = p[(i + 2) % 3], &from = p[i], &to = p[(i + 1) % 3];
    rest.weight[i] = Cotangent(from - apex, to - apex);
  }
  return rest;
}

}  // namespace

std::vector<Rest> RestOf(const Chart& chart) {
  std::vector<Rest> rest;
  rest.reserve(chart.triangles.size());
  for (const Triangle& t : chart.triangles) rest.push_back(RestOf(chart, t));
  return rest;
}

HeldLaplacian::HeldLaplacian(const Chart& chart, const std::vector<Rest>& rest, const std::vector<bool>& held)
    : row_(chart.positions.size(), kNone) {
  for (size_t v = 0; v < row_.size(); ++v) {
    if (!held[v]) row_[v] = rows_++;
  }
  std::vector<Eigen::Triplet<double>> entries;
  const auto add = [&](uint32_t a, uint32_t b, double w) {
    if (row_[a] == kNone) return;
    entries.emplace_back(row_[a], row_[a], w);
    if (row_[b] != kNone) entries.emplace_back(row_[a], row_[b], -w);
  };
  for (size_t t = 0; t < rest.size(); ++t) {
    for (size_t i = 0; i < 3; ++i) {
      const uint32_t a = chart.triangles[t][i], b = chart.triangles[t][(i + 1) % 3];
      add(a, b, rest[t].weight[i]);
      add(b, a, rest[t].weight[i]);
    }
  }
  Eigen::SparseMatrix<double> matrix(rows_, rows_);
  matrix.setFromTriplets(entries.begin(), entries.end());
  if (rows_ > 0) solver_.compute(matrix);
}

void HeldLaplacian::Scatter(const Columns& rows, std::vector<dvec2>* uv) const {
  for (size_t v = 0; v < row_.size(); ++v) {
    if (row_[v] != kNone) (*uv)[v] = {rows(row_[v], 0), rows(row_[v], 1)};
  }
}

}  // namespace fur::furuv

// What the steps of flattening share: triangles at rest, and the sparse system over a chart's vertices.
#pragma once

#include <Eigen/SparseCholesky>
#include <glm/glm.hpp>
#include <vector>

#include "fur_uv_charts.h"

namespace fur::furuv {

using Columns = Eigen::Matrix<double, Eigen::Dynamic, 2>;

// A triangle laid flat by itself: corner 0 at the origin, corner 1 on +x, corner 2 above; and the weight of each edge,
// from corner i to the next.
struct Rest {
  std::array<glm::dvec2, 3> at{};
  std::array<double, 3> weight{};
  bool solid = false;  // has an area worth the name: only then can it be turned over
};

std::vector<Rest> RestOf(const Chart&);

// The Laplacian with these weights, factored, with some vertices held: their rows are left out. Positive definite where
// every piece of the chart has a held vertex.
class HeldLaplacian {
 public:
  HeldLaplacian(const Chart&, const std::vector<Rest>&, const std::vector<bool>& held);

  uint32_t Rows() const { return rows_; }
  uint32_t RowOf(uint32_t vertex) const { return row_[vertex]; }  // kNone: held
  bool Ok() const { return rows_ == 0 || solver_.info() == Eigen::Success; }
  Columns Solve(const Columns& right) const {
    if (rows_ == 0) return right;
    return solver_.solve(right);
  }
  // Writes rows into the vertices that are not held.
  void Scatter(const Columns& rows, std::vector<glm::dvec2>* uv) const;

 private:
  std::vector<uint32_t> row_;
  uint32_t rows_ = 0;
  Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> solver_;
};

inline void AddTo(Columns* columns, uint32_t row, const glm::dvec2& value) {
  (*columns)(row, 0) += value.x;
  (*columns)(row, 1) += value.y;
}

}  // namespace fur::furuv

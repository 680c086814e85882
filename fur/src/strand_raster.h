// Areas of strands in a grid of cells.
#pragma once

#include <glm/glm.hpp>
#include <span>
#include <vector>

namespace fur {

// The hull of two discs: what a disc sweeps while it moves and shrinks evenly. Cells are 1 wide.
struct SweptDisc {
  glm::dvec2 a, b;
  double radiusA, radiusB;
  glm::dvec3 direction;  // of the strand there, unit
  double along;          // share of the strand's length
};

// What one strand covers: the union of its pieces in each cell.
class Footprint {
 public:
  // rowHeight: of a cell, in cell widths.
  explicit Footprint(double rowHeight) : rowHeight_(rowHeight) {}

  // Exact along x; along y the mean over 32 lines in each row of cells, 64 where no disc is wider than half a row.
  void Cover(std::span<const SweptDisc> pieces);

  struct Cell {
    double share = 0;         // of the cell's area, <= 1
    double weight = 0;        // sum of the pieces' shares
    glm::dvec3 direction{0};  // weighted by share
    double along = 0;         // weighted by share
  };
  // Calls visit(x, y, cell) for each cell that is covered, row by row.
  template <class F>
  void ForCovered(F visit) const {
    for (int y = 0; y < height_; ++y)
      for (int x = 0; x < width_; ++x)
        if (const Cell& cell = cells_[size_t(y) * size_t(width_) + size_t(x)]; cell.share > 0)
          visit(x0_ + x, y0_ + y, cell);
  }

 private:
  struct Hull {
    SweptDisc piece;
    glm::dvec2 corners[4];  // of the quadrilateral between the outer tangents' points
    bool hasQuad;
    double low, high;
  };
  struct Interval {
    double from, to;
  };

  static Hull MakeHull(const SweptDisc& piece);
  static bool Cut(const Hull& hull, double y, Interval* cut);
  void SetBox();
  void CoverLine(double y, int row, double part);
  template <class F>
  void ForCells(const Interval& interval, int row, F add);

  double rowHeight_;
  int x0_ = 0, y0_ = 0, width_ = 0, height_ = 0;
  std::vector<Cell> cells_;
  std::vector<Hull> hulls_;
  std::vector<Interval> line_;
};

}  // namespace fur

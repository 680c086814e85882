// Back to front by the space that a triangle's fur takes: the order in which all shells of one triangle may be blended
// before those of the next.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "fur/fur_mesh.h"

namespace fur {

// The fur of a triangle fills its prism, the triangle swept along the fur. Two prisms meet in a wall, which stands on
// their common edge along the mean way from root to tip at its ends; the one on the eye's side of the wall is nearer.
// Of two prisms without a common edge nothing is known but what the chains of neighbours between them say. (Sorting
// cells by the walls between neighbours: Max, Hanrahan, Crawfis, "Area and Volume Coherence for Efficient Visualization
// of 3D Scalar Functions", 1990.)
//
// A painter's order along every ray from the eye, where there is one and walls are flat: certainly for a convex body
// whose triangles are those of its points' hull and whose fur points away from one point. Elsewhere it is the best that
// the walls allow: fur of limbs that overlap without touching is sorted by distance alone.
class TriangleOrder {
 public:
  TriangleOrder() = default;
  // Vertices at one position count as one. An edge with more than two triangles relates those that follow each other in
  // the list. Degenerate triangles have no walls.
  TriangleOrder(std::span<const FurVertex> vertices, std::span<const uint32_t> indices);

  // The triangles' numbers, farthest first. Eye and comb (offset of the tips relative to the fur's length) in the
  // vertices' axes. Where the walls leave a choice, and where they run in a circle, the triangle whose middle is
  // farthest comes first; of equal ones the first of the list. O(n log n). A position that is not finite gives the
  // list's order.
  std::vector<uint32_t> BackToFront(const glm::dvec3& eye, const glm::dvec3& comb) const;

  // Whether the eye is on the roots' side of the triangle's middle shell: its shells then come outside in. `length`: of the
  // fur, in the vertices' units.
  bool SeenFromBehind(uint32_t triangle, const glm::dvec3& eye, const glm::dvec3& comb, double length) const;

  size_t TriangleCount() const { return middles_.size(); }

 private:
  struct Root {
    glm::dvec3 position, toTip;  // toTip: length times direction
    double length = 0;
  };
  struct Wall {  // roots: the edge's ends, then the third corner of each triangle
    uint32_t end0, end1, corner0, corner1;
    uint32_t triangle0, triangle1;
  };
  struct Relation {
    uint32_t farther, nearer;
  };
  void AddWall(uint32_t corner0, uint32_t corner1, std::span<const uint32_t> welded);
  std::vector<uint32_t> FarthestFirst(const glm::dvec3& eye) const;
  std::vector<Relation> Relations(const glm::dvec3& eye, const glm::dvec3& comb) const;

  std::vector<Root> roots_;
  std::vector<Wall> walls_;
  std::vector<uint32_t> corners_;    // three for each triangle
  std::vector<glm::dvec3> middles_;  // of the triangles
};

}  // namespace fur

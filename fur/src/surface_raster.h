// Which texel shows which point of which triangle, in a material's texture coordinates, which wrap around.
#pragma once

#include <array>
#include <vector>

#include "body.h"
#include "fur/model.h"

namespace fur {

class SurfaceRaster {
 public:
  // side x side texels. Where several places share a texel the last triangle's stands.
  SurfaceRaster(const Model&, uint32_t material, uint32_t side);

  struct Triangle {
    size_t part;
    std::array<uint32_t, 3> vertices;  // of the part's primitive
  };
  // A texel's centre in a triangle: weights of its corners.
  struct Point {
    uint32_t triangle = kNone;
    bool inside = false;  // else a little outside, so that filtering finds no holes
    std::array<double, 3> weights{};
    bool IsEmpty() const { return triangle == kNone; }
    static constexpr uint32_t kNone = ~0u;
  };
  const std::vector<Point>& Points() const { return points_; }  // row by row
  const std::vector<Triangle>& Triangles() const { return triangles_; }
  // A texel that two triangles hold: by index, what came first and what came last.
  struct Overlap {
    Point first, last;
  };
  const std::vector<Overlap>& Overlaps() const { return overlaps_; }

 private:
  void Fill(std::array<glm::dvec2, 3> uv);
  void Set(int x, int y, const Point&);
  size_t Wrapped(int i) const { return size_t((i % int(side_) + int(side_)) % int(side_)); }

  uint32_t side_;
  std::vector<Point> points_;
  std::vector<Triangle> triangles_;
  std::vector<Overlap> overlaps_;
};

// Grows what is there outwards by some texels, so that mips and filtering do not mix with what never was: `color` holds
// side x side pixels, `there` says which count.
void GrowPicture(uint32_t side, std::vector<uint8_t>* there, std::vector<glm::u8vec4>* pixels);

}  // namespace fur

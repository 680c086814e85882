#include "builtin_mesh.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "builtin_shape.h"

namespace fur::builtin {
namespace {

using glm::dvec3;
using glm::ivec3;

constexpr uint32_t kNone = ~0u;

// Grid lines along one axis; a fine stretch from `fineFrom` upwards gives the head more triangles.
std::vector<double> GridLines(double from, double to, double fineFrom, double coarse, double fine) {
  std::vector<double> lines;
  for (double x = from; x < to - fine / 2;) {
    lines.push_back(x);
    const double t = std::clamp((x - fineFrom) / 0.2 + 1, 0.0, 1.0);
    x += coarse + (fine - coarse) * t;
  }
  lines.push_back(to);
  return lines;
}

// Naive surface nets (Gibson 1998, "Constrained Elastic Surface Nets"): one vertex in every cell that the surface
// crosses, one quad for every grid edge that it crosses.
class SurfaceNets {
 public:
  SurfaceNets(std::vector<double> x, std::vector<double> y, std::vector<double> z)
      : lines_{std::move(x), std::move(y), std::move(z)} {
    for (int a = 0; a < 3; ++a) size_[a] = static_cast<int>(lines_[a].size());
    SampleField();
  }

  Mesh Run() {
    PlaceVertices();
    for (int axis = 0; axis < 3; ++axis) ConnectAcross(axis);
    return std::move(mesh_);
  }

 private:
  size_t At(ivec3 c) const { return (static_cast<size_t>(c.z) * size_.y + c.y) * size_.x + c.x; }
  dvec3 Point(ivec3 c) const { return {lines_[0][c.x], lines_[1][c.y], lines_[2][c.z]}; }

  template <class F>
  void ForGrid(ivec3 from, ivec3 to, F visit) const {
    for (int z = from.z; z < to.z; ++z) {
      for (int y = from.y; y < to.y; ++y) {
        for (int x = from.x; x < to.x; ++x) visit(ivec3(x, y, z));
      }
    }
  }

  void SampleField() {
    field_.resize(static_cast<size_t>(size_.x) * size_.y * size_.z);
    ForGrid(ivec3(0), size_, [&](ivec3 c) { field_[At(c)] = Distance(Point(c)); });
  }

  // The mean of the places where the surface crosses the cell's twelve edges.
  void PlaceVertices() {
    vertexOf_.assign(field_.size(), kNone);
    ForGrid(ivec3(0), size_ - 1, [&](ivec3 cell) {
      dvec3 sum{0};
      int count = 0;
      for (int axis = 0; axis < 3; ++axis) {
        for (int corner = 0; corner < 4; ++corner) AddCrossing(cell, axis, corner, &sum, &count);
      }
      if (count == 0) return;
      vertexOf_[At(cell)] = static_cast<uint32_t>(mesh_.positions.size());
      mesh_.positions.push_back(sum / static_cast<double>(count));
    });
  }

  void AddCrossing(ivec3 cell, int axis, int corner, dvec3* sum, int* count) const {
    ivec3 a = cell;
    a[(axis + 1) % 3] += corner & 1;
    a[(axis + 2) % 3] += corner >> 1;
    ivec3 b = a;
    b[axis] += 1;
    const double fa = field_[At(a)], fb = field_[At(b)];
    if ((fa < 0) == (fb < 0)) return;
    *sum += glm::mix(Point(a), Point(b), fa / (fa - fb));
    ++*count;
  }

  // The four cells around a grid edge, in the order that turns counter-clockwise seen from its far end.
  void ConnectAcross(int axis) {
    const int u = (axis + 1) % 3, v = (axis + 2) % 3;
    ivec3 from(1);
    from[axis] = 0;
    ForGrid(from, size_ - 1, [&](ivec3 a) {
      ivec3 b = a;
      b[axis] += 1;
      const bool insideA = field_[At(a)] < 0, insideB = field_[At(b)] < 0;
      if (insideA == insideB) return;
      std::array<uint32_t, 4> quad;
      const int du[4] = {-1, 0, 0, -1}, dv[4] = {-1, -1, 0, 0};
      for (int i = 0; i < 4; ++i) {
        ivec3 cell = a;
        cell[u] += du[i];
        cell[v] += dv[i];
        quad[i] = vertexOf_[At(cell)];
      }
      if (insideB) std::swap(quad[1], quad[3]);
      AddQuad(quad);
    });
  }

  // Split along the shorter diagonal.
  void AddQuad(const std::array<uint32_t, 4>& q) {
    const auto span = [&](int i, int j) { return glm::length(mesh_.positions[q[i]] - mesh_.positions[q[j]]); };
    const int s = span(0, 2) <= span(1, 3) ? 0 : 1;
    const auto at = [&](int i) { return q[(s + i) % 4]; };
    mesh_.indices.insert(mesh_.indices.end(), {at(0), at(1), at(2), at(0), at(2), at(3)});
  }

  std::array<std::vector<double>, 3> lines_;
  ivec3 size_{0};
  std::vector<double> field_;
  std::vector<uint32_t> vertexOf_;
  Mesh mesh_;
};

// Every vertex half-way to the mean of its neighbours, then back on the surface: triangles grow even.
void Relax(Mesh* mesh, int rounds) {
  for (int round = 0; round < rounds; ++round) {
    std::vector<dvec3> sum(mesh->positions.size(), dvec3(0));
    std::vector<int> count(mesh->positions.size(), 0);
    for (size_t i = 0; i < mesh->indices.size(); ++i) {
      const uint32_t a = mesh->indices[i], b = mesh->indices[i % 3 == 2 ? i - 2 : i + 1];
      sum[a] += mesh->positions[b];  // closed and consistently wound: every edge comes once from each end
      ++count[a];
    }
    for (size_t v = 0; v < sum.size(); ++v) {
      if (count[v] == 0) continue;
      const dvec3 mean = sum[v] / static_cast<double>(count[v]);
      mesh->positions[v] = Project(glm::mix(mesh->positions[v], mean, 0.5), 1);
    }
  }
}

}  // namespace

Mesh PolygonizeSkin() {
  const Box box = SkinBox();
  constexpr double kCoarse = 0.048, kFine = 0.033;
  SurfaceNets nets(GridLines(box.min.x, box.max.x, 1e9, 0.035, 0.035),
                   GridLines(box.min.y, box.max.y, 0.90, kCoarse, kFine),
                   GridLines(box.min.z, box.max.z, 0.45, kCoarse, kFine));
  Mesh mesh = nets.Run();
  Relax(&mesh, 8);
  for (dvec3& p : mesh.positions) {
    p = Project(p, 2);
    // The precision of the final vertices decides what is welded: round once, here.
    p = dvec3(glm::vec3(p));
    mesh.normals.push_back(Normal(p));
  }
  return mesh;
}

Mesh MakeBall(const dvec3& center, const dvec3& radii, int rings, int segments) {
  Mesh mesh;
  constexpr double kPi = 3.14159265358979324;
  for (int r = 0; r <= rings; ++r) {
    for (int s = 0; s <= segments; ++s) {
      const double polar = kPi * r / rings, around = 2 * kPi * (s % segments) / segments;
      const bool pole = r == 0 || r == rings;
      const double ring = pole ? 0 : std::sin(polar);
      const dvec3 n{ring * std::cos(around), ring * std::sin(around), std::cos(polar)};
      mesh.positions.push_back(center + radii * n);
      mesh.normals.push_back(glm::normalize(n / radii));
    }
  }
  const auto at = [&](int r, int s) { return static_cast<uint32_t>(r * (segments + 1) + s); };
  for (int r = 0; r < rings; ++r) {
    for (int s = 0; s < segments; ++s) {
      if (r > 0) mesh.indices.insert(mesh.indices.end(), {at(r, s), at(r + 1, s), at(r, s + 1)});
      if (r + 1 < rings) mesh.indices.insert(mesh.indices.end(), {at(r, s + 1), at(r + 1, s), at(r + 1, s + 1)});
    }
  }
  return mesh;
}

}  // namespace fur::builtin

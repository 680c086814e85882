// The fur above one triangle as a ray sees it. At each height h the shell is a flat triangle with the corners
// P_i(h) = p_i + h a_i + h^k c_i, so a ray meets it once: t and the barycentrics are functions of h, and what the ray
// crosses of the prism is a set of intervals of h. docs/accuracy.md.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

namespace fur::reference {

struct Ray {
  glm::dvec3 origin{0}, direction{0, 0, -1};  // unit
  double tMin = 0, tMax = 1e300;
  glm::dvec3 right{1, 0, 0}, up{0, 1, 0};     // orthonormal with the direction: SetDirection
  void SetDirection(const glm::dvec3& unit);
};

// World space.
struct Prism {
  std::array<glm::dvec3, 3> p, a, c;  // c is zero without a comb
  double bend = 1;                    // k; 1 without a comb
  uint32_t part = 0, triangle = 0;    // FurScene
  glm::dvec3 At(uint32_t corner, double h) const;
};

// A ray and a prism in the ray's axes, whose z is t.
class PrismView {
 public:
  PrismView(const Prism&, const Ray&);
  // Before secants are asked for: most prisms that a ray comes near are missed.
  void FindNormals();

  // What is known where the ray meets the shell at height h.
  struct Point {
    glm::dvec3 b{0};     // barycentrics
    double t = 0;
    double secant = 1;   // 1 / |m.w|, m the unit normal of the shell
    bool valid = false;  // false: the ray lies in the shell's plane, or there is none
  };
  Point At(double h) const;
  double Slope(double h) const;  // dt/dh; 0 where no point is valid

  // Intervals of h in [0, 1], ascending, within which the ray is inside the prism and t is monotone.
  struct Interval {
    double h0 = 0, h1 = 0;
  };
  void Intervals(std::vector<Interval>*) const;

  // The height between h0 and h1 at which the ray is at t; t(h) is monotone there.
  double Solve(double t, double h0, double h1) const;

 private:
  // F_i(h) = edge function of the edge opposite to corner i; coefficients of 1, h, g, h^2, h g, g^2 with g = h^k.
  using Edge = std::array<double, 6>;
  // Bent fur has at most 6 roots an edge: a, b, c span (1, h, g)^2, and k is at least 1.
  struct Cuts {
    std::array<double, 32> h;
    uint32_t count = 0;
    void Add(double value) {
      if (count < h.size()) h[count++] = value;
    }
  };
  Edge Across(size_t i, size_t j, int x, int y) const;
  double Value(const Edge& e, double h, double g) const {
    const double plain = e[0] + h * (e[1] + h * e[3]);
    return combed_ ? plain + g * (e[2] + h * e[4] + g * e[5]) : plain;
  }
  void AddRoots(const Edge&, Cuts*) const;
  void Isolate(const Edge&, double h0, double h1, int depth, Cuts*) const;
  double Side(size_t edge, double h, double g) const;
  bool Inside(double h) const;
  bool MayMeet() const;
  void AddMonotone(double h0, double h1, std::vector<Interval>*) const;
  double Power(double h) const { return combed_ ? (bend_ == 2 ? h * h : std::pow(h, bend_)) : h; }

  std::array<glm::dvec3, 3> q_, a_, c_;
  std::array<Edge, 3> edges_;
  std::array<Edge, 2> normal_{};  // of the shell, not unit, by two of its components
  double bend_, noArea_ = 0;
  bool combed_;
};

}  // namespace fur::reference

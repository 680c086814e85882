#include "clump.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

namespace fur::reference {
namespace {

constexpr double kAcross = 4;          // clumps across a tile
constexpr double kMostDrawn = 0.75;    // of the way to the site, at the tip of a coat of clumping 1
constexpr double kTileOverLength = 4;  // of a baked coat: a tile is four lengths of the fur wide
constexpr double kSoftBorder = 8;      // a border is 1/8 of a cell wide

// Hash lowbias32: C. Wellons, "Prospecting for hash functions" (2018).
uint32_t Hash(uint32_t x) {
  x = (x ^ (x >> 16)) * 0x7feb352du;
  x = (x ^ (x >> 15)) * 0x846ca68bu;
  return x ^ (x >> 16);
}

// Within the middle half of its cell.
glm::dvec2 Site(const glm::dvec2& cell) {
  const auto whole = [](double x) { return uint32_t(int32_t(x)); };
  const uint32_t h = Hash(whole(cell.x) + Hash(whole(cell.y)));
  return cell + 0.25 + glm::dvec2(h & 0xffff, h >> 16) * (0.5 / 65536);
}

// Distance from the line half-way between two sites.
double Margin(const glm::dvec2& at, const glm::dvec2& own, const glm::dvec2& other) {
  const glm::dvec2 across = own - other;
  const double apart = glm::length(across);
  return apart > 0 ? glm::dot(at - (own + other) * 0.5, across) / apart : 1;
}

}  // namespace

Clump ClumpAt(const glm::dvec2& tiles, double h, double clumping) {
  const glm::dvec2 p = tiles * kAcross, cell = glm::floor(p - 0.5);
  const std::array<glm::dvec2, 4> sites{Site(cell), Site(cell + glm::dvec2(1, 0)), Site(cell + glm::dvec2(0, 1)),
                                        Site(cell + glm::dvec2(1, 1))};
  glm::dvec2 own = sites[0];
  for (const glm::dvec2& s : sites)
    if (glm::dot(s - p, s - p) < glm::dot(own - p, own - p)) own = s;
  const double drawn = kMostDrawn * clumping, q = drawn * h * h;
  Clump c;
  c.spread = 1 / (1 - q);
  const glm::dvec2 root = own + (p - own) * c.spread;
  double margin = 1;
  for (const glm::dvec2& s : sites) margin = std::min(margin, Margin(root, own, s));
  c.inside = std::clamp(1 + kSoftBorder * margin, 0.0, 1.0);
  c.root = root / kAcross;
  // d/dh of the way to the site; the volume's y axis runs against v.
  const double steep = 2 * drawn * h * kTileOverLength / kAcross;
  c.lean = {(own.x - root.x) * steep, (root.y - own.y) * steep};
  return c;
}

}  // namespace fur::reference

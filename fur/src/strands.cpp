// Fur grown as particles: Lengyel, Praun, Finkelstein, Hoppe, "Real-Time Fur over Arbitrary Surfaces", I3D 2001,
// section 3.2, in its simplest case: each hair is a curve with a closed form. Nothing here calls the maths library
// beyond sqrt, floor, frexp and ldexp, which IEEE 754 fixes to the bit.
#include <algorithm>
#include <array>
#include <cmath>

#include "fur/coat.h"
#include "random.h"

namespace fur {
namespace {

using glm::dvec2;
using glm::dvec3;

// How far the tip of an undercoat hair is drawn to the nearest overcoat hair (Sheppard 2004: domination), in units of
// the distance between them.
constexpr double kClump = 0.45;
constexpr double kLengthDeviation = 0.13;  // of the class's mean length
constexpr double kLean = 0.35;             // part of the bend that is straight lean, the rest curves

// x^p for x in [0, 1], p >= 0, the same on every machine: log2 by its atanh series on the mantissa in [1/sqrt 2, sqrt
// 2), 2^y by Taylor. Better than 1e-10.
double Power(double x, double p) {
  if (p == 0) return 1;
  if (x <= 0) return 0;
  int exponent = 0;
  double m = std::frexp(x, &exponent);
  if (m < 0.70710678118654752) m *= 2, --exponent;
  const double z = (m - 1) / (m + 1), z2 = z * z;
  double series = 0;
  for (int k = 17; k >= 1; k -= 2) series = series * z2 + 1.0 / k;
  const double y = p * (exponent + series * z * 2 / 0.69314718055994531);
  if (y < -1000) return 0;
  const double whole = std::floor(y + 0.5), t = (y - whole) * 0.69314718055994531;
  double sum = 1;
  for (int k = 13; k >= 1; --k) sum = 1 + sum * t / k;
  return std::ldexp(sum, static_cast<int>(whole));
}

double Wrap(double x) { return x - std::floor(x); }
// The shortest way around the tile from 0 to d.
double Nearest(double d) { return d - std::floor(d + 0.5); }
dvec2 Nearest(dvec2 d) { return {Nearest(d.x), Nearest(d.y)}; }

dvec2 UnitVector(Pcg32* random) {
  for (;;) {  // rejection from the square: sine and cosine differ between maths libraries
    const double x = random->Uniform() * 2 - 1, y = random->Uniform() * 2 - 1;
    const double d = x * x + y * y;
    if (d > 1e-4 && d <= 1) return dvec2{x, y} / std::sqrt(d);
  }
}

// Points on the unit torus, with a grid that finds the ones near a place.
class TorusPoints {
 public:
  explicit TorusPoints(size_t expected) {
    cells_ = std::max(1, static_cast<int>(std::sqrt(static_cast<double>(expected))));
    grid_.resize(static_cast<size_t>(cells_) * cells_);
  }
  void Add(dvec2 p) {
    grid_[CellOf(p)].push_back(static_cast<uint32_t>(points_.size()));
    points_.push_back(p);
  }
  bool AnyWithin(dvec2 p, double radius) const {
    bool found = false;
    ForNear(p, radius, [&](dvec2 q) { found = found || glm::dot(Nearest(q - p), Nearest(q - p)) < radius * radius; });
    return found;
  }
  // The vector from p to the nearest point; zero without points within the radius.
  dvec2 ToNearest(dvec2 p, double radius) const {
    dvec2 best{0};
    double distance = radius * radius;
    ForNear(p, radius, [&](dvec2 q) {
      const dvec2 d = Nearest(q - p);
      if (glm::dot(d, d) < distance) best = d, distance = glm::dot(d, d);
    });
    return best;
  }
  const std::vector<dvec2>& all() const { return points_; }

 private:
  size_t CellOf(dvec2 p) const {
    const int x = std::min(cells_ - 1, static_cast<int>(p.x * cells_));
    const int y = std::min(cells_ - 1, static_cast<int>(p.y * cells_));
    return static_cast<size_t>(y) * cells_ + x;
  }
  template <class F>
  void ForNear(dvec2 p, double radius, F visit) const {
    const int reach = std::min((cells_ - 1) / 2 + 1, static_cast<int>(radius * cells_) + 1);
    const int cx = static_cast<int>(p.x * cells_), cy = static_cast<int>(p.y * cells_);
    for (int y = cy - reach; y <= cy + reach; ++y) {
      for (int x = cx - reach; x <= cx + reach; ++x) {
        const int wx = ((x % cells_) + cells_) % cells_, wy = ((y % cells_) + cells_) % cells_;
        for (uint32_t i : grid_[static_cast<size_t>(wy) * cells_ + wx]) visit(points_[i]);
      }
    }
  }

  int cells_ = 1;
  std::vector<std::vector<uint32_t>> grid_;
  std::vector<dvec2> points_;
};

// Poisson-disc roots by dart throwing; the radius starts at 0.8 of the hexagonal packing's and shrinks a little
// whenever 24 darts in a row miss, so that the count is met exactly.
TorusPoints ThrowRoots(uint32_t count, Pcg32* random) {
  TorusPoints roots(count);
  double radius = 0.8 * std::sqrt(1.1547 / std::max(1u, count));
  for (uint32_t misses = 0; roots.all().size() < count;) {
    const dvec2 p{random->Uniform(), random->Uniform()};
    if (!roots.AnyWithin(p, radius)) {
      roots.Add(p);
      misses = 0;
    } else if (++misses % 24 == 0) {
      radius *= 0.98;
    }
  }
  return roots;
}

// A smooth periodic field of directions, so that neighbouring hairs lie alike.
class FlowField {
 public:
  explicit FlowField(Pcg32* random) {
    for (dvec2& v : lattice_) v = UnitVector(random);
  }
  dvec2 At(dvec2 p) const {
    const dvec2 q = p * double{kCells};
    const int x = static_cast<int>(q.x), y = static_cast<int>(q.y);
    const dvec2 f = q - dvec2(x, y), s = f * f * (3.0 - 2.0 * f);
    return glm::mix(glm::mix(V(x, y), V(x + 1, y), s.x), glm::mix(V(x, y + 1), V(x + 1, y + 1), s.x), s.y);
  }

 private:
  static constexpr int kCells = 5;
  dvec2 V(int x, int y) const { return lattice_[(y % kCells) * kCells + x % kCells]; }
  std::array<dvec2, kCells * kCells> lattice_;
};

// One hair. At height h (0 .. length) its centre is root + bend * (lean s + (1 - lean) s^2) + clump * s^2, s = h /
// length.
struct Strand {
  dvec2 root{0};  // in tiles, as everything sideways
  double length = 1;
  double radius = 0;  // texels
  dvec2 bend{0}, clump{0};

  dvec2 Center(double h) const {
    const double s = h / length;
    return root + bend * (kLean * s + (1 - kLean) * s * s) + clump * (s * s);
  }
  // Towards the tip, in units of the fur length.
  dvec3 Direction(double h) const {
    const double s = h / length;
    const dvec2 slope = (bend * (kLean + 2 * (1 - kLean) * s) + clump * (2 * s)) / length;
    return glm::normalize(dvec3(slope * kTileOverLength, 1));
  }
};

struct StrandClass {
  double length, radius;
};

Strand MakeStrand(const StrandParams& params, const StrandClass& kind, dvec2 root, const FlowField& flow,
                  Pcg32* random) {
  Strand strand;
  strand.root = root;
  strand.length = std::clamp(kind.length * (1 + kLengthDeviation * random->Bell()), 0.05, 1.0);
  strand.radius = kind.radius * (1 + 0.12 * random->Bell());
  const dvec2 own = flow.At(root) * 0.8 + UnitVector(random) * 0.6;
  const double reach = params.bend * strand.length * (1 + 0.25 * random->Bell());
  strand.bend = glm::mix(dvec2(1, 0), own, params.spread) * reach;
  return strand;
}

// The classes use separate generators: changing one class leaves the other's hairs where they are.
std::vector<Strand> MakeStrands(const StrandParams& params) {
  Pcg32 flowRandom(params.seed * 3ull), overRandom(params.seed * 3ull + 1), underRandom(params.seed * 3ull + 2);
  const FlowField flow(&flowRandom);
  std::vector<Strand> strands;
  const TorusPoints overRoots = ThrowRoots(params.overStrands, &overRandom);
  for (dvec2 root : overRoots.all()) {
    strands.push_back(MakeStrand(params, {params.overLength, params.overRadius}, root, flow, &overRandom));
  }
  const TorusPoints underRoots = ThrowRoots(params.underStrands, &underRandom);
  for (dvec2 root : underRoots.all()) {
    strands.push_back(MakeStrand(params, {params.underLength, params.underRadius}, root, flow, &underRandom));
    strands.back().clump = kClump * overRoots.ToNearest(root, 0.25);
  }
  return strands;
}

// Eight strips of equal height and of the disc's own area in each: fraction (F(s1) - F(s0)) / pi with
// F(s) = s sqrt(1 - s^2) + asin s, s = -1, -3/4, .. 1.
constexpr std::array<double, 8> kStripArea = {0.0721468064071937, 0.1233543030706916, 0.1470177117592610,
                                              0.1574811787628537, 0.1574811787628537, 0.1470177117592610,
                                              0.1233543030706916, 0.0721468064071937};

// Accumulates one slice: 1 - coverage, and the tangent weighted by coverage.
class Slice {
 public:
  explicit Slice(uint32_t size) : size_(size), open_(size * size, 1.0), tangent_(size * size, dvec3(0)) {
    own_.resize(size * size, 0.0);
  }

  // The slab between the two heights. A hair that leans more than it is thick would leave separate dots: several discs
  // along its path, and the largest coverage in each texel, give the swept shape.
  void AddStrand(const Strand& strand, double h0, double h1, double taper) {
    if (h0 >= strand.length) return;
    const double middle = (h0 + h1) / 2, top = std::min(h1, strand.length);
    const double travel = glm::length(strand.Center(top) - strand.Center(h0)) * size_;
    const int discs = std::clamp(static_cast<int>(travel * 2) + 1, 1, 8);
    for (int i = 0; i < discs; ++i) {
      const double h = h0 + (h1 - h0) * (i + 0.5) / discs;
      if (h < strand.length) AddDisc(strand.Center(h), strand.radius * Power(1 - h / strand.length, taper));
    }
    Commit(strand.Direction(std::min(middle, strand.length)));
  }

  void Write(uint8_t* rgba) {
    FillDirections();
    for (size_t i = 0; i < open_.size(); ++i, rgba += 4) {
      const dvec3 t = glm::normalize(tangent_[i]);
      for (int c = 0; c < 3; ++c) rgba[c] = ToByte((c == 1 ? -t[c] : t[c]) * 0.5 + 0.5);  // y is up, rows run down
      rgba[3] = ToByte(1 - open_[i]);
    }
  }

 private:
  static uint8_t ToByte(double x) { return static_cast<uint8_t>(std::clamp(x, 0.0, 1.0) * 255 + 0.5); }
  size_t IndexOf(int x, int y) const {
    const int n = static_cast<int>(size_);
    return static_cast<size_t>(((y % n) + n) % n) * size_ + static_cast<size_t>(((x % n) + n) % n);
  }

  // Texel areas under the disc: the disc is a stack of eight rectangles, each cut exactly along the texels' sides. The
  // total area is exact; a texel's is off by less than 1 % of the disc.
  void AddDisc(dvec2 center, double radius) {
    if (radius < 1e-3) return;
    const dvec2 c = dvec2{Wrap(center.x), Wrap(center.y)} * double(size_);
    const double height = radius / 4;
    for (int k = 0; k < 8; ++k) {
      const double y0 = c.y - radius + k * height;
      const double halfWidth = kStripArea[k] * 3.14159265358979324 * radius * radius / height / 2;
      AddRectangle(c.x - halfWidth, c.x + halfWidth, y0, y0 + height);
    }
    KeepLargest();
  }

  void AddRectangle(double x0, double x1, double y0, double y1) {
    const auto overlap = [](int cell, double a, double b) { return std::min(b, cell + 1.0) - std::max(a, cell + 0.0); };
    for (int y = static_cast<int>(std::floor(y0)); y < y1; ++y) {
      for (int x = static_cast<int>(std::floor(x0)); x < x1; ++x) {
        AddToDisc(IndexOf(x, y), std::max(0.0, overlap(x, x0, x1)) * std::max(0.0, overlap(y, y0, y1)));
      }
    }
  }

  void AddToDisc(size_t texel, double area) {
    for (auto& [index, sum] : discTexels_) {
      if (index == texel) return void(sum += area);
    }
    discTexels_.emplace_back(texel, area);
  }

  void KeepLargest() {
    for (const auto& [texel, area] : discTexels_) {
      if (own_[texel] == 0) touched_.push_back(texel);
      own_[texel] = std::max(own_[texel], std::min(1.0, area));
    }
    discTexels_.clear();
  }

  void Commit(const dvec3& direction) {
    for (size_t texel : touched_) {
      open_[texel] *= 1 - own_[texel];
      tangent_[texel] += direction * own_[texel];
      own_[texel] = 0;
    }
    touched_.clear();
  }

  // Empty texels take the mean of their neighbours, ring by ring, so that filtering never mixes in a foreign direction;
  // what is still empty then takes the slice's mean, or straight up.
  void FillDirections() {
    dvec3 mean{0, 0, 1e-6};
    for (const dvec3& t : tangent_) mean += t;
    for (int ring = 0; ring < 4; ++ring) {
      const std::vector<dvec3> before = tangent_;
      for (size_t i = 0; i < before.size(); ++i) {
        if (before[i] == dvec3(0)) tangent_[i] = NeighborSum(before, i);
      }
    }
    for (dvec3& t : tangent_) {
      if (t == dvec3(0)) t = mean;
    }
  }

  dvec3 NeighborSum(const std::vector<dvec3>& field, size_t i) const {
    const int x = static_cast<int>(i % size_), y = static_cast<int>(i / size_);
    return field[IndexOf(x - 1, y)] + field[IndexOf(x + 1, y)] + field[IndexOf(x, y - 1)] + field[IndexOf(x, y + 1)];
  }

  uint32_t size_;
  std::vector<double> open_;
  std::vector<dvec3> tangent_;
  std::vector<double> own_;  // coverage of the strand in work
  std::vector<size_t> touched_;
  std::vector<std::pair<size_t, double>> discTexels_;
};

}  // namespace

FurVolume GrowStrands(const StrandParams& params) {
  FurVolume volume;
  volume.name = "strands";
  volume.width = volume.height = std::max(1u, params.size);
  volume.layers = std::max(1u, params.layers);
  const size_t sliceBytes = size_t{volume.width} * volume.height * 4;
  volume.pixels.resize(sliceBytes * volume.layers);
  const std::vector<Strand> strands = MakeStrands(params);
  for (uint32_t j = 0; j < volume.layers; ++j) {
    Slice slice(volume.width);
    for (const Strand& strand : strands) {
      if (j + 1 == volume.layers) break;  // the top slice is empty by contract
      slice.AddStrand(strand, double(j) / volume.layers, double(j + 1) / volume.layers, params.taper);
    }
    slice.Write(volume.pixels.data() + j * sliceBytes);
  }
  return volume;
}

}  // namespace fur

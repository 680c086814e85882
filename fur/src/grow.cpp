// Strands as particles. Each draws its numbers from a generator of its own, all of them whatever the parameters are: a
// changed parameter moves nothing that it does not govern.
#include <algorithm>
#include <cmath>

#include "bake_math.h"
#include "fur/bake.h"
#include "random.h"
#include "torus_points.h"

namespace fur {
namespace {

using glm::dvec2;
using glm::dvec3;

constexpr int kKnots = 4;  // of the wander along a strand

uint64_t StreamSeed(uint32_t seed, uint32_t stream, uint32_t index) {
  uint64_t x = (uint64_t{seed} << 32 | index) + stream * 0x9e3779b97f4a7c15ull;
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9ull;  // Vigna's SplitMix64 (2015), its finalizer
  x = (x ^ (x >> 27)) * 0x94d049bb133111ebull;
  return x ^ (x >> 31);
}

// Everything that is random about one strand; bells have deviation 1.
struct Draws {
  explicit Draws(uint64_t seed) {
    Pcg32 random(seed);
    length = random.Bell(), radius = random.Bell();
    lean.x = random.Bell(), lean.y = random.Bell();
    phase = random.Uniform();
    tint = random.Bell(), warmth = random.Bell();
    for (dvec3& v : wander)
      for (int c = 0; c < 3; ++c) v[c] = random.Bell();
  }
  dvec3 WanderAt(double along) const {
    const double x = along * (kKnots - 1);
    const int i = std::min(kKnots - 2, static_cast<int>(x));
    return glm::mix(wander[i], wander[i + 1], x - i);
  }
  double length = 0, radius = 0, phase = 0, tint = 0, warmth = 0;
  dvec2 lean{0};
  dvec3 wander[kKnots];
};

// A smooth periodic field of directions, so that neighbouring strands lie alike.
class SwirlField {
 public:
  SwirlField(uint32_t cells, Pcg32* random) : cells_(static_cast<int>(cells)), lattice_(size_t{cells} * cells) {
    for (dvec2& v : lattice_) v = CosSinTurns(random->Uniform());
  }
  dvec2 At(dvec2 p) const {
    const dvec2 q = p * double(cells_);
    const int x = static_cast<int>(q.x), y = static_cast<int>(q.y);
    const dvec2 f = q - dvec2(x, y), s = f * f * (3.0 - 2.0 * f);
    return glm::mix(glm::mix(V(x, y), V(x + 1, y), s.x), glm::mix(V(x, y + 1), V(x + 1, y + 1), s.x), s.y);
  }

 private:
  dvec2 V(int x, int y) const { return lattice_[static_cast<size_t>(y % cells_ * cells_ + x % cells_)]; }
  int cells_;
  std::vector<dvec2> lattice_;
};

// A curl needs a dozen points for each turn to look round.
int PointsOf(const StrandClass& kind, double length) {
  const double curled = kind.curl > 0 ? std::ceil(kind.curlTurns * length * 12) : 0;
  return 24 + static_cast<int>(std::min(curled, 400.0));
}

dvec3 UnitOr(const dvec3& v, const dvec3& otherwise) {
  const double length = std::sqrt(glm::dot(v, v));
  return length > 1e-9 ? v / length : otherwise;
}

double LengthOf(const StrandClass& kind, const Draws& draws) {
  return kind.length * std::clamp(1 + kind.lengthSpread * draws.length, 0.1, 4.0);
}

dvec3 TintOf(const StrandClass& kind, const Draws& draws) {
  const double brightness = kind.tint + kind.tintSpread * draws.tint;
  const double warmth = kind.warmth + kind.warmthSpread * draws.warmth;
  return glm::clamp(brightness * dvec3(1 + warmth, 1, 1 - warmth), 0.0, 2.0);
}

// The particle's path: t <- normalize(t + dt (bias + gravity + noise)), x <- x + dt t, then the curl.
Strand Grow(const StrandClass& kind, StrandKind which, dvec2 root, dvec2 swirl, const Draws& draws) {
  Strand strand{which, root, {}, TintOf(kind, draws)};
  const double length = LengthOf(kind, draws);
  const double radius = kind.radius * std::clamp(1 + kind.radiusSpread * draws.radius, 0.1, 4.0);
  const int steps = PointsOf(kind, length);
  const double dt = length / steps;
  const dvec3 pull(dvec2(kind.biasX, kind.biasY) + kind.swirl * swirl, -kind.gravity);
  dvec3 x(0), t = UnitOr(dvec3(draws.lean * kind.spread, 1), dvec3(0, 0, 1));
  for (int i = 0; i <= steps; ++i) {
    const double along = double(i) / steps;
    const dvec2 curl =
        kind.curl * Power(along, kind.curlExponent) * CosSinTurns(kind.curlTurns * along * length + draws.phase);
    strand.points.push_back({x + dvec3(curl, 0), radius * Power(1 - along, kind.taper), along});
    t = UnitOr(t + dt * (pull + kind.noise * draws.WanderAt(along)), t);
    x += dt * t;
    x.z = std::max(x.z, 0.0);  // on the skin, not through it
  }
  return strand;
}

dvec3 PositionAt(const Strand& strand, double along) {
  const double x = std::min(along, 1.0) * double(strand.points.size() - 1);
  const size_t i = std::min(strand.points.size() - 2, static_cast<size_t>(x));
  return glm::mix(strand.points[i].position, strand.points[i + 1].position, x - double(i));
}

// x <- lerp(x, x_dominant, c (h/l)^s), x_dominant at the same way h from the root, or its tip.
void Clump(const StrandClass& kind, double length, const Strand& dominant, double dominantLength, double tile,
           Strand* strand) {
  const dvec3 apart(Nearest(dominant.root - strand->root) * tile, 0);
  for (StrandPoint& p : strand->points) {
    const dvec3 target = apart + PositionAt(dominant, p.along * length / dominantLength);
    p.position = glm::mix(p.position, target, kind.clump * Power(p.along, kind.clumpExponent));
  }
}

uint32_t CountOf(const StrandClass& kind, double tile) {
  return static_cast<uint32_t>(kind.density * tile * tile + 0.5);
}

class Grower {
 public:
  explicit Grower(const CoatParams& params)
      : params_(params),
        swirlRandom_(StreamSeed(params.seed, 3, 0)),
        swirl_(params.swirlCells, &swirlRandom_),
        dominants_(1) {}

  std::vector<Strand> All() {
    const uint32_t over = CountOf(params_.over, params_.tile);
    const uint32_t dominants = std::min(over, static_cast<uint32_t>(std::ceil(over * params_.dominants)));
    const TorusPoints overRoots = Roots(over, dominants, 4);
    dominants_ = TorusPoints(dominants);
    for (uint32_t i = 0; i < dominants; ++i) dominants_.Add(overRoots.all()[i]);
    GrowClass(params_.over, StrandKind::Over, overRoots, dominants);
    GrowClass(params_.under, StrandKind::Under, Roots(CountOf(params_.under, params_.tile), 0, 5), 0);
    return std::move(strands_);
  }

 private:
  TorusPoints Roots(uint32_t count, uint32_t first, uint32_t stream) const {
    Pcg32 random(StreamSeed(params_.seed, stream, 0));
    return ThrowRoots(count, first, &random);
  }

  // The first `free` of a class follow nobody.
  void GrowClass(const StrandClass& kind, StrandKind which, const TorusPoints& roots, uint32_t free) {
    for (uint32_t i = 0; i < roots.all().size(); ++i) {
      const Draws draws = DrawsOf(which, i);
      const dvec2 root = roots.all()[i];
      strands_.push_back(Grow(kind, which, root, swirl_.At(root), draws));
      if (i < free || dominants_.all().empty()) continue;
      const uint32_t dominant = dominants_.NearestTo(root);
      const double dominantLength = LengthOf(params_.over, DrawsOf(StrandKind::Over, dominant));
      Clump(kind, LengthOf(kind, draws), strands_[dominant], dominantLength, params_.tile, &strands_.back());
    }
  }

  Draws DrawsOf(StrandKind which, uint32_t index) const {
    return Draws(StreamSeed(params_.seed, which == StrandKind::Over ? 1 : 2, index));
  }

  const CoatParams& params_;
  Pcg32 swirlRandom_;
  SwirlField swirl_;
  TorusPoints dominants_;
  std::vector<Strand> strands_;  // the dominant ones first
};

}  // namespace

std::vector<Strand> GrowStrandList(const CoatParams& params) { return Grower(params).All(); }

}  // namespace fur

// Coats grown by particles and sampled into a fur volume: Lengyel, Praun, Finkelstein, Hoppe, "Real-Time Fur over
// Arbitrary Surfaces", I3D 2001, section 3.2 (a particle's path is a hair); undercoat, overcoat and hairs that draw
// others to themselves after Sheppard, "Real-Time Rendering of Fur", 2004. docs/bake.md has the formulas.
//
// Lengths are in fur lengths: the volume's height is 1 and its tile is CoatParams::tile wide. Axes as in the volume's
// tangents: x along u, y up the picture (against its rows), z away from the skin. The same parameters give the same
// bytes on every machine and at any number of threads.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "fur/model.h"
#include "fur/result.h"

namespace fur {

// Defaults are the undercoat's. Ranges and meaning, for people: CoatKeys().
struct StrandClass {
  double density = 130;                              // roots on a square of one fur length
  double length = 0.62, lengthSpread = 0.13;         // of the whole strand; deviation relative to the mean
  double radius = 0.022, radiusSpread = 0.12;        // at the root; deviation relative to the mean
  double taper = 0.75;                               // radius (1 - h/l)^taper
  double curl = 0, curlTurns = 2, curlExponent = 1;  // sideways curl (h/l)^exponent (cos, sin)(2 pi turns h + phase)
  double biasX = 0, biasY = 0;                       // the way that all lean, more with each fur length grown
  double spread = 0.1;                               // deviation of the lean at the root, each strand its own
  double swirl = 0.4;                                // lean shared with neighbours, more with each fur length grown
  double gravity = 0;                                // pull towards the skin
  double noise = 0.6;                                // wander, each strand its own
  double clump = 0.3, clumpExponent = 1.5;           // towards the nearest dominant strand by clump (h/l)^exponent
  double tint = 1, tintSpread = 0.1;                 // brightness, mean and deviation
  double warmth = 0, warmthSpread = 0.03;            // red up, blue down; mean and deviation
};

struct CoatParams {
  uint32_t size = 128, layers = 16;  // texels across the tile; slices
  uint32_t seed = 1;
  double tile = 4;          // fur lengths across the tile
  double dominants = 0.22;  // share of the overcoat that draws the others to itself
  uint32_t swirlCells = 5;  // eddies across the tile
  double finDepth = 0.25;   // fur lengths: the fin slice shows the strands rooted in a sheet this thick
  StrandClass under, over = DefaultOvercoat();

  static StrandClass DefaultOvercoat();
};

// The table that flags, JSON and help are made from. `name` is the JSON key; those of a class stand in "under" or
// "over".
struct CoatKey {
  const char* group;  // "", "under", "over"
  const char* name;
  double min, max;
  bool whole;  // a whole number
  const char* help;
};
std::span<const CoatKey> CoatKeys();
double CoatValue(const CoatParams&, const CoatKey&);
// InputMalformed with what was expected, as "must be a number from 0 to 1, not 3".
Result<Done> SetCoatValue(const CoatKey&, double value, CoatParams*);
// What the ranges of single keys leave open: the size of the volume and the number of strands.
Result<Done> CheckCoat(const CoatParams&);

enum class StrandKind : uint8_t { Under, Over };

struct StrandPoint {
  glm::dvec3 position;  // from the root; z is the height above the skin
  double radius;
  double along;  // share of the strand's length, 0 at the root, 1 at the tip
};

struct Strand {
  StrandKind kind = StrandKind::Under;
  glm::dvec2 root{0};  // tiles, 0 <= root < 1, multiples of 2^-20: whole texels can be added without rounding
  std::vector<StrandPoint> points;  // at least two
  glm::dvec3 tint{1};               // factor of the fur's colour
};

// Overcoat first. CheckCoat(params) must be good.
std::vector<Strand> GrowStrandList(const CoatParams& params);

// Called with 0..1, never less than before, one call at a time, from any thread.
using BakeProgress = std::function<void(double)>;

// Slice j is what stands between the heights j / layers and (j + 1) / layers, seen from above: coverage
// 1 - prod (1 - c_i), c_i the share of the texel that strand i covers; the tangent is the mean weighted by c_i, unit.
// The top slice is empty. Texels without fur have their neighbours' tangent. threads 0: one for each core.
FurVolume BakeVolume(const CoatParams& params, std::span<const Strand> strands, uint32_t threads = 0,
                     const BakeProgress& progress = {});

// The strands whose roots lie within finDepth of the line y = 0, seen along y: u along the tile, v (row 0 first) from
// the root to the tip, size x size / 2 texels, tangents and coverage as in the volume. The last row is empty.
Image BakeFinSlice(const CoatParams& params, std::span<const Strand> strands);

// The coat of a model that brings none: default parameters.
FurVolume GrowCoat(uint32_t seed);

}  // namespace fur

// Generated markings: stripes, rosettes, patches, painted by the place on the body, so that what is at one place has one
// colour whichever texel holds it. docs/coats.md has the meaning of every key.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "fur/model.h"
#include "fur/result.h"

namespace fur {

enum class Pattern : uint8_t {
  Solid,     // everywhere
  Stripes,   // across the body: they follow its length, taper, fork and break
  Rosettes,  // broken rings around the sites that Spots has with the same scale and seed
  Spots,     // around sites spread evenly over the skin
  Patches,   // smooth noise
  Streaks    // fine lines along the body and down the limbs: guard hairs
};

// Where on the body. Distances are in diameters of the model.
enum class BodyCoordinate : uint8_t {
  Height,  // 0 at the lowest point, 1 at the highest
  Up,      // of the normal: 1 on the back, -1 on the belly
  Front,   // of the normal: 1 faces ahead
  Inward,  // of the normal: 1 faces the middle plane, as the inner side of a leg
  Side,    // distance from the middle plane
  Along,   // 0 at the nose, 1 at the tip of the tail, over the skin
  Nose,    // distance over the skin from the nose
  Tail,    // distance over the skin from the tip of the tail
  Feet     // distance over the skin from the ground
};

// 0 at `from` and before, 1 at `to` and beyond; from > to runs the other way.
struct BodyRamp {
  BodyCoordinate coordinate = BodyCoordinate::Height;
  double from = 0, to = 1;
};

// Painted over what is there: mix(there, color, opacity x where x pattern). Ranges: ReadMarkings refuses what is outside.
struct MarkingLayer {
  Pattern pattern = Pattern::Solid;
  glm::dvec3 color{0};     // sRGB, 0..1
  double opacity = 1;
  double scale = 0.05;     // diameters: from stripe to stripe, from site to site, of the noise, width of a streak
  double coverage = 0.5;   // share of the skin that the pattern marks, where nothing tapers it
  double softness = 0.15;  // width of its edges, as a share of the skin
  double length = 5;       // of stripes and streaks, in scales
  double irregular = 0.4;  // 0: even; 1: as broken as can be
  double ring = 0.6;       // rosettes: 0 at the site, 1 half way to the next
  double ragged = 0.15;    // how far noise moves the edges of `where` and `taper`, in their own ramps
  uint32_t seed = 1;
  std::vector<BodyRamp> where;  // the least of them is a factor of the opacity
  std::vector<BodyRamp> taper;  // ... of the coverage: stripes end in points there
};

struct Markings {
  glm::dvec3 base{1};   // sRGB: what the layers are painted on
  double overBase = 1;  // how much of the model's own picture they cover
  uint32_t size = 1024;  // texels of the side of the picture
  std::vector<MarkingLayer> layers;
};

// {"base": [r, g, b], "over_base": 1, "size": 1024, "layers": [{"pattern": "stripes", "color": [r, g, b], ...,
// "where": {"up": [0, 0.5]}}]}. InputMalformed for keys that are not known, of the wrong type or out of range, with
// `where` and the path of the key.
Result<Markings> ReadMarkings(const nlohmann::json& object, const std::string& where);

class Body;  // fur/src/body.h

// The picture in the texture coordinates of the material, sRGB; the model's own picture of it is mixed in by overBase.
// The same bytes on each run.
Image PaintMarkings(const Model&, const Body&, uint32_t material, const Markings&);

}  // namespace fur

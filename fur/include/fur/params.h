// The parameters of a coat, and where they come from. Order of precedence, later wins: the defaults below, the coat's
// own, the material's glTF `extras.fur`, a whole coat (`--coat`), a JSON file (`--groom FILE`), flags (docs/fur.md).
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <nlohmann/json_fwd.hpp>
#include <span>
#include <string>
#include <vector>

#include "fur/result.h"

namespace fur {

// JSON key in brackets. Lengths are in the primitive's own units unless said otherwise.
struct FurParams {
  bool enabled = true;             // [enabled]
  double length = 0;               // [length_scale] total fur length at length map 1; 0: 2.5 % of the model's diameter
  std::string lengthMap;           // [length_map] file, relative to the model or to the JSON file; red, linear
  std::string directionMap;        // [direction_map] file; tangent-space comb direction, rgb * 2 - 1, linear
  std::vector<std::string> layers; // [layers] files of the PNG stack, root first; empty: strands grown by the program
  double layerUvScale = 0;         // [layer_uv_scale] tiles across the unit UV square; 0: chosen so that strands have a
                                   // natural width
  uint32_t shells = 0;             // [shells] number of shells; 0: the number of layers, 16 at least
  double selfShadow = 0.5;         // [self_shadow] light left at the root, 0..1. The cat's extras say
                                   // source_self_shadow = 0.9+0.1*i/16, which reads as 0.9
  double specularPower = 30;       // [specular_power] > 0
  double specularScale = 0.35;     // [specular_scale] >= 0
  double heightFalloff = 0;        // [height_falloff] share of the coverage lost at the tip, 0..1: a(h) (1 - f h). The cat's
                                   // extras say source_shell_alpha = alpha*(1-i/16), which reads as 1

  // The groom: technique shells (the comb also in preset nvidia-d3d10). docs/fur.md has the formulas.
  double density = 1;          // [density] 0..4, exponent of the coverage: 1 - (1 - a)^density
  double thickness = 1;        // [thickness] 0.25..4, of the strands: a^(1 / thickness)
  glm::dvec3 comb{0};          // [comb] direction in the model's axes; 0: not combed
  double combStrength = 1;     // [comb_strength] sideways offset of the tips, in fur lengths
  double bend = 2;             // [bend] exponent of the height in every sideways offset, >= 1
  double gravity = 0;          // [gravity] 0..1, sideways offset of the tips towards the world's -Y, in fur lengths
  std::string furlessMap;      // [furless_map] file; red of a half or less: no fur, the skin shows
  glm::dvec3 rootColor{1};     // [root_color] linear factors of the fur's colour at the root ...
  glm::dvec3 tipColor{1};      // [tip_color] ... and at the tip
  double colorFromBase = 1;    // [color_from_base] 0..1, how much of the base texture colours the fur; the rest is white
  double tint = 1;             // [tint] 0..1, how much of the strands' own colours (FurVolume::tint) shows
  double clumping = 0;         // [clumping] 0..1, how far strands are drawn together towards their tips
  double wetness = 0;          // [wetness] 0..1: clumps, shortens, darkens, shines
  glm::dvec3 wind{1, 0, 0};    // [wind] the way it blows, world axes
  double windStrength = 0;     // [wind_strength] most sideways offset of the tips, in fur lengths
  double windFrequency = 0.8;  // [wind_frequency] waves a second
  double windLength = 0;       // [wind_length] distance of two waves, model units; 0: half of the model's diameter
  double inertiaStiffness = 400, inertiaDamping = 12;  // [inertia_stiffness] 1/s^2, [inertia_damping] 1/s: fur/inertia.h
  glm::dvec3 front{0};         // [front] the way the animal looks, model axes, for a coat's markings; 0: +z, or +x where the
                               // model is longer that way
  bool operator==(const FurParams&) const = default;
};

// Applies the keys of a JSON object over `params`. `where` names the object in messages. Unknown keys are refused by
// name, values of the wrong type or out of range too; `extras` tolerates the descriptive keys that the cat asset carries
// (length_units, layer_rgb, layer_alpha, source_*, note), reading source_specular_power and source_specular_scale.
Result<Done> ApplyFurJson(const nlohmann::json& object, const std::string& where, bool extras, FurParams* params);

// InputMalformed naming the first number that is outside of its key's range, or not a number.
Result<Done> CheckFurParams(const FurParams& params);

// One key of the table that the JSON reader, the flags and the schema are made from.
enum class FurKind { Switch, Number, Count, Vector, File, Files };
struct FurKey {
  const char* name;
  const char* flag;  // of `fur render`
  const char* help;
  FurKind kind;
  double min, max;      // of numbers and of a vector's components
  bool minIsExcluded;
};
std::span<const FurKey> FurKeys();
std::string DefaultText(const FurKey&);  // as JSON

// JSON schema of a fur file (`--groom`), from the same table.
std::string GroomSchema();

}  // namespace fur

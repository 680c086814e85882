// The parameters of a coat, and where they come from. Order of precedence, later wins: the defaults below, the
// material's glTF `extras.fur`, a JSON file (`--fur FILE`), flags.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <nlohmann/json_fwd.hpp>
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
  bool operator==(const FurParams&) const = default;
};

// Applies the keys of a JSON object over `params`. `where` names the object in messages. Unknown keys are refused by
// name, values of the wrong type or out of range too; `extras` tolerates the descriptive keys that the cat asset carries
// (length_units, layer_rgb, layer_alpha, source_*, note), reading source_specular_power and source_specular_scale.
Result<Done> ApplyFurJson(const nlohmann::json& object, const std::string& where, bool extras, FurParams* params);

}  // namespace fur

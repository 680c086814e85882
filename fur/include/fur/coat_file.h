// Whole coats: strands, groom and markings in one JSON file (docs/coats.md). Those of fur/coats/ are inside the program.
#pragma once

#include <optional>
#include <span>
#include <string>

#include "fur/bake.h"
#include "fur/markings.h"
#include "fur/params.h"
#include "fur/result.h"

namespace fur {

struct Coat {
  std::string name;       // of the coat in the program, or of the file
  std::string title;      // one line for people
  double length = 0.025;  // of the fur, in diameters of the model
  CoatParams strands;
  // Keys that name files, switch fur on, or depend on the model's size (length_scale, layer_uv_scale) are refused in a
  // coat and stay at their defaults here.
  FurParams groom;
  std::optional<Markings> markings;
};

struct EmbeddedCoat {
  const char* name;
  const char* json;
};
std::span<const EmbeddedCoat> EmbeddedCoats();

// A file if the text has a slash or ends with .json, else the name of an embedded coat. Usage for a name that is not
// known (the message lists them), InputMissing, InputMalformed with the file and the path of the key.
Result<Coat> LoadCoat(const std::string& nameOrFile);
Result<Coat> ParseCoat(const std::string& json, const std::string& name);

// What a model's own parameters become when it wears the coat: the coat's, but for the maps and switches, which say where
// the model's fur is. `diameter` in the units of FurParams::length.
FurParams Wear(const Coat&, const FurParams& own, double diameter);

}  // namespace fur

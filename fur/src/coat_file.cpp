#include "fur/coat_file.h"

#include <algorithm>
#include <iterator>
#include <nlohmann/json.hpp>
#include <sstream>

#include "file_bytes.h"
#include "fur/bake_files.h"

namespace fur {
namespace {

using Json = nlohmann::json;

constexpr double kLongest = 0.5;  // fur, in diameters
// They belong to the model that wears the coat.
const char* const kModelKeys[] = {"enabled", "length_scale", "length_map",     "direction_map",
                                  "layers",  "furless_map",  "layer_uv_scale", "front"};

Error Refuse(const std::string& where, const std::string& what) {
  return {ErrorCode::InputMalformed, where + ": " + what};
}

Result<Done> ApplyGroom(const Json& object, const std::string& where, FurParams* groom) {
  if (object.is_object())
    for (const char* key : kModelKeys)
      if (object.contains(key))
        return Refuse(where, "\"" + std::string(key) + "\" belongs to a model, not to a coat; give it to --groom");
  return ApplyFurJson(object, where, false, groom);
}

Result<Done> ApplyLength(const Json& value, const std::string& where, double* length) {
  const double number = value.is_number() ? value.get<double>() : -1;
  if (!(number > 0 && number <= kLongest)) {
    std::ostringstream text;
    text << "\"length\" must be a number above 0 to " << kLongest << " diameters of the model, not "
         << (value.is_number() ? value.dump() : value.type_name());
    return Refuse(where, text.str());
  }
  *length = number;
  return Done{};
}

Result<Done> ApplyKey(const std::string& key, const Json& value, const std::string& where, Coat* coat) {
  if (key == "strands") return ApplyCoatJson(value, where + ": strands", &coat->strands);
  if (key == "groom") return ApplyGroom(value, where + ": groom", &coat->groom);
  if (key == "length") return ApplyLength(value, where, &coat->length);
  if (key == "markings") {
    Result<Markings> markings = ReadMarkings(value, where + ": markings");
    if (!markings) return markings.error();
    coat->markings = std::move(*markings);
    return Done{};
  }
  if (key != "title")
    return Refuse(where, "\"" + key + "\" is no key of a coat; known are title, length, strands, groom, markings");
  if (!value.is_string()) return Refuse(where, std::string("\"title\" must be a text, not ") + value.type_name());
  coat->title = value.get<std::string>();
  return Done{};
}

std::string KnownNames() {
  std::string names;
  for (const EmbeddedCoat& coat : EmbeddedCoats()) names += (names.empty() ? "" : ", ") + std::string(coat.name);
  return names;
}

}  // namespace

Result<Coat> ParseCoat(const std::string& text, const std::string& name) {
  const Json json = Json::parse(text, nullptr, false);
  if (json.is_discarded()) return Refuse(name, "is not valid JSON");
  if (!json.is_object()) return Refuse(name, std::string("must be an object, not ") + json.type_name());
  Coat coat;
  coat.name = name;
  for (const auto& [key, value] : json.items())
    if (Result<Done> ok = ApplyKey(key, value, name, &coat); !ok) return ok.error();
  return coat;
}

Result<Coat> LoadCoat(const std::string& nameOrFile) {
  if (nameOrFile.find('/') == std::string::npos && !nameOrFile.ends_with(".json")) {
    for (const EmbeddedCoat& coat : EmbeddedCoats())
      if (nameOrFile == coat.name) return ParseCoat(coat.json, nameOrFile);
    return Error{ErrorCode::Usage, "no coat is called '" + nameOrFile + "'; known are " + KnownNames() +
                                       "; a file's name has a / or ends with .json"};
  }
  Result<std::vector<uint8_t>> bytes = ReadFileBytes(nameOrFile, uint64_t{1} << 20);
  if (!bytes) return bytes.error();
  return ParseCoat({bytes->begin(), bytes->end()}, nameOrFile);
}

FurParams Wear(const Coat& coat, const FurParams& own, double diameter) {
  FurParams worn = coat.groom;
  worn.enabled = own.enabled;
  worn.lengthMap = own.lengthMap;
  worn.directionMap = own.directionMap;
  worn.furlessMap = own.furlessMap;
  worn.front = own.front;
  worn.length = coat.length * diameter;
  return worn;
}

}  // namespace fur

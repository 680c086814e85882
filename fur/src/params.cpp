#include "fur/params.h"

#include <algorithm>
#include <array>
#include <limits>
#include <nlohmann/json.hpp>
#include <sstream>
#include <variant>

namespace fur {
namespace {

using Json = nlohmann::json;
using Strings = std::vector<std::string>;
using Member = std::variant<bool FurParams::*, double FurParams::*, uint32_t FurParams::*, std::string FurParams::*,
                            Strings FurParams::*>;

struct Key {
  const char* name;
  Member member;
  double min = 0, max = 0;     // of numbers
  bool minIsExcluded = false;  // of numbers
};

constexpr size_t kMaxLayerFiles = 256;

// Upper limits only keep out values that would overflow a float or a draw call.
const std::array kKeys = {
    Key{"enabled", &FurParams::enabled},
    Key{"length_scale", &FurParams::length, 0, 1e9},
    Key{"length_map", &FurParams::lengthMap},
    Key{"direction_map", &FurParams::directionMap},
    Key{"layers", &FurParams::layers},
    Key{"layer_uv_scale", &FurParams::layerUvScale, 0, 1e5},
    Key{"shells", &FurParams::shells, 0, 512},
    Key{"self_shadow", &FurParams::selfShadow, 0, 1},
    Key{"specular_power", &FurParams::specularPower, 0, 1e5, true},
    Key{"specular_scale", &FurParams::specularScale, 0, 1e3},
    Key{"height_falloff", &FurParams::heightFalloff, 0, 1},
};

// Written by the converter of the cat asset. Objects are sorted by key, so that the plain names come later and win.
constexpr std::array<std::pair<const char*, const char*>, 2> kExtrasAliases = {
    {{"source_specular_power", "specular_power"}, {"source_specular_scale", "specular_scale"}}};

bool IsDescription(const std::string& key) {
  return key == "length_units" || key == "layer_rgb" || key == "layer_alpha" || key == "note" ||
         key.starts_with("source_");
}

const Key* FindKey(const std::string& name) {
  const auto it = std::find_if(kKeys.begin(), kKeys.end(), [&](const Key& key) { return name == key.name; });
  return it == kKeys.end() ? nullptr : &*it;
}

std::string KnownKeys() {
  std::string text;
  for (const Key& key : kKeys) text += (text.empty() ? "" : ", ") + std::string(key.name);
  return text;
}

std::string RangeText(const Key& key) {
  std::ostringstream text;
  text << (key.minIsExcluded ? "above " : "from ") << key.min << " to " << key.max;
  return text.str();
}

// Each Take... returns an empty text, or what was expected.
std::string Take(const Json& value, const Key&, bool* out) {
  if (!value.is_boolean()) return "true or false";
  *out = value.get<bool>();
  return {};
}

std::string Take(const Json& value, const Key& key, double* out) {
  const double number = value.is_number() ? value.get<double>() : std::numeric_limits<double>::quiet_NaN();
  // A NaN fails both comparisons.
  if (!(key.minIsExcluded ? number > key.min : number >= key.min) || !(number <= key.max))
    return "a number " + RangeText(key);
  *out = number;
  return {};
}

std::string Take(const Json& value, const Key& key, uint32_t* out) {
  double number = 0;
  if (!value.is_number_integer() || !Take(value, key, &number).empty()) return "a whole number " + RangeText(key);
  *out = static_cast<uint32_t>(number);
  return {};
}

bool IsFileName(const Json& value) {
  return value.is_string() && value.get_ref<const std::string&>().find('\0') == std::string::npos;
}

std::string Take(const Json& value, const Key&, std::string* out) {
  if (!IsFileName(value)) return "a file name";
  *out = value.get<std::string>();
  return {};
}

std::string Take(const Json& value, const Key&, Strings* out) {
  const auto isName = [](const Json& name) { return IsFileName(name) && !name.get_ref<const std::string&>().empty(); };
  if (!value.is_array() || value.size() > kMaxLayerFiles || !std::all_of(value.begin(), value.end(), isName))
    return "an array of at most " + std::to_string(kMaxLayerFiles) + " file names";
  *out = value.get<Strings>();
  return {};
}

Error Refuse(const std::string& where, const std::string& key, const std::string& what) {
  return {ErrorCode::InputMalformed, where + ": \"" + key + "\" " + what};
}

Result<Done> ApplyKey(const Key& key, const Json& value, const std::string& where, const std::string& spelling,
                      FurParams* params) {
  const std::string expected =
      std::visit([&](auto member) { return Take(value, key, &(params->*member)); }, key.member);
  if (expected.empty()) return Done{};
  const std::string given = value.is_number() ? value.dump() : std::string(value.type_name());
  return Refuse(where, spelling, "must be " + expected + ", not " + given);
}

std::string WithoutAlias(const std::string& name) {
  for (const auto& [alias, plain] : kExtrasAliases)
    if (name == alias) return plain;
  return name;
}

}  // namespace

Result<Done> ApplyFurJson(const Json& object, const std::string& where, bool extras, FurParams* params) {
  if (!object.is_object())
    return Error{ErrorCode::InputMalformed, where + ": must be an object of fur parameters, not " + object.type_name()};
  FurParams changed = *params;  // all or nothing
  // The cat's extras state the published laws in words: "alpha*(1-i/16)", "0.9+0.1*i/16".
  if (extras && object.contains("source_shell_alpha")) changed.heightFalloff = 1;
  if (extras && object.contains("source_self_shadow")) changed.selfShadow = 0.9;
  for (const auto& [name, value] : object.items()) {
    const Key* key = FindKey(extras ? WithoutAlias(name) : name);
    if (key == nullptr && extras && IsDescription(name)) continue;
    if (key == nullptr) return Refuse(where, name, "is not a fur parameter; known are " + KnownKeys());
    if (Result<Done> applied = ApplyKey(*key, value, where, name, &changed); !applied) return applied;
  }
  *params = std::move(changed);
  return Done{};
}

}  // namespace fur

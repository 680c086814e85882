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
using Ordered = nlohmann::ordered_json;
using Strings = std::vector<std::string>;
using Member = std::variant<bool FurParams::*, double FurParams::*, uint32_t FurParams::*, std::string FurParams::*,
                            Strings FurParams::*, glm::dvec3 FurParams::*>;

constexpr size_t kMaxLayerFiles = 256;

struct Entry {
  FurKey key;
  Member member;
};

constexpr FurKind KindOf(bool FurParams::*) { return FurKind::Switch; }
constexpr FurKind KindOf(double FurParams::*) { return FurKind::Number; }
constexpr FurKind KindOf(uint32_t FurParams::*) { return FurKind::Count; }
constexpr FurKind KindOf(std::string FurParams::*) { return FurKind::File; }
constexpr FurKind KindOf(Strings FurParams::*) { return FurKind::Files; }
constexpr FurKind KindOf(glm::dvec3 FurParams::*) { return FurKind::Vector; }

template <class T>
Entry Make(const char* name, const char* flag, T FurParams::*member, const char* help, double min = 0, double max = 0,
           bool minIsExcluded = false) {
  return {{name, flag, help, KindOf(member), min, max, minIsExcluded}, member};
}

// Upper limits of lengths, scales and powers only keep out values that would overflow a float or a draw call.
const std::vector<Entry>& Entries() {
  using P = FurParams;
  static const std::vector<Entry> entries{
      Make("enabled", "--enabled", &P::enabled, "Grow fur"),
      Make("length_scale", "--fur-length", &P::length,
           "Fur length in the primitive's units, at length map 1; 0: 2.5 % of the model's diameter", 0, 1e9),
      Make("length_map", "--length-map", &P::lengthMap, "Picture, red: length relative to the fur's; 0 is bald"),
      Make("direction_map", "--direction-map", &P::directionMap, "Picture, rgb * 2 - 1: the fur's direction in tangent space"),
      Make("layers", "--layers", &P::layers, "Pictures of the volume's slices, root first"),
      Make("layer_uv_scale", "--uv-scale", &P::layerUvScale,
           "Tiles of the volume across the UV square; 0: so that strands look natural", 0, 1e5),
      Make("shells", "--shells", &P::shells, "Number of shells; 0: the number of layers, at least 16", 0, 512),
      Make("self_shadow", "--self-shadow", &P::selfShadow, "Light left at the root", 0, 1),
      Make("specular_power", "--specular-power", &P::specularPower, "Sharpness of the highlight", 0, 1e5, true),
      Make("specular_scale", "--specular-scale", &P::specularScale, "Strength of the highlight", 0, 1e3),
      Make("height_falloff", "--height-falloff", &P::heightFalloff, "Share of the coverage lost at the tip", 0, 1),
      Make("density", "--density", &P::density, "Exponent of the coverage: 0 none, 2 as two coats in one", 0, 4),
      Make("thickness", "--thickness", &P::thickness, "Of the strands: coverage to the power of its inverse", 0.25, 4),
      Make("comb", "--comb", &P::comb, "Direction that the fur is combed to, model axes; 0,0,0: not combed", -1e6, 1e6),
      Make("comb_strength", "--comb-strength", &P::combStrength, "Sideways offset of the tips, in fur lengths", 0, 10),
      Make("bend", "--bend", &P::bend, "Exponent of the height in every offset: 1 straight, 2 bent", 1, 8),
      Make("gravity", "--gravity", &P::gravity, "Sideways offset of the tips downwards, in fur lengths", 0, 1),
      Make("furless_map", "--furless-map", &P::furlessMap, "Picture; red of a half or less: no fur, the skin shows"),
      Make("root_color", "--root-color", &P::rootColor, "Factors of the fur's colour at the root, linear", 0, 2),
      Make("tip_color", "--tip-color", &P::tipColor, "Factors of the fur's colour at the tip, linear", 0, 2),
      Make("color_from_base", "--color-from-base", &P::colorFromBase,
           "How much of the base texture colours the fur; the rest is white", 0, 1),
      Make("tint", "--tint", &P::tint, "How much of the strands' own colours, where the volume has them, shows", 0, 1),
      Make("clumping", "--clumping", &P::clumping, "How far strands are drawn together towards their tips", 0, 1),
      Make("wetness", "--wetness", &P::wetness, "Clumps, shortens, darkens and shines", 0, 1),
      Make("wind", "--wind", &P::wind, "The way the wind blows, world axes", -1e6, 1e6),
      Make("wind_strength", "--wind-strength", &P::windStrength, "Most offset of the tips by wind, in fur lengths", 0, 4),
      Make("wind_frequency", "--wind-frequency", &P::windFrequency, "Waves of wind a second", 0, 100),
      Make("wind_length", "--wind-length", &P::windLength,
           "Distance of two waves of wind in model units; 0: half of the model's diameter", 0, 1e9),
      Make("inertia_stiffness", "--inertia-stiffness", &P::inertiaStiffness,
           "Of the spring that holds moving fur, 1/s^2", 0, 1e5, true),
      Make("front", "--front", &P::front,
           "The way the animal looks, model axes, for a coat's markings; 0,0,0: +z, or +x where it is longer", -1e6, 1e6),
      Make("inertia_damping", "--inertia-damping", &P::inertiaDamping, "Of the spring that holds moving fur, 1/s", 0, 1e3),
  };
  return entries;
}

const Entry& EntryOf(const FurKey& key) {
  const auto& all = Entries();
  return *std::find_if(all.begin(), all.end(), [&](const Entry& e) { return std::string(e.key.name) == key.name; });
}

// Written by the converter of the cat asset. Objects are sorted by key, so that the plain names come later and win.
constexpr std::array<std::pair<const char*, const char*>, 2> kExtrasAliases = {
    {{"source_specular_power", "specular_power"}, {"source_specular_scale", "specular_scale"}}};

bool IsDescription(const std::string& key) {
  return key == "length_units" || key == "layer_rgb" || key == "layer_alpha" || key == "note" ||
         key.starts_with("source_");
}

const Entry* FindEntry(const std::string& name) {
  const auto& all = Entries();
  const auto it = std::find_if(all.begin(), all.end(), [&](const Entry& e) { return name == e.key.name; });
  return it == all.end() ? nullptr : &*it;
}

std::string KnownKeys() {
  std::string text;
  for (const Entry& e : Entries()) text += (text.empty() ? "" : ", ") + std::string(e.key.name);
  return text;
}

std::string RangeText(const FurKey& key) {
  std::ostringstream text;
  text << (key.minIsExcluded ? "above " : "from ") << key.min << " to " << key.max;
  return text.str();
}

// Each Take... returns an empty text, or what was expected.
std::string Take(const Json& value, const FurKey&, bool* out) {
  if (!value.is_boolean()) return "true or false";
  *out = value.get<bool>();
  return {};
}

std::string Take(const Json& value, const FurKey& key, double* out) {
  const double number = value.is_number() ? value.get<double>() : std::numeric_limits<double>::quiet_NaN();
  // A NaN fails both comparisons.
  if (!(key.minIsExcluded ? number > key.min : number >= key.min) || !(number <= key.max))
    return "a number " + RangeText(key);
  *out = number;
  return {};
}

std::string Take(const Json& value, const FurKey& key, uint32_t* out) {
  double number = 0;
  if (!value.is_number_integer() || !Take(value, key, &number).empty()) return "a whole number " + RangeText(key);
  *out = static_cast<uint32_t>(number);
  return {};
}

std::string Take(const Json& value, const FurKey& key, glm::dvec3* out) {
  glm::dvec3 v(0);
  bool ok = value.is_array() && value.size() == 3;
  for (int i = 0; ok && i < 3; ++i) ok = Take(value[size_t(i)], key, &v[i]).empty();
  if (!ok) return "an array of three numbers " + RangeText(key);
  *out = v;
  return {};
}

bool IsFileName(const Json& value) {
  return value.is_string() && value.get_ref<const std::string&>().find('\0') == std::string::npos;
}

std::string Take(const Json& value, const FurKey&, std::string* out) {
  if (!IsFileName(value)) return "a file name";
  *out = value.get<std::string>();
  return {};
}

std::string Take(const Json& value, const FurKey&, Strings* out) {
  const auto isName = [](const Json& name) { return IsFileName(name) && !name.get_ref<const std::string&>().empty(); };
  if (!value.is_array() || value.size() > kMaxLayerFiles || !std::all_of(value.begin(), value.end(), isName))
    return "an array of at most " + std::to_string(kMaxLayerFiles) + " file names";
  *out = value.get<Strings>();
  return {};
}

Error Refuse(const std::string& where, const std::string& key, const std::string& what) {
  return {ErrorCode::InputMalformed, where + ": \"" + key + "\" " + what};
}

Result<Done> ApplyKey(const Entry& entry, const Json& value, const std::string& where, const std::string& spelling,
                      FurParams* params) {
  const std::string expected =
      std::visit([&](auto member) { return Take(value, entry.key, &(params->*member)); }, entry.member);
  if (expected.empty()) return Done{};
  const std::string given = value.is_number() ? value.dump() : std::string(value.type_name());
  return Refuse(where, spelling, "must be " + expected + ", not " + given);
}

std::string WithoutAlias(const std::string& name) {
  for (const auto& [alias, plain] : kExtrasAliases)
    if (name == alias) return plain;
  return name;
}

template <class T>
Ordered AsJson(const T& value) {
  return value;
}
Ordered AsJson(const glm::dvec3& v) { return Ordered::array({v.x, v.y, v.z}); }

Ordered Default(const Entry& entry) {
  return std::visit([](auto member) { return AsJson(FurParams{}.*member); }, entry.member);
}

Ordered Range(const char* type, const FurKey& key) {
  Ordered j{{"type", type}};
  j[key.minIsExcluded ? "exclusiveMinimum" : "minimum"] = key.min;
  j["maximum"] = key.max;
  return j;
}

Ordered TypeSchema(const FurKey& key) {
  switch (key.kind) {
    case FurKind::Switch: return {{"type", "boolean"}};
    case FurKind::Number: return Range("number", key);
    case FurKind::Count: return Range("integer", key);
    case FurKind::Vector:
      return {{"type", "array"}, {"items", Range("number", key)}, {"minItems", 3}, {"maxItems", 3}};
    case FurKind::File: return {{"type", "string"}};
    case FurKind::Files: break;
  }
  return {{"type", "array"}, {"items", {{"type", "string"}, {"minLength", 1}}}, {"maxItems", kMaxLayerFiles}};
}

}  // namespace

std::span<const FurKey> FurKeys() {
  static const std::vector<FurKey> keys = [] {
    std::vector<FurKey> all;
    for (const Entry& e : Entries()) all.push_back(e.key);
    return all;
  }();
  return keys;
}

std::string DefaultText(const FurKey& key) { return Default(EntryOf(key)).dump(); }

std::string GroomSchema() {
  Ordered properties;
  for (const Entry& e : Entries()) {
    Ordered j{{"description", e.key.help}};
    j.update(TypeSchema(e.key));
    j["default"] = Default(e);
    properties[e.key.name] = j;
  }
  const Ordered reference{{"$ref", "#/$defs/fur"}};
  const Ordered perMaterial{{"anyOf", {reference, {{"const", false}}}}};
  const Ordered schema{
      {"$schema", "https://json-schema.org/draft/2020-12/schema"},
      {"title", "Fur file of fur render --groom; made by fur info --groom-schema"},
      {"type", "object"},
      {"properties",
       {{"default", reference}, {"materials", {{"type", "object"}, {"additionalProperties", perMaterial}}}}},
      {"additionalProperties", false},
      {"$defs", {{"fur", {{"type", "object"}, {"properties", properties}, {"additionalProperties", false}}}}}};
  return schema.dump(2) + "\n";
}

Result<Done> ApplyFurJson(const Json& object, const std::string& where, bool extras, FurParams* params) {
  if (!object.is_object())
    return Error{ErrorCode::InputMalformed, where + ": must be an object of fur parameters, not " + object.type_name()};
  FurParams changed = *params;  // all or nothing
  // The cat's extras state the published laws in words: "alpha*(1-i/16)", "0.9+0.1*i/16".
  if (extras && object.contains("source_shell_alpha")) changed.heightFalloff = 1;
  if (extras && object.contains("source_self_shadow")) changed.selfShadow = 0.9;
  for (const auto& [name, value] : object.items()) {
    const Entry* entry = FindEntry(extras ? WithoutAlias(name) : name);
    if (entry == nullptr && extras && IsDescription(name)) continue;
    if (entry == nullptr) return Refuse(where, name, "is not a fur parameter; known are " + KnownKeys());
    if (Result<Done> applied = ApplyKey(*entry, value, where, name, &changed); !applied) return applied;
  }
  *params = std::move(changed);
  return Done{};
}

Result<Done> CheckFurParams(const FurParams& params) {
  const auto check = [](const FurKey& key, double value) -> Result<Done> {
    const bool inside = value <= key.max && (key.minIsExcluded ? value > key.min : value >= key.min);
    if (inside) return Done{};
    std::ostringstream text;
    text << key.name << " must be " << RangeText(key) << ", not " << value;
    return Error{ErrorCode::InputMalformed, text.str()};
  };
  for (const Entry& e : Entries()) {
    if (const auto* number = std::get_if<double FurParams::*>(&e.member))
      if (Result<Done> ok = check(e.key, params.**number); !ok) return ok;
    const auto* vector = std::get_if<glm::dvec3 FurParams::*>(&e.member);
    for (int c = 0; vector && c < 3; ++c)
      if (Result<Done> ok = check(e.key, (params.**vector)[c]); !ok) return ok;
  }
  return Done{};
}

}  // namespace fur

// The parameters of a coat by name: one table for JSON, flags and help.
#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <sstream>
#include <variant>

#include "fur/bake.h"
#include "fur/bake_files.h"

namespace fur {
namespace {

using Json = nlohmann::json;
using Member = std::variant<uint32_t CoatParams::*, double CoatParams::*, double StrandClass::*>;

struct Entry {
  const char* name;
  Member member;
  double min, max;
  const char* help;
};

// Upper limits keep out what would take for ever, or nothing that is fur.
const Entry kCoat[] = {
    {"size", &CoatParams::size, 2, 2048, "texels across the tile"},
    {"layers", &CoatParams::layers, 2, 256, "slices"},
    {"seed", &CoatParams::seed, 0, 4294967295.0, "of everything that is random"},
    {"tile", &CoatParams::tile, 0.25, 64, "fur lengths across the tile"},
    {"dominants", &CoatParams::dominants, 0, 1, "share of the overcoat that draws the others to itself"},
    {"swirl_cells", &CoatParams::swirlCells, 1, 256, "eddies across the tile"},
    {"fin_depth", &CoatParams::finDepth, 0, 64, "thickness of the sheet that the fin slice shows, fur lengths"},
};

const Entry kClass[] = {
    {"density", &StrandClass::density, 0, 10000, "strands on a square of one fur length"},
    {"length", &StrandClass::length, 0.02, 2, "mean length of a strand, fur lengths"},
    {"length_spread", &StrandClass::lengthSpread, 0, 1, "deviation of the length, relative to it"},
    {"radius", &StrandClass::radius, 0.0005, 0.5, "mean radius at the root, fur lengths"},
    {"radius_spread", &StrandClass::radiusSpread, 0, 1, "deviation of the radius, relative to it"},
    {"taper", &StrandClass::taper, 0, 8, "radius (1 - h/l)^taper; 0: a cylinder"},
    {"curl", &StrandClass::curl, 0, 1, "radius of the curl at the tip, fur lengths"},
    {"curl_turns", &StrandClass::curlTurns, 0, 32, "turns of the curl in a fur length"},
    {"curl_exponent", &StrandClass::curlExponent, 0, 8, "the curl widens with (h/l)^exponent"},
    {"bias_x", &StrandClass::biasX, -8, 8, "lean along u, more with each fur length grown"},
    {"bias_y", &StrandClass::biasY, -8, 8, "lean up the picture, more with each fur length grown"},
    {"spread", &StrandClass::spread, 0, 4, "deviation of the lean at the root"},
    {"swirl", &StrandClass::swirl, 0, 8, "lean shared with neighbours, more with each fur length grown"},
    {"gravity", &StrandClass::gravity, 0, 8, "pull towards the skin"},
    {"noise", &StrandClass::noise, 0, 8, "wander of each strand"},
    {"clump", &StrandClass::clump, 0, 1, "how far the tip goes to the nearest dominant strand"},
    {"clump_exponent", &StrandClass::clumpExponent, 0, 8, "it goes there with (h/l)^exponent"},
    {"tint", &StrandClass::tint, 0, 2, "mean brightness"},
    {"tint_spread", &StrandClass::tintSpread, 0, 1, "deviation of the brightness"},
    {"warmth", &StrandClass::warmth, -1, 1, "mean of red up and blue down"},
    {"warmth_spread", &StrandClass::warmthSpread, 0, 1, "deviation of that"},
};

constexpr uint64_t kMostTexels = uint64_t{1} << 27;  // of a volume: 512 MiB, and as much for the tint
constexpr double kMostStrands = 200000;              // of a class

bool IsWhole(const Member& member) { return std::holds_alternative<uint32_t CoatParams::*>(member); }

// Calls use(member of params or of the class) for the key's member.
template <class Params, class Use>
void Visit(Params& params, const CoatKey& key, Use use) {
  const bool inClass = *key.group != '\0';
  const auto find = [&](const auto& table) -> const Entry& {
    return *std::find_if(std::begin(table), std::end(table),
                         [&](const Entry& e) { return std::string_view(e.name) == key.name; });
  };
  const Entry& entry = inClass ? find(kClass) : find(kCoat);
  auto& kind = std::string_view(key.group) == "under" ? params.under : params.over;
  if (const auto* whole = std::get_if<uint32_t CoatParams::*>(&entry.member))
    use(params.**whole);
  else if (const auto* number = std::get_if<double CoatParams::*>(&entry.member))
    use(params.**number);
  else
    use(kind.*std::get<double StrandClass::*>(entry.member));
}

std::string NumberText(double x) {
  std::ostringstream text;
  text.precision(10);
  text << x;
  return text.str();
}

const CoatKey* FindKey(const std::string& group, const std::string& name) {
  const std::span<const CoatKey> keys = CoatKeys();
  const auto it =
      std::find_if(keys.begin(), keys.end(), [&](const CoatKey& k) { return group == k.group && name == k.name; });
  return it == keys.end() ? nullptr : &*it;
}

std::string KnownKeys(const std::string& group) {
  std::string names;
  for (const CoatKey& key : CoatKeys())
    if (group == key.group) names += (names.empty() ? "" : ", ") + std::string(key.name);
  return names + (group.empty() ? ", under, over" : "");
}

Result<Done> ApplyObject(const Json& object, const std::string& group, const std::string& where, CoatParams* params) {
  const auto refuse = [&](const std::string& what) { return Error{ErrorCode::InputMalformed, where + ": " + what}; };
  if (!object.is_object())
    return refuse((group.empty() ? "" : "\"" + group + "\" ") + std::string("must be an object, not ") +
                  object.type_name());
  for (const auto& [name, value] : object.items()) {
    const std::string path = group.empty() ? name : group + "." + name;
    if (group.empty() && (name == "under" || name == "over")) {
      if (Result<Done> inner = ApplyObject(value, name, where, params); !inner) return inner;
      continue;
    }
    const CoatKey* key = FindKey(group, name);
    if (key == nullptr) return refuse("\"" + path + "\" is not a coat parameter; known are " + KnownKeys(group));
    if (!value.is_number()) return refuse("\"" + path + "\" must be a number, not " + value.type_name());
    if (Result<Done> set = SetCoatValue(*key, value.get<double>(), params); !set)
      return refuse("\"" + path + "\" " + set.error().message);
  }
  return Done{};
}

}  // namespace

StrandClass CoatParams::DefaultOvercoat() {
  return {.density = 45, .length = 0.92, .radius = 0.03, .swirl = 0.5, .noise = 0.7, .clump = 0.5};
}

std::span<const CoatKey> CoatKeys() {
  static const std::vector<CoatKey> keys = [] {
    std::vector<CoatKey> all;
    for (const Entry& e : kCoat) all.push_back({"", e.name, e.min, e.max, IsWhole(e.member), e.help});
    for (const char* group : {"under", "over"})
      for (const Entry& e : kClass) all.push_back({group, e.name, e.min, e.max, false, e.help});
    return all;
  }();
  return keys;
}

double CoatValue(const CoatParams& params, const CoatKey& key) {
  double value = 0;
  Visit(params, key, [&](const auto& member) { value = double(member); });
  return value;
}

Result<Done> SetCoatValue(const CoatKey& key, double value, CoatParams* params) {
  // A NaN fails every comparison.
  if (!(value >= key.min && value <= key.max) || (key.whole && value != std::floor(value)))
    return Error{ErrorCode::InputMalformed, std::string("must be a ") + (key.whole ? "whole " : "") + "number from " +
                                                NumberText(key.min) + " to " + NumberText(key.max) + ", not " +
                                                NumberText(value)};
  Visit(*params, key, [&](auto& member) { member = static_cast<std::decay_t<decltype(member)>>(value); });
  return Done{};
}

Result<Done> CheckCoat(const CoatParams& params) {
  if (uint64_t{params.size} * params.size * params.layers > kMostTexels)
    return Error{ErrorCode::Usage, "size " + std::to_string(params.size) + " with " + std::to_string(params.layers) +
                                       " layers is more than " + std::to_string(kMostTexels) +
                                       " texels; take a smaller size or fewer layers"};
  for (const auto& [name, kind] : {std::pair{"under", &params.under}, {"over", &params.over}}) {
    const double count = kind->density * params.tile * params.tile;
    if (!(count <= kMostStrands))
      return Error{ErrorCode::Usage, std::string("density of ") + name + " on the tile gives " + NumberText(count) +
                                         " strands, more than " + NumberText(kMostStrands) +
                                         "; take a lower density or a smaller tile"};
  }
  return Done{};
}

Result<Done> ApplyCoatJson(const Json& object, const std::string& where, CoatParams* params) {
  CoatParams changed = *params;  // all or nothing
  if (Result<Done> applied = ApplyObject(object, "", where, &changed); !applied) return applied;
  *params = changed;
  return Done{};
}

std::string CoatJson(const CoatParams& params) {
  nlohmann::ordered_json json;
  nlohmann::ordered_json& strands = json["strands"];
  for (const CoatKey& key : CoatKeys()) {
    nlohmann::ordered_json& object = *key.group == '\0' ? strands : strands[key.group];
    if (key.whole)
      object[key.name] = static_cast<uint64_t>(CoatValue(params, key));
    else
      object[key.name] = CoatValue(params, key);
  }
  return json.dump(2) + "\n";
}

}  // namespace fur

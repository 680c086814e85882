// Markings from JSON: one table of keys for reader and messages.
#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>
#include <sstream>
#include <variant>

#include "fur/markings.h"

namespace fur {
namespace {

using Json = nlohmann::json;
using Ramps = std::vector<BodyRamp>;

template <class Object>
struct Entry {
  const char* name;
  std::variant<double Object::*, uint32_t Object::*, glm::dvec3 Object::*, Ramps Object::*, Pattern Object::*> member;
  double min = 0, max = 1;  // of numbers
};

using M = Markings;
using L = MarkingLayer;
const Entry<M> kMarkings[] = {{"base", &M::base}, {"over_base", &M::overBase}, {"size", &M::size, 16, 4096}};
const Entry<L> kLayer[] = {
    {"pattern", &L::pattern},
    {"color", &L::color},
    {"opacity", &L::opacity},
    {"scale", &L::scale, 0.002, 2},
    {"coverage", &L::coverage},
    {"softness", &L::softness},
    {"length", &L::length, 1, 100},
    {"irregular", &L::irregular},
    {"ring", &L::ring},
    {"ragged", &L::ragged, 0, 2},
    {"seed", &L::seed, 0, 4294967295.0},
    {"where", &L::where},
    {"taper", &L::taper},
};

const std::pair<const char*, Pattern> kPatterns[] = {{"solid", Pattern::Solid},     {"stripes", Pattern::Stripes},
                                                     {"rosettes", Pattern::Rosettes}, {"spots", Pattern::Spots},
                                                     {"patches", Pattern::Patches}, {"streaks", Pattern::Streaks}};
using Coordinate = BodyCoordinate;
const std::pair<const char*, Coordinate> kCoordinates[] = {
    {"height", Coordinate::Height}, {"up", Coordinate::Up},       {"front", Coordinate::Front},
    {"inward", Coordinate::Inward}, {"side", Coordinate::Side},   {"along", Coordinate::Along},
    {"nose", Coordinate::Nose},     {"tail", Coordinate::Tail},   {"feet", Coordinate::Feet}};

constexpr size_t kMostLayers = 64;

// Stops at the first problem.
struct Refusal {
  std::string message;
};
[[noreturn]] void Refuse(const std::string& path, const std::string& what) { throw Refusal{"\"" + path + "\" " + what}; }

[[noreturn]] void Expect(const std::string& path, const std::string& what, const Json& given) {
  Refuse(path, "must be " + what + ", not " + (given.is_number() || given.is_string() ? given.dump() : given.type_name()));
}

std::string Range(double min, double max) {
  std::ostringstream text;
  text.precision(10);
  text << "from " << min << " to " << max;
  return text.str();
}

template <class Table>
std::string Names(const Table& table, const char* more = "") {
  std::string names;
  for (const auto& [name, rest] : table) names += (names.empty() ? "" : ", ") + std::string(name);
  return names + more;
}

template <class Object, size_t N>
std::string Names(const Entry<Object> (&table)[N], const char* more = "") {
  std::string names;
  for (const auto& e : table) names += (names.empty() ? "" : ", ") + std::string(e.name);
  return names + more;
}

template <class Value, size_t N>
const Value* Find(const std::pair<const char*, Value> (&table)[N], const std::string& name) {
  const auto it = std::find_if(std::begin(table), std::end(table), [&](const auto& e) { return name == e.first; });
  return it == std::end(table) ? nullptr : &it->second;
}

void Read(const Json& json, const std::string& path, double min, double max, double* out) {
  if (!json.is_number() || !(json.get<double>() >= min && json.get<double>() <= max))
    Expect(path, "a number " + Range(min, max), json);
  *out = json.get<double>();
}

void Read(const Json& json, const std::string& path, double min, double max, uint32_t* out) {
  if (!json.is_number_integer() || !(json.get<double>() >= min && json.get<double>() <= max))
    Expect(path, "a whole number " + Range(min, max), json);
  *out = json.get<uint32_t>();
}

void Read(const Json& json, const std::string& path, double, double, glm::dvec3* out) {
  if (!json.is_array() || json.size() != 3) Expect(path, "a colour [r, g, b], sRGB, 0..1", json);
  for (int k = 0; k < 3; ++k) Read(json[size_t(k)], path + "[" + std::to_string(k) + "]", 0, 1, &(*out)[k]);
}

void Read(const Json& json, const std::string& path, double, double, Pattern* out) {
  const Pattern* pattern = json.is_string() ? Find(kPatterns, json.get<std::string>()) : nullptr;
  if (pattern == nullptr) Expect(path, "one of " + Names(kPatterns), json);
  *out = *pattern;
}

void Read(const Json& json, const std::string& path, double, double, Ramps* out) {
  if (!json.is_object()) Expect(path, "an object of ramps, as {\"up\": [0, 0.5]}", json);
  for (const auto& [name, value] : json.items()) {
    const std::string inner = path + "." + name;
    BodyRamp ramp;
    const Coordinate* coordinate = Find(kCoordinates, name);
    if (coordinate == nullptr) Refuse(inner, "is no place on the body; known are " + Names(kCoordinates));
    if (!value.is_array() || value.size() != 2) Expect(inner, "two numbers [from, to]", value);
    Read(value[0], inner + "[0]", -10, 10, &ramp.from);
    Read(value[1], inner + "[1]", -10, 10, &ramp.to);
    if (ramp.from == ramp.to) Refuse(inner, "must be two different numbers: it goes from 0 at the one to 1 at the other");
    ramp.coordinate = *coordinate;
    out->push_back(ramp);
  }
}

// False if the table has no such key.
template <class Object, size_t N>
bool ReadKey(const Entry<Object> (&table)[N], const std::string& name, const Json& value, const std::string& path,
             Object* out) {
  const auto it = std::find_if(std::begin(table), std::end(table), [&](const auto& e) { return name == e.name; });
  if (it == std::end(table)) return false;
  std::visit([&](auto member) { Read(value, path, it->min, it->max, &(out->*member)); }, it->member);
  return true;
}

MarkingLayer ReadLayer(const Json& json, const std::string& path) {
  if (!json.is_object()) Expect(path, "an object", json);
  MarkingLayer layer;
  for (const auto& [name, value] : json.items())
    if (!ReadKey(kLayer, name, value, path + "." + name, &layer))
      Refuse(path + "." + name, "is no key of a layer; known are " + Names(kLayer));
  return layer;
}

Markings ReadAll(const Json& json) {
  if (!json.is_object()) throw Refusal{std::string("must be an object, not ") + json.type_name()};
  Markings markings;
  for (const auto& [name, value] : json.items()) {
    if (name != "layers") {
      if (!ReadKey(kMarkings, name, value, name, &markings))
        Refuse(name, "is no key of markings; known are " + Names(kMarkings, ", layers"));
      continue;
    }
    if (!value.is_array() || value.size() > kMostLayers)
      Expect(name, "an array of at most " + std::to_string(kMostLayers) + " layers", value);
    for (size_t i = 0; i < value.size(); ++i)
      markings.layers.push_back(ReadLayer(value[i], "layers[" + std::to_string(i) + "]"));
  }
  return markings;
}

}  // namespace

Result<Markings> ReadMarkings(const Json& object, const std::string& where) {
  try {
    return ReadAll(object);
  } catch (const Refusal& refusal) {
    return Error{ErrorCode::InputMalformed, where + ": " + refusal.message};
  }
}

}  // namespace fur

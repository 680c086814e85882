#include "groom_flags.h"

#include <fmt/format.h>

#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <sstream>

#include "fur/params.h"

namespace app {
namespace {

using fur::Error;
using fur::ErrorCode;
using fur::FurKey;
using fur::FurKind;
using fur::Result;
using Json = nlohmann::json;

bool IsFlag(const FurKey& key) { return std::string(key.name) != "shells"; }

std::string Help(const FurKey& key) {
  std::string text = key.help;
  if (key.kind == FurKind::Vector) text += "; X,Y,Z";
  if (key.kind == FurKind::Files) text += "; A.png,B.png,...";
  const bool number = key.kind == FurKind::Number && key.max < 1e5;
  if (number) text += fmt::format("; {}..{}", key.min, key.max);
  return text + "; default: the coat's, or " + fur::DefaultText(key);
}

std::vector<std::string> Split(const std::string& text) {
  std::vector<std::string> parts;
  std::istringstream in(text);
  for (std::string part; std::getline(in, part, ',');) parts.push_back(part);
  return parts;
}

Result<Json> Value(const FurKey& key, const std::string& text) {
  switch (key.kind) {
    case FurKind::Switch: return Json(text == "true");
    case FurKind::Number:
    case FurKind::Count: return Json(std::strtod(text.c_str(), nullptr));
    case FurKind::File: return Json(text);
    case FurKind::Files: return Json(Split(text));
    case FurKind::Vector: break;
  }
  const Result<glm::dvec3> v = ParseVector(text, key.flag);
  if (!v) return v.error();
  for (int i = 0; i < 3; ++i)
    if ((*v)[i] < key.min || (*v)[i] > key.max)
      return Error{ErrorCode::Usage,
                   fmt::format("{} takes numbers of {}..{}, not '{}'", key.flag, key.min, key.max, text)};
  return Json::array({v->x, v->y, v->z});
}

}  // namespace

Result<glm::dvec3> ParseVector(const std::string& text, const char* flag) {
  glm::dvec3 v(0);
  char rest = 0;
  const int read = std::sscanf(text.c_str(), "%lf,%lf,%lf%c", &v.x, &v.y, &v.z, &rest);
  if (read == 3 && std::isfinite(v.x + v.y + v.z)) return v;
  return Error{ErrorCode::Usage, fmt::format("{} takes three finite numbers X,Y,Z, not '{}'", flag, text)};
}

void AddGroomFlags(CLI::App* app, std::map<std::string, std::string>* values) {
  for (const FurKey& key : fur::FurKeys()) {
    if (!IsFlag(key)) continue;
    const std::string name = key.name;
    CLI::Option* option = app->add_option_function<std::string>(
        key.flag, [values, name](const std::string& text) { (*values)[name] = text; }, Help(key));
    if (key.kind == FurKind::Number) {
      option->check(kFinite)->check(CLI::Range(key.min, key.max));
      if (key.minIsExcluded) option->check(CLI::PositiveNumber);
    }
    if (key.kind == FurKind::Switch) option->check(CLI::IsMember({"true", "false"}));
    option->group("The coat (docs/fur.md)");
  }
}

Result<std::string> GroomOverrides(const std::map<std::string, std::string>& values) {
  Json json = Json::object();
  for (const FurKey& key : fur::FurKeys()) {
    const auto given = values.find(key.name);
    if (given == values.end()) continue;
    const Result<Json> value = Value(key, given->second);
    if (!value) return value.error();
    json[key.name] = *value;
  }
  return json.empty() ? std::string() : json.dump();
}

}  // namespace app

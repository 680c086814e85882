// A table of what a glTF file may say where, checked before tinygltf sees the text: tinygltf takes wrong types for
// absent values and follows references without looking.
#include <algorithm>
#include <cmath>
#include <limits>
#include <string_view>

#include "gltf_internal.h"

namespace fur::gltf {
namespace {

enum class Kind { Object, Array, UInt, Number, Numbers, Text, Bool, Reference };

struct Rule {
  const char* path;  // '.' enters an object, "[]" each element of an array, "{}" each member of an object
  Kind kind;
  const char* target = nullptr;  // Reference: the top-level array
  unsigned limit = 0;            // Numbers: how many; UInt: the largest, 0: any
  bool required = false;
};

constexpr Rule kRules[] = {
    {.path = "asset", .kind = Kind::Object, .required = true},
    {.path = "asset.version", .kind = Kind::Text, .required = true},
    {.path = "extensionsUsed[]", .kind = Kind::Text},
    {.path = "extensionsRequired[]", .kind = Kind::Text},
    {.path = "scene", .kind = Kind::Reference, .target = "scenes"},
    {.path = "scenes[].nodes[]", .kind = Kind::Reference, .target = "nodes"},
    {.path = "nodes[].name", .kind = Kind::Text},
    {.path = "nodes[].mesh", .kind = Kind::Reference, .target = "meshes"},
    {.path = "nodes[].skin", .kind = Kind::Reference, .target = "skins"},
    {.path = "nodes[].children[]", .kind = Kind::Reference, .target = "nodes"},
    {.path = "nodes[].matrix", .kind = Kind::Numbers, .limit = 16},
    {.path = "nodes[].translation", .kind = Kind::Numbers, .limit = 3},
    {.path = "nodes[].rotation", .kind = Kind::Numbers, .limit = 4},
    {.path = "nodes[].scale", .kind = Kind::Numbers, .limit = 3},
    {.path = "meshes[].name", .kind = Kind::Text},
    {.path = "meshes[].primitives", .kind = Kind::Array, .required = true},
    {.path = "meshes[].primitives[]", .kind = Kind::Object},
    {.path = "meshes[].primitives[].mode", .kind = Kind::UInt, .limit = 6},
    {.path = "meshes[].primitives[].material", .kind = Kind::Reference, .target = "materials"},
    {.path = "meshes[].primitives[].indices", .kind = Kind::Reference, .target = "accessors"},
    {.path = "meshes[].primitives[].attributes", .kind = Kind::Object, .required = true},
    {.path = "meshes[].primitives[].attributes{}", .kind = Kind::Reference, .target = "accessors"},
    {.path = "meshes[].primitives[].targets[]{}", .kind = Kind::Reference, .target = "accessors"},
    {.path = "accessors[].bufferView", .kind = Kind::Reference, .target = "bufferViews"},
    {.path = "accessors[].byteOffset", .kind = Kind::UInt},
    {.path = "accessors[].count", .kind = Kind::UInt, .required = true},
    {.path = "accessors[].componentType", .kind = Kind::UInt, .required = true},
    {.path = "accessors[].type", .kind = Kind::Text, .required = true},
    {.path = "accessors[].normalized", .kind = Kind::Bool},
    {.path = "accessors[].sparse.count", .kind = Kind::UInt, .required = true},
    {.path = "accessors[].sparse.indices", .kind = Kind::Object, .required = true},
    {.path = "accessors[].sparse.indices.bufferView",
     .kind = Kind::Reference,
     .target = "bufferViews",
     .required = true},
    {.path = "accessors[].sparse.indices.byteOffset", .kind = Kind::UInt},
    {.path = "accessors[].sparse.indices.componentType", .kind = Kind::UInt, .required = true},
    {.path = "accessors[].sparse.values", .kind = Kind::Object, .required = true},
    {.path = "accessors[].sparse.values.bufferView",
     .kind = Kind::Reference,
     .target = "bufferViews",
     .required = true},
    {.path = "accessors[].sparse.values.byteOffset", .kind = Kind::UInt},
    {.path = "bufferViews[].buffer", .kind = Kind::Reference, .target = "buffers", .required = true},
    {.path = "bufferViews[].byteOffset", .kind = Kind::UInt},
    {.path = "bufferViews[].byteLength", .kind = Kind::UInt, .required = true},
    {.path = "bufferViews[].byteStride", .kind = Kind::UInt, .limit = 252},
    {.path = "buffers[].byteLength", .kind = Kind::UInt, .required = true},
    {.path = "buffers[].uri", .kind = Kind::Text},
    {.path = "images[].name", .kind = Kind::Text},
    {.path = "images[].uri", .kind = Kind::Text},
    {.path = "images[].mimeType", .kind = Kind::Text},
    {.path = "images[].bufferView", .kind = Kind::Reference, .target = "bufferViews"},
    {.path = "samplers[].wrapS", .kind = Kind::UInt},
    {.path = "samplers[].wrapT", .kind = Kind::UInt},
    {.path = "textures[].source", .kind = Kind::Reference, .target = "images"},
    {.path = "textures[].sampler", .kind = Kind::Reference, .target = "samplers"},
    {.path = "materials[].name", .kind = Kind::Text},
    {.path = "materials[].doubleSided", .kind = Kind::Bool},
    {.path = "materials[].pbrMetallicRoughness.baseColorFactor", .kind = Kind::Numbers, .limit = 4},
    {.path = "materials[].pbrMetallicRoughness.metallicFactor", .kind = Kind::Number},
    {.path = "materials[].pbrMetallicRoughness.roughnessFactor", .kind = Kind::Number},
    {.path = "materials[].normalTexture.scale", .kind = Kind::Number},
    {.path = "materials[].extensions.KHR_materials_specular.specularColorFactor", .kind = Kind::Numbers, .limit = 3},
    {.path = "skins[].joints", .kind = Kind::Array, .required = true},
    {.path = "skins[].joints[]", .kind = Kind::Reference, .target = "nodes"},
    {.path = "skins[].inverseBindMatrices", .kind = Kind::Reference, .target = "accessors"},
    {.path = "skins[].skeleton", .kind = Kind::Reference, .target = "nodes"},
};

constexpr const char* kArrays[] = {"accessors", "bufferViews", "buffers", "images", "materials", "meshes",
                                   "nodes",     "samplers",    "scenes",  "skins",  "textures"};

constexpr const char* kTextureInfos[] = {
    "materials[].pbrMetallicRoughness.baseColorTexture",
    "materials[].pbrMetallicRoughness.metallicRoughnessTexture",
    "materials[].normalTexture",
    "materials[].occlusionTexture",
    "materials[].emissiveTexture",
    "materials[].extensions.KHR_materials_specular.specularColorTexture",
    "materials[].extensions.KHR_materials_specular.specularTexture",
};

// tinygltf keeps these numbers in an int.
constexpr uint64_t kMaxInteger = std::numeric_limits<int32_t>::max();

class Checker {
 public:
  Checker(const Json& json, const std::string& where) : json_(json), where_(where) {}

  void Check(const Rule& rule) const { Walk(json_, "", rule.path, rule); }

  template <class... Args>
  [[noreturn]] void Fail(const Args&... what) const {
    throw LoadFailure(ErrorCode::InputMalformed, Text(where_, ": ", what...));
  }

 private:
  const Json& json_;
  const std::string& where_;

  // Follows `rest` down from `value`, which was found at `at`.
  void Walk(const Json& value, const std::string& at, std::string_view rest, const Rule& rule) const {
    if (rest.empty()) return CheckValue(value, at, rule);
    if (rest.starts_with("[]")) return WalkArray(value, at, rest.substr(2), rule);
    if (rest.starts_with("{}")) return WalkMembers(value, at, rest.substr(2), rule);
    if (rest.starts_with(".")) rest.remove_prefix(1);
    const size_t end = rest.find_first_of(".[{");
    const std::string key(rest.substr(0, end));
    const std::string_view after = end == std::string_view::npos ? std::string_view{} : rest.substr(end);
    if (!value.is_object()) Fail(at, " must be an object, not ", value.type_name());
    const std::string inner = at.empty() ? key : at + "." + key;
    if (const auto it = value.find(key); it != value.end()) return Walk(*it, inner, after, rule);
    if (after.empty() && rule.required) Fail(inner, " is missing");
  }

  void WalkArray(const Json& value, const std::string& at, std::string_view rest, const Rule& rule) const {
    if (!value.is_array()) Fail(at, " must be an array, not ", value.type_name());
    for (size_t i = 0; i < value.size(); ++i) Walk(value[i], Text(at, "[", i, "]"), rest, rule);
  }

  void WalkMembers(const Json& value, const std::string& at, std::string_view rest, const Rule& rule) const {
    if (!value.is_object()) Fail(at, " must be an object, not ", value.type_name());
    for (const auto& [key, member] : value.items()) Walk(member, at + "." + key, rest, rule);
  }

  void CheckValue(const Json& value, const std::string& at, const Rule& rule) const {
    switch (rule.kind) {
      case Kind::Object: return Expect(value.is_object(), value, at, "an object");
      case Kind::Array: return Expect(value.is_array(), value, at, "an array");
      case Kind::Text: return Expect(value.is_string(), value, at, "a string");
      case Kind::Bool: return Expect(value.is_boolean(), value, at, "true or false");
      case Kind::Number: return CheckNumber(value, at);
      case Kind::Numbers: return CheckNumbers(value, at, rule.limit);
      case Kind::UInt: return CheckUInt(value, at, rule.limit == 0 ? kMaxInteger : rule.limit);
      case Kind::Reference: return CheckReference(value, at, rule.target);
    }
  }

  void Expect(bool ok, const Json& value, const std::string& at, const char* expected) const {
    if (!ok) Fail(at, " must be ", expected, ", not ", value.type_name());
  }

  // What does not fit a float would become infinite.
  void CheckNumber(const Json& value, const std::string& at) const {
    Expect(value.is_number(), value, at, "a number");
    if (!(std::abs(value.get<double>()) <= std::numeric_limits<float>::max())) Fail(at, " is out of a float's range");
  }

  void CheckNumbers(const Json& value, const std::string& at, size_t count) const {
    if (!value.is_array() || value.size() != count) Fail(at, " must be an array of ", count, " numbers");
    for (size_t i = 0; i < count; ++i) CheckNumber(value[i], Text(at, "[", i, "]"));
  }

  void CheckUInt(const Json& value, const std::string& at, uint64_t limit) const {
    if (!value.is_number_unsigned()) Fail(at, " must be a whole number from 0, not ", value.dump().substr(0, 40));
    if (value.get<uint64_t>() > limit) Fail(at, " is ", value.get<uint64_t>(), ", at most ", limit, " is allowed");
  }

  void CheckReference(const Json& value, const std::string& at, const char* target) const {
    CheckUInt(value, at, kMaxInteger);
    const auto it = json_.find(target);
    const size_t count = it != json_.end() && it->is_array() ? it->size() : 0;
    if (value.get<uint64_t>() >= count)
      Fail(at, " refers to ", target, "[", value.get<uint64_t>(), "], but there are ", count);
  }
};

uint64_t Get(const Json& object, const char* key) {
  const auto it = object.find(key);
  return it == object.end() ? 0 : it->get<uint64_t>();
}

// tinygltf takes the address of a picture's first byte without looking, so that views are checked before it runs. It
// makes every buffer exactly byteLength long.
void CheckViews(const Json& json, const Checker& checker) {
  const auto views = json.find("bufferViews");
  if (views == json.end()) return;
  for (size_t i = 0; i < views->size(); ++i) {
    const Json& view = (*views)[i];
    const uint64_t end = Get(view, "byteOffset") + Get(view, "byteLength");
    const uint64_t size = Get(json["buffers"][Get(view, "buffer")], "byteLength");
    if (end > size)
      checker.Fail("bufferViews[", i, "] ends at byte ", end, ", but buffers[", Get(view, "buffer"), "] has ", size);
    if (Get(view, "byteLength") == 0) checker.Fail("bufferViews[", i, "].byteLength is 0");
  }
}

// Any other data URI would be taken for a file name.
void CheckUris(const Json& json, const char* array, const Checker& checker) {
  const auto it = json.find(array);
  if (it == json.end()) return;
  for (size_t i = 0; i < it->size(); ++i) {
    const std::string uri = (*it)[i].value("uri", std::string());
    if (uri.find('\0') != std::string::npos) checker.Fail(array, "[", i, "].uri has a zero character");
    if (uri.starts_with("data:") && !tinygltf::IsDataURI(uri))
      checker.Fail(array, "[", i, "].uri is a data URI of an unknown type or not in base64: ", uri.substr(0, 40));
  }
}

void CheckExtensions(const Json& json, const Checker& checker) {
  constexpr const char* kSupported[] = {"KHR_materials_specular", "KHR_mesh_quantization", "KHR_lights_punctual"};
  const auto required = json.find("extensionsRequired");
  if (required == json.end()) return;
  for (const Json& extension : *required) {
    const std::string name = extension.get<std::string>();
    if (std::find(std::begin(kSupported), std::end(kSupported), name) == std::end(kSupported))
      checker.Fail("needs the glTF extension ", name,
                   ", which is not supported; export the model without it (uncompressed, textures untransformed)");
  }
}

}  // namespace

void CheckSchema(const Json& json, const std::string& where) {
  const Checker checker(json, where);
  if (!json.is_object()) checker.Fail("is JSON, but not a glTF object");
  // First, so that references count what is really there.
  for (const char* array : kArrays) checker.Check({.path = array, .kind = Kind::Array});
  for (const Rule& rule : kRules) checker.Check(rule);
  for (const std::string info : kTextureInfos) {
    checker.Check({.path = (info + ".index").c_str(), .kind = Kind::Reference, .target = "textures", .required = true});
    checker.Check({.path = (info + ".texCoord").c_str(), .kind = Kind::UInt});
  }
  const std::string version = json["asset"]["version"].get<std::string>();
  if (!version.starts_with("2.")) checker.Fail("is glTF version ", version, "; only 2.x is read");
  CheckExtensions(json, checker);
  CheckViews(json, checker);
  CheckUris(json, "buffers", checker);
  CheckUris(json, "images", checker);
}

}  // namespace fur::gltf

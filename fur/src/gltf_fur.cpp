// Which materials grow fur, and with which parameters, maps and volume.
#include <algorithm>
#include <cctype>
#include <cmath>

#include "body.h"
#include "file_bytes.h"
#include "fur/bake.h"
#include "fur/coat.h"
#include "fur/groom.h"
#include "fur/image_io.h"
#include "gltf_internal.h"
#include "surface_painter.h"
#include "unwrap.h"

namespace fur::gltf {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void Fail(const Error& error) { throw LoadFailure(error.code, error.message); }

// One object of parameters and where its file names start.
struct Source {
  Json object;
  std::string where;
  fs::path folder;
  bool extras = false;
  ErrorCode code = ErrorCode::InputMalformed;
};

// The fur file, checked.
struct FurFile {
  Json materials = Json::object();
  std::optional<Source> fallback;  // "default"
  fs::path folder;
};

bool ContainsFur(std::string name) {
  std::transform(name.begin(), name.end(), name.begin(), [](unsigned char c) { return std::tolower(c); });
  return name.find("fur") != std::string::npos;
}

std::string MaterialNames(const Model& model) {
  std::string names;
  for (const Material& material : model.materials) names += (names.empty() ? "\"" : ", \"") + material.name + "\"";
  return names;
}

bool HasMaterial(const Model& model, const std::string& name) {
  return std::any_of(model.materials.begin(), model.materials.end(),
                     [&](const Material& material) { return material.name == name; });
}

void CheckFurFile(const Json& json, const std::string& where, const Model& model) {
  const auto refuse = [&](const auto&... what) { Fail({ErrorCode::InputMalformed, Text(where, ": ", what...)}); };
  if (!json.is_object()) refuse("must be a JSON object with \"default\" and \"materials\"");
  for (const auto& [key, value] : json.items()) {
    if (key != "default" && key != "materials")
      refuse("\"", key, "\" is not known here; known are default, materials (fur parameters go inside them)");
    if (!value.is_object()) refuse("\"", key, "\" must be an object, not ", value.type_name());
  }
  if (!json.contains("materials")) return;
  for (const auto& [name, value] : json["materials"].items()) {
    if (!HasMaterial(model, name))
      refuse("the model has no material \"", name, "\"; its materials are ", MaterialNames(model));
    if (!value.is_object() && value != false) refuse("materials.", name, " must be an object or false");
  }
}

FurFile ReadFurFile(const fs::path& file, const Model& model) {
  FurFile out;
  if (file.empty()) return out;
  Result<std::vector<uint8_t>> bytes = ReadFileBytes(file, uint64_t{1} << 24);
  if (!bytes) Fail(bytes.error());
  const Json json = ParseJson(*bytes, file.string());
  CheckFurFile(json, file.string(), model);
  out.folder = file.parent_path();
  out.materials = json.value("materials", Json::object());
  if (json.contains("default")) out.fallback = Source{json["default"], file.string() + ": default", out.folder};
  return out;
}

class Resolver {
 public:
  Resolver(Document& doc, const LoadOptions& options, std::span<const double> unitScale, Model* model)
      : doc_(doc), options_(options), unitScale_(unitScale), model_(*model), diameter_(Diameter(*model)) {
    file_ = ReadFurFile(options.furFile, model_);
  }

  void ResolveAll() {
    const std::vector<bool> furred = Choose();
    for (uint32_t i = 0; i < model_.materials.size(); ++i) {
      const FurParams params = Params(i, furred[i]);
      model_.materials[i].fur = furred[i] && params.enabled ? std::optional(Grow(i, params)) : std::nullopt;
    }
    if (options_.coat != nullptr && options_.coat->markings) Paint(*options_.coat->markings);
  }

 private:
  Document& doc_;
  const LoadOptions& options_;
  std::span<const double> unitScale_;
  Model& model_;
  double diameter_;
  FurFile file_;
  std::map<std::string, int32_t> images_;                // by path: each file is read once
  std::map<std::pair<int32_t, int32_t>, int32_t> furless_;  // by the pictures of length and of where fur is
  std::map<std::vector<std::string>, int32_t> volumes_;  // by the layers' paths; none: the grown volume

  static double Diameter(const Model& model) {
    const double diameter = ComputeBounds(model).Diameter();
    return diameter > 0 ? diameter : 1;
  }

  const Json* Extras(uint32_t material) const {
    if (material >= doc_.model.materials.size()) return nullptr;  // the default material
    const Json& json = doc_.json["materials"][material];
    const Json::json_pointer path("/extras/fur");
    return json.contains(path) ? &json[path] : nullptr;
  }

  // The first of these rules that finds a material decides; docs/fur.md lists them too.
  std::vector<bool> Choose() const {
    const size_t count = model_.materials.size();
    std::vector<bool> chosen(count);
    const auto choose = [&](const auto& rule) {
      bool any = false;
      for (uint32_t i = 0; i < count; ++i) {
        chosen[i] = rule(i);
        any |= chosen[i];
      }
      return any;
    };
    const auto name = [&](uint32_t i) -> const std::string& { return model_.materials[i].name; };
    if (!options_.furMaterial.empty()) {
      if (choose([&](uint32_t i) { return name(i) == options_.furMaterial; })) return chosen;
      Fail({ErrorCode::Usage, Text("the model has no material \"", options_.furMaterial, "\"; its materials are ",
                                   MaterialNames(model_))});
    }
    const auto bald = [&](uint32_t i) { return file_.materials.value(name(i), Json()) == false; };
    const auto named = [&](uint32_t i) {
      return file_.materials.contains(name(i)) || Extras(i) != nullptr || model_.materials[i].fur.has_value();
    };
    if (choose([&](uint32_t i) { return !bald(i) && named(i); })) return chosen;
    if (choose([&](uint32_t i) { return !bald(i) && ContainsFur(name(i)); })) return chosen;
    choose([&](uint32_t i) { return !bald(i); });
    return chosen;
  }

  // What the asset says; the coat of the command line comes next.
  std::vector<Source> AssetSources(uint32_t material) const {
    const Json* extras = Extras(material);
    if (extras == nullptr) return {};
    return {{*extras, Text(doc_.file.string(), ": materials[", material, "].extras.fur"), doc_.file.parent_path(), true}};
  }

  // Later sources win.
  std::vector<Source> UserSources(uint32_t material, bool furred) const {
    std::vector<Source> sources;
    const std::string& name = model_.materials[material].name;
    if (file_.fallback) sources.push_back(*file_.fallback);
    if (file_.materials.contains(name) && file_.materials[name].is_object())
      sources.push_back({file_.materials[name], Text(options_.furFile.string(), ": materials.", name), file_.folder});
    if (!options_.furOverrides.empty() && furred) sources.push_back(Overrides());
    return sources;
  }

  Source Overrides() const {
    const auto* text = reinterpret_cast<const uint8_t*>(options_.furOverrides.data());
    try {
      return {ParseJson({text, options_.furOverrides.size()}, "fur flags"), "fur flags", {}, false, ErrorCode::Usage};
    } catch (const LoadFailure& failure) {
      throw LoadFailure(ErrorCode::Usage, failure.what());
    }
  }

  // Bald materials' parameters are checked too: a typing error should not hide behind another setting.
  FurParams Params(uint32_t material, bool furred) const {
    const std::optional<MaterialFur>& coat = model_.materials[material].fur;
    FurParams params = coat ? coat->params : FurParams{};
    Apply(AssetSources(material), &params);
    if (options_.coat != nullptr && furred) params = Wear(*options_.coat, params, diameter_ / UnitScale(material));
    Apply(UserSources(material, furred), &params);
    return params;
  }

  void Apply(const std::vector<Source>& sources, FurParams* params) const {
    for (const Source& source : sources) {
      if (Result<Done> ok = ApplyFurJson(source.object, source.where, source.extras, params); !ok)
        Fail({source.code, ok.error().message});
      ResolvePaths(source, params);
    }
  }

  // Makes the names that this source has set independent of where it stands.
  void ResolvePaths(const Source& source, FurParams* params) const {
    const auto resolve = [&](std::string& name) {
      if (!name.empty()) name = Find(source.folder, name).string();
    };
    if (source.object.contains("length_map")) resolve(params->lengthMap);
    if (source.object.contains("direction_map")) resolve(params->directionMap);
    if (source.object.contains("furless_map")) resolve(params->furlessMap);
    if (source.object.contains("layers")) std::for_each(params->layers.begin(), params->layers.end(), resolve);
  }

  // Beside the file that names it, else beside the model. An absolute name replaces the folder.
  fs::path Find(const fs::path& folder, const std::string& name) const {
    std::error_code failed;
    const fs::path near = folder / name, atModel = doc_.file.parent_path() / name;
    return !fs::exists(near, failed) && fs::exists(atModel, failed) ? atModel : near;
  }

  MaterialFur Grow(uint32_t material, const FurParams& params) {
    MaterialFur fur = model_.materials[material].fur.value_or(MaterialFur{});
    fur.params = params;
    const bool wearsCoat = options_.coat != nullptr && params.layers.empty();
    if (fur.volume < 0 || wearsCoat || !params.layers.empty()) fur.volume = Volume(params.layers);
    if (!params.lengthMap.empty()) fur.lengthMap = ImageFile(params.lengthMap);
    if (!params.directionMap.empty()) fur.directionMap = ImageFile(params.directionMap);
    if (!params.furlessMap.empty()) fur.lengthMap = Furless(fur.lengthMap, ImageFile(params.furlessMap));
    const double unit = UnitScale(material);
    constexpr double kLengthOfDiameter = 0.025;  // a short coat on an animal
    if (fur.params.length == 0) fur.params.length = kLengthOfDiameter * diameter_ / unit;
    const double tile = wearsCoat ? options_.coat->strands.tile : kTileOverLength;
    if (fur.params.layerUvScale == 0) fur.params.layerUvScale = TilesAcross(material, tile * fur.params.length * unit);
    return fur;
  }

  // Of the first primitive that wears the material.
  double UnitScale(uint32_t material) const {
    for (size_t i = 0; i < model_.primitives.size(); ++i)
      if (model_.primitives[i].material == material) return unitScale_[i];
    return 1;
  }

  // Strands look natural when a tile, which holds some forty of them across, covers about as much skin as the fur is
  // long: then a strand is a few hundredths of its length thick. The mean size of the UV square on the skin follows
  // from the areas. A whole number keeps the tiling seamless where u or v wraps from 1 to 0.
  double TilesAcross(uint32_t material, double tile) const {
    constexpr double kMostTiles = 4096;
    double skin = 0, uv = 0;
    for (const Part& part : model_.parts)
      if (model_.primitives[part.primitive].material == material) AddAreas(part, &skin, &uv);
    if (!(skin > 0) || !(uv > 0) || !(tile > 0)) return 1;
    return std::clamp(std::round(std::sqrt(skin / uv) / tile), 1.0, kMostTiles);
  }

  void AddAreas(const Part& part, double* skin, double* uv) const {
    const Primitive& p = model_.primitives[part.primitive];
    const glm::dmat3 linear(part.transform);
    for (size_t i = 0; i < p.indices.size(); i += 3) {
      const Vertex &a = p.vertices[p.indices[i]], &b = p.vertices[p.indices[i + 1]], &c = p.vertices[p.indices[i + 2]];
      const glm::dvec3 ab = linear * (glm::dvec3(b.position) - glm::dvec3(a.position));
      const glm::dvec3 ac = linear * (glm::dvec3(c.position) - glm::dvec3(a.position));
      const glm::dvec2 u = glm::dvec2(b.uv) - glm::dvec2(a.uv), v = glm::dvec2(c.uv) - glm::dvec2(a.uv);
      *skin += glm::length(glm::cross(ab, ac)) / 2;
      *uv += std::abs(u.x * v.y - u.y * v.x) / 2;
    }
  }

  int32_t ImageFile(const std::string& path) {
    if (path.empty()) return -1;
    const auto [it, isNew] = images_.try_emplace(path, static_cast<int32_t>(model_.images.size()));
    if (!isNew) return it->second;
    Result<Image> image = ReadImage(path);
    if (!image) Fail(image.error());
    model_.images.push_back(std::move(*image));
    return it->second;
  }

  int32_t Furless(int32_t length, int32_t furless) {
    const auto [it, isNew] = furless_.try_emplace({length, furless}, static_cast<int32_t>(model_.images.size()));
    if (!isNew) return it->second;
    const Image* lengths = length < 0 ? nullptr : &model_.images[size_t(length)];
    Image both = WithoutFurless(lengths, model_.images[size_t(furless)]);
    model_.images.push_back(std::move(both));
    return it->second;
  }

  int32_t Volume(const std::vector<std::string>& layers) {
    const auto [it, isNew] = volumes_.try_emplace(layers, static_cast<int32_t>(model_.volumes.size()));
    if (isNew) model_.volumes.push_back(layers.empty() ? GrownVolume() : LoadLayers(layers));
    return it->second;
  }

  FurVolume GrownVolume() const {
    if (options_.coat == nullptr) return GrowCoat(1);
    const CoatParams& strands = options_.coat->strands;
    if (Result<Done> ok = CheckCoat(strands); !ok) Fail({ok.error().code, options_.coat->name + ": " + ok.error().message});
    return BakeVolume(strands, GrowStrandList(strands));
  }

  // The markings instead of the materials' own pictures, in their texture coordinates.
  void Paint(const Markings& markings) {
    Body body(model_);
    if (Unwrap(body, markings.size)) body = Body(model_);
    for (uint32_t i = 0; i < model_.materials.size(); ++i) {
      Material& material = model_.materials[i];
      if (!material.fur) continue;
      model_.images.push_back(PaintMarkings(model_, body, i, markings));
      material.baseColorTexture = {.image = int32_t(model_.images.size() - 1)};
      material.baseColor = glm::vec4(1);
    }
  }

  // Where one texel shows two places, new texture coordinates. Whether there are any: vertices are split.
  bool Unwrap(const Body& body, uint32_t side) {
    constexpr double kMostOverlap = 0.002;  // a texel here and there on a seam
    std::vector<uint32_t> overlapping;
    for (uint32_t i = 0; i < model_.materials.size(); ++i)
      if (model_.materials[i].fur && OverlapShare(model_, body, i) > kMostOverlap) overlapping.push_back(i);
    for (const uint32_t i : overlapping) UnwrapMaterial(&model_, i, side);
    return !overlapping.empty();
  }

  FurVolume LoadLayers(const std::vector<std::string>& layers) {
    const std::vector<fs::path> files(layers.begin(), layers.end());
    Result<FurVolume> volume = LoadFurLayers(files);
    if (!volume) Fail(volume.error());
    WarnOfSolidTip(*volume);
    return std::move(*volume);
  }

  // Hair ends thin. Where only the last slice is solid (a defect of the published cat), it is a film all around. Look
  // correct empties the last slice when it uploads the volume; look seed shows the asset as shipped.
  void WarnOfSolidTip(const FurVolume& volume) {
    const size_t slice = size_t{4} * volume.width * volume.height;
    const auto isSolid = [&](size_t layer) {
      for (size_t i = layer * slice + 3; i < (layer + 1) * slice; i += 4)
        if (volume.pixels[i] != 255) return false;
      return true;
    };
    if (volume.layers < 2 || !isSolid(volume.layers - 1) || isSolid(volume.layers - 2)) return;
    doc_.Warn("the last fur layer is solid though the one below is not; look correct takes it as empty");
  }
};

}  // namespace

void ResolveFur(Document& doc, const LoadOptions& options, std::span<const double> unitScale, Model* model) {
  Resolver(doc, options, unitScale, model).ResolveAll();
}

}  // namespace fur::gltf

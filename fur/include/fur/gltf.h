// Reads glTF 2.0 and GLB into a Model. tinygltf parses; every index, range and reference is checked here, because
// tinygltf checks none.
#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <string>

#include "fur/coat_file.h"
#include "fur/model.h"
#include "fur/result.h"

namespace fur {

struct LoadOptions {
  // Worn by every furred material: grows its strands, takes the place of the material's own parameters (Wear), and paints
  // its markings. What follows acts on it. Null: none. Must live until the model is loaded.
  const Coat* coat = nullptr;
  std::filesystem::path furFile;  // JSON with {"default": {...}, "materials": {"NAME": {...} | false}}; empty: none
  // Flags, as one more JSON object of FurParams keys applied to every furred material; empty text: none.
  std::string furOverrides;
  std::string furMaterial;  // grow fur on materials of this name only; empty: see docs/fur.md
};

// Reads all primitives (triangles, strips and fans), materials, textures and the node hierarchy of the default scene;
// skins are applied at their rest pose. Missing normals, tangents and UVs are made. Malformed input gives one Error and
// never a crash.
Result<Model> LoadGltf(const std::filesystem::path& file, const LoadOptions& options = {});

// Applies the fur file and the flags to a model that a program made and gave its coats: those count as the coats' own
// parameters.
Result<Done> GroomModel(const LoadOptions& options, Model* model);

}  // namespace fur

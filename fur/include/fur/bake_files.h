// Baked coats as files.
#pragma once

#include <cstdint>
#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <span>
#include <string>

#include "fur/bake.h"
#include "fur/result.h"

namespace fur {

// {"size": 128, ..., "under": {"density": ...}, "over": {...}} over `params`. Unknown keys and values out of range are
// refused by name; `where` starts the message. A coat file has this object as "strands".
Result<Done> ApplyCoatJson(const nlohmann::json& object, const std::string& where, CoatParams* params);
// Every parameter as a coat file (fur/coat_file.h): {"strands": {...}}.
std::string CoatJson(const CoatParams& params);

struct BakedCoat {
  CoatParams params;
  std::vector<Strand> strands;
  FurVolume volume;
  Image fin;
};
BakedCoat Bake(const CoatParams& params, uint32_t threads = 0, const BakeProgress& progress = {});

// Strands as polylines, for looking: .json {"tile", "strands": [{"class", "tint", "points": [[x, y, z, radius],
// ...]}]}, or .ply with x, y, z, radius, class (0 undercoat, 1 overcoat) for each vertex and edges between neighbours;
// fur lengths, the tile from 0 to CoatParams::tile. Usage for another extension, OutputFailed.
Result<Done> WriteStrands(const std::filesystem::path& file, const BakedCoat& coat);

// What a folder of a baked coat holds: NN.png (the volume's slices, root first), tint/NN.png (its tint), mips/L/NN.png
// (its mips, L >= 1; at height falloff 0), fin.png, coat.json (the parameters) and fur.json (a fur file that grows it
// on a model). Folder and list of strands appear whole or not at all; an existing folder is replaced if it is empty or
// holds nothing else than a baked coat.
struct CoatOutput {
  std::filesystem::path folder;
  std::filesystem::path strands;  // .json or .ply; in the folder only as strands.json or strands.ply; empty: none
  bool mips = true;
  uint32_t threads = 0;
};
// For a check before long work; leaves nothing behind. Errors: Usage, OutputFailed.
Result<Done> CheckCoatOutput(const CoatOutput& output);
Result<Done> WriteCoat(const CoatOutput& output, const BakedCoat& coat, const BakeProgress& progress = {});

}  // namespace fur

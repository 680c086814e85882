// Fur volumes from files.
#pragma once

#include <filesystem>
#include <span>

#include "fur/model.h"
#include "fur/result.h"

namespace fur {

// Reads one PNG for each slice, all of one size, RGB or RGBA (RGB: coverage 1). Where each file FOLDER/NAME has a
// FOLDER/tint/NAME, as `fur bake` writes them, those are the volume's tint.
Result<FurVolume> LoadFurLayers(std::span<const std::filesystem::path> files);

// Tile width over fur length of a model without layer_uv_scale: that of the default coat, whose tangents are stored for
// it, since a volume knows its width in texels only.
inline constexpr double kTileOverLength = 4;

}  // namespace fur

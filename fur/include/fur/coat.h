// Fur volumes: read from a PNG stack, or grown as strands.
#pragma once

#include <filesystem>
#include <span>
#include <string>

#include "fur/model.h"
#include "fur/result.h"

namespace fur {

// Reads one PNG for each slice, all of one size, RGB or RGBA (RGB: coverage 1).
Result<FurVolume> LoadFurLayers(std::span<const std::filesystem::path> files);

// A plain coat of tapered strands on a tile (Lengyel 2001's texture by particles, its simplest case): roots by toroidal
// Poisson-disc, each strand bends along one direction, radius r0 (1 - h/l)^taper, coverage accumulated analytically with
// wrap-around. Deterministic by seed on every machine. The top slice is empty.
struct StrandParams {
  uint32_t size = 128, layers = 16;  // texels across the tile; slices
  uint32_t underStrands = 1500, overStrands = 520;
  double underLength = 0.62, overLength = 0.92;   // mean, relative to the fur length
  double underRadius = 0.8, overRadius = 1.15;  // texels, at the root
  double taper = 0.75;
  double bend = 0.07;   // sideways reach at the tip, in tiles
  double spread = 0.6;  // 0: all strands bend along +u; 1: each its own way
  uint32_t seed = 1;
};
// Tile width over fur length that the stored tangents assume, since a volume knows its width in texels only; the width
// of the tile that a model without layer_uv_scale gets.
inline constexpr double kTileOverLength = 4;

FurVolume GrowStrands(const StrandParams& params);

}  // namespace fur

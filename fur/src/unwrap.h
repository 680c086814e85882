// Texture coordinates in which no two places share a texel, for models whose own overlap, mirror or repeat.
#pragma once

#include "fur/model.h"

namespace fur {

// Gives the primitives of a furred material the fur's own charts (fur/fur_uv.h), cut where they lie on themselves, side
// by side in the unit square as their texture coordinates, which may split vertices, and carries the material's
// pictures over, resampled to side x side texels. Tangents, which normal and direction maps stand on, stay. Tiles of
// the volume keep their size on the skin.
void UnwrapMaterial(Model*, uint32_t material, uint32_t side);

}  // namespace fur

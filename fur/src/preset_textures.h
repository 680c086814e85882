// Textures that a technique or a preset needs and a model lacks, made on the CPU: deterministic, of the model's own maps
// and coat.
#pragma once

#include "fur/model.h"
#include "fur/renderer.h"

namespace fur {

// The volume with an empty last slice: what ends the fur (docs/accuracy.md, "Assets"). That slice has the tint of the one
// below it.
FurVolume WithoutTopSlice(FurVolume);

// The colour with the length map in its alpha, as large as the larger of both. A material without a length map keeps the
// alpha.
Image LengthInAlpha(const Image& color, const Model&, const Material&);

// Preset gs-shells. Grey: how much hair stands above a texel of the tile, 0..1 for the coat's own range; 1 for an even
// one.
Image OpacityMap(const FurVolume&);
// The coat from the side: u along the tile, v 0 the root, 1/2 the tip, empty above (the sampler wraps). Grey:
// coverage of the hairs in a narrow band.
Image FinMap(const FurVolume&);
// Alpha 1 where the length map is 0, fading out up to a tenth; rgb: bare skin, between the colour and that of flesh.
// Without a length map nothing is bare.
Image FurlessSpots(const Image& color, const Model&, const Material&);

// Preset four-coats: the colours of a furred material, in its texture coordinates, painted by a function of the place
// on the body. Where several places share a texel the last triangle's stands.
Image PaintCoat(const Model&, uint32_t material, FourCoat);

}  // namespace fur

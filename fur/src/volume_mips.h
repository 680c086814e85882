// Mips of a fur volume, judged by what the whole stack lets through, not by each slice alone: docs/accuracy.md states
// the law, docs/measured.md how it compares with others.
#pragma once

#include <vector>

#include "fur/model.h"
#include "mips.h"

namespace fur {

// For each slice from the root, its levels. A level's coverage is the mean of the texels below it, weighted by how
// visible each is from above through the composited coverage a_j (1 - heightFalloff j / N0); what is stored stays a_j,
// the shader takes the falloff off. rgb is the mean weighted by coverage alone: its length tells how much the
// directions agree.
std::vector<MipChain> MakeVolumeMips(const FurVolume&, double heightFalloff);

// For each slice of the volume's tint, its levels: the mean weighted by coverage, so that nothing bleeds from texels
// without fur; the plain mean where there is none. `volume.tint` is not empty.
std::vector<MipChain> MakeTintMips(const FurVolume& volume);

// What `shells` shells, fewer than slices, find at their heights (i + 1/2) / N: for each shell its levels, linear between the
// two slices next to it as the shader would read them (fur_shade.hlsli), rounded to 8 bits once more.
std::vector<MipChain> SlicesAtShells(const std::vector<MipChain>& slices, uint32_t shells);

// The same for a volume, whose coverage a shell has of its whole slab: with c(z) = min(a(z) (1 - heightFalloff z / N0), .999)
// between slices, 1 - c_i = exp(mean over the slab of ln(1 - c(z))), by the midpoint rule in kStepsOfASlice steps for each
// slice, rounded up. Stored is a_i, of which the shader takes the falloff at the slab's middle off, at most 1.
std::vector<MipChain> VolumeAtShells(const std::vector<MipChain>& slices, uint32_t shells, double heightFalloff);
inline constexpr int kStepsOfASlice = 16;

}  // namespace fur

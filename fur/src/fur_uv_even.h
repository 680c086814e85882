// Makes a flat chart's density more even, without folding it.
#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "fur_uv_charts.h"
#include "fur_uv_laplacian.h"

namespace fur::furuv {

// Lowers the integral over the skin of |J|^2 + |J^-1|^2 + k (det J + 1 / det J): the symmetric Dirichlet energy (Smith
// and Schaefer 2015, "Bijective parameterization with free boundaries"), which keeps lengths, and a term that keeps
// areas, for a tile's hairs are counted by area. No solid triangle turns over; those that are at the start do not
// count. The Laplacian must hold vertex 0 alone.
void EvenOut(const Chart&, const std::vector<Rest>&, const HeldLaplacian&, std::vector<glm::dvec2>* uv);

// Opens folds by lowering the same energy with det J replaced by a positive function of it that comes ever closer to
// det J (Garanzha, Kaporin, Kudryavtseva, Protais, Ray, Sokolov 2021, "Foldover-free maps in 50 lines of code"). True
// when no solid triangle is turned over any more.
bool Unfold(const Chart&, const std::vector<Rest>&, const HeldLaplacian&, std::vector<glm::dvec2>* uv);

}  // namespace fur::furuv

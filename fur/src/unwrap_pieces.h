// Cuts a flattened mesh where it lies on itself.
#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

namespace fur {

// For each triangle of `indices` (three each) a piece, 0.. in order: what hangs together over shared vertices and does not
// overlap itself in `uv`. `chartOf`: of each vertex; a piece stays within one chart.
std::vector<uint32_t> FindPieces(std::span<const uint32_t> indices, std::span<const glm::dvec2> uv,
                                 std::span<const uint32_t> chartOf);

}  // namespace fur

// What a technique's geometry shaders make of a model, counted by pipeline statistics.
#pragma once

#include "support.h"

namespace fur::test {

// Triangles that leave the geometry shader, in one frame of 96 x 64 pixels. With shells off: two for each fin.
uint64_t EmittedTriangles(TestDevice&, const Model&, const RenderSettings&, const Camera&, const glm::dmat4& placement);

}  // namespace fur::test

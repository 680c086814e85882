// The shaders' constant buffers as C++ sees them.
#pragma once

#include <cstddef>
#include <glm/glm.hpp>

#include "../../shaders_hlsl/fur_constants.h"

namespace fur {

static_assert(sizeof(FrameConstants) == 80 && offsetof(FrameConstants, lightSpecular) == 64);
static_assert(sizeof(MaterialConstants) == 160 && offsetof(MaterialConstants, groom) == 112);
static_assert(sizeof(ObjectConstants) == 256 && offsetof(ObjectConstants, windWave) == 240);

}  // namespace fur

// The shaders' constant buffers as C++ sees them.
#pragma once

#include <cstddef>
#include <glm/glm.hpp>

#include "../../shaders_hlsl/fur_constants.h"

namespace fur {

static_assert(sizeof(FrameConstants) == 80 && offsetof(FrameConstants, lightSpecular) == 64);
static_assert(sizeof(MaterialConstants) == 112 && offsetof(MaterialConstants, furSemantics) == 80);
static_assert(sizeof(ObjectConstants) == 208 && offsetof(ObjectConstants, comb) == 192);

}  // namespace fur

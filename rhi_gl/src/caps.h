#pragma once

#include "rhi/types.h"

namespace rhi_gl {

struct Limits;

// Of the current context. One older than GL 4.5 gets its names and version only.
rhi::Caps QueryCaps();
Limits QueryLimits();

}  // namespace rhi_gl

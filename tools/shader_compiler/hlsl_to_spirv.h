// HLSL -> SPIR-V 1.3 by glslang, with line information and HLSL semantics, not yet optimised.
#pragma once

#include <cstdint>
#include <vector>

#include "includer.h"
#include "options.h"

namespace shaderc {

// Throws CompileError with one problem for each message of glslang.
std::vector<uint32_t> CompileHlsl(const Options&, Includer&);

}  // namespace shaderc

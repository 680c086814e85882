// Checks that refuse what glslang 12 gets wrong silently or what the drivers compute differently.
#pragma once

#include "rhi/types.h"
#include "spirv_module.h"

namespace shaderc {

// On the module as glslang made it: built-ins whose sums the drivers order differently, Append/Consume counters.
void GateSource(const Module&);

// On the optimised module, where structs and function calls are gone: SV_Position.w in a pixel shader, a layer written
// outside a geometry shader, and again the built-ins, lest the optimiser made one.
void GateOptimized(const Module&, rhi::Stage);

// A value that no path has set. Not always a fault: a loop may set it before its first use.
bool ReadsUndefined(const Module&);

}  // namespace shaderc

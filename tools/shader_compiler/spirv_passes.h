// What is done to the SPIR-V between glslang and the backends.
#pragma once

#include "options.h"
#include "spirv_module.h"

namespace shaderc {

// SPIRV-Tools' validator for Vulkan 1.1; throws with the HLSL line. Before legalisation some rules are relaxed.
void Validate(const Module&, bool legalised);

// spirv-opt 2023.1 folds a*b + c into one fma and rearranges constants, here in one shader and not in the next, which
// computes the same position otherwise. NoContraction keeps it off; AllowFolding takes the marks away again, so that
// both backends see plain operations. HLSL's own `precise` cannot be told from the marks and is refused.
void ForbidFolding(Module&);
void AllowFolding(Module&);

// Inlines, legalises (textures and buffers passed to functions) and cleans up.
Module Optimize(const Module&);

// A typed UAV that is only written gets no format, so that it may be bound as any; one that is read must be of one
// 32-bit component, which is Direct3D's rule too.
void RelaxImageFormats(Module&);

// Direct3D's SV_VertexID and SV_InstanceID leave the base out, SPIR-V's VertexIndex and InstanceIndex include it.
// Turns each load of `index` into index - base. False when the shader does not read it.
bool SubtractBase(Module&, spv::BuiltIn index, spv::BuiltIn base);

// The descriptor sets of rhi/shader.h, from the bindings. Throws where the HLSL names a space.
void AssignSets(Module&, rhi::Stage);

// Line information and source text; names stay.
void StripLines(Module&);

}  // namespace shaderc

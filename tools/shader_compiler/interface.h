// Vertex inputs and the variables between stages, by their HLSL semantics.
#pragma once

#include <string>
#include <vector>

#include "rhi/types.h"
#include "spirv_module.h"

namespace shaderc {

struct VertexInput {
  std::string semantic;  // upper case, without the index
  uint32_t index = 0;
  uint32_t location = 0;
};

// The HLSL semantics of a module's inputs and outputs, by the id of the variable; ids outlive the optimiser.
struct Semantic {
  std::string name;  // upper case, without the index
  uint32_t index = 0;
};
using Semantics = std::map<uint32_t, Semantic>;

// Reads the decorations that carry them and removes these, with the extensions that they need: no backend wants them,
// and the optimiser leaves half its work undone in a module with an extension that it does not know.
Semantics TakeSemantics(Module&);

// The inputs that the vertex shader reads, by location.
std::vector<VertexInput> ReadVertexInputs(const Module&, const Semantics&);

// glslang numbers the variables between stages in the order of declaration, so a pixel shader that leaves out a member
// would read its neighbour. Renumbers them by semantic: the same semantic is the same location in every shader.
void LocateBySemantic(Module&, const Semantics&, rhi::Stage);

// Of a pixel shader for blending with two sources (rhi::kDualSourceMacro): SV_Target1 becomes the second source of target
// 0, which Direct3D 10 decides by the blend factors, and Vulkan and GL in the shader.
void MakeSecondSource(Module&);

}  // namespace shaderc

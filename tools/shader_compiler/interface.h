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

// The inputs that the vertex shader reads, by location.
std::vector<VertexInput> ReadVertexInputs(const Module&);

// glslang numbers the variables between stages in the order of declaration, so a pixel shader that leaves out a member
// would read its neighbour. Renumbers them by semantic: the same semantic is the same location in every shader.
void LocateBySemantic(Module&, rhi::Stage);

}  // namespace shaderc

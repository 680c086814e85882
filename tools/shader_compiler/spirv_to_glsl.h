// SPIR-V -> GLSL 4.50 core with the GL bindings of rhi/shader.h, and the reflection that goes with it.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "reflect.h"

namespace shaderc {

struct GlslResult {
  std::string source;
  Reflection reflection;
};

// `words`: descriptor sets still 0; SV_VertexID already made relative, SV_InstanceID not (gl_InstanceID leaves the base
// out by itself).
GlslResult SpirvToGlsl(const std::vector<uint32_t>& words, rhi::Stage);

}  // namespace shaderc

// The tables of rhi::ShaderReflection, as values that the emitter prints.
#pragma once

#include <spirv_cross.hpp>

#include "interface.h"
#include "rhi/shader.h"

namespace shaderc {

struct ConstantBuffer {
  uint8_t slot;
  uint32_t byteWidth;
  std::string name;
  uint32_t id;  // of the SPIR-V variable
};
struct Resource {
  rhi::ShaderResourceKind kind;
  uint8_t slot;
  rhi::TextureDim dim;
  bool integer;
  uint32_t stride;
  std::string name;
  uint32_t id;
};
struct Sampler {
  uint8_t slot;
  std::string name;
  uint32_t id;
};

struct Reflection {
  std::vector<ConstantBuffer> constantBuffers;  // each list is sorted by slot
  std::vector<Resource> resources;              // t registers, then u registers
  std::vector<Sampler> samplers;
  std::vector<rhi::ShaderTexturePair> pairs;  // filled in by SpirvToGlsl, which finds them
  std::vector<VertexInput> inputs;
  rhi::PrimitiveTopology gsInput = rhi::PrimitiveTopology::TriangleList;
  uint32_t gsMaxVertices = 0, gsOutputComponents = 0;
  bool usesVertexId = false, usesInstanceId = false, writesLayer = false;
  std::array<uint32_t, 3> groupSize{};
};

// Throws where a resource is of a kind or in a register that rhi/shader.h has no place for, or has a layout that HLSL,
// C++ and GLSL see differently. `usesVertexId` and `inputs` are the caller's.
Reflection Reflect(const spirv_cross::Compiler&, rhi::Stage);

}  // namespace shaderc

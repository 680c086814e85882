// What the build makes of one HLSL entry point: SPIR-V, GLSL and the tables the backends bind by.
//
// The contract between the shader compiler (tools/shader_compiler) and the backends:
//
//   HLSL register          Vulkan set, binding                    GL binding
//   b0..b3                 set 0, binding n (dynamic uniform)      uniform block n
//   t0..t15 (textures)     set 1 + stage index, binding 16 + n     the unit of each texture+sampler pair, see below
//   t0..t15 (structured)   set 1 + stage index, binding 16 + n     storage block kGlBufferBase[stage] + i, see below
//   s0..s15                set 1 + stage index, binding 32 + n     the pair's unit
//   u0..u7 (compute)       set 2, binding 48 + n                   image unit n, or storage block 8 + n
//
// Stage index: vertex 0, geometry 1, pixel 2; compute has set 1 for t and s, and set 2 for u. GL knows no separate
// samplers: every (texture, sampler) pair that a shader uses has a unit of its own, kGlUnitBase[stage] + its index in
// ShaderReflection::pairs. A texture that is only loaded (no sampler) is a pair with sampler kNoSampler.
// Structured buffers: i counts the structured t registers of one shader in slot order; at most kGlMaxBuffers[stage].
// GL's gl_VertexID of a non-indexed draw includes the first vertex; shaders that read SV_VertexID subtract
// `rhi_FirstVertex`, an int at offset 0 of the uniform block kGlDrawParametersBlock (see usesVertexId).
// GL's window has its origin at the bottom: the last stage before the rasterizer negates gl_Position.y, so that row 0
// is the top. Geometry shaders always do; a vertex shader does where the macro kGlLastStageMacro is defined. (Clip
// control's GL_UPPER_LEFT would do the same, but Mesa's rasterizer then takes the bottom row, not the top row, for an
// edge exactly through pixel centres, which Direct3D's and Vulkan's top-left rule forbids.)
#pragma once

#include "rhi/types.h"

namespace rhi {

inline constexpr uint32_t kVkTextureBinding = 16, kVkSamplerBinding = 32, kVkUavBinding = 48;
inline constexpr uint32_t kVkConstantSet = 0, kVkStageSet = 1, kVkUavSet = 2;  // kVkStageSet + stage index
inline constexpr std::array<uint32_t, kStageCount> kGlUnitBase{0, 16, 32, 0};
inline constexpr std::array<uint32_t, kStageCount> kGlBufferBase{0, 4, 8, 0};
inline constexpr std::array<uint32_t, kStageCount> kGlMaxBuffers{4, 4, 4, 8};
inline constexpr uint32_t kGlUavBufferBase = 8;
inline constexpr uint32_t kGlDrawParametersBlock = 4;
inline constexpr const char* kGlLastStageMacro = "RHI_LAST_STAGE_BEFORE_RASTERIZER";
// Compiled with this define, a pixel shader's SV_Target1 is the second source of target 0 (Blend::Src1Color and kin).
// Direct3D 10 decides that by the blend factors; Vulkan and GL in the shader.
inline constexpr const char* kDualSourceMacro = "RHI_DUAL_SOURCE";
inline constexpr uint8_t kNoSampler = 0xFF;

enum class ShaderResourceKind : uint8_t { Texture, StructuredBuffer, RWTexture, RWStructuredBuffer };

struct ShaderResource {  // a t register, or a u register for the RW kinds
  ShaderResourceKind kind;
  uint8_t slot;
  TextureDim dim;       // textures
  bool integer;         // textures of uint or int
  uint32_t stride;      // structured buffers, bytes
  const char* name;
};
struct ShaderConstantBuffer {
  uint8_t slot;
  uint32_t byteWidth;
  const char* name;
};
struct ShaderSampler {
  uint8_t slot;
  const char* name;
};
struct ShaderTexturePair {
  uint8_t texture, sampler;  // t and s registers; sampler may be kNoSampler
};
struct ShaderInput {  // vertex shaders
  const char* semantic;  // upper case, without the index
  uint32_t semanticIndex;
  uint32_t location;
};

template <class T>
struct Array {  // a view of a constant table of the generated code
  const T* data = nullptr;
  uint32_t size = 0;
  const T* begin() const { return data; }
  const T* end() const { return data + size; }
  const T& operator[](uint32_t i) const { return data[i]; }
};

struct ShaderReflection {
  Array<ShaderConstantBuffer> constantBuffers;
  Array<ShaderResource> resources;
  Array<ShaderSampler> samplers;
  Array<ShaderTexturePair> pairs;
  Array<ShaderInput> inputs;
  PrimitiveTopology gsInput = PrimitiveTopology::TriangleList;  // PointList, LineList, LineListAdj, TriangleList, ..Adj
  uint32_t gsMaxVertices = 0, gsOutputComponents = 0;  // components: scalars of one output vertex
  bool usesVertexId = false, usesInstanceId = false, writesLayer = false;
  std::array<uint32_t, 3> groupSize{};  // compute
};

// One compiled entry point. The generated tables have static lifetime; a ShaderBlob is never copied deep.
struct ShaderBlob {
  Stage stage = Stage::Vertex;
  const char* name = "";  // file:entry
  Array<uint32_t> spirv;  // SPIR-V 1.3 words, entry point "main"
  const char* glsl = "";  // GLSL 4.50 core
  ShaderReflection reflection;
};

}  // namespace rhi

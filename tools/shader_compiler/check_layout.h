// Constant and structured buffers: is a member where HLSL, C++ and GLSL all expect it?
#pragma once

#include <spirv_cross.hpp>

namespace shaderc {

// A cbuffer. Throws where Direct3D's packing (16-byte registers) and std140 would put a member at different places.
void CheckConstantBuffer(const spirv_cross::Compiler&, const spirv_cross::SPIRType&, const std::string& name);

// An element of a structured buffer. Throws where Direct3D's packing (and that of a C++ struct of floats and ints: one
// member after the other) differs from std430.
void CheckElement(const spirv_cross::Compiler&, const spirv_cross::SPIRType& element, uint32_t stride,
                  const std::string& name);

}  // namespace shaderc

// Constant and structured buffers: is a member where HLSL, C++ and GLSL all expect it?
#pragma once

#include <spirv_cross.hpp>

namespace shaderc {

// A cbuffer, whose offsets here are std140's. Throws where Direct3D's packing (16-byte registers) differs.
void CheckConstantBuffer(const spirv_cross::Compiler&, const spirv_cross::SPIRType&, const std::string& name);

// An element of a structured buffer, whose offsets here are std430's. Throws where Direct3D's (and a C++ struct of floats
// and ints) differ: members follow each other at 4-byte alignment.
void CheckElement(const spirv_cross::Compiler&, const spirv_cross::SPIRType& element, uint32_t stride,
                  const std::string& name);

}  // namespace shaderc

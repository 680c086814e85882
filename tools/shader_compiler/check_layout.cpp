#include "check_layout.h"

#include <algorithm>

#include "error.h"

namespace shaderc {
namespace {

using spirv_cross::Compiler;
using spirv_cross::SPIRType;

constexpr uint32_t kRegister = 16;  // bytes

uint32_t RoundUp(uint32_t value, uint32_t to) { return (value + to - 1) / to * to; }

// SPIR-V's column-major is HLSL's row_major: the vectors that lie one after another in memory.
struct MatrixShape {
  uint32_t vectors, width;
};
MatrixShape ShapeOf(const Compiler& c, const SPIRType& parent, uint32_t member, const SPIRType& type) {
  const bool rowMajor = c.has_member_decoration(parent.self, member, spv::DecorationRowMajor);
  return rowMajor ? MatrixShape{type.vecsize, type.columns} : MatrixShape{type.columns, type.vecsize};
}

[[noreturn]] void Refuse(const std::string& buffer, const std::string& member, uint32_t d3d, uint32_t gl) {
  throw CompileError(
      "'" + buffer + "." + member + "' would be at byte " + std::to_string(d3d) +
      " by Direct3D's and C++'s packing but at byte " + std::to_string(gl) +
      " by GLSL's; pad by hand: float2 at multiples of 8, float3 at multiples of 16, and fill the last 16 "
      "bytes of arrays, structs and matrices");
}

void RequireWords(const SPIRType& type, const std::string& name) {
  if (type.basetype != SPIRType::Struct && type.width != 32)
    throw CompileError("'" + name + "' has a member that is not 32 bits wide");
}

bool IsAggregate(const SPIRType& t) { return !t.array.empty() || t.columns > 1 || t.basetype == SPIRType::Struct; }

// std140 and std430 agree on vectors.
uint32_t VectorAlignment(const SPIRType& t) { return t.vecsize == 1 ? 4 : t.vecsize == 2 ? 8 : 16; }

// Where a member lies by Direct3D's rules and by GLSL's, side by side.
struct Cursor {
  uint32_t d3d = 0, gl = 0;
};

class CbufferLayout {
 public:
  CbufferLayout(const Compiler& c, std::string name) : c_(c), name_(std::move(name)) {}

  // Bytes of the struct by Direct3D's rules, without padding at the end. Throws on the first difference.
  uint32_t Check(const SPIRType& type, const std::string& prefix) const {
    Cursor at;
    for (uint32_t i = 0; i < type.member_types.size(); ++i) {
      const SPIRType& member = c_.get_type(type.member_types[i]);
      const std::string path = prefix + c_.get_member_name(type.self, i);
      RequireWords(member, name_ + "." + path);
      const uint32_t size = Size(type, i, member, path);
      Align(at, member, size);
      if (at.d3d != at.gl || at.d3d != c_.type_struct_member_offset(type, i)) Refuse(name_, path, at.d3d, at.gl);
      at.d3d += size;
      at.gl += IsAggregate(member) ? RoundUp(size, kRegister) : size;
    }
    return at.d3d;
  }

 private:
  static void Align(Cursor& at, const SPIRType& member, uint32_t size) {
    const bool straddles = at.d3d / kRegister != (at.d3d + size - 1) / kRegister;
    if (IsAggregate(member) || straddles) at.d3d = RoundUp(at.d3d, kRegister);
    at.gl = RoundUp(at.gl, IsAggregate(member) ? kRegister : VectorAlignment(member));
  }
  uint32_t Size(const SPIRType& parent, uint32_t i, const SPIRType& member, const std::string& path) const {
    uint32_t one = member.vecsize * 4;
    if (member.basetype == SPIRType::Struct) {
      one = Check(c_.get_type(member.self), path + ".");
    } else if (member.columns > 1) {
      const MatrixShape shape = ShapeOf(c_, parent, i, member);
      one = kRegister * (shape.vectors - 1) + 4 * shape.width;
    }
    for (const uint32_t count : member.array) one = RoundUp(one, kRegister) * (count - 1) + one;
    return one;
  }
  const Compiler& c_;
  std::string name_;
};

struct Extent {
  uint32_t size, alignment;
};

// The element of a structured buffer: tight for Direct3D and C++, std430 for GLSL. Both must be what glslang wrote.
class ElementLayout {
 public:
  ElementLayout(const Compiler& c, std::string name) : c_(c), name_(std::move(name)) {}

  Extent Check(const SPIRType& type, const std::string& prefix) const {
    if (type.basetype != SPIRType::Struct) return {type.vecsize * type.columns * 4, VectorAlignment(type)};
    Extent all{0, 4};
    for (uint32_t i = 0; i < type.member_types.size(); ++i) {
      const SPIRType& member = c_.get_type(type.member_types[i]);
      const std::string path = prefix + c_.get_member_name(type.self, i);
      const Extent one = Member(type, i, member, path);
      const uint32_t gl = RoundUp(all.size, one.alignment);
      if (all.size != gl || all.size != c_.type_struct_member_offset(type, i)) Refuse(name_, path, all.size, gl);
      all = {all.size + one.size, std::max(all.alignment, one.alignment)};
    }
    return all;
  }

 private:
  Extent Member(const SPIRType& parent, uint32_t i, const SPIRType& member, const std::string& path) const {
    RequireWords(member, name_ + "." + path);
    Extent one = Check(member.basetype == SPIRType::Struct ? c_.get_type(member.self) : member, path + ".");
    if (member.columns > 1) {
      const MatrixShape shape = ShapeOf(c_, parent, i, member);
      one.alignment = shape.width == 2 ? 8 : 16;
    }
    RequireTight(one, path);
    for (const uint32_t count : member.array) one.size *= count;
    return one;
  }
  // Arrays, structs and matrices are padded to their alignment by std430, so nothing may be left to pad.
  void RequireTight(const Extent& one, const std::string& path) const {
    const bool vec3 = one.size == 12;  // a float3 alone is tight: what follows is checked by its own offset
    if (!vec3 && one.size % one.alignment)
      Refuse(name_, path + " (its end)", one.size, RoundUp(one.size, one.alignment));
  }
  const Compiler& c_;
  std::string name_;
};

}  // namespace

void CheckConstantBuffer(const Compiler& c, const SPIRType& type, const std::string& name) {
  CbufferLayout(c, name).Check(type, "");
}

void CheckElement(const Compiler& c, const SPIRType& element, uint32_t stride, const std::string& name) {
  RequireWords(element, name);
  const Extent extent = ElementLayout(c, name).Check(element, "");
  const uint32_t size = extent.size;
  if (size != stride || size % extent.alignment)
    throw CompileError("an element of '" + name + "' has " + std::to_string(size) + " bytes in Direct3D and C++ but " +
                       std::to_string(std::max(stride, RoundUp(size, extent.alignment))) +
                       " in GLSL; pad it by hand to a multiple of 16 bytes");
}

}  // namespace shaderc

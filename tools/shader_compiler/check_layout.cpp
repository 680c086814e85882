#include "check_layout.h"

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

[[noreturn]] void Refuse(const std::string& buffer, const std::string& member, uint32_t here, uint32_t there) {
  throw CompileError("'" + buffer + "." + member + "' would be at byte " + std::to_string(here) + " in Vulkan and GL but at byte " +
                     std::to_string(there) + " in Direct3D and C++; pad by hand: float3 at multiples of 16, and fill the "
                     "last 16 bytes of arrays, structs and matrices");
}

void RequireWords(const SPIRType& type, const std::string& name) {
  if (type.basetype != SPIRType::Struct && type.width != 32)
    throw CompileError("'" + name + "' has a member that is not 32 bits wide");
}

class CbufferLayout {
 public:
  CbufferLayout(const Compiler& c, std::string name) : c_(c), name_(std::move(name)) {}

  // Bytes of the struct by Direct3D's rules, without padding at the end. Throws on the first difference.
  uint32_t Check(const SPIRType& type, const std::string& prefix) const {
    uint32_t at = 0;
    for (uint32_t i = 0; i < type.member_types.size(); ++i) {
      const SPIRType& member = c_.get_type(type.member_types[i]);
      const std::string path = prefix + c_.get_member_name(type.self, i);
      RequireWords(member, name_ + "." + path);
      const uint32_t size = Size(type, i, member, path);
      const bool straddles = at / kRegister != (at + size - 1) / kRegister;
      if (NeedsRegister(member) || straddles) at = RoundUp(at, kRegister);
      const uint32_t here = c_.type_struct_member_offset(type, i);
      if (here != at) Refuse(name_, path, here, at);
      at += size;
    }
    return at;
  }

 private:
  static bool NeedsRegister(const SPIRType& t) {
    return !t.array.empty() || t.columns > 1 || t.basetype == SPIRType::Struct;
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

uint32_t CheckTight(const Compiler& c, const SPIRType& type, const std::string& name, const std::string& prefix) {
  uint32_t at = 0;
  for (uint32_t i = 0; i < type.member_types.size(); ++i) {
    const SPIRType& member = c.get_type(type.member_types[i]);
    const std::string path = prefix + c.get_member_name(type.self, i);
    RequireWords(member, name + "." + path);
    const uint32_t here = c.type_struct_member_offset(type, i);
    if (here != at) Refuse(name, path, here, at);
    uint32_t size = member.vecsize * member.columns * 4;
    if (member.basetype == SPIRType::Struct) size = CheckTight(c, c.get_type(member.self), name, path + ".");
    for (const uint32_t count : member.array) size *= count;
    at += size;
  }
  return at;
}

}  // namespace

void CheckConstantBuffer(const Compiler& c, const SPIRType& type, const std::string& name) {
  CbufferLayout(c, name).Check(type, "");
}

void CheckElement(const Compiler& c, const SPIRType& element, uint32_t stride, const std::string& name) {
  uint32_t size = element.vecsize * element.columns * 4;
  RequireWords(element, name);
  if (element.basetype == SPIRType::Struct) size = CheckTight(c, element, name, "");
  if (size != stride)
    throw CompileError("an element of '" + name + "' has " + std::to_string(stride) + " bytes in Vulkan and GL but " +
                       std::to_string(size) + " in Direct3D and C++; pad it by hand to a multiple of 16 bytes");
}

}  // namespace shaderc

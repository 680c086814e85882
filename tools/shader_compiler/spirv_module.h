// A SPIR-V module as a list of instructions that passes can edit.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <span>
#include <spirv.hpp>
#include <string>
#include <vector>

#include "error.h"

namespace shaderc {

struct Instruction {
  spv::Op op = spv::OpNop;
  std::vector<uint32_t> words;  // the operands: without the word of op and length
};

class Module {
 public:
  explicit Module(std::span<const uint32_t> words);
  std::vector<uint32_t> Words() const;

  uint32_t NewId() { return header_[3]++; }
  uint32_t IdBound() const { return header_[3]; }
  void RemoveIf(const std::function<bool(const Instruction&)>&);
  void InsertCapability(spv::Capability);                   // once
  void InsertDecoration(Instruction);                       // among the other decorations
  void InsertGlobal(Instruction);                           // after the types and global variables
  void AddToInterface(uint32_t variable);                   // of the entry point
  std::optional<uint32_t> FindBuiltIn(spv::BuiltIn) const;  // the variable decorated with it
  const Instruction* FindVariable(uint32_t id) const;
  std::map<uint32_t, std::string> Names() const;  // OpName
  std::vector<Where> Places() const;              // of each instruction, from OpLine

  std::vector<Instruction> code;

 private:
  size_t FirstFunction() const;
  size_t LastDecoration() const;
  std::vector<uint32_t> header_;
};

// A string operand that starts at words[first].
std::string ReadString(const std::vector<uint32_t>& words, size_t first);
std::vector<uint32_t> EncodeString(const std::string&);

}  // namespace shaderc

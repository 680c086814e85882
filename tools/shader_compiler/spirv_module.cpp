#include "spirv_module.h"

#include <algorithm>
#include <cstring>

namespace shaderc {
namespace {

constexpr size_t kHeaderWords = 5;

bool IsDecoration(spv::Op op) {
  return op == spv::OpDecorate || op == spv::OpMemberDecorate || op == spv::OpDecorateString ||
         op == spv::OpMemberDecorateString || op == spv::OpDecorateId;
}

}  // namespace

std::string ReadString(const std::vector<uint32_t>& words, size_t first) {
  std::string text;
  for (size_t i = first; i < words.size(); ++i)
    for (int shift = 0; shift < 32; shift += 8) {
      const char c = char(words[i] >> shift & 0xFF);
      if (c == 0) return text;
      text += c;
    }
  return text;
}

std::vector<uint32_t> EncodeString(const std::string& text) {
  std::vector<uint32_t> words(text.size() / 4 + 1, 0);
  for (size_t i = 0; i < text.size(); ++i) words[i / 4] |= uint32_t(uint8_t(text[i])) << (i % 4 * 8);
  return words;
}

Module::Module(std::span<const uint32_t> words) {
  if (words.size() < kHeaderWords) throw CompileError("glslang made an empty SPIR-V module");
  header_.assign(words.begin(), words.begin() + kHeaderWords);
  for (size_t at = kHeaderWords; at < words.size();) {
    const uint32_t length = words[at] >> 16;
    if (length == 0 || at + length > words.size()) throw CompileError("glslang made a broken SPIR-V module");
    const auto body = words.subspan(at + 1, length - 1);
    code.push_back({spv::Op(words[at] & 0xFFFF), {body.begin(), body.end()}});
    at += length;
  }
}

std::vector<uint32_t> Module::Words() const {
  std::vector<uint32_t> words = header_;
  for (const Instruction& i : code) {
    words.push_back(uint32_t(i.words.size() + 1) << 16 | uint32_t(i.op));
    words.insert(words.end(), i.words.begin(), i.words.end());
  }
  return words;
}

void Module::RemoveIf(const std::function<bool(const Instruction&)>& predicate) { std::erase_if(code, predicate); }

void Module::InsertCapability(spv::Capability capability) {
  const Instruction wanted{spv::OpCapability, {uint32_t(capability)}};
  for (const Instruction& i : code)
    if (i.op == wanted.op && i.words == wanted.words) return;
  code.insert(code.begin(), wanted);
}

size_t Module::FirstFunction() const {
  const auto at = std::find_if(code.begin(), code.end(), [](const auto& i) { return i.op == spv::OpFunction; });
  size_t index = size_t(at - code.begin());
  while (index > 0 && code[index - 1].op == spv::OpLine) --index;  // an OpLine belongs to what follows it
  return index;
}

size_t Module::LastDecoration() const {
  for (size_t i = code.size(); i-- > 0;)
    if (IsDecoration(code[i].op)) return i + 1;
  throw CompileError("the SPIR-V module has no decorations");
}

void Module::InsertDecoration(Instruction i) { code.insert(code.begin() + ptrdiff_t(LastDecoration()), std::move(i)); }
void Module::InsertGlobal(Instruction i) { code.insert(code.begin() + ptrdiff_t(FirstFunction()), std::move(i)); }

void Module::AddToInterface(uint32_t variable) {
  for (Instruction& i : code)
    if (i.op == spv::OpEntryPoint) i.words.push_back(variable);
}

std::optional<uint32_t> Module::FindBuiltIn(spv::BuiltIn builtIn) const {
  for (const Instruction& i : code)
    if (i.op == spv::OpDecorate && i.words[1] == spv::DecorationBuiltIn && i.words[2] == uint32_t(builtIn))
      return i.words[0];
  return std::nullopt;
}

const Instruction* Module::FindVariable(uint32_t id) const {
  for (const Instruction& i : code)
    if (i.op == spv::OpVariable && i.words[1] == id) return &i;
  return nullptr;
}

std::map<uint32_t, std::string> Module::Names() const {
  std::map<uint32_t, std::string> names;
  for (const Instruction& i : code)
    if (i.op == spv::OpName) names[i.words[0]] = ReadString(i.words, 1);
  return names;
}

std::vector<Where> Module::Places() const {
  std::map<uint32_t, std::string> strings;
  std::vector<Where> places;
  Where now;
  for (const Instruction& i : code) {
    if (i.op == spv::OpString) strings[i.words[0]] = ReadString(i.words, 1);
    if (i.op == spv::OpLine) now = {strings[i.words[0]], i.words[1]};
    places.push_back(now);
    // OpNoLine is passed over on purpose: a place a few lines off says more than none.
    if (i.op == spv::OpFunctionEnd) now = {};
  }
  return places;
}

}  // namespace shaderc

#include "interface.h"

#include <algorithm>
#include <cctype>
#include <set>

#include "rhi/shader.h"

namespace shaderc {
namespace {

// The locations of the semantics that may pass between stages. Geometry shaders take no more than 16 on
// the drivers at hand.
struct Block {
  const char* name;
  uint32_t first, count;
};
constexpr Block kBlocks[] = {
    {"TEXCOORD", 0, 10}, {"COLOR", 10, 2}, {"NORMAL", 12, 1}, {"TANGENT", 13, 1}, {"POSITION", 14, 2}};

struct Variable {
  uint32_t id, type, storage;  // type: what the pointer points to
};

struct Interface {
  const Semantics& semantics;
  std::map<uint32_t, uint32_t*> locations;  // into the module
  std::vector<Variable> variables;          // Input and Output
  std::map<uint32_t, spv::Op> typeOps;
  std::map<uint32_t, uint32_t> elementTypes;  // of arrays
};

Semantic Split(const std::string& text) {
  size_t digits = text.size();
  while (digits > 0 && std::isdigit(static_cast<unsigned char>(text[digits - 1]))) --digits;
  Semantic s{text.substr(0, digits), digits < text.size() ? uint32_t(std::stoul(text.substr(digits))) : 0};
  for (char& c : s.name) c = char(std::toupper(static_cast<unsigned char>(c)));
  return s;
}

void ReadTypes(const Instruction& i, Interface& out, std::map<uint32_t, uint32_t>& pointee) {
  if (i.op >= spv::OpTypeVoid && i.op <= spv::OpTypePointer) out.typeOps[i.words[0]] = i.op;
  if (i.op == spv::OpTypeArray) out.elementTypes[i.words[0]] = i.words[1];
  if (i.op == spv::OpTypePointer) pointee[i.words[0]] = i.words[2];
}

Interface Read(Module& module, const Semantics& semantics) {
  Interface out{.semantics = semantics};
  std::map<uint32_t, uint32_t> pointee;
  for (Instruction& i : module.code) {
    ReadTypes(i, out, pointee);
    if (i.op == spv::OpDecorate && i.words[1] == spv::DecorationLocation) out.locations[i.words[0]] = &i.words[2];
    if (i.op == spv::OpVariable && (i.words[2] == spv::StorageClassInput || i.words[2] == spv::StorageClassOutput))
      out.variables.push_back({i.words[1], pointee[i.words[0]], i.words[2]});
  }
  return out;
}

// One location each: no arrays, matrices or structs. A geometry shader's inputs are arrays over the vertices.
void RequireOneLocation(const Interface& all, const Variable& v, bool perVertex) {
  uint32_t type = v.type;
  if (perVertex && all.elementTypes.contains(type)) type = all.elementTypes.at(type);
  const spv::Op op = all.typeOps.at(type);
  if (op == spv::OpTypeArray || op == spv::OpTypeMatrix || op == spv::OpTypeStruct)
    throw CompileError("the semantic '" + all.semantics.at(v.id).name +
                       "' is on an array, a matrix or a struct within; use one float4 for each row");
}

uint32_t LocationOf(const Semantic& s) {
  for (const Block& b : kBlocks)
    if (s.name == b.name && s.index < b.count) return b.first + s.index;
  throw CompileError(
      "semantic '" + s.name + std::to_string(s.index) +
      "' cannot pass between stages; use TEXCOORD0..15, COLOR0..3, NORMAL0..1, TANGENT0..1 or POSITION0..1");
}

void Locate(Interface& all, spv::StorageClass storage, bool perVertex) {
  std::set<uint32_t> used;
  for (const Variable& v : all.variables) {
    const auto at = all.locations.find(v.id);
    if (v.storage != uint32_t(storage) || at == all.locations.end()) continue;
    if (!all.semantics.contains(v.id)) throw CompileError("a value that passes between stages has no semantic");
    RequireOneLocation(all, v, perVertex);
    const Semantic& s = all.semantics.at(v.id);
    *at->second = LocationOf(s);
    if (!used.insert(*at->second).second)
      throw CompileError("the semantic " + s.name + std::to_string(s.index) + " is used twice");
  }
}

}  // namespace

namespace {

// glslang 12 turns it into an undefined value.
void RefuseCoverageInput(const Module& module, const Semantics& semantics) {
  for (const auto& [id, semantic] : semantics)
    if (semantic.name == "SV_COVERAGE" && module.FindVariable(id)->words[2] == spv::StorageClassInput)
      throw CompileError("SV_Coverage cannot be an input; Direct3D 10 has it as an output only");
}

}  // namespace

Semantics TakeSemantics(Module& module) {
  Semantics semantics;
  for (const Instruction& i : module.code)
    if (i.op == spv::OpDecorateString && i.words[1] == spv::DecorationUserSemantic)
      semantics[i.words[0]] = Split(ReadString(i.words, 2));
  RefuseCoverageInput(module, semantics);
  module.RemoveIf([](const Instruction& i) {
    if (i.op == spv::OpDecorateString || i.op == spv::OpMemberDecorateString) return true;
    if (i.op == spv::OpDecorateId && i.words[1] == spv::DecorationHlslCounterBufferGOOGLE) return true;
    return i.op == spv::OpExtension && ReadString(i.words, 0).starts_with("SPV_GOOGLE_");
  });
  return semantics;
}

std::vector<VertexInput> ReadVertexInputs(const Module& module, const Semantics& semantics) {
  Module copy = module;
  const Interface all = Read(copy, semantics);
  std::vector<VertexInput> inputs;
  for (const Variable& v : all.variables) {
    const auto at = all.locations.find(v.id);
    if (v.storage != spv::StorageClassInput || at == all.locations.end()) continue;
    if (!all.semantics.contains(v.id)) throw CompileError("a vertex input has no semantic");
    RequireOneLocation(all, v, false);
    const Semantic& s = all.semantics.at(v.id);
    inputs.push_back({s.name, s.index, *at->second});
  }
  std::sort(inputs.begin(), inputs.end(), [](const auto& a, const auto& b) { return a.location < b.location; });
  return inputs;
}

void LocateBySemantic(Module& module, const Semantics& semantics, rhi::Stage stage) {
  Interface all = Read(module, semantics);
  const bool geometry = stage == rhi::Stage::Geometry;
  if (geometry || stage == rhi::Stage::Pixel) Locate(all, spv::StorageClassInput, geometry);
  if (geometry || stage == rhi::Stage::Vertex) Locate(all, spv::StorageClassOutput, false);
}

void MakeSecondSource(Module& module) {
  const Semantics none;
  const Interface all = Read(module, none);
  std::map<uint32_t, uint32_t> byLocation;
  for (const Variable& v : all.variables)
    if (const auto at = all.locations.find(v.id); v.storage == spv::StorageClassOutput && at != all.locations.end())
      byLocation[*at->second] = v.id;
  if (byLocation.size() != 2 || !byLocation.contains(0) || !byLocation.contains(1))
    throw CompileError(std::string(rhi::kDualSourceMacro) +
                       " needs a pixel shader of SV_Target0 and SV_Target1, no more");
  const uint32_t second = byLocation[1];
  *all.locations.at(second) = 0;
  const auto location = std::find_if(module.code.begin(), module.code.end(), [&](const Instruction& i) {
    return i.op == spv::OpDecorate && i.words[0] == second && i.words[1] == spv::DecorationLocation;
  });
  module.code.insert(location, {spv::OpDecorate, {second, spv::DecorationIndex, 1}});
}

}  // namespace shaderc

#include "spirv_passes.h"

#include <algorithm>
#include <set>
#include <spirv-tools/libspirv.hpp>
#include <spirv-tools/optimizer.hpp>

#include "rhi/shader.h"

namespace shaderc {
namespace {

constexpr spv_target_env kTarget = SPV_ENV_VULKAN_1_1;

std::string FirstLine(const std::string& text) { return text.substr(0, text.find('\n')); }

// The validator counts instructions from 1, after the header.
Where PlaceOf(const std::vector<Where>& places, size_t instruction) {
  return instruction >= 1 && instruction <= places.size() ? places[instruction - 1] : Where{};
}

bool IsNoContraction(const Instruction& i) {
  return i.op == spv::OpDecorate && i.words[1] == spv::DecorationNoContraction;
}

bool IsFloatArithmetic(spv::Op op) {
  switch (op) {
    case spv::OpFNegate:
    case spv::OpFAdd:
    case spv::OpFSub:
    case spv::OpFMul:
    case spv::OpFDiv:
    case spv::OpFRem:
    case spv::OpFMod:
    case spv::OpVectorTimesScalar:
    case spv::OpMatrixTimesScalar:
    case spv::OpExtInst: return true;
    default: return false;
  }
}

bool IsImageRead(spv::Op op) { return op == spv::OpImageRead || op == spv::OpImageTexelPointer; }

// Ids of the OpTypeImage types whose images are read. Images are loaded first: load -> variable -> pointer -> type.
std::set<uint32_t> ReadImageTypes(const Module& module) {
  std::map<uint32_t, uint32_t> typeOf, pointee;
  std::set<uint32_t> types;
  for (const Instruction& i : module.code) {
    if (i.op == spv::OpTypePointer) pointee[i.words[0]] = i.words[2];
    if (i.op == spv::OpLoad || i.op == spv::OpVariable || i.op == spv::OpFunctionParameter ||
        i.op == spv::OpAccessChain)
      typeOf[i.words[1]] = i.words[0];
    if (!IsImageRead(i.op)) continue;
    const uint32_t type = typeOf[i.words[2]];
    types.insert(i.op == spv::OpImageRead ? type : pointee[type]);
  }
  return types;
}

bool IsSingle32(uint32_t format) {
  return format == spv::ImageFormatR32f || format == spv::ImageFormatR32i || format == spv::ImageFormatR32ui;
}

void RelaxFormat(Instruction& type, bool read, bool& relaxed) {
  uint32_t& format = type.words[7];
  if (read && !IsSingle32(format))
    throw CompileError(
        "a typed UAV (RWTexture) that is read must be of float, int or uint; this is Direct3D's rule too");
  if (read) return;
  format = spv::ImageFormatUnknown;
  relaxed = true;
}

// Legalisation leaves local copies of vectors behind; a second round of the same kind takes them out.
void RegisterPasses(spvtools::Optimizer& optimizer) {
  optimizer.RegisterPass(spvtools::CreateRemoveDuplicatesPass());  // RelaxImageFormats can make two types one
  optimizer.RegisterLegalizationPasses();
  optimizer.RegisterPass(spvtools::CreateScalarReplacementPass())
      .RegisterPass(spvtools::CreateLocalAccessChainConvertPass())
      .RegisterPass(spvtools::CreateLocalSingleBlockLoadStoreElimPass())
      .RegisterPass(spvtools::CreateLocalSingleStoreElimPass())
      .RegisterPass(spvtools::CreateSimplificationPass())
      .RegisterPass(spvtools::CreateAggressiveDCEPass())
      .RegisterPass(spvtools::CreateLocalMultiStoreElimPass())
      .RegisterPass(spvtools::CreateSimplificationPass())
      .RegisterPass(spvtools::CreateVectorDCEPass())
      .RegisterPass(spvtools::CreateDeadInsertElimPass())
      .RegisterPass(spvtools::CreateRedundancyEliminationPass())
      .RegisterPass(spvtools::CreateAggressiveDCEPass())
      .RegisterPass(spvtools::CreateBlockMergePass())
      .RegisterPass(spvtools::CreateCFGCleanupPass());
}

uint32_t AddBuiltIn(Module& module, spv::BuiltIn builtIn, uint32_t pointerType) {
  const uint32_t id = module.NewId();
  module.InsertDecoration({spv::OpDecorate, {id, spv::DecorationBuiltIn, uint32_t(builtIn)}});
  module.InsertGlobal({spv::OpVariable, {pointerType, id, spv::StorageClassInput}});
  module.AddToInterface(id);
  return id;
}

// %r = load %index   becomes   %a = load %index; %b = load %base; %r = %a - %b
void SubtractAfterLoads(Module& module, uint32_t index, uint32_t base) {
  for (size_t i = 0; i < module.code.size(); ++i) {
    if (module.code[i].op != spv::OpLoad || module.code[i].words[2] != index) continue;
    const uint32_t type = module.code[i].words[0], result = module.code[i].words[1];
    const uint32_t a = module.NewId(), b = module.NewId();
    module.code[i].words[1] = a;
    module.code.insert(module.code.begin() + ptrdiff_t(i) + 1,
                       {{spv::OpLoad, {type, b, base}}, {spv::OpISub, {type, result, a, b}}});
    i += 2;
  }
}

uint32_t SetOfBinding(uint32_t binding, rhi::Stage stage) {
  if (binding < rhi::kVkTextureBinding) return rhi::kVkConstantSet;
  if (binding >= rhi::kVkUavBinding) return rhi::kVkUavSet;
  return rhi::kVkStageSet + (stage == rhi::Stage::Compute ? 0 : uint32_t(stage));
}

}  // namespace

void Validate(const Module& module, bool legalised) {
  const std::vector<Where> places = module.Places();
  std::vector<Problem> problems;
  spvtools::SpirvTools tools(kTarget);
  tools.SetMessageConsumer([&](spv_message_level_t level, const char*, const spv_position_t& at, const char* text) {
    if (level <= SPV_MSG_ERROR) problems.emplace_back(PlaceOf(places, at.index), "invalid SPIR-V: " + FirstLine(text));
  });
  spvtools::ValidatorOptions options;
  spvValidatorOptionsSetBeforeHlslLegalization(options, !legalised);
  const std::vector<uint32_t> words = module.Words();
  const bool ok = tools.Validate(words.data(), words.size(), options);
  if (!ok && problems.empty()) problems.emplace_back(Where{}, "invalid SPIR-V");
  ThrowIfAny(std::move(problems));
}

void ForbidFolding(Module& module) {
  std::vector<uint32_t> ids;
  for (const Instruction& i : module.code) {
    if (IsNoContraction(i))
      throw CompileError("'precise' has no effect: sums are kept as they are written; leave it out");
    if (IsFloatArithmetic(i.op)) ids.push_back(i.words[1]);
  }
  for (const uint32_t id : ids) module.InsertDecoration({spv::OpDecorate, {id, spv::DecorationNoContraction}});
}

void AllowFolding(Module& module) { module.RemoveIf(IsNoContraction); }

Module Optimize(const Module& module) {
  std::vector<Problem> problems;
  spvtools::Optimizer optimizer(kTarget);
  optimizer.SetMessageConsumer([&](spv_message_level_t level, const char*, const spv_position_t&, const char* text) {
    if (level <= SPV_MSG_ERROR) problems.emplace_back(Where{}, "spirv-opt: " + FirstLine(text));
  });
  RegisterPasses(optimizer);
  spvtools::OptimizerOptions options;
  options.set_run_validator(false);  // we validate before and after
  const std::vector<uint32_t> in = module.Words();
  std::vector<uint32_t> out;
  const bool ok = optimizer.Run(in.data(), in.size(), &out, options);
  if (!ok && problems.empty()) problems.emplace_back(Where{}, "spirv-opt failed");
  ThrowIfAny(std::move(problems));
  return Module(out);
}

void RelaxImageFormats(Module& module) {
  constexpr uint32_t kStorage = 2;  // the operand Sampled of an image without a sampler
  const std::set<uint32_t> read = ReadImageTypes(module);
  bool relaxed = false;
  for (Instruction& i : module.code)
    if (i.op == spv::OpTypeImage && i.words[6] == kStorage && i.words[2] != spv::DimSubpassData)
      RelaxFormat(i, read.contains(i.words[0]), relaxed);
  if (relaxed) module.InsertCapability(spv::CapabilityStorageImageWriteWithoutFormat);
}

bool SubtractBase(Module& module, spv::BuiltIn index, spv::BuiltIn base) {
  const auto variable = module.FindBuiltIn(index);
  if (!variable) return false;
  const uint32_t pointerType = module.FindVariable(*variable)->words[0];
  const uint32_t baseVariable = AddBuiltIn(module, base, pointerType);
  module.InsertCapability(spv::CapabilityDrawParameters);
  SubtractAfterLoads(module, *variable, baseVariable);
  return true;
}

void AssignSets(Module& module, rhi::Stage stage) {
  std::map<uint32_t, uint32_t> bindings;
  for (const Instruction& i : module.code)
    if (i.op == spv::OpDecorate && i.words[1] == spv::DecorationBinding) bindings[i.words[0]] = i.words[2];
  for (Instruction& i : module.code)
    if (i.op == spv::OpDecorate && i.words[1] == spv::DecorationDescriptorSet)
      i.words[2] = SetOfBinding(bindings[i.words[0]], stage);
}

void StripLines(Module& module) {
  const std::set<spv::Op> ops{spv::OpLine,   spv::OpNoLine,          spv::OpSource,         spv::OpSourceContinued,
                              spv::OpString, spv::OpSourceExtension, spv::OpModuleProcessed};
  module.RemoveIf([&](const Instruction& i) { return ops.contains(i.op); });
}

}  // namespace shaderc

#include "hlsl_to_spirv.h"

#include <glslang/MachineIndependent/localintermediate.h>
#include <glslang/Public/ResourceLimits.h>
#include <glslang/SPIRV/GlslangToSpv.h>

#include <iostream>
#include <optional>
#include <sstream>

#include "error.h"
#include "rhi/shader.h"

namespace shaderc {
namespace {

constexpr EShMessages kMessages = EShMessages(EShMsgSpvRules | EShMsgVulkanRules | EShMsgReadHlsl | EShMsgDebugInfo);

EShLanguage ToGlslang(rhi::Stage stage) {
  switch (stage) {
    case rhi::Stage::Vertex: return EShLangVertex;
    case rhi::Stage::Geometry: return EShLangGeometry;
    case rhi::Stage::Pixel: return EShLangFragment;
    case rhi::Stage::Compute: return EShLangCompute;
  }
  return EShLangVertex;
}

std::string Preamble(const Options& options) {
  std::string text;
  for (const std::string& define : options.defines) {
    const size_t equals = define.find('=');
    const std::string value = equals == std::string::npos ? "1" : define.substr(equals + 1);
    text += "#define " + define.substr(0, equals) + " " + value + "\n";
  }
  return text;
}

// Finds `before` + line number + `after`: the place in a message such as "file:12: text" or "file(12): text".
std::optional<Problem> FindPlace(const std::string& text, const std::string& before, const std::string& after) {
  for (size_t at = text.find(before); at != std::string::npos; at = text.find(before, at + 1)) {
    const size_t digits = at + before.size(), end = text.find_first_not_of("0123456789", digits);
    if (end == std::string::npos || end == digits || end - digits > 9 || text.compare(end, after.size(), after) != 0)
      continue;
    const uint32_t line = uint32_t(std::stoul(text.substr(digits, end - digits)));
    return Problem{{text.substr(0, at), line}, text.substr(end + after.size())};
  }
  return std::nullopt;
}

std::optional<std::string> After(const std::string& text, const std::string& prefix) {
  return text.starts_with(prefix) ? std::optional(text.substr(prefix.size())) : std::nullopt;
}

// Messages are "ERROR: file:line: text", the same with WARNING, or "file(line): text"; a count of them ends the log.
void ReadLine(const std::string& line, std::vector<Problem>& errors) {
  const std::optional<std::string> error = After(line, "ERROR: "), warning = After(line, "WARNING: ");
  if (line.find_first_not_of(" \t\r") == std::string::npos) return;
  if (error && error->find(" compilation errors.") != std::string::npos) return;
  if (const auto w = FindPlace(warning.value_or(""), ":", ": ")) {
    std::cerr << w->where.file << ":" << w->where.line << ": warning: " << w->text << "\n";
    return;
  }
  std::optional<Problem> problem = error ? FindPlace(*error, ":", ": ") : FindPlace(line, "(", "): ");
  // No place: also "WARNING: Linking ...: Entry point not found", which is no mere warning.
  errors.push_back(problem.value_or(Problem{{}, error.value_or(line)}));
}

std::vector<Problem> ReadLog(const std::string& log) {
  std::vector<Problem> errors;
  std::istringstream in(log);
  for (std::string line; std::getline(in, line);) ReadLine(line, errors);
  return errors;
}

void Require(bool ok, const std::string& log) {
  std::vector<Problem> problems = ReadLog(log);
  if (!ok && problems.empty()) problems.emplace_back(Where{}, "glslang failed without a message");
  ThrowIfAny(std::move(problems));
}

void Configure(glslang::TShader& shader, const Options& options) {
  const EShLanguage stage = ToGlslang(options.stage);
  shader.setEntryPoint("main");
  shader.setSourceEntryPoint(options.entry.c_str());
  shader.setEnvInput(glslang::EShSourceHlsl, stage, glslang::EShClientVulkan, 100);
  shader.setEnvClient(glslang::EShClientVulkan, glslang::EShTargetVulkan_1_1);
  shader.setEnvTarget(glslang::EShTargetSpv, glslang::EShTargetSpv_1_3);
  shader.setEnvTargetHlslFunctionality1();  // the semantics, as UserSemantic decorations
  shader.setHlslIoMapping(true);
  shader.setShiftBinding(glslang::EResUbo, 0);
  shader.setShiftBinding(glslang::EResTexture, rhi::kVkTextureBinding);
  shader.setShiftBinding(glslang::EResSampler, rhi::kVkSamplerBinding);
  shader.setShiftBinding(glslang::EResUav, rhi::kVkUavBinding);
  // Lines come from EShMsgDebugInfo and generateDebugInfo. setDebugInfo() is for another kind of debug information, and
  // glslang 12 crashes on it unless that is emitted.
}

// A cbuffer's symbol is called anon@N; its type has the name.
std::string NameOf(const glslang::TIntermSymbol& symbol) {
  const glslang::TString& name = symbol.getName();
  return (name.compare(0, 5, "anon@") == 0 ? symbol.getType().getTypeName() : name).c_str();
}

bool NeedsRegister(const glslang::TIntermSymbol& symbol) {
  const glslang::TType& type = symbol.getType();
  const bool resource = type.getBasicType() == glslang::EbtBlock || type.getBasicType() == glslang::EbtSampler;
  const bool hidden =
      NameOf(symbol).find_first_of("$@") != std::string::npos;  // globals, counters: reflect and gate tell
  return resource && !hidden && type.getQualifier().isUniformOrBuffer() && !type.getQualifier().hasBinding();
}

// Before mapIO, which would put all of them at register 0 without a word.
void RequireRegisters(glslang::TProgram& program, rhi::Stage stage) {
  std::vector<Problem> problems;
  for (TIntermNode* node : program.getIntermediate(ToGlslang(stage))->findLinkerObjects()->getSequence()) {
    const glslang::TIntermSymbol* symbol = node->getAsSymbolNode();
    if (!symbol || !NeedsRegister(*symbol)) continue;
    const glslang::TSourceLoc& at = symbol->getLoc();
    const std::string file = at.name ? std::string(at.name->c_str()) : std::string();
    problems.push_back(
        {{file, uint32_t(at.line)}, "'" + NameOf(*symbol) + "' has no register; write ': register(...)'"});
  }
  ThrowIfAny(std::move(problems));
}

std::vector<uint32_t> Generate(glslang::TProgram& program, rhi::Stage stage) {
  spv::SpvBuildLogger logger;
  glslang::SpvOptions spv;
  spv.generateDebugInfo = true;
  spv.disableOptimizer = true;  // we run the optimiser ourselves, after the checks
  std::vector<uint32_t> words;
  glslang::GlslangToSpv(*program.getIntermediate(ToGlslang(stage)), words, &logger, &spv);
  // "TBD" and "missing functionality" come with a module that is wrong, so any message is an error.
  Require(true, logger.getAllMessages());
  return words;
}

}  // namespace

std::vector<uint32_t> CompileHlsl(const Options& options, Includer& includer) {
  glslang::InitializeProcess();
  const std::string source = ReadSource(options.input), preamble = Preamble(options);
  const char* text = source.c_str();
  const char* name = options.input.c_str();
  const int length = int(source.size());
  glslang::TShader shader(ToGlslang(options.stage));
  shader.setStringsWithLengthsAndNames(&text, &length, &name, 1);
  shader.setPreamble(preamble.c_str());
  Configure(shader, options);
  const bool parsed = shader.parse(GetDefaultResources(), 100, false, kMessages, includer);
  Require(parsed, shader.getInfoLog());
  glslang::TProgram program;
  program.addShader(&shader);
  const bool linked = program.link(kMessages);
  Require(linked, program.getInfoLog());
  RequireRegisters(program, options.stage);
  const bool mapped = program.mapIO();
  Require(mapped, program.getInfoLog());
  return Generate(program, options.stage);
}

}  // namespace shaderc

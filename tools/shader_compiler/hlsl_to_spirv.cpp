#include "hlsl_to_spirv.h"

#include <iostream>
#include <regex>
#include <sstream>

#include <glslang/SPIRV/GlslangToSpv.h>
#include <glslang/Public/ResourceLimits.h>

#include "error.h"
#include "rhi/shader.h"

namespace shaderc {
namespace {

constexpr EShMessages kMessages =
    EShMessages(EShMsgSpvRules | EShMsgVulkanRules | EShMsgReadHlsl | EShMsgDebugInfo);

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

// Messages are "ERROR: file:line: text" or "file(line): text"; the counts at the end are dropped.
void ReadLine(const std::string& line, std::vector<Problem>& errors) {
  static const std::regex placed(R"(^(ERROR|WARNING): (.*?):(\d+): (.*)$)"), parenthesised(R"(^(.*)\((\d+)\): (.*)$)"),
      count(R"(^ERROR: \d+ compilation errors.*$)");
  std::smatch m;
  if (std::regex_match(line, count) || line.find_first_not_of(" \t\r") == std::string::npos) return;
  if (std::regex_match(line, m, placed)) {
    Problem p{{m[2], uint32_t(std::stoul(m[3]))}, m[4]};
    if (m[1] == "ERROR") errors.push_back(p);
    else std::cerr << p.where.file << ":" << p.where.line << ": warning: " << p.text << "\n";
  } else if (std::regex_match(line, m, parenthesised)) {
    errors.push_back({{m[1], uint32_t(std::stoul(m[2]))}, m[3]});
  } else {
    errors.push_back({{}, line});  // also "WARNING: Linking ...: Entry point not found", which is no warning
  }
}

std::vector<Problem> ReadLog(const std::string& log) {
  std::vector<Problem> errors;
  std::istringstream in(log);
  for (std::string line; std::getline(in, line);) ReadLine(line, errors);
  return errors;
}

void Require(bool ok, const std::string& log) {
  std::vector<Problem> problems = ReadLog(log);
  if (!ok && problems.empty()) problems.push_back({{}, "glslang failed without a message"});
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
  const bool mapped = program.mapIO();
  Require(mapped, program.getInfoLog());
  return Generate(program, options.stage);
}

}  // namespace shaderc

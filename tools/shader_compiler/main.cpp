// fur_shaderc: HLSL entry point in, C++ file out. See options.h for the command line, rhi/shader.h for what comes out.
#include <sys/wait.h>
#include <unistd.h>

#include <cstdio>
#include <cstring>
#include <iostream>

#include "emit.h"
#include "error.h"
#include "gate.h"
#include "hlsl_to_spirv.h"
#include "interface.h"
#include "options.h"
#include "spirv_passes.h"
#include "spirv_to_glsl.h"

namespace shaderc {
namespace {

void Print(const CompileError& error, const std::string& input) {
  for (const Problem& p : error.problems) {
    std::cerr << (p.where.file.empty() ? input.empty() ? "fur_shaderc" : input : p.where.file);
    if (p.where.line) std::cerr << ":" << p.where.line;
    std::cerr << ": error: " << p.text << "\n";
  }
}

Module ToOptimizedModule(const Options& options, Includer& includer, Semantics& semantics) {
  Module module(CompileHlsl(options, includer));
  GateSource(module);
  Validate(module, false);
  semantics = TakeSemantics(module);
  RelaxImageFormats(module);
  ForbidFolding(module);
  Module optimized = Optimize(module);
  AllowFolding(optimized);
  GateOptimized(optimized, options.stage);
  if (ReadsUndefined(optimized))
    std::cerr << options.input << ": warning: " << options.entry << " reads a value that is never set\n";
  return optimized;
}

void Dump(const Options& options, const std::vector<uint32_t>& spirv, const std::string& glsl) {
  if (!options.dumpSpirv.empty())
    WriteFile(options.dumpSpirv, {reinterpret_cast<const char*>(spirv.data()), spirv.size() * sizeof(uint32_t)});
  if (!options.dumpGlsl.empty()) WriteFile(options.dumpGlsl, glsl);
}

void Compile(const Options& options) {
  Includer includer(options.includeDirs);
  Semantics semantics;
  Module module = ToOptimizedModule(options, includer, semantics);
  const bool vertex = options.stage == rhi::Stage::Vertex;
  const std::vector<VertexInput> inputs = vertex ? ReadVertexInputs(module, semantics) : std::vector<VertexInput>{};
  LocateBySemantic(module, semantics, options.stage);
  if (std::find(options.defines.begin(), options.defines.end(), rhi::kDualSourceMacro) != options.defines.end())
    MakeSecondSource(module);
  const bool usesVertexId = SubtractBase(module, spv::BuiltInVertexIndex, spv::BuiltInBaseVertex);
  StripLines(module);
  GlslResult glsl = SpirvToGlsl(module.Words(), options.stage);
  glsl.reflection.inputs = inputs;
  glsl.reflection.usesVertexId = usesVertexId;
  // After the GLSL is made: gl_InstanceID is without the base already.
  glsl.reflection.usesInstanceId = SubtractBase(module, spv::BuiltInInstanceIndex, spv::BuiltInBaseInstance);
  AssignSets(module, options.stage);
  Validate(module, true);
  const std::vector<uint32_t> words = module.Words();
  Dump(options, words, glsl.source);
  if (!options.depfile.empty()) WriteFile(options.depfile, EmitDepfile(options, includer.Files()));
  WriteFile(options.output, EmitCpp(options, words, glsl.source, glsl.reflection));
}

int RunGuarded(const Options& options) {
  try {
    Compile(options);
    return 0;
  } catch (const CompileError& e) {
    Print(e, options.input);
  } catch (const std::exception& e) {
    std::cerr << options.input << ": error: " << e.what() << "\n";
  }
  return 1;
}

int ReportCrash(const Options& options, int signal) {
  std::cerr
      << options.input << ": error: the compiler crashed (" << strsignal(signal) << ") on entry " << options.entry
      << "; glslang does so on two geometry shaders with different outputs in one file: put each in a file of its "
         "own, or #if one out\n";
  return 1;
}

// glslang can crash on HLSL that is merely wrong, so the work is done in a child, and the parent tells which shader.
int RunInChild(const Options& options) {
  std::cerr.flush();
  const pid_t child = fork();
  if (child < 0) return RunGuarded(options);
  if (child == 0) {
    const int status = RunGuarded(options);
    std::cerr.flush();
    std::fflush(nullptr);
    _exit(status);  // no destructors and no leak check: glslang keeps its pools
  }
  int status = 0;
  if (waitpid(child, &status, 0) != child) return 1;
  if (WIFSIGNALED(status)) return ReportCrash(options, WTERMSIG(status));
  return WEXITSTATUS(status);
}

}  // namespace
}  // namespace shaderc

int main(int argc, char** argv) {
  shaderc::Options options;
  try {
    options = shaderc::ParseOptions({argv + 1, argv + argc});
  } catch (const shaderc::CompileError& e) {
    shaderc::Print(e, "");
    return 2;
  }
  const int status = shaderc::RunInChild(options);
  if (status != 0) std::remove(options.output.c_str());  // an old output must not pass for the new one
  return status;
}

// The command line of fur_shaderc.
#pragma once

#include <string>
#include <vector>

#include "rhi/types.h"

namespace shaderc {

struct Options {
  rhi::Stage stage = rhi::Stage::Vertex;
  std::string entry, name, symbol, nameSpace, input, output, depfile;
  std::vector<std::string> includeDirs;
  std::vector<std::string> defines;  // NAME or NAME=VALUE
  std::string dumpSpirv, dumpGlsl;   // optional files for people and tests
};

const char* Usage();

// Reads the arguments after the program's name. Throws CompileError on an unknown or missing one.
Options ParseOptions(const std::vector<std::string>& args);

// vs, gs, ps, cs
const char* StagePrefix(rhi::Stage);

}  // namespace shaderc

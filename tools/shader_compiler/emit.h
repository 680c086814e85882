// Writes the generated C++ file, the depfile and the optional dumps.
#pragma once

#include <cstdint>
#include <set>
#include <string>
#include <vector>

#include "options.h"
#include "reflect.h"

namespace shaderc {

// A C++ file that defines `const rhi::ShaderBlob <namespace>::<symbol>`.
std::string EmitCpp(const Options&, const std::vector<uint32_t>& spirv, const std::string& glsl, const Reflection&);

// One make rule: the output depends on the input and every file it included.
std::string EmitDepfile(const Options&, const std::set<std::string>& includes);

void WriteFile(const std::string& path, const std::string& content);  // throws CompileError

}  // namespace shaderc

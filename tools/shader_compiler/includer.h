// #include "x": relative to the including file, then the -I directories. Remembers every file for the depfile.
#pragma once

#include <glslang/Public/ShaderLang.h>

#include <filesystem>
#include <optional>
#include <set>
#include <string>
#include <vector>

namespace shaderc {

// The whole file; throws CompileError when it cannot be read or holds what glslang 12 silently ignores (#pragma once)
// or what we leave out (#include <>).
std::string ReadSource(const std::filesystem::path&);

class Includer : public glslang::TShader::Includer {
 public:
  explicit Includer(std::vector<std::string> dirs) : dirs_(std::move(dirs)) {}
  IncludeResult* includeLocal(const char* header, const char* includer, size_t depth) override;
  void releaseInclude(IncludeResult*) override;
  const std::set<std::string>& Files() const { return files_; }

 private:
  std::optional<std::filesystem::path> Find(const std::string& header, const std::string& includer) const;

  std::vector<std::string> dirs_;
  std::set<std::string> files_;
};

}  // namespace shaderc

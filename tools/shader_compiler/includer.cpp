#include "includer.h"

#include <fstream>
#include <sstream>

#include "error.h"

namespace shaderc {
namespace fs = std::filesystem;
namespace {

constexpr size_t kMaxIncludeDepth = 64;  // a file that includes itself without a guard

// "#  include <x>" -> "include<x>": the directive without its blanks; empty for other lines.
std::string Directive(const std::string& line) {
  std::string text;
  for (const char c : line)
    if (c != ' ' && c != '\t') text += c;
  return text.starts_with("#") ? text.substr(1) : std::string();
}

void CheckSource(const std::string& file, const std::string& text) {
  std::istringstream in(text);
  std::string line;
  for (uint32_t n = 1; std::getline(in, line); ++n) {
    const std::string directive = Directive(line);
    if (directive.starts_with("pragmaonce"))
      throw CompileError({file, n}, "#pragma once has no effect here; use an include guard");
    if (directive.starts_with("include<")) throw CompileError({file, n}, "#include <> is not supported; write \"\"");
  }
}

}  // namespace

std::string ReadSource(const fs::path& path) {
  std::ifstream in(path, std::ios::binary);
  std::ostringstream text;
  if (!in || !(text << in.rdbuf())) throw CompileError({path.string(), 0}, "cannot read this file, or it is empty");
  CheckSource(path.string(), text.str());
  return text.str();
}

std::optional<fs::path> Includer::Find(const std::string& header, const std::string& includer) const {
  std::vector<fs::path> candidates{fs::path(includer).parent_path() / header};
  for (const std::string& dir : dirs_) candidates.push_back(fs::path(dir) / header);
  for (const fs::path& p : candidates)
    if (fs::is_regular_file(p)) return p.lexically_normal();
  return std::nullopt;
}

Includer::IncludeResult* Includer::includeLocal(const char* header, const char* includer, size_t depth) {
  if (depth > kMaxIncludeDepth) throw CompileError({includer, 0}, "#include is nested too deep; is a guard missing?");
  const std::optional<fs::path> path = Find(header, includer);
  if (!path) return nullptr;  // glslang reports the place
  auto* text = new std::string(ReadSource(*path));
  files_.insert(path->string());
  return new IncludeResult(path->string(), text->data(), text->size(), text);
}

void Includer::releaseInclude(IncludeResult* result) {
  if (!result) return;
  delete static_cast<std::string*>(result->userData);
  delete result;
}

}  // namespace shaderc

#include "run_tool.h"

#include <sys/wait.h>

#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <sstream>

namespace fs = std::filesystem;

RunResult RunCommand(const std::string& command) {
  RunResult result;
  FILE* pipe = popen((command + " 2>&1").c_str(), "r");
  if (!pipe) return result;
  char buffer[4096];
  for (size_t n; (n = std::fread(buffer, 1, sizeof buffer, pipe)) > 0;) result.output.append(buffer, n);
  const int status = pclose(pipe);
  result.status = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  return result;
}

Scratch::Scratch() {
  std::string pattern = (fs::temp_directory_path() / "fur_shaderc_XXXXXX").string();
  if (mkdtemp(pattern.data())) root_ = pattern;
}

Scratch::~Scratch() {
  std::error_code ignored;
  if (!root_.empty()) fs::remove_all(root_, ignored);
}

std::string Scratch::Write(const std::string& name, const std::string& text) const {
  std::ofstream(root_ / name) << text;
  return Path(name);
}

std::string ReadText(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  std::ostringstream text;
  text << in.rdbuf();
  return text.str();
}

RunResult CompileText(const Scratch& scratch, const std::string& stage, const std::string& hlsl,
                      const std::string& more) {
  const std::string input = scratch.Write("shader.hlsl", hlsl);
  return RunCommand(std::string(FUR_SHADERC) + " --stage " + stage + " --entry Main --symbol s --namespace n " + more +
                    " -o " + scratch.Path("out.cpp") + " " + input);
}

// Runs programs and writes files in a folder of the test's own.
#pragma once

#include <filesystem>
#include <string>

struct RunResult {
  int status = -1;
  std::string output;  // stdout and stderr
};

RunResult RunCommand(const std::string& command);

// A folder that goes away with the object.
class Scratch {
 public:
  Scratch();
  ~Scratch();
  Scratch(const Scratch&) = delete;
  Scratch& operator=(const Scratch&) = delete;
  std::string Write(const std::string& name, const std::string& text) const;  // returns the path
  std::string Path(const std::string& name) const { return (root_ / name).string(); }

 private:
  std::filesystem::path root_;
};

std::string ReadText(const std::string& path);

// fur_shaderc on `hlsl` (written as shader.hlsl), entry Main.
RunResult CompileText(const Scratch&, const std::string& stage, const std::string& hlsl, const std::string& more = "");

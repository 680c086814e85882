#include "child_run.h"

#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <stdexcept>

namespace conformance {
namespace {

std::vector<uint8_t> Bytes(const std::string& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

std::string Quoted(const std::string& text) {  // for the shell
  std::string quoted = "'";
  for (const char c : text) quoted += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return quoted + "'";
}

}  // namespace

CacheFolder::CacheFolder() : path_((std::filesystem::temp_directory_path() / "fur_conformance_XXXXXX").string()) {
  if (!mkdtemp(path_.data())) throw std::runtime_error("no folder " + path_ + " can be made");
}

CacheFolder::~CacheFolder() {
  std::error_code ignored;
  std::filesystem::remove_all(path_, ignored);
}

size_t CacheFolder::Files() const {
  size_t files = 0;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(path_)) files += entry.is_regular_file();
  return files;
}

ChildRun RunInChild(const std::string& name, rhi::Backend backend, const CacheFolder& cache) {
  const CacheFolder work;
  const std::string bytes = work.Path() + "/bytes", said = work.Path() + "/said";
  const std::string label = rhi_test::BackendName(backend),
                    adapter = rhi_test::TestDeviceDesc(backend, nullptr).adapter;
  std::string command = "MESA_SHADER_CACHE_DIR=" + Quoted(cache.Path()) + " " +
                        Quoted(std::filesystem::read_symlink("/proc/self/exe").string()) + " --filter " +
                        Quoted(name + "." + label) + " --read-backs " + Quoted(bytes);
  if (!adapter.empty()) command += " --adapter " + Quoted(label + ":" + adapter);
  if (std::system((command + " > " + Quoted(said) + " 2>&1").c_str()) == 0)
    return {.bytes = Bytes(bytes), .problem = ""};
  const std::vector<uint8_t> text = Bytes(said);
  return {.bytes = {}, .problem = command + ":\n" + std::string(text.begin(), text.end())};
}

}  // namespace conformance

#include "settings.h"

#include <cstdlib>
#include <filesystem>

namespace conformance {
namespace {

std::string& Folder() {
  static std::string folder = [] {
    const char* named = std::getenv("FUR_ASSETS");
    return std::string(named ? named : FUR_ASSETS_DIR);
  }();
  return folder;
}

}  // namespace

std::string AssetsFolder() { return Folder(); }

bool SetAssetsFolder(const std::string& folder) {
  Folder() = folder;
  std::error_code ignored;
  return std::filesystem::is_directory(folder, ignored);
}

}  // namespace conformance

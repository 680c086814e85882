// Where the test models are.
#pragma once

#include <cstdlib>
#include <filesystem>

namespace fur::test {

// FUR_ASSETS in the environment, else what the build was told; tests that miss something there say so.
inline std::filesystem::path AssetsDir() {
  if (const char* folder = std::getenv("FUR_ASSETS")) return folder;
#ifdef FUR_ASSETS_DIR
  return FUR_ASSETS_DIR;
#else
  return {};
#endif
}

}  // namespace fur::test

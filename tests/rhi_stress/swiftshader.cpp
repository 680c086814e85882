#include "swiftshader.h"

#include <unistd.h>

#include <cstdlib>

namespace rhi_stress {

std::string SwiftShaderIcd() {
  const char* named = std::getenv("FUR_SWIFTSHADER_ICD");
  const std::string path = named ? named : "/usr/lib/chromium/vk_swiftshader_icd.json";
  return access(path.c_str(), R_OK) == 0 ? path : "";
}

void UseOnlyDriver(const std::string& icd) {
  setenv("VK_ICD_FILENAMES", icd.c_str(), 1);  // of old loaders
  setenv("VK_DRIVER_FILES", icd.c_str(), 1);
}

}  // namespace rhi_stress

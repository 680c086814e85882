// Usage: rhi_on_swiftshader PROGRAM ARGUMENTS...
// Becomes PROGRAM with SwiftShader as the only Vulkan driver; without SwiftShader, says so.
#include <unistd.h>

#include <cstdio>
#include <cstdlib>

#include "swiftshader.h"

int main(int argc, char** argv) {
  if (argc < 2) return std::fprintf(stderr, "usage: rhi_on_swiftshader PROGRAM ARGUMENTS...\n"), 2;
  const std::string icd = rhi_stress::SwiftShaderIcd();
  if (icd.empty()) {
    std::puts("skipped: no SwiftShader: install the Debian package chromium-common, or set FUR_SWIFTSHADER_ICD");
    return 0;
  }
  rhi_stress::UseOnlyDriver(icd);
  execv(argv[1], argv + 1);
  std::perror(argv[1]);
  return 1;
}

// The loader reads which drivers there are once and from the environment, so the tests run in a child that was born
// with SwiftShader as its only driver. Without SwiftShader they run here, and skip.
#include <gtest/gtest.h>
#include <spawn.h>
#include <sys/wait.h>

#include <cstdlib>

#include "swiftshader.h"

namespace {

constexpr const char* kInChild = "FUR_SWIFTSHADER_CHILD";

int RunInChild(const std::string& icd, char** argv) {
  setenv(kInChild, "1", 1);
  rhi_stress::UseOnlyDriver(icd);
  pid_t child = 0;
  if (posix_spawn(&child, "/proc/self/exe", nullptr, nullptr, argv, environ) != 0) return 1;
  int status = 0;
  if (waitpid(child, &status, 0) != child) return 1;
  return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
}

}  // namespace

int main(int argc, char** argv) {
  const std::string icd = rhi_stress::SwiftShaderIcd();
  if (!icd.empty() && !std::getenv(kInChild)) return RunInChild(icd, argv);
  testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
}

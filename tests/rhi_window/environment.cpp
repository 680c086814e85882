// An X server for all tests of this process, unless DISPLAY names one.
#include <gtest/gtest.h>

#include <cstdlib>

#include "scene.h"
#include "x_server.h"

namespace rhi_test {
namespace {

std::string problem = "the environment was not set up";

// Why a failure here is only noted: gtest would skip the tests for it, and ctest takes a skipped test for a good one.
class DisplayEnvironment final : public testing::Environment {
 public:
  void SetUp() override {
    const char* display = std::getenv("DISPLAY");
    problem = display && *display ? "" : server_.Start();
    if (problem.empty()) problem = StartWindows();
  }
  void TearDown() override {
    if (problem.empty()) EndWindows();
    server_.Stop();
  }

 private:
  XServer server_;
};

[[maybe_unused]] const testing::Environment* const kDisplay = testing::AddGlobalTestEnvironment(new DisplayEnvironment);

}  // namespace

std::string DisplayProblem() { return problem; }

}  // namespace rhi_test

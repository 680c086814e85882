// Hands the shared devices back before main returns, and fails on messages that come with their end.
#include "gpu.h"

namespace rhi_test {
namespace {

std::map<rhi::Backend, std::unique_ptr<Gpu>>& All() {
  static std::map<rhi::Backend, std::unique_ptr<Gpu>> all;
  return all;
}

class DevicesEnvironment final : public testing::Environment {
 public:
  void TearDown() override {
    // GL first: after the end of NVIDIA's last Vulkan device EGL is not initialized any more (driver 580).
    for (auto gpu = All().rbegin(); gpu != All().rend(); ++gpu) {
      gpu->second->Close();
      gpu->second->sink.Verify();
    }
    All().clear();
  }
};

[[maybe_unused]] const testing::Environment* const kDevices = testing::AddGlobalTestEnvironment(new DevicesEnvironment);

}  // namespace

Gpu& SharedGpu(rhi::Backend backend) {
  const auto found = All().find(backend);
  if (found != All().end()) return *found->second;
  return *All().emplace(backend, std::make_unique<Gpu>(backend)).first->second;
}

}  // namespace rhi_test

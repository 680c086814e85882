#include "support.h"

#include <ostream>

#include "rhi_gl/rhi_gl.h"
#include "rhi_vulkan/rhi_vulkan.h"

namespace fur::test {

const std::vector<BackendCase>& Backends() {
  static const std::vector<BackendCase> backends{{"vulkan", rhi_vulkan::CreateDevice}, {"gl", rhi_gl::CreateDevice}};
  return backends;
}

void PrintTo(const BackendCase& backend, std::ostream* out) { *out << backend.name; }

std::string BackendName(const testing::TestParamInfo<BackendCase>& info) { return info.param.name; }

void Messages::OnMessage(const rhi::Message& m) {
  if (m.severity != rhi::Severity::Info) lines.push_back(std::string(m.object) + ": " + m.text);
}

TestDevice::TestDevice(const BackendCase& backend) {
  const rhi::DeviceDesc desc{.sink = &messages_};
  const rhi::Status status = backend.createDevice(desc, &device_);
  EXPECT_EQ(status, rhi::Status::Ok) << "no " << backend.name << " device: " << rhi::ToString(status);
}

TestDevice::~TestDevice() {
  device_ = {};  // leaks are reported here
  for (const std::string& line : messages_.lines) ADD_FAILURE() << "the device says: " << line;
}

void OnEachBackend::SetUp() {
  device_ = std::make_unique<TestDevice>(GetParam());
  ASSERT_TRUE(*device_);
}

}  // namespace fur::test

// Devices for the renderer's tests, whose pictures are made by frames.h.
#pragma once

#include <gtest/gtest.h>

#include <memory>
#include <string>
#include <vector>

#include "frames.h"

namespace fur::test {

struct BackendCase {
  const char* name;
  rhi::Status (*createDevice)(const rhi::DeviceDesc&, rhi::Ref<rhi::IDevice>*);
};
const std::vector<BackendCase>& Backends();
void PrintTo(const BackendCase&, std::ostream*);
std::string BackendName(const testing::TestParamInfo<BackendCase>&);

// Keeps what the RHI and the drivers say.
class Messages final : public rhi::IMessageSink {
 public:
  void OnMessage(const rhi::Message&) override;
  std::vector<std::string> lines;  // warnings and worse
};

// A device whose messages must stay silent: each is a failure of the test that it belongs to.
class TestDevice {
 public:
  explicit TestDevice(const BackendCase&);
  ~TestDevice();
  TestDevice(const TestDevice&) = delete;
  TestDevice& operator=(const TestDevice&) = delete;
  rhi::IDevice& operator*() { return *device_; }
  operator rhi::IDevice&() { return *device_; }
  rhi::IDevice* operator->() { return device_.get(); }
  explicit operator bool() const { return device_.get() != nullptr; }

 private:
  Messages messages_;  // outlives the device
  rhi::Ref<rhi::IDevice> device_;
};

// Tests that run on each backend.
class OnEachBackend : public testing::TestWithParam<BackendCase> {
 protected:
  void SetUp() override;
  std::unique_ptr<TestDevice> device_;
};

}  // namespace fur::test

// Devices, small models and pictures for the renderer's tests.
#pragma once

#include <gtest/gtest.h>

#include <array>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "fur/renderer.h"

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

struct Frame {
  Image image;
  FrameCounts counts;
};
// One animal at `placements`, or in the origin without a turn.
Frame Render(TestDevice&, const Model&, const RenderSettings&, const Camera&,
             const std::vector<glm::dmat4>& placements = {glm::dmat4(1)});

// The frame before it is brought to 8 bits.
FloatImage Pixels(TestDevice&, const Model&, const RenderSettings&, const Camera&,
                  const std::vector<glm::dmat4>& placements = {glm::dmat4(1)});

// Whether there are pixels, and each is a number.
bool AllFinite(const FloatImage&);

using Rgb = std::array<int, 3>;
Rgb PixelAt(const Image&, uint32_t x, uint32_t y);
Rgb Center(const Image&);
size_t Colors(const Image&);  // how many a picture has: a wrong one tends to have few
uint64_t DifferingPixels(const Image&, const Image&);
// Each channel within `tolerance` of 255 * expected.
void ExpectColor(const Rgb& got, const glm::dvec3& expected, double tolerance, const std::string& what);

}  // namespace fur::test

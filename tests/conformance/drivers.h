// Which driver each backend runs on, by short names: "vulkan:lavapipe", "gl:llvmpipe", "vulkan:swiftshader", "gl:zink".
#pragma once

#include <string>

#include "rhi/types.h"

namespace conformance {

struct DriverInfo {
  bool present = false;
  std::string backend;          // "vulkan", "gl"
  std::string key;              // "vulkan:lavapipe"
  std::string adapter, driver;  // as the driver names itself, with its version
  std::string problem;          // why it is not present
};

std::string BackendName(rhi::Backend);  // "vulkan", "gl"
DriverInfo Describe(const rhi::Caps&);

// Set once by main, before the cases run.
void SetDrivers(const DriverInfo& vulkan, const DriverInfo& gl);
const DriverInfo& DriverOf(const std::string& backend);
// The key of the driver that a case of this backend (names.h) is for. Of "both": the odd one; "cpu" for "cpu".
std::string DriverKeyOf(const std::string& backend);
// The same for people and filters: of "both", both keys with a space between.
std::string DriverLabelOf(const std::string& backend);
// The driver that is not lavapipe or llvmpipe; "gl:llvmpipe" where both are the required ones.
std::string OddDriver();

}  // namespace conformance

// The Vulkan 1.3 backend.
#pragma once

#include <string>
#include <vector>

#include "rhi/rhi.h"

namespace rhi_vulkan {

// Makes a device on the adapter that `desc` names. Unsupported, with a message, where there is no Vulkan 1.3 driver.
rhi::Status CreateDevice(const rhi::DeviceDesc& desc, rhi::Ref<rhi::IDevice>* device);

// Caps of every adapter that the loader lists, also of those that are too old (apiMajor.apiMinor tells).
std::vector<rhi::Caps> EnumerateAdapters();

}  // namespace rhi_vulkan

// The OpenGL 4.5 core backend, through EGL.
#pragma once

#include <string>
#include <vector>

#include "rhi/rhi.h"

namespace rhi_gl {

// Makes a device on the EGL device that `desc` names. Unsupported, with a message, where there is no GL 4.5.
rhi::Status CreateDevice(const rhi::DeviceDesc& desc, rhi::Ref<rhi::IDevice>* device);

// Caps of every adapter that EGL lists, also of those that are too old (apiMajor.apiMinor tells).
std::vector<rhi::Caps> EnumerateAdapters();

}  // namespace rhi_gl

#pragma once

namespace rhi_gl {

class Core;

// Sends what the driver's debug layer says to the device's sink, on the thread and within the call that caused it.
void InstallDebugCallback(Core&);

}  // namespace rhi_gl

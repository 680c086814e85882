// The RHI's own validation: a device over any backend's that checks each call before it forwards it.
//
//   rhi_vulkan::CreateDevice({.sink = &sink}, &device);
//   device = rhi::WrapWithValidation(device, &sink);  // from here on use only the wrapper and its context
//
//  - Messages say what is wrong, the actual state, and what to do. What a backend reports too keeps the backend's code.
//  - An Error is reported and the call ignored; after a Warning or Info it goes on to the backend. A backend may then
//    add its own message of the same code (registers with nothing bound, say).
//  - The same code for the same object is reported once between two EndFrames.
//  - Objects are the backend's own. Those that were not made through the wrapper are ForeignObject to it. It holds a
//    count of each object until the EndFrame after the caller's last Release, so that it can tell objects of another
//    device, and destroyed ones, by their address.
//  - When the last reference of the wrapper goes, it unbinds everything, waits, and reports what is still referenced
//    (LiveObjects, a Warning), except state objects, which a backend may hold itself. That objects live on is legal.
//
// What it cannot see: indices of indexed draws, arguments of indirect draws, what the GPU writes, and a mapped pointer
// that is used after Unmap.
#pragma once

#include "rhi/device.h"

namespace rhi {

// Null stays null. The sink must outlive the device and may be the inner device's; null drops the messages.
Ref<IDevice> WrapWithValidation(Ref<IDevice> inner, IMessageSink* sink);

}  // namespace rhi

// A device without a driver, for tests of code that uses the RHI: Backend::Null.
//
// It checks descriptors as every backend does, keeps state objects interned, and follows Direct3D 10's binding rules.
// Buffers and textures live in the CPU's memory, so that Map, UpdateConstants, UpdateSubresource, copies and ReadBack
// give what was written. Clears write the whole view for every format but R11G11B10_Float (left as it is). A
// multisampled texture keeps one texel for all its samples, which ResolveSubresource copies.
// Draws and dispatches are counted in Stats and write nothing; GenerateMips leaves the further mips as they are.
// Queries are ready at once: an Event has passed, TimestampDisjoint counts in ns, the others give 0.
// Shader blobs need no code, only reflection. Rules of draws are not checked: see rhi/validation.h.
#pragma once

#include "rhi/device.h"

namespace rhi {

// Only `sink` of the descriptor matters.
Status CreateNullDevice(const DeviceDesc&, Ref<IDevice>*);

}  // namespace rhi

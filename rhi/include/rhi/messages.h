// Messages: the one way in which the RHI, its validation, and the drivers' debug layers speak. Codes are stable:
// a number never changes its meaning; new ones are appended.
#pragma once

#include "rhi/types.h"

namespace rhi {

enum class MsgCode : uint16_t {
  None = 0,
  // 1xx: creation
  DeviceUnavailable = 100,
  CapMissing = 101,
  InvalidDesc = 102,
  OutOfMemory = 103,
  ShaderRejected = 104,
  LayoutMismatch = 105,
  ImmutableWrite = 106,
  LiveObjects = 107,  // an object is still referenced when its device goes
  // 2xx: binding
  TargetStillBoundAsInput = 200,  // a target's shader view was unbound, as Direct3D 10 does
  InputStillBoundAsTarget = 201,
  SlotOutOfRange = 202,
  WrongBindFlag = 203,
  WrongStage = 204,
  ForeignObject = 205,  // of another device, or destroyed
  // 3xx: drawing
  NoVertexShader = 300,
  NoTarget = 301,
  TargetsDiffer = 302,  // size or sample count of the targets
  NothingBound = 303,   // a shader reads a register with nothing bound; it reads 0
  TopologyMismatch = 304,
  IndexBufferMissing = 305,
  ViewMismatch = 306,       // a view's kind or dimension is another than the shader declares
  StrideMismatch = 307,     // a structured buffer's stride is another than the shader's
  ConstantsTooSmall = 308,  // a constant buffer holds less than the shader's block
  ViewportOutside = 309,
  // 4xx: data
  MapMode = 400,  // the usage does not allow this way to the data: Map's mode, a copy to a Dynamic resource
  MapTwice = 401,
  OutOfBounds = 402,
  SubresourceOutOfRange = 403,
  FormatMismatch = 404,  // format, size, sample count or kind of two resources differ, or of a resource and the call
  MappedInUse = 405,    // a mapped resource is used by a draw, dispatch or copy
  MapOpen = 406,        // a resource is mapped at EndFrame
  PitchTooSmall = 407,  // rows or slices of the caller's data overlap
  // 5xx: queries and debug events
  QueryOrder = 500,
  QueryOpen = 501,   // begun and never ended, or open at EndFrame
  QueryEmpty = 502,  // nothing was drawn between Begin and End
  EventOpen = 503,   // BeginEvent without EndEvent at EndFrame
  // 6xx: swap chain
  SurfaceLost = 600,
  // 9xx: from outside
  ApiValidation = 900,  // Vulkan validation layer or GL debug output
  DeviceLost = 901
};

struct Message {
  Severity severity = Severity::Info;
  MsgCode code = MsgCode::None;
  const char* object = "";  // the object's name, or ""
  const char* text = "";    // what, the actual state, what to do; valid during the call only
  int32_t apiId = 0;        // the layer's own number, with ApiValidation
};

// Receives every message; may be called from any thread in which the RHI is used. Must outlive the device.
class IMessageSink {
 public:
  virtual void OnMessage(const Message&) = 0;

 protected:
  ~IMessageSink() = default;
};

const char* ToString(MsgCode);

}  // namespace rhi

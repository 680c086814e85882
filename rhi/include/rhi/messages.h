// Messages: the one way in which the RHI, its validation, and the drivers' debug layers speak. Codes are stable:
// a number never changes its meaning; new ones are appended.
#pragma once

#include "rhi/types.h"

namespace rhi {

// [v]: only rhi/validation.h says it; without the wrapper the case is undefined or harmless.
enum class MsgCode : uint16_t {
  None = 0,
  // 1xx: creation
  DeviceUnavailable = 100,  // no adapter that fits DeviceDesc
  CapMissing = 101,         // Status::Unsupported: the text names the cap or the format's support
  InvalidDesc = 102,        // a descriptor breaks a rule, or a pointer that must not be null is
  OutOfMemory = 103,
  ShaderRejected = 104,  // by the driver: when it is made, or at the first draw
  LayoutMismatch = 105,  // an input of the vertex shader without an element; a draw with a layout that lacks one
  ImmutableWrite = 106,
  LiveObjects = 107,  // [v] an object is still referenced when its device goes
  PipelineCacheRefused = 108,  // DeviceDesc::pipelineCache is damaged, or of another driver; it is ignored
  // 2xx: binding
  TargetStillBoundAsInput = 200,  // a target's shader view was unbound, as Direct3D 10 does
  InputStillBoundAsTarget = 201,  // a shader view of what is bound as a target was bound as null, likewise
  SlotOutOfRange = 202,
  WrongBindFlag = 203,  // views, mips, indirect arguments; [v] buffers that are bound
  WrongStage = 204,
  ForeignObject = 205,  // [v] of another device, or destroyed
  // 3xx: drawing
  NoVertexShader = 300,
  NoTarget = 301,
  TargetsDiffer = 302,  // size or sample count of the targets
  NothingBound = 303,   // a shader reads a register with nothing bound; it reads 0
  TopologyMismatch = 304,
  IndexBufferMissing = 305,
  ViewMismatch = 306,       // a view's kind, dimension or type of texels is another than the shader declares
  StrideMismatch = 307,     // [v] a structured buffer's stride is another than the shader's
  ConstantsTooSmall = 308,  // [v] a constant buffer holds less than the shader's block
  ViewportOutside = 309,    // [v] a viewport shows nothing of the targets (Warning), or reaches beyond (Info)
  // 4xx: data
  MapMode = 400,  // a way of writing or mapping that the usage does not allow
  MapTwice = 401,
  OutOfBounds = 402,            // bytes, elements, boxes, sizes of results
  SubresourceOutOfRange = 403,  // also of views
  FormatMismatch = 404,         // formats, sizes, sample counts or kinds of resources that do not go together
  MappedInUse = 405,            // [v] a mapped resource is used by a draw, dispatch or copy
  MapOpen = 406,                // [v] a resource is mapped at EndFrame
  PitchTooSmall = 407,          // rows or slices of the caller's data overlap
  // 5xx: queries and debug events
  QueryOrder = 500,  // also an EndEvent too many (Warning)
  QueryOpen = 501,   // [v] begun and never ended, or open at EndFrame
  QueryEmpty = 502,  // [v] nothing was drawn between Begin and End
  EventOpen = 503,   // [v] BeginEvent without EndEvent at EndFrame
  // 6xx: swap chain
  SurfaceLost = 600,  // the window is gone
  // 9xx: from outside
  ApiValidation = 900,  // Vulkan validation layer or GL debug output
  DeviceLost = 901      // the GPU was reset or does not finish: make the device anew
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

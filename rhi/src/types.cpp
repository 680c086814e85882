#include "rhi/types.h"

#include <algorithm>
#include <bit>

#include "rhi/messages.h"

namespace rhi {
namespace {

constexpr auto kFormats = std::to_array<FormatInfo>({
    //name                 bytes block comps depth  stencil sRGB  float  integer
    {"Unknown",             0, 1, 0, false, false, false, false, false},
    {"R8_UNorm",            1, 1, 1, false, false, false, false, false},
    {"RG8_UNorm",           2, 1, 2, false, false, false, false, false},
    {"RGBA8_UNorm",         4, 1, 4, false, false, false, false, false},
    {"RGBA8_UNorm_sRGB",    4, 1, 4, false, false, true,  false, false},
    {"BGRA8_UNorm",         4, 1, 4, false, false, false, false, false},
    {"BGRA8_UNorm_sRGB",    4, 1, 4, false, false, true,  false, false},
    {"R16_Float",           2, 1, 1, false, false, false, true,  false},
    {"RG16_Float",          4, 1, 2, false, false, false, true,  false},
    {"RGBA16_Float",        8, 1, 4, false, false, false, true,  false},
    {"R32_Float",           4, 1, 1, false, false, false, true,  false},
    {"RG32_Float",          8, 1, 2, false, false, false, true,  false},
    {"RGB32_Float",        12, 1, 3, false, false, false, true,  false},
    {"RGBA32_Float",       16, 1, 4, false, false, false, true,  false},
    {"R16_UInt",            2, 1, 1, false, false, false, false, true},
    {"R32_UInt",            4, 1, 1, false, false, false, false, true},
    {"RGBA8_UInt",          4, 1, 4, false, false, false, false, true},
    {"R10G10B10A2_UNorm",   4, 1, 4, false, false, false, false, false},
    {"R11G11B10_Float",     4, 1, 3, false, false, false, true,  false},
    {"D16_UNorm",           2, 1, 1, true,  false, false, false, false},
    {"D24_UNorm_S8_UInt",   4, 1, 2, true,  true,  false, false, false},
    {"D32_Float",           4, 1, 1, true,  false, false, true,  false},
    {"D32_Float_S8_UInt",   8, 1, 2, true,  true,  false, true,  false},
    {"BC1_UNorm",           8, 4, 4, false, false, false, false, false},
    {"BC3_UNorm",          16, 4, 4, false, false, false, false, false},
    {"BC5_UNorm",          16, 4, 2, false, false, false, false, false},
    {"BC7_UNorm",          16, 4, 4, false, false, false, false, false},
});
static_assert(kFormats.size() == size_t(Format::Count));

}  // namespace

const FormatInfo& GetFormatInfo(Format format) {
  return kFormats[size_t(format) < kFormats.size() ? size_t(format) : 0];
}

Format ToSRGB(Format format) {
  if (format == Format::RGBA8_UNorm) return Format::RGBA8_UNorm_sRGB;
  if (format == Format::BGRA8_UNorm) return Format::BGRA8_UNorm_sRGB;
  return format;
}

Format ToLinear(Format format) {
  if (format == Format::RGBA8_UNorm_sRGB) return Format::RGBA8_UNorm;
  if (format == Format::BGRA8_UNorm_sRGB) return Format::BGRA8_UNorm;
  return format;
}

uint32_t FullMipCount(uint32_t width, uint32_t height, uint32_t depth) {
  return uint32_t(std::bit_width(std::max({width, height, depth, 1u})));
}

const char* ToString(Format format) { return GetFormatInfo(format).name; }

const char* ToString(Status status) {
  switch (status) {
    case Status::Ok: return "ok";
    case Status::InvalidArg: return "invalid argument";
    case Status::Unsupported: return "unsupported";
    case Status::OutOfMemory: return "out of memory";
    case Status::CompileFailed: return "compile failed";
    case Status::DeviceLost: return "device lost";
    case Status::StillDrawing: return "still drawing";
    case Status::InternalError: return "internal error";
    case Status::SurfaceLost: return "surface lost";
  }
  return "unknown status";
}

const char* ToString(Backend backend) {
  switch (backend) {
    case Backend::Null: return "null";
    case Backend::Vulkan: return "vulkan";
    case Backend::OpenGL: return "gl";
  }
  return "unknown backend";
}

const char* ToString(Severity severity) {
  switch (severity) {
    case Severity::Info: return "info";
    case Severity::Warning: return "warning";
    case Severity::Error: return "error";
    case Severity::Corruption: return "corruption";
  }
  return "unknown severity";
}

const char* ToString(Stage stage) {
  switch (stage) {
    case Stage::Vertex: return "vertex";
    case Stage::Geometry: return "geometry";
    case Stage::Pixel: return "pixel";
    case Stage::Compute: return "compute";
  }
  return "unknown stage";
}

const char* ToString(PrimitiveTopology topology) {
  constexpr auto kNames = std::to_array<const char*>({"PointList", "LineList", "LineStrip", "TriangleList", "TriangleStrip",
                                                      "LineListAdj", "LineStripAdj", "TriangleListAdj", "TriangleStripAdj"});
  return size_t(topology) < kNames.size() ? kNames[size_t(topology)] : "unknown topology";
}

const char* ToString(MsgCode code) {
  switch (code) {
    case MsgCode::None: return "None";
    case MsgCode::DeviceUnavailable: return "DeviceUnavailable";
    case MsgCode::CapMissing: return "CapMissing";
    case MsgCode::InvalidDesc: return "InvalidDesc";
    case MsgCode::OutOfMemory: return "OutOfMemory";
    case MsgCode::ShaderRejected: return "ShaderRejected";
    case MsgCode::LayoutMismatch: return "LayoutMismatch";
    case MsgCode::ImmutableWrite: return "ImmutableWrite";
    case MsgCode::LiveObjects: return "LiveObjects";
    case MsgCode::PipelineCacheRefused: return "PipelineCacheRefused";
    case MsgCode::TargetStillBoundAsInput: return "TargetStillBoundAsInput";
    case MsgCode::InputStillBoundAsTarget: return "InputStillBoundAsTarget";
    case MsgCode::SlotOutOfRange: return "SlotOutOfRange";
    case MsgCode::WrongBindFlag: return "WrongBindFlag";
    case MsgCode::WrongStage: return "WrongStage";
    case MsgCode::ForeignObject: return "ForeignObject";
    case MsgCode::NoVertexShader: return "NoVertexShader";
    case MsgCode::NoTarget: return "NoTarget";
    case MsgCode::TargetsDiffer: return "TargetsDiffer";
    case MsgCode::NothingBound: return "NothingBound";
    case MsgCode::TopologyMismatch: return "TopologyMismatch";
    case MsgCode::IndexBufferMissing: return "IndexBufferMissing";
    case MsgCode::ViewMismatch: return "ViewMismatch";
    case MsgCode::StrideMismatch: return "StrideMismatch";
    case MsgCode::ConstantsTooSmall: return "ConstantsTooSmall";
    case MsgCode::ViewportOutside: return "ViewportOutside";
    case MsgCode::MapMode: return "MapMode";
    case MsgCode::MapTwice: return "MapTwice";
    case MsgCode::OutOfBounds: return "OutOfBounds";
    case MsgCode::SubresourceOutOfRange: return "SubresourceOutOfRange";
    case MsgCode::FormatMismatch: return "FormatMismatch";
    case MsgCode::MappedInUse: return "MappedInUse";
    case MsgCode::MapOpen: return "MapOpen";
    case MsgCode::PitchTooSmall: return "PitchTooSmall";
    case MsgCode::QueryOrder: return "QueryOrder";
    case MsgCode::QueryOpen: return "QueryOpen";
    case MsgCode::QueryEmpty: return "QueryEmpty";
    case MsgCode::EventOpen: return "EventOpen";
    case MsgCode::SurfaceLost: return "SurfaceLost";
    case MsgCode::ApiValidation: return "ApiValidation";
    case MsgCode::DeviceLost: return "DeviceLost";
  }
  return "unknown code";
}

}  // namespace rhi

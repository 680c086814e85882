// Plain data of the RHI: enums, descriptors, limits, capabilities.
//
// Names and meanings are Direct3D 10's (10.1's for per-target blending). Where a Vulkan or GL term differs, the comment
// gives it. Descriptors are plain structs with defaults, made for designated initialisers:
//
//   device->CreateBuffer({.byteWidth = 256, .usage = Usage::Dynamic, .bind = Bind::ConstantBuffer}, nullptr, &buffer);
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace rhi {

// ---------------------------------------------------------------------------------------------------------- limits
inline constexpr uint32_t kMaxRenderTargets = 8;    // D3D10_SIMULTANEOUS_RENDER_TARGET_COUNT
inline constexpr uint32_t kMaxViewports = 16;       // and scissor rectangles
inline constexpr uint32_t kMaxSamples = 32;         // of a pixel, whatever a driver offers
inline constexpr uint32_t kMaxVertexBuffers = 16;   // slots
inline constexpr uint32_t kMaxVertexElements = 16;  // of one input layout
// b0 frame, b1 pass or material, b2 object, b3 draw; shared by all stages. Direct3D has 14 for each stage; per-stage
// slots would exceed Vulkan's guaranteed 8 dynamic uniform buffers, so this is a documented deviation.
inline constexpr uint32_t kMaxConstantBuffers = 4;
inline constexpr uint32_t kMaxConstantBufferBytes = 16384;  // GL's and Vulkan's floor (D3D10: 65536)
inline constexpr uint32_t kMaxShaderResources = 16;         // t0..t15, for each stage
inline constexpr uint32_t kMaxSamplers = 16;                // s0..s15, for each stage
inline constexpr uint32_t kMaxUnorderedAccess = 8;          // u0..u7, compute only
inline constexpr uint32_t kAllMips = ~0u;                   // in a view: up to the last
inline constexpr uint32_t kAllSlices = ~0u;                 // the same for slices

// ----------------------------------------------------------------------------------------------------------- enums
enum class Backend : uint8_t { Null, Vulkan, OpenGL };

// DXGI_FORMAT, the subset that every backend can express. _sRGB: decoded when read, encoded when written or blended.
enum class Format : uint8_t {
  Unknown,
  R8_UNorm,
  RG8_UNorm,
  RGBA8_UNorm,
  RGBA8_UNorm_sRGB,
  BGRA8_UNorm,
  BGRA8_UNorm_sRGB,
  R16_Float,
  RG16_Float,
  RGBA16_Float,
  R32_Float,
  RG32_Float,
  RGB32_Float,  // vertex elements only
  RGBA32_Float,
  R16_UInt,  // index buffers, vertex elements
  R32_UInt,
  RGBA8_UInt,
  R10G10B10A2_UNorm,
  R11G11B10_Float,
  D16_UNorm,
  D24_UNorm_S8_UInt,
  D32_Float,
  D32_Float_S8_UInt,
  BC1_UNorm,
  BC3_UNorm,
  BC5_UNorm,
  BC7_UNorm,
  Count
};

// D3D10_USAGE. Default and Immutable: memory of the GPU; Dynamic: slices of the ring (no textures); Staging: memory
// that the CPU maps, no bind flags, neither stencil nor samples.
enum class Usage : uint8_t {
  Default,    // GPU reads and writes; UpdateSubresource and copies
  Immutable,  // initialised once, never written again
  Dynamic,    // CPU writes by Map(WriteDiscard / WriteNoOverwrite), GPU reads
  Staging     // CPU reads or writes, copies only
};

// D3D10_BIND_FLAG. Textures: ShaderResource, RenderTarget, DepthStencil, UnorderedAccess; buffers: the others, and
// ShaderResource and UnorderedAccess where they are structured. ConstantBuffer stands alone; UnorderedAccess needs
// Usage::Default.
enum class Bind : uint32_t {
  None = 0,
  VertexBuffer = 1,
  IndexBuffer = 2,
  ConstantBuffer = 4,
  ShaderResource = 8,
  RenderTarget = 16,
  DepthStencil = 32,
  UnorderedAccess = 64,
  IndirectArgs = 128
};
constexpr Bind operator|(Bind a, Bind b) { return Bind(uint32_t(a) | uint32_t(b)); }
constexpr bool operator&(Bind a, Bind b) { return (uint32_t(a) & uint32_t(b)) != 0; }

enum class MapMode : uint8_t {
  Read,             // staging
  Write,            // staging
  WriteDiscard,     // dynamic: fresh memory, the old contents stay with the draws already recorded
  WriteNoOverwrite  // dynamic: same memory, the caller promises not to touch what recorded draws read
};

// Tex2DMS: 2 samples or more, one mip, no initial data. Tex3D: no depth formats.
enum class TextureDim : uint8_t { Tex2D, Tex2DArray, TexCube, Tex3D, Tex2DMS };
enum class PrimitiveTopology : uint8_t {
  PointList,
  LineList,
  LineStrip,
  TriangleList,
  TriangleStrip,
  LineListAdj,
  LineStripAdj,
  TriangleListAdj,
  TriangleStripAdj
};
enum class Stage : uint8_t { Vertex, Geometry, Pixel, Compute };
inline constexpr uint32_t kStageCount = 4;

// The Src1 factors need a pixel shader that was compiled for them: see kDualSourceMacro in rhi/shader.h.
enum class Blend : uint8_t {
  Zero = 1,
  One,
  SrcColor,
  InvSrcColor,
  SrcAlpha,
  InvSrcAlpha,
  DestAlpha,
  InvDestAlpha,
  DestColor,
  InvDestColor,
  SrcAlphaSat,
  BlendFactor,
  InvBlendFactor,
  Src1Color,
  InvSrc1Color,
  Src1Alpha,
  InvSrc1Alpha
};
enum class BlendOp : uint8_t { Add = 1, Subtract, RevSubtract, Min, Max };
enum class Comparison : uint8_t { Never = 1, Less, Equal, LessEqual, Greater, NotEqual, GreaterEqual, Always };
enum class StencilOp : uint8_t { Keep = 1, Zero, Replace, IncrSat, DecrSat, Invert, Incr, Decr };
enum class FillMode : uint8_t { Wireframe = 2, Solid };
enum class CullMode : uint8_t { None = 1, Front, Back };
enum class Filter : uint8_t { Point, Linear, Anisotropic };
enum class AddressMode : uint8_t { Wrap = 1, Mirror, Clamp, Border };
enum class InputClass : uint8_t { PerVertex, PerInstance };
enum class QueryType : uint8_t {
  Event,
  Occlusion,
  OcclusionPredicate,
  Timestamp,
  TimestampDisjoint,
  PipelineStatistics
};
enum class Severity : uint8_t { Info, Warning, Error, Corruption };
enum class Status : uint8_t {
  Ok,
  InvalidArg,   // the call breaks a rule of this interface; the message says which
  Unsupported,  // the driver lacks it; see Caps
  OutOfMemory,
  CompileFailed,  // the driver refused a shader or program
  DeviceLost,
  StillDrawing,  // GetData: not ready yet
  InternalError,
  SurfaceLost  // the window of a swap chain is gone
};

// ----------------------------------------------------------------------------------------------------- descriptors
struct Rect {
  int32_t left, top, right, bottom;  // D3D10_RECT: pixels, top-left origin, right and bottom exclusive
};
struct Viewport {
  float x = 0, y = 0, width = 0, height = 0;  // pixels, top-left origin
  float minDepth = 0, maxDepth = 1;
};
struct Box {  // texels (buffers: bytes in left/right); right, bottom, back exclusive
  uint32_t left, top, front, right, bottom, back;
};

struct BufferDesc {
  uint32_t byteWidth = 0;  // at least 1; a constant buffer at most kMaxConstantBufferBytes
  Usage usage = Usage::Default;
  Bind bind = Bind::None;
  uint32_t structureStride = 0;  // bytes of one element of a StructuredBuffer, a multiple of 4 that divides byteWidth;
                                 // 0 otherwise. Multiples of 16 read best.
  const char* name = "";
};

struct TextureDesc {
  TextureDim dim = TextureDim::Tex2D;
  uint32_t width = 1, height = 1;
  uint32_t depthOrArray = 1;  // depth of a Tex3D, slices of a Tex2DArray, 6 for a TexCube, else 1
  uint32_t mipLevels = 1;     // 0: the full chain
  uint32_t sampleCount = 1;   // > 1 only with Tex2DMS
  Format format = Format::Unknown;
  Usage usage = Usage::Default;
  Bind bind = Bind::ShaderResource;
  const char* name = "";
};

// Subresource index, as in Direct3D: mip + slice * mipLevels. A Tex3D has one subresource for each mip.
constexpr uint32_t Subresource(uint32_t mip, uint32_t slice, uint32_t mipLevels) { return mip + slice * mipLevels; }

struct SubresourceData {
  const void* data = nullptr;
  uint32_t rowPitch = 0;    // bytes from one row of texels (or blocks) to the next; 0: tightly packed
  uint32_t slicePitch = 0;  // bytes from one depth slice to the next; Tex3D only; 0: rowPitch times the rows
};
struct Mapped {  // D3D10_MAPPED_TEXTURE3D
  void* data = nullptr;
  uint32_t rowPitch = 0, slicePitch = 0;  // bytes; buffers: byteWidth
};

// What part of a resource a view shows, and as what format (same texel size; the sRGB twin, say). Null means all of it.
struct ViewDesc {
  Format format = Format::Unknown;                   // Unknown: the resource's own
  uint32_t firstMip = 0, mipCount = kAllMips;        // targets and u registers: one, which kAllMips means there
  uint32_t firstSlice = 0, sliceCount = kAllSlices;  // array slices, faces; a Tex3D has one slice here
  uint32_t firstElement = 0, elementCount = ~0u;     // structured buffers, in elements
};

struct InputElement {
  const char* semantic = "";  // as written in the HLSL, without the index
  uint32_t semanticIndex = 0;
  Format format = Format::Unknown;
  uint32_t slot = 0, offset = 0;  // vertex buffer slot; byte offset within a vertex
  InputClass inputClass = InputClass::PerVertex;
  uint32_t stepRate = 0;  // PerInstance: instances for each step, at least 1
};

struct RenderTargetBlend {
  bool enable = false;
  Blend src = Blend::One, dest = Blend::Zero;
  BlendOp op = BlendOp::Add;
  Blend srcAlpha = Blend::One, destAlpha = Blend::Zero;
  BlendOp opAlpha = BlendOp::Add;
  uint8_t writeMask = 0xF;  // bit 0 red .. bit 3 alpha
  bool operator==(const RenderTargetBlend&) const = default;
};
struct BlendDesc {
  bool alphaToCoverage = false;  // of target 0's alpha; only with several samples
  bool independent = false;      // false: rt[0] holds for every target
  std::array<RenderTargetBlend, kMaxRenderTargets> rt{};
  bool operator==(const BlendDesc&) const = default;
};
struct StencilFace {
  StencilOp fail = StencilOp::Keep, depthFail = StencilOp::Keep, pass = StencilOp::Keep;
  Comparison func = Comparison::Always;
  bool operator==(const StencilFace&) const = default;
};
struct DepthStencilDesc {
  bool depthEnable = true, depthWrite = true;
  Comparison depthFunc = Comparison::Less;
  bool stencilEnable = false;
  uint8_t readMask = 0xFF, writeMask = 0xFF;  // of the stencil
  StencilFace front, back;
  bool operator==(const DepthStencilDesc&) const = default;
};
struct RasterizerDesc {
  FillMode fill = FillMode::Solid;
  CullMode cull = CullMode::Back;
  bool frontCCW = false;  // Direct3D: clockwise faces are front unless set
  int32_t depthBias = 0;  // in the smallest steps of the depth format near the primitive's greatest depth
  float depthBiasClamp = 0, slopeScaledBias = 0;  // depth; a factor of the depth's slope in a pixel
  bool depthClip = true;                          // false: depth is clamped to the viewport's range
  bool scissor = false;
  // multisample is for Direct3D's shape: samples are used wherever the target has them. antialiasedLine is a wish.
  bool multisample = false, antialiasedLine = false;
  bool operator==(const RasterizerDesc&) const = default;
};
struct SamplerDesc {
  Filter min = Filter::Linear, mag = Filter::Linear, mip = Filter::Linear;  // Anisotropic in any: anisotropic filtering
  AddressMode u = AddressMode::Clamp, v = AddressMode::Clamp, w = AddressMode::Clamp;
  float mipBias = 0;        // mips; clamped to what the driver has
  uint32_t maxAniso = 1;    // 1..16; less where the driver has less
  bool comparison = false;  // for SampleCmp of depth textures
  Comparison func = Comparison::Never;
  std::array<float, 4> border{};    // Vulkan and GL: (0,0,0,0), (0,0,0,1), (1,1,1,1) everywhere; others need the driver
  float minLod = 0, maxLod = 1000;  // mips of the view
  bool operator==(const SamplerDesc&) const = default;
};
struct QueryDesc {
  QueryType type = QueryType::Event;
};

// ----------------------------------------------------------------------------------- results of queries, GPU structs
struct PipelineStatistics {  // D3D10_QUERY_DATA_PIPELINE_STATISTICS and compute; drivers may round vs and ps up
  uint64_t iaVertices, iaPrimitives, vsInvocations, gsInvocations, gsPrimitives, cInvocations, cPrimitives,
      psInvocations, csInvocations;
};
struct TimestampDisjoint {
  uint64_t frequency;  // ticks for each second
  bool disjoint;       // the pair of timestamps cannot be compared
};
struct DrawArgs {  // one DrawInstancedIndirect
  uint32_t vertexCount, instanceCount, startVertex, startInstance;
};
struct DrawIndexedArgs {
  uint32_t indexCount, instanceCount, startIndex;
  int32_t baseVertex;
  uint32_t startInstance;
};
struct DispatchArgs {
  uint32_t x, y, z;  // groups
};

// -------------------------------------------------------------------------------------------------------------- caps
struct Caps {
  Backend backend = Backend::Null;
  std::array<char, 128> adapter{};  // the hardware, as the driver names it
  std::array<char, 128> driver{};   // the driver and its version
  uint32_t apiMajor = 0, apiMinor = 0;
  bool software = false;  // a CPU rasteriser
  // What each is for is said where it is asked for: a Status::Unsupported with CapMissing names the cap.
  bool geometryShader = false, layeredRendering = false, alphaToCoverage = false, independentBlend = false,
       dualSourceBlend = false, wireframe = false, depthClipDisable = false, depthBiasClamp = false,
       instanceStepRate = false, customBorderColor = false;
  bool timestamp = false, pipelineStatistics = false, occlusionPrecise = false, drawIndirect = false, compute = false,
       samplerAnisotropy = false, textureCompressionBC = false, swapChain = false, debugMarkers = false,
       pipelineCacheBlob = false;
  bool bresenhamLines = false;  // lines drawn by the same rule as GL's aliased lines
  // Texels, slices, samples, vertices, scalars of one geometry shader invocation, bytes.
  uint32_t maxTexture2D = 0, maxTexture3D = 0, maxArrayLayers = 0, maxColorSamples = 1, maxGSOutputVertices = 0,
           maxGSOutputComponents = 0, constantBufferAlignment = 256;
  double timestampPeriodNs = 0;  // of one tick
};

// D3D10_FORMAT_SUPPORT. Each says that creation with that use succeeds and that it works; tests/rhi/format_test.cpp
// tries.
enum class FormatSupport : uint32_t {
  None = 0,
  Buffer = 1,        // VertexBuffer or IndexBuffer
  VertexBuffer = 2,  // an InputElement's format
  IndexBuffer = 4,
  Texture2D = 8,  // some texture of it can be made
  Sample = 16,    // Bind::ShaderResource
  SampleLinear = 32,
  RenderTarget = 64,
  Blendable = 128,
  DepthStencil = 256,
  Multisample = 512,  // a target of 4 samples; others: IDevice::CheckMultisample
  Resolve = 1024,
  MipAutogen = 2048,  // IContext::GenerateMips
  UnorderedAccess = 4096
};
constexpr FormatSupport operator|(FormatSupport a, FormatSupport b) { return FormatSupport(uint32_t(a) | uint32_t(b)); }
constexpr bool operator&(FormatSupport a, FormatSupport b) { return (uint32_t(a) & uint32_t(b)) != 0; }

// What a frame cost the RHI. Counted since the last GetStats(true); an indirect draw is one draw.
struct Stats {
  uint64_t draws = 0, dispatches = 0;
  uint64_t pipelineLookups = 0;   // draws whose pipeline key was not the one bound
  uint64_t pipelineMisses = 0;    // pipelines (Vulkan) or programs (GL) made
  uint64_t descriptorMisses = 0;  // descriptor sets written (Vulkan); 0 on GL
  uint64_t ringBytes = 0;         // taken for constants and dynamic data
  uint64_t passes = 0;            // render passes begun (Vulkan) or framebuffers bound (GL)
  uint64_t passBreaks = 0;        // passes ended for another reason than new targets, Flush or EndFrame
  uint64_t barriers = 0;
  uint64_t redundantSets = 0;  // state set to what it was already
};

// --------------------------------------------------------------------------------------------------- format facts
struct FormatInfo {
  const char* name;
  uint8_t blockBytes;  // bytes of one texel, or of one 4x4 block
  uint8_t blockSize;   // 1, or 4 for BC formats
  uint8_t components;
  bool depth, stencil, sRGB, isFloat, isInteger;
};
const FormatInfo& GetFormatInfo(Format);  // any value; out of range gives Unknown's
Format ToSRGB(Format);                    // the _sRGB twin, or the same
Format ToLinear(Format);                  // the UNorm twin, or the same

// Mip levels of a full chain: 1 + floor(log2(max(w, h, d))).
uint32_t FullMipCount(uint32_t width, uint32_t height, uint32_t depth = 1);

const char* ToString(Status);
const char* ToString(Format);
const char* ToString(Backend);
const char* ToString(Severity);
const char* ToString(Stage);
const char* ToString(PrimitiveTopology);

}  // namespace rhi

// Device, context, resources and state objects. See docs/rhi.md for the rules that hold everywhere:
//
//  - Top-left origin, depth 0..1, clockwise front faces, on every backend. Row 0 of a texture is its top.
//  - The context holds a reference on all that is bound; an object may be released while the GPU still uses it.
//  - Constants never end a pass: Map(WriteDiscard) and UpdateConstants take a slice of a growing ring.
//  - Binding a target unbinds its shader views, with a message. What is not bound reads 0.
//  - Errors are a Status and a message to the device's sink. Setters do not fail: a wrong argument is reported once and
//    the call ignored. Draws with an unusable state are reported and skipped.
//  - Everything runs on one thread at a time for each device; two devices are independent.
#pragma once

#include "rhi/messages.h"
#include "rhi/ref.h"
#include "rhi/shader.h"
#include "rhi/types.h"

namespace rhi {

class IDevice;

// --------------------------------------------------------------------------------------------------------- objects
class IObject {
 public:
  virtual uint32_t AddRef() noexcept = 0;
  // The last Release defers the destruction until the GPU has passed the work recorded so far.
  virtual uint32_t Release() noexcept = 0;
  // Shown in messages and, where the driver has debug markers, in captures.
  virtual void SetName(const char*) = 0;

 protected:
  virtual ~IObject() = default;
};

class IResource : public IObject {
 public:
  virtual Usage GetUsage() const = 0;
};
class IBuffer : public IResource {
 public:
  virtual const BufferDesc& Desc() const = 0;
};
class ITexture : public IResource {
 public:
  virtual const TextureDesc& Desc() const = 0;  // mipLevels is the actual number
};
class IView : public IObject {
 public:
  virtual IResource* Resource() const = 0;
  virtual const ViewDesc& Desc() const = 0;  // resolved: no Unknown, no kAllMips
};
class IShaderResourceView : public IView {};
class IRenderTargetView : public IView {};
class IDepthStencilView : public IView {};
class IUnorderedAccessView : public IView {};
class IShader : public IObject {
 public:
  virtual Stage GetStage() const = 0;
};
class IInputLayout : public IObject {};
// State objects are interned: equal descriptors give the same object, as in Direct3D 10.
class IBlendState : public IObject {
 public:
  virtual const BlendDesc& Desc() const = 0;
};
class IDepthStencilState : public IObject {
 public:
  virtual const DepthStencilDesc& Desc() const = 0;
};
class IRasterizerState : public IObject {
 public:
  virtual const RasterizerDesc& Desc() const = 0;
};
class ISamplerState : public IObject {
 public:
  virtual const SamplerDesc& Desc() const = 0;
};
class IQuery : public IObject {
 public:
  virtual QueryType Type() const = 0;
};

// --------------------------------------------------------------------------------------------------------- context
// The one immediate context (ID3D10Device's drawing half). Null pointers unbind. What each call becomes is said as
// "D3D10 / Vulkan / GL" where the three differ in name or in kind.
//
// Errors of setters: a slot range beyond the limits (SlotOutOfRange), a shader of another stage (WrongStage), an index
// format that is none (FormatMismatch); the call is then ignored. Setting what is set already costs a comparison and is
// counted (Stats::redundantSets).
class IContext {
 public:
  // ---- Input assembler: IA* / vertex input state and topology of the pipeline key, vkCmdBindVertexBuffers2,
  // vkCmdBindIndexBuffer / one vertex array object for each layout, glVertexArrayVertexBuffer,
  // glVertexArrayElementBuffer.
  virtual void IASetInputLayout(IInputLayout*) = 0;
  virtual void IASetPrimitiveTopology(PrimitiveTopology) = 0;
  virtual void IASetVertexBuffers(uint32_t firstSlot, uint32_t count, IBuffer* const* buffers, const uint32_t* strides,
                                  const uint32_t* offsets) = 0;          // strides and offsets in bytes
  virtual void IASetIndexBuffer(IBuffer*, Format, uint32_t offset) = 0;  // R16_UInt or R32_UInt; offset in bytes
                                                                         // strips are cut at 0xFFFF or 0xFFFFFFFF
  // ---- Shaders and their registers: VSSetShader and kin / pipeline key, descriptor sets (rhi/shader.h) / one linked
  // program for each combination, texture units, sampler objects, uniform and storage blocks.
  virtual void SetShader(Stage, IShader*) = 0;
  virtual void SetConstantBuffers(uint32_t first, uint32_t count, IBuffer* const*) = 0;  // shared by all stages
  virtual void SetShaderResources(Stage, uint32_t first, uint32_t count, IShaderResourceView* const*) = 0;
  virtual void SetSamplers(Stage, uint32_t first, uint32_t count, ISamplerState* const*) = 0;
  virtual void CSSetUnorderedAccessViews(uint32_t first, uint32_t count, IUnorderedAccessView* const*) = 0;

  void VSSetShader(IShader* s) { SetShader(Stage::Vertex, s); }
  void GSSetShader(IShader* s) { SetShader(Stage::Geometry, s); }
  void PSSetShader(IShader* s) { SetShader(Stage::Pixel, s); }
  void CSSetShader(IShader* s) { SetShader(Stage::Compute, s); }
  void VSSetShaderResources(uint32_t f, uint32_t n, IShaderResourceView* const* v) {
    SetShaderResources(Stage::Vertex, f, n, v);
  }
  void GSSetShaderResources(uint32_t f, uint32_t n, IShaderResourceView* const* v) {
    SetShaderResources(Stage::Geometry, f, n, v);
  }
  void PSSetShaderResources(uint32_t f, uint32_t n, IShaderResourceView* const* v) {
    SetShaderResources(Stage::Pixel, f, n, v);
  }
  void CSSetShaderResources(uint32_t f, uint32_t n, IShaderResourceView* const* v) {
    SetShaderResources(Stage::Compute, f, n, v);
  }
  void VSSetSamplers(uint32_t f, uint32_t n, ISamplerState* const* s) { SetSamplers(Stage::Vertex, f, n, s); }
  void GSSetSamplers(uint32_t f, uint32_t n, ISamplerState* const* s) { SetSamplers(Stage::Geometry, f, n, s); }
  void PSSetSamplers(uint32_t f, uint32_t n, ISamplerState* const* s) { SetSamplers(Stage::Pixel, f, n, s); }
  void CSSetSamplers(uint32_t f, uint32_t n, ISamplerState* const* s) { SetSamplers(Stage::Compute, f, n, s); }

  // ---- Rasterizer: RS* / pipeline key and dynamic state, a viewport of negative height / glPolygonMode, glCullFace,
  // glFrontFace, glPolygonOffsetClamp, glViewportIndexedf. Null state: the defaults of RasterizerDesc. Pixels.
  virtual void RSSetState(IRasterizerState*) = 0;
  virtual void RSSetViewports(uint32_t count, const Viewport*) = 0;
  virtual void RSSetScissorRects(uint32_t count, const Rect*) = 0;  // used only where RasterizerDesc::scissor is set

  // ---- Output merger: OM* / pipeline key, vkCmdSetBlendConstants, vkCmdSetStencilReference, dynamic rendering begun
  // at the first draw / glBlendFuncSeparatei, glDepthFunc, glStencilFuncSeparate, framebuffer objects. Null states: the
  // defaults of their descriptors; null factor: (1,1,1,1).
  virtual void OMSetBlendState(IBlendState*, const float factor[4] = nullptr, uint32_t sampleMask = ~0u) = 0;
  virtual void OMSetDepthStencilState(IDepthStencilState*, uint32_t stencilRef = 0) = 0;
  // Does not change viewports or scissors, as in Direct3D 10. All targets of one size and sample count.
  virtual void OMSetRenderTargets(uint32_t count, IRenderTargetView* const*, IDepthStencilView*) = 0;
  // Clears the whole view: viewport, scissor and write masks do not matter. ClearRenderTargetView / the pass's load op,
  // or a pass of its own / glClearNamedFramebufferfv. Depth 0..1.
  virtual void ClearRenderTargetView(IRenderTargetView*, const float rgba[4]) = 0;  // linear values for sRGB views
  virtual void ClearDepthStencilView(IDepthStencilView*, bool clearDepth, float depth, bool clearStencil,
                                     uint8_t stencil) = 0;
  virtual void ClearState() = 0;

  // ---- Data. Map: ID3D10Buffer::Map, ID3D10Texture2D::Map / persistently mapped memory / the same. Dynamic buffers:
  // WriteDiscard, WriteNoOverwrite; staging: Read (waits for the GPU), Write. Others: InvalidArg and MsgCode::MapMode
  // (Immutable: ImmutableWrite); mapped already: MapTwice; a subresource that is not there: SubresourceOutOfRange. Unmap
  // of what is not mapped: MapMode.
  virtual Status Map(IResource*, uint32_t subresource, MapMode, Mapped*) = 0;
  virtual void Unmap(IResource*, uint32_t subresource) = 0;
  // WriteDiscard in one call for a dynamic constant buffer; `size` <= byteWidth bytes, the rest is undefined. Never
  // ends a pass. The buffer need not be bound again. Map + memcpy + Unmap / a slice of the ring and a dynamic offset /
  // a slice of the ring and glBindBufferRange.
  virtual void UpdateConstants(IBuffer*, const void* data, uint32_t size) = 0;
  // Default usage only (Immutable: ImmutableWrite, others: MapMode). Buffers: box in bytes, null for all. Ends a pass.
  // UpdateSubresource / a staging slice and vkCmdCopyBuffer(ToImage) / glNamedBufferSubData, glTextureSubImage*.
  virtual void UpdateSubresource(IResource*, uint32_t subresource, const Box*, const void* data, uint32_t rowPitch,
                                 uint32_t slicePitch) = 0;
  // Whole resources of the same size and format (or sRGB twins; else FormatMismatch), and boxes of them (OutOfBounds);
  // overlapping boxes of one subresource are refused (OutOfBounds). The destination is Default or Staging (Immutable:
  // ImmutableWrite, Dynamic: MapMode). Copy* / vkCmdCopyBuffer, vkCmdCopyImage / glCopyNamedBufferSubData, glCopyImageSubData.
  // Ends a pass.
  virtual void CopyResource(IResource* dst, IResource* src) = 0;
  virtual void CopySubresourceRegion(IResource* dst, uint32_t dstSubresource, uint32_t x, uint32_t y, uint32_t z,
                                     IResource* src, uint32_t srcSubresource, const Box*) = 0;
  // Averages the samples. ResolveSubresource / vkCmdResolveImage / glBlitNamedFramebuffer.
  virtual void ResolveSubresource(ITexture* dst, uint32_t dstSubresource, ITexture* src, uint32_t srcSubresource,
                                  Format) = 0;
  // Box-filters the view's first mip into its further ones, for every slice. The texture needs RenderTarget and
  // ShaderResource, as in Direct3D 10.
  virtual void GenerateMips(IShaderResourceView*) = 0;

  // ---- Work: Draw* / vkCmdDraw* / glDraw*BaseVertexBaseInstance. Counts in vertices, indices, instances, groups.
  // SV_VertexID and SV_InstanceID count from 0 whatever the start, as in Direct3D 10. A draw whose state cannot be used
  // (NoVertexShader, NoTarget, IndexBufferMissing, ...) is reported and skipped. Indirect: Direct3D 11's, byte offsets,
  // multiples of 4.
  virtual void Draw(uint32_t vertexCount, uint32_t startVertex) = 0;
  virtual void DrawIndexed(uint32_t indexCount, uint32_t startIndex, int32_t baseVertex) = 0;
  virtual void DrawInstanced(uint32_t vertexCountPerInstance, uint32_t instanceCount, uint32_t startVertex,
                             uint32_t startInstance) = 0;
  virtual void DrawIndexedInstanced(uint32_t indexCountPerInstance, uint32_t instanceCount, uint32_t startIndex,
                                    int32_t baseVertex, uint32_t startInstance) = 0;
  virtual void DrawInstancedIndirect(IBuffer* args, uint32_t offset) = 0;         // DrawArgs
  virtual void DrawIndexedInstancedIndirect(IBuffer* args, uint32_t offset) = 0;  // DrawIndexedArgs
  virtual void Dispatch(uint32_t x, uint32_t y, uint32_t z) = 0;
  virtual void DispatchIndirect(IBuffer* args, uint32_t offset) = 0;  // DispatchArgs

  // ---- Queries: ID3D10Asynchronous / query pools, timeline semaphore / query objects, fences. Event and Timestamp
  // take only End. GetData: Ok and the value, or StillDrawing; `flush` submits first. Sizes: Event bool, Occlusion
  // uint64_t (samples), OcclusionPredicate bool, Timestamp uint64_t (ticks), TimestampDisjoint and PipelineStatistics
  // their structs.
  virtual void Begin(IQuery*) = 0;
  virtual void End(IQuery*) = 0;
  virtual Status GetData(IQuery*, void* data, uint32_t size, bool flush) = 0;

  // Debug markers: D3DPERF_BeginEvent / vkCmdBeginDebugUtilsLabelEXT / glPushDebugGroup.
  virtual void BeginEvent(const char* name) = 0;
  virtual void EndEvent() = 0;

  // Submits what is recorded: Flush / vkQueueSubmit2 / glFlush. EndFrame also rotates the ring and retires what the GPU
  // has finished with; it waits when framesInFlight frames are still under way.
  virtual void Flush() = 0;
  virtual void EndFrame() = 0;
  virtual IDevice* Device() = 0;

 protected:
  ~IContext() = default;
};

// ---------------------------------------------------------------------------------------------- device, swap chain
struct SwapChainDesc {
  void* nativeWindow = nullptr;         // an X11 Window, as an integer; what GLFW gives with GLFW_NO_API
  uint32_t width = 0, height = 0;       // of the back buffer; Present scales it to the window where they differ
  uint32_t bufferCount = 2;             // images on the way to the screen, at least; a driver may take more
  Format format = Format::BGRA8_UNorm;  // RGBA8 or BGRA8, also _sRGB; R10G10B10A2_UNorm; RGBA16_Float
  bool vsync = true;
};
// Release it before its window is destroyed; its last Release waits for the GPU.
class ISwapChain : public IObject {
 public:
  // An ordinary texture with Bind::RenderTarget and ShaderResource, the same one until Resize; Present keeps its
  // contents.
  virtual ITexture* BackBuffer() = 0;
  // Submits what is recorded and shows the back buffer; EndFrame remains the caller's, before it or after. A window
  // that changed its size is followed. SurfaceLost: the window is gone.
  virtual Status Present() = 0;
  // Makes a back buffer of the new size, without contents; unbind the old one. 0: minimised; the back buffer stays and
  // Present does nothing until the next Resize.
  virtual Status Resize(uint32_t width, uint32_t height) = 0;
};

struct DeviceDesc {
  // Null: headless (no display server is touched; no swap chain). Else the X11 Display*, for swap chains. It must be
  // said here because a surfaceless EGL display cannot present, and Vulkan's surface extensions belong to the instance.
  // It must outlive the device and its swap chains.
  void* nativeDisplay = nullptr;
  bool apiValidation = false;   // Vulkan's validation layer, GL's debug context
  bool syncValidation = false;  // Vulkan, with apiValidation
  const char* adapter = "";     // part of an adapter's name; "": the first hardware adapter, else software
  bool preferSoftware = false;  // with adapter "": a CPU rasteriser first
  IMessageSink* sink = nullptr;
  const void* pipelineCache = nullptr;  // a blob of GetPipelineCacheBlob
  size_t pipelineCacheSize = 0;
  uint32_t framesInFlight = 2;
  uint32_t ringPageBytes = 1u << 20;
};

struct PipelineKeyDesc {
  IShader *vs = nullptr, *gs = nullptr, *ps = nullptr;
  IInputLayout* layout = nullptr;
  IBlendState* blend = nullptr;
  IDepthStencilState* depth = nullptr;
  IRasterizerState* raster = nullptr;
  PrimitiveTopology topology = PrimitiveTopology::TriangleList;
  std::array<Format, kMaxRenderTargets> rtv{};
  uint32_t rtvCount = 0;
  Format dsv = Format::Unknown;
  uint32_t samples = 1;
};

// ID3D10Device's creating half. Statuses: InvalidArg (the descriptor breaks a rule), Unsupported (the adapter lacks it;
// CapMissing names the cap), OutOfMemory, CompileFailed (the driver refused a shader), DeviceLost (from then on).
class IDevice : public IObject {
 public:
  virtual const Caps& GetCaps() const = 0;
  virtual FormatSupport CheckFormatSupport(Format) const = 0;
  // Levels of quality of `samples` samples: 0 (not supported) or 1. ID3D10Device::CheckMultisampleQualityLevels.
  virtual uint32_t CheckMultisample(Format, uint32_t samples) const = 0;

  // Creation. On failure the out parameter is left null and a message says why. `init`: byteWidth bytes, or one
  // SubresourceData for each subresource; Immutable needs it.
  virtual Status CreateBuffer(const BufferDesc&, const void* init, Ref<IBuffer>*) = 0;
  virtual Status CreateTexture(const TextureDesc&, const SubresourceData* init, Ref<ITexture>*) = 0;
  virtual Status CreateShaderResourceView(IResource*, const ViewDesc*, Ref<IShaderResourceView>*) = 0;
  virtual Status CreateRenderTargetView(ITexture*, const ViewDesc*, Ref<IRenderTargetView>*) = 0;
  virtual Status CreateDepthStencilView(ITexture*, const ViewDesc*, Ref<IDepthStencilView>*) = 0;
  virtual Status CreateUnorderedAccessView(IResource*, const ViewDesc*, Ref<IUnorderedAccessView>*) = 0;
  virtual Status CreateShader(const ShaderBlob&, Ref<IShader>*) = 0;
  // Matches the elements to the shader's inputs by semantic; an input without an element is an error.
  virtual Status CreateInputLayout(const InputElement*, uint32_t count, IShader* vs, Ref<IInputLayout>*) = 0;
  virtual Status CreateBlendState(const BlendDesc&, Ref<IBlendState>*) = 0;
  virtual Status CreateDepthStencilState(const DepthStencilDesc&, Ref<IDepthStencilState>*) = 0;
  virtual Status CreateRasterizerState(const RasterizerDesc&, Ref<IRasterizerState>*) = 0;
  virtual Status CreateSamplerState(const SamplerDesc&, Ref<ISamplerState>*) = 0;
  virtual Status CreateQuery(const QueryDesc&, Ref<IQuery>*) = 0;
  virtual Status CreateSwapChain(const SwapChainDesc&, Ref<ISwapChain>*) = 0;

  virtual Status PrecachePipeline(const PipelineKeyDesc&) = 0;  // makes a pipeline before its first draw
  // The size of the blob; copies it if `capacity` suffices. 0 where the driver has none (Caps::pipelineCacheBlob).
  virtual size_t GetPipelineCacheBlob(void* out, size_t capacity) = 0;

  virtual IContext* ImmediateContext() = 0;
  // Blocking helper: one subresource, tightly packed unless rowPitch is given. Not for multisampled textures.
  virtual Status ReadBack(ITexture*, uint32_t subresource, void* out, size_t capacity, uint32_t rowPitch = 0) = 0;
  virtual Status ReadBack(IBuffer*, uint32_t offset, uint32_t size, void* out) = 0;
  virtual Status WaitIdle() = 0;  // submits and waits for the GPU
  virtual Stats GetStats(bool reset) = 0;
};

}  // namespace rhi

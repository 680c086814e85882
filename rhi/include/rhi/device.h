// Device, context, resources and state objects. See docs/rhi.md for the rules that hold everywhere:
//
//  - Top-left origin, depth 0..1, clockwise front faces, on every backend. Row 0 of a texture is its top.
//  - The context holds a reference on all that is bound; an object may be released while the GPU still uses it.
//  - Constants never end a pass: Map(WriteDiscard) and UpdateConstants take a slice of a growing ring.
//  - Binding a target unbinds its shader views, with a message. What is not bound reads 0.
//  - Errors are a Status and a message to the device's sink. What returns nothing reports (Severity::Error unless said
//    otherwise) and ignores the call; draws with an unusable state are reported, once a frame, and skipped:
//    looked at in the order indirect arguments, shader, layout and topology, targets, viewport, index buffer.
//    That there is no memory is said once a frame, too, where there is no status to say it.
//  - Arrays of `count` entries may have null entries, which unbind; the array itself is null only where count is 0.
//    An out parameter is never null. Objects belong to the device that made them; only rhi/validation.h looks
//    (ForeignObject), and it alone checks bind flags of buffers that are bound (WrongBindFlag).
//  - Everything runs on one thread at a time for each device; two devices are independent.
//
// Comments say what a call is in "Direct3D 10 / Vulkan / GL".
#pragma once

#include "rhi/messages.h"
#include "rhi/ref.h"
#include "rhi/shader.h"
#include "rhi/types.h"

namespace rhi {

class IDevice;

// --------------------------------------------------------------------------------------------------------- objects
class IObject {  // IUnknown, without QueryInterface
 public:
  virtual uint32_t AddRef() noexcept = 0;  // both give the new count, for tests
  // The last Release defers the destruction until the GPU has passed the work recorded so far: a list of what to
  // destroy after a fence. Objects may outlive their device; they can then only be released.
  virtual uint32_t Release() noexcept = 0;
  // Shown in messages and, where the driver has debug markers, in captures: SetPrivateData(WKPDID_D3DDebugObjectName) /
  // vkSetDebugUtilsObjectNameEXT / glObjectLabel. Copied; null is "".
  virtual void SetName(const char*) = 0;

 protected:
  virtual ~IObject() = default;
};

class IResource : public IObject {  // ID3D10Resource: a VkBuffer or VkImage, a buffer or texture object
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
// ID3D10View / VkImageView, or a range of a buffer / a glTextureView where it shows less than all, or a range. Holds
// its resource.
class IView : public IObject {
 public:
  virtual IResource* Resource() const = 0;
  virtual const ViewDesc& Desc() const = 0;  // resolved: no Unknown, no kAllMips
};
class IShaderResourceView : public IView {};
class IRenderTargetView : public IView {};
class IDepthStencilView : public IView {};
class IUnorderedAccessView : public IView {};
class IShader : public IObject {  // ID3D10VertexShader and kin / VkShaderModule / shader object
 public:
  virtual Stage GetStage() const = 0;
};
class IInputLayout : public IObject {};  // ID3D10InputLayout / part of the pipeline key / vertex array object
// State objects are interned: equal descriptors give the same object for as long as somebody holds it, as in
// Direct3D 10. ID3D10BlendState and kin / part of the pipeline key, or dynamic state / values that are set where they
// differ; a sampler is a VkSampler and a sampler object.
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
class IQuery : public IObject {  // ID3D10Query / slots of query pools / query objects, a fence
 public:
  virtual QueryType Type() const = 0;
};

// --------------------------------------------------------------------------------------------------------- context
// The one immediate context (ID3D10Device's drawing half). Null pointers unbind.
//
// Errors of setters: a slot range beyond the limits (SlotOutOfRange), a shader of another stage (WrongStage), an index
// format that is none (FormatMismatch). Setting what is set already costs a comparison and is counted
// (Stats::redundantSets).
class IContext {
 public:
  // ---- Input assembler: IA* / vertex input state and topology of the pipeline key, vkCmdBindVertexBuffers2,
  // vkCmdBindIndexBuffer / one vertex array object for each layout, glVertexArrayVertexBuffer,
  // glVertexArrayElementBuffer. What lies beyond the end of a vertex or index buffer reads 0, as does an unbound slot.
  virtual void IASetInputLayout(IInputLayout*) = 0;            // null: for vertex shaders without inputs
  virtual void IASetPrimitiveTopology(PrimitiveTopology) = 0;  // at first TriangleList; D3D10: undefined
  virtual void IASetVertexBuffers(uint32_t firstSlot, uint32_t count, IBuffer* const* buffers, const uint32_t* strides,
                                  const uint32_t* offsets) = 0;  // strides and offsets in bytes
  // R16_UInt or R32_UInt; offset in bytes, a multiple of the index size (Vulkan: OutOfBounds at the draw). Strips are
  // cut at 0xFFFF or 0xFFFFFFFF, before the base vertex is added; lists are not.
  virtual void IASetIndexBuffer(IBuffer*, Format, uint32_t offset) = 0;

  // ---- Shaders and their registers: VSSetShader and kin / pipeline key, descriptor sets (rhi/shader.h) / one linked
  // program for each combination, texture units, sampler objects, uniform and storage blocks.
  // A register with nothing bound reads 0, with a Warning at the draw (NothingBound); so do constants and elements
  // beyond the end of what is bound. No sampler: the default SamplerDesc. A view of another kind, dimension or type of
  // texels (integer or not) than the shader declares: ViewMismatch, and it reads 0, as if nothing were bound.
  virtual void SetShader(Stage, IShader*) = 0;
  virtual void SetConstantBuffers(uint32_t first, uint32_t count, IBuffer* const*) = 0;  // shared by all stages
  // What is bound as a target cannot be bound here, too: the slot becomes null, with a Warning
  // (InputStillBoundAsTarget).
  virtual void SetShaderResources(Stage, uint32_t first, uint32_t count, IShaderResourceView* const*) = 0;
  virtual void SetSamplers(Stage, uint32_t first, uint32_t count, ISamplerState* const*) = 0;
  // Direct3D 11's. Unbinds the t registers that show the same subresources (Warning TargetStillBoundAsInput). The other
  // way round nothing is unbound: what one dispatch reads and writes by both is undefined. Later dispatches, draws and
  // copies see what was written: a barrier of the resource's state / glMemoryBarrier.
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
  // glFrontFace, glPolygonOffsetClamp, glViewportArrayv, glScissorArrayv. Pixels, from the top left. Each call replaces
  // all; a geometry shader picks one by SV_ViewportArrayIndex. None set: nothing is drawn.
  virtual void RSSetState(IRasterizerState*) = 0;  // null: the defaults of RasterizerDesc
  virtual void RSSetViewports(uint32_t count, const Viewport*) = 0;
  virtual void RSSetScissorRects(uint32_t count, const Rect*) = 0;  // used only where RasterizerDesc::scissor is set;
                                                                    // those not set are empty
  // ---- Output merger: OM* / pipeline key, vkCmdSetBlendConstants, vkCmdSetStencilReference, dynamic rendering begun
  // at the first draw / glBlendFuncSeparatei, glDepthFunc, glStencilFuncSeparate, framebuffer objects. Null states: the
  // defaults of their descriptors; null factor: (1,1,1,1). Bit i of sampleMask is sample i; targets of one sample have
  // one, too. stencilRef: the lowest 8 bits.
  virtual void OMSetBlendState(IBlendState*, const float factor[4] = nullptr, uint32_t sampleMask = ~0u) = 0;
  virtual void OMSetDepthStencilState(IDepthStencilState*, uint32_t stencilRef = 0) = 0;
  // Unbinds the shader views of the same subresources, with a Warning (TargetStillBoundAsInput). Does not change
  // viewports or scissors, as in Direct3D 10. All targets of one size and sample count, else the draw is skipped
  // (TargetsDiffer). Of targets with several slices SV_RenderTargetArrayIndex picks one; without it the first.
  virtual void OMSetRenderTargets(uint32_t count, IRenderTargetView* const*, IDepthStencilView*) = 0;
  // Clears the whole view, all its slices: viewport, scissor, tests and write masks do not matter. Null: InvalidDesc.
  // ClearRenderTargetView, ClearDepthStencilView / the pass's load op, vkCmdClearAttachments within a pass, or a pass
  // of its own / glClearNamedFramebufferfv. rgba: linear values for sRGB views; integers are truncated. Depth 0..1.
  virtual void ClearRenderTargetView(IRenderTargetView*, const float rgba[4]) = 0;
  virtual void ClearDepthStencilView(IDepthStencilView*, bool clearDepth, float depth, bool clearStencil,
                                     uint8_t stencil) = 0;  // stencil is ignored where the format has none
  virtual void ClearState() = 0;  // unbinds all; the defaults named here. D3D10's / dirty bits / dirty bits

  // ---- Data. Map: ID3D10Buffer::Map, ID3D10Texture2D::Map / persistently mapped memory / the same. Dynamic buffers:
  // WriteDiscard (contents undefined), WriteNoOverwrite (not for constant buffers); staging: Read and Write (both keep
  // the contents and wait for the GPU's copies). Else InvalidArg and MapMode, or ImmutableWrite; mapped already:
  // MapTwice; a subresource that is not there: SubresourceOutOfRange (buffers: `subresource` is 0). OutOfMemory: no
  // more ring. *Mapped is valid until Unmap; unmap before the GPU uses it. Pitches in bytes; a buffer's are its
  // byteWidth. Unmap of what is not mapped: MapMode.
  virtual Status Map(IResource*, uint32_t subresource, MapMode, Mapped*) = 0;
  virtual void Unmap(IResource*, uint32_t subresource) = 0;
  // WriteDiscard in one call for a dynamic constant buffer (others: MapMode; null: NothingBound); `size` <= byteWidth
  // bytes (OutOfBounds), the rest is undefined. Never ends a pass. The buffer need not be bound again. Map + memcpy +
  // Unmap / a slice of the ring and a dynamic offset / a slice of the ring and glBindBufferRange.
  virtual void UpdateConstants(IBuffer*, const void* data, uint32_t size) = 0;
  // Default usage only (Immutable: ImmutableWrite, others: MapMode), neither depth nor samples. Buffers: left and right
  // of the box in bytes. Null box: all. Pitches in bytes, of the caller's rows (of blocks) and depth slices; 0: tightly
  // packed. A box beyond the subresource, or one that cuts 4x4 blocks: OutOfBounds. `data` is read before the call
  // returns. Ends a pass. UpdateSubresource / a staging slice and vkCmdCopyBuffer(ToImage) / glNamedBufferSubData,
  // glTextureSubImage*.
  virtual void UpdateSubresource(IResource*, uint32_t subresource, const Box*, const void* data, uint32_t rowPitch,
                                 uint32_t slicePitch) = 0;
  // Two buffers, or two textures of one format (or sRGB twins) and sample count (FormatMismatch), to Default or Staging
  // (ImmutableWrite, MapMode). CopyResource: everything, sizes and mips equal (FormatMismatch). CopySubresourceRegion:
  // a box of the source (null: all) to x, y, z of the destination, in texels, whole 4x4 blocks of BC formats; buffers:
  // bytes, in x and the box's left and right. Slices of arrays, faces of cubes and depth slices of volumes may be
  // mixed. Beyond an edge, right before left, or onto itself (one subresource of a texture, overlapping bytes of a
  // buffer): OutOfBounds; no such subresource: SubresourceOutOfRange. Empty boxes, here and above: nothing happens.
  // Ends a pass. Copy* / vkCmdCopyBuffer, vkCmdCopyImage / glCopyNamedBufferSubData, glCopyImageSubData; staging
  // textures are buffers there.
  virtual void CopyResource(IResource* dst, IResource* src) = 0;
  virtual void CopySubresourceRegion(IResource* dst, uint32_t dstSubresource, uint32_t x, uint32_t y, uint32_t z,
                                     IResource* src, uint32_t srcSubresource, const Box*) = 0;
  // Averages the samples, as linear light for sRGB. Source multisampled, destination not, both of one size and of the
  // colour format that is named, else FormatMismatch. Ends a pass. ResolveSubresource / vkCmdResolveImage /
  // glBlitNamedFramebuffer.
  virtual void ResolveSubresource(ITexture* dst, uint32_t dstSubresource, ITexture* src, uint32_t srcSubresource,
                                  Format) = 0;
  // Each further mip of the view from the one above it, for every slice (and between depth slices), as linear light for
  // sRGB: the box filter where sizes are even, a linear filter at the texel's centre where they are odd. The texture
  // needs RenderTarget and ShaderResource, as in Direct3D 10 (WrongBindFlag), and one sample; the view's format is the
  // texture's own (FormatMismatch) and has FormatSupport::MipAutogen (CapMissing). Ends a pass. GenerateMips /
  // vkCmdBlitImage / glBlitNamedFramebuffer, glGenerateTextureMipmap for 3D.
  virtual void GenerateMips(IShaderResourceView*) = 0;

  // ---- Work: Draw* / vkCmdDraw* / glDraw*BaseVertexBaseInstance. Counts in vertices, indices, instances, groups; 0
  // does nothing. SV_VertexID and SV_InstanceID count from 0 whatever the start, as in Direct3D 10; of an indexed draw
  // SV_VertexID is the index, without the base. Skipped with a message: NoVertexShader, NoTarget, TargetsDiffer,
  // LayoutMismatch (none, or an input is missing), TopologyMismatch (the geometry shader takes another),
  // IndexBufferMissing, NothingBound (no viewport; no compute shader), ShaderRejected (the driver links or makes no
  // pipeline of it). No pixel shader: depth only. Indirect: Direct3D 11's; bytes, multiples of 4, within a buffer of
  // Bind::IndirectArgs (WrongBindFlag or OutOfBounds). At most 65535 groups in each dimension (OutOfBounds).
  virtual void Draw(uint32_t vertexCount, uint32_t startVertex) = 0;
  virtual void DrawIndexed(uint32_t indexCount, uint32_t startIndex, int32_t baseVertex) = 0;
  virtual void DrawInstanced(uint32_t vertexCountPerInstance, uint32_t instanceCount, uint32_t startVertex,
                             uint32_t startInstance) = 0;
  virtual void DrawIndexedInstanced(uint32_t indexCountPerInstance, uint32_t instanceCount, uint32_t startIndex,
                                    int32_t baseVertex, uint32_t startInstance) = 0;
  virtual void DrawInstancedIndirect(IBuffer* args, uint32_t offset) = 0;         // DrawArgs
  virtual void DrawIndexedInstancedIndirect(IBuffer* args, uint32_t offset) = 0;  // DrawIndexedArgs
  virtual void Dispatch(uint32_t x, uint32_t y, uint32_t z) = 0;      // vkCmdDispatch / glDispatchCompute; ends a pass
  virtual void DispatchIndirect(IBuffer* args, uint32_t offset) = 0;  // DispatchArgs

  // ---- Queries: ID3D10Asynchronous / query pools, timeline semaphore / query objects, fences. Event and Timestamp
  // take only End. Queries of a kind may nest and overlap. QueryOrder: no query, Begin twice, End without Begin,
  // GetData before End. GetData: Ok and the value, StillDrawing (try again), or DeviceLost; `flush` submits first,
  // without it a result may never come. Null data: only asks. `size` is the result's, else InvalidArg and OutOfBounds:
  // Event bool, Occlusion uint64_t (samples), OcclusionPredicate bool, Timestamp uint64_t (ticks, see
  // TimestampDisjoint), TimestampDisjoint and PipelineStatistics their structs. Begin forgets the last result.
  virtual void Begin(IQuery*) = 0;
  virtual void End(IQuery*) = 0;
  virtual Status GetData(IQuery*, void* data, uint32_t size, bool flush) = 0;

  // Debug markers: D3DPERF_BeginEvent / vkCmdBeginDebugUtilsLabelEXT / glPushDebugGroup. They nest, also over passes
  // and frames. The name is copied, and not null. Without Caps::debugMarkers they do nothing. EndEvent alone is
  // ignored.
  virtual void BeginEvent(const char* name) = 0;
  virtual void EndEvent() = 0;

  // Submits what is recorded: Flush / vkQueueSubmit2 / glFlush. EndFrame (Present's other half in Direct3D) also
  // rotates the ring and retires what the GPU has finished with; it waits when framesInFlight frames are still under
  // way (timeline semaphore / fence). A lost device: DeviceLost as a message here, and as a Status from then on.
  virtual void Flush() = 0;
  virtual void EndFrame() = 0;
  virtual IDevice* Device() = 0;  // without a new count

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
// IDXGISwapChain / VkSwapchainKHR / EGL window surface. Release it before its window is destroyed; its last Release
// waits for the GPU.
class ISwapChain : public IObject {
 public:
  // An ordinary texture with Bind::RenderTarget and ShaderResource, the same one until Resize, without a new count;
  // Present keeps its contents. GetBuffer(0).
  virtual ITexture* BackBuffer() = 0;
  // Submits what is recorded and shows the back buffer; EndFrame remains the caller's, before it or after. A window
  // that changed its size is followed. SurfaceLost (also as a message): the window is gone. DeviceLost.
  // IDXGISwapChain::Present / vkCmdBlitImage and vkQueuePresentKHR / a blit that turns it over and eglSwapBuffers.
  virtual Status Present() = 0;
  // Makes a back buffer of the new size in pixels, without contents; unbind the old one. 0: minimised; the back buffer
  // stays and Present does nothing until the next Resize. Statuses of CreateTexture. ResizeBuffers.
  virtual Status Resize(uint32_t width, uint32_t height) = 0;
};

struct DeviceDesc {
  // Null: headless (no display server is touched; no swap chain). Else the X11 Display*, for swap chains. It must be
  // said here because a surfaceless EGL display cannot present, and Vulkan's surface extensions belong to the instance.
  // It must outlive the device and its swap chains.
  void* nativeDisplay = nullptr;
  bool apiValidation = false;           // Vulkan's validation layer, GL's debug context
  bool syncValidation = false;          // Vulkan, with apiValidation
  const char* adapter = "";             // part of an adapter's name; "": the first hardware adapter, else software
  bool preferSoftware = false;          // with adapter "": a CPU rasteriser first
  IMessageSink* sink = nullptr;         // null: messages are dropped. Must outlive the device
  const void* pipelineCache = nullptr;  // a blob of GetPipelineCacheBlob; one that does not fit is said
  size_t pipelineCacheSize = 0;
  uint32_t framesInFlight = 2;        // that EndFrame lets the CPU be ahead of the GPU; at least 1
  uint32_t ringPageBytes = 1u << 20;  // of constants and dynamic data; the ring grows by pages
};

// What a draw will be set to. Only what the backend compiles matters: Vulkan looks at all but `depth`, GL at the
// shaders.
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

// ID3D10Device's creating half. Statuses: InvalidArg (the descriptor breaks a rule: InvalidDesc, WrongBindFlag,
// FormatMismatch, OutOfBounds or SubresourceOutOfRange of views, LayoutMismatch), Unsupported (the adapter lacks it;
// CapMissing names the cap), OutOfMemory, CompileFailed (the driver refused a shader: ShaderRejected), DeviceLost (from
// then on). On failure the out parameter is left null and a message says why.
class IDevice : public IObject {
 public:
  virtual const Caps& GetCaps() const = 0;  // never changes
  // What creation accepts and what then works. Any value; what is no format: None. ID3D10Device::CheckFormatSupport /
  // vkGetPhysicalDeviceFormatProperties / glGetInternalformativ.
  virtual FormatSupport CheckFormatSupport(Format) const = 0;
  // Levels of quality of `samples` samples: 0 (not supported) or 1. ID3D10Device::CheckMultisampleQualityLevels /
  // vkGetPhysicalDeviceImageFormatProperties / GL_SAMPLES.
  virtual uint32_t CheckMultisample(Format, uint32_t samples) const = 0;

  // ---- Resources: CreateBuffer, CreateTexture2D and 3D / vkCreateBuffer, vkCreateImage / glNamedBufferStorage,
  // glTextureStorage*. `init` is copied before the call returns: byteWidth bytes, or one SubresourceData for each
  // subresource; Immutable needs it. Without it the contents are undefined. Not for samples and stencil.
  virtual Status CreateBuffer(const BufferDesc&, const void* init, Ref<IBuffer>*) = 0;
  virtual Status CreateTexture(const TextureDesc&, const SubresourceData* init, Ref<ITexture>*) = 0;
  // Null desc: all of it. A TexCube's view of other than six slices is a Texture2DArray to shaders. Buffers: the first
  // byte keeps the adapter's alignment (multiples of 256 always do), else Unsupported.
  virtual Status CreateShaderResourceView(IResource*, const ViewDesc*, Ref<IShaderResourceView>*) = 0;
  // Targets and u registers: one mip. All depth slices of a Tex3D. A TexCube's faces are slices.
  virtual Status CreateRenderTargetView(ITexture*, const ViewDesc*, Ref<IRenderTargetView>*) = 0;
  virtual Status CreateDepthStencilView(ITexture*, const ViewDesc*, Ref<IDepthStencilView>*) = 0;
  virtual Status CreateUnorderedAccessView(IResource*, const ViewDesc*, Ref<IUnorderedAccessView>*) = 0;
  // No code: InvalidArg. Code that the driver does not take: CompileFailed, here or (linking) at the first draw.
  // CreateVertexShader and kin / vkCreateShaderModule, for compute vkCreateComputePipelines / glCompileShader.
  virtual Status CreateShader(const ShaderBlob&, Ref<IShader>*) = 0;
  // Matches the elements to the shader's inputs by semantic, whatever their case; an input without an element is a
  // LayoutMismatch, further elements are ignored. All elements of a slot share class and step rate. No longer needs
  // `elements` when it returns. For this shader, or one of the same inputs.
  virtual Status CreateInputLayout(const InputElement*, uint32_t count, IShader* vs, Ref<IInputLayout>*) = 0;
  virtual Status CreateBlendState(const BlendDesc&, Ref<IBlendState>*) = 0;
  virtual Status CreateDepthStencilState(const DepthStencilDesc&, Ref<IDepthStencilState>*) = 0;
  virtual Status CreateRasterizerState(const RasterizerDesc&, Ref<IRasterizerState>*) = 0;
  virtual Status CreateSamplerState(const SamplerDesc&, Ref<ISamplerState>*) = 0;
  // Unsupported: Caps::timestamp, pipelineStatistics, occlusionPrecise.
  virtual Status CreateQuery(const QueryDesc&, Ref<IQuery>*) = 0;
  // Unsupported: a headless device (Caps::swapChain) or format. A window that is not there is an error, too.
  virtual Status CreateSwapChain(const SwapChainDesc&, Ref<ISwapChain>*) = 0;

  // Makes a pipeline before its first draw: - / vkCreateGraphicsPipelines / glLinkProgram. No or a wrong shader,
  // or too many targets: InvalidArg and NoVertexShader.
  virtual Status PrecachePipeline(const PipelineKeyDesc&) = 0;
  // The size of the blob in bytes; copies it if `capacity` suffices (null, 0: only the size). 0 where the driver has
  // none (Caps::pipelineCacheBlob), or no pipeline yet. - / vkGetPipelineCacheData / -. For
  // DeviceDesc::pipelineCache; a blob of another driver, or a damaged one, is ignored (PipelineCacheRefused).
  virtual size_t GetPipelineCacheBlob(void* out, size_t capacity) = 0;

  virtual IContext* ImmediateContext() = 0;
  // Submits, waits, and copies one subresource to `out`: rows of rowPitch bytes (0: tightly packed), slices of a Tex3D
  // one after the other, of blocks for BC, depth before stencil as in DXGI. InvalidArg: null (InvalidDesc), no such
  // subresource (SubresourceOutOfRange), samples (FormatMismatch; resolve them), too little capacity or rowPitch, bytes
  // beyond a buffer (OutOfBounds). CopyResource to a staging resource and Map / vkCmdCopyImageToBuffer /
  // glGetTextureSubImage, glGetNamedBufferSubData.
  virtual Status ReadBack(ITexture*, uint32_t subresource, void* out, size_t capacity, uint32_t rowPitch = 0) = 0;
  virtual Status ReadBack(IBuffer*, uint32_t offset, uint32_t size, void* out) = 0;
  virtual Status WaitIdle() = 0;  // submits and waits for the GPU: an Event query / vkDeviceWaitIdle's job / glFinish's
  virtual Stats GetStats(bool reset) = 0;  // counted on the CPU; costs nothing
};

}  // namespace rhi

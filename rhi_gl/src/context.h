// The immediate context: ContextBase remembers what is bound, this brings it to GL at each draw, as little as possible.
#pragma once

#include "core.h"
#include "gl_state.h"
#include "queries.h"
#include "resources.h"
#include "rhi/backend/context_base.h"
#include "ring.h"
#include "shaders.h"
#include "states.h"
#include "transfer.h"

namespace rhi_gl {

// Bits of ContextBase::dirty_ that are this backend's own.
enum OwnDirty : uint32_t {
  DirtyBarrier = 1u << 24,       // a dispatch wrote: the next reader needs a memory barrier
  DirtyUnusable = 1u << 25,      // the state was refused at the last draw: look again
  DirtyThread = 1u << 26,        // another context may be current on this thread: ask EGL
  DirtyFirstVertex = 1u << 27,   // block kGlDrawParametersBlock may hold another first vertex than readyFirst_
  DirtyConstantSlot = 1u << 28,  // << slot: the slot's buffer has new contents
};

// What Present shows, scaled where the window has another size.
struct WindowPicture {
  void* window;        // the X11 Window
  void* surface;       // of EglContext
  GLuint framebuffer;  // the picture, row 0 on top
  uint32_t width, height;
  int swapInterval;
};

class Context final : public backend::ContextBase {
 public:
  Context(IDevice& device, const CorePtr& core, const DeviceDesc& desc);
  ~Context();
  Context(const Context&) = delete;
  Context& operator=(const Context&) = delete;

  void SetConstantBuffers(uint32_t first, uint32_t count, IBuffer* const*) override;
  void ClearState() override;
  void ClearRenderTargetView(IRenderTargetView*, const float rgba[4]) override;
  void ClearDepthStencilView(IDepthStencilView*, bool clearDepth, float depth, bool clearStencil,
                             uint8_t stencil) override;

  Status Map(IResource*, uint32_t subresource, MapMode, Mapped*) override;
  void Unmap(IResource*, uint32_t subresource) override;
  void UpdateConstants(IBuffer*, const void* data, uint32_t size) override;
  void UpdateSubresource(IResource*, uint32_t subresource, const Box*, const void* data, uint32_t rowPitch,
                         uint32_t slicePitch) override;
  void CopyResource(IResource* dst, IResource* src) override;
  void CopySubresourceRegion(IResource* dst, uint32_t dstSubresource, uint32_t x, uint32_t y, uint32_t z,
                             IResource* src, uint32_t srcSubresource, const Box*) override;
  void ResolveSubresource(ITexture* dst, uint32_t dstSubresource, ITexture* src, uint32_t srcSubresource,
                          Format) override;
  void GenerateMips(IShaderResourceView*) override;

  void Draw(uint32_t vertexCount, uint32_t startVertex) override;
  void DrawIndexed(uint32_t indexCount, uint32_t startIndex, int32_t baseVertex) override;
  void DrawInstanced(uint32_t vertexCount, uint32_t instanceCount, uint32_t startVertex,
                     uint32_t startInstance) override;
  void DrawIndexedInstanced(uint32_t indexCount, uint32_t instanceCount, uint32_t startIndex, int32_t baseVertex,
                            uint32_t startInstance) override;
  void DrawInstancedIndirect(IBuffer* args, uint32_t offset) override;
  void DrawIndexedInstancedIndirect(IBuffer* args, uint32_t offset) override;
  void Dispatch(uint32_t x, uint32_t y, uint32_t z) override;
  void DispatchIndirect(IBuffer* args, uint32_t offset) override;

  void Begin(IQuery*) override;
  void End(IQuery*) override;
  Status GetData(IQuery*, void* data, uint32_t size, bool flush) override;
  void BeginEvent(const char* name) override;
  void EndEvent() override;
  void Flush() override;
  void EndFrame() override;
  IDevice* Device() override { return &device_; }

  // For Core: another device's context was made current on the thread.
  void LoseThread();

  // For the device.
  Status ReadBack(ITexture*, uint32_t subresource, void* out, size_t capacity, uint32_t rowPitch);
  Status ReadBack(IBuffer*, uint32_t offset, uint32_t size, void* out);
  Status WaitIdle();
  Status ShowInWindow(const WindowPicture&);  // SurfaceLost: the window is gone
  Status Precache(const PipelineKeyDesc&);
  Stats GetStats(bool reset);

 private:
  // context_draw.cpp
  bool Ready(uint32_t firstVertex) const;
  bool Prepare(int64_t firstVertex);
  void PrepareAndDraw(uint32_t vertexCount, uint32_t startVertex);
  bool PrepareIndexed();
  bool ApplyGraphics();
  bool CheckGraphics();
  bool CheckInputs(const Shader& vs, const Shader* gs);
  void ApplyProgram();
  void ApplyVertexArray();
  void ApplyIndexBuffer(VertexArray&);
  void ApplyOutput();
  void ApplyBlend();
  void SetFirstVertex(int32_t first);
  const void* IndexPointer(uint32_t startIndex) const;
  const Buffer* CheckIndirect(IBuffer* args, uint32_t offset, uint32_t size);
  void BindFirstVertexFrom(const Buffer& args, uint32_t offset);
  bool IndicesFromZero();

  // context_bind.cpp
  void UnmarkConstants();
  void BindConstants(uint32_t slots);
  void BindStage(Stage, const Shader&);
  void BindPair(uint32_t unit, Stage, const Shader&, uint32_t pair);
  void BindStorage(uint32_t block, Stage, const ShaderResource&);
  void BindUavs(const Shader&);
  void BindDummy(uint32_t unit, const ShaderResource&);
  void BindUavBuffer(uint32_t slot, const UnorderedAccessView*);
  void BindUavTexture(uint32_t slot, const UnorderedAccessView*);
  void ReportUnbound(Stage, const ShaderResource&, bool other);

  // context_compute.cpp
  bool PrepareDispatch();
  void FinishDispatch();
  void Barrier();
  bool Settle();  // before anything that reads or writes resources outside of draws; false: as Enter

  // context_clear.cpp
  bool OpenGates();
  struct ClearPlace {
    GLuint framebuffer;
    GLint drawBuffer;
  };
  ClearPlace PlaceOf(const RenderTargetView&);

  // context_copy.cpp, context_data.cpp
  struct CopyPlace {
    Texture* texture;
    uint32_t subresource;
    TexelBlock block;
  };
  void UpdateBuffer(Buffer&, const Box*, const void* data);
  void UpdateTexture(Texture&, uint32_t subresource, const Box*, const void* data, uint32_t rowPitch,
                     uint32_t slicePitch);
  void CopyBuffer(Buffer& dst, uint32_t at, Buffer& src, const Box*);
  void CopyTexture(Texture& dst, uint32_t dstSub, uint32_t x, uint32_t y, uint32_t z, Texture& src, uint32_t srcSub,
                   const Box*);
  void CopyBlock(const CopyPlace& dst, const CopyPlace& src);
  void CopyStaging(const CopyPlace& dst, const CopyPlace& src);
  void Refuse(MsgCode, const char* name, const char* call, const char* why);
  Status MapBuffer(Buffer&, MapMode, Mapped*);
  Status MapTexture(Texture&, uint32_t subresource, MapMode, Mapped*);
  Status RefuseMap(const char* name, MsgCode, const char* why) const;
  void UpdateElsewhere(Buffer*, const void* data, uint32_t size);
  Status WaitForCopies(bool* touched);
  void MarkMoved(const Buffer&);

  // queries.cpp
  bool CheckQuery(const Query*, bool begin);
  void NextSegment(uint32_t target, SegmentPtr next);

  // context_frame.cpp
  bool Enter();  // false: the call is ignored (Core::Enter)
  Status FinishAll();
  void AfterFrame();
  // At most once a frame for each code, so that a broken draw of every frame does not drown the rest.
  [[gnu::format(printf, 4, 5)]] void ReportOnce(Severity, MsgCode, const char* format, ...);

  IDevice& device_;
  const CorePtr corePtr_;
  Core& core_;
  Ring ring_;
  GlState gl_;
  const uint32_t framesInFlight_;

  // What the last ApplyGraphics found; the draws read it.
  GLenum mode_ = GL_TRIANGLES;
  GLenum indexType_ = GL_UNSIGNED_INT;
  uint32_t indexShift_ = 2;
  uint64_t indexBase_ = 0;
  bool hasIndices_ = false, usesVertexId_ = false, writesColors_ = true;
  const Framebuffer* framebuffer_ = nullptr;
  const Program* program_ = nullptr;

  VertexArray emptyArray_;    // for draws without an input layout
  int64_t firstVertex_ = -1;  // what block kGlDrawParametersBlock holds; -1: unknown
  uint32_t readyFirst_ = 0;   // the first vertex of the last draw that was prepared
  GLuint indirectFirst_ = 0;  // its buffer for indirect draws
  GLuint scratchIndices_ = 0;
  uint64_t scratchIndicesBytes_ = 0;
  std::array<std::array<GLuint, 2>, 5> dummies_{};  // zero textures by TextureDim and integer
  std::array<std::array<uint32_t, 2>, 5> dummyUids_{};
  Ref<ISamplerState> defaultSampler_, loadSampler_;
  std::array<uint32_t, kMaxUnorderedAccess> images_{};  // uids of the bound images

  uint64_t ringTakenAtReset_ = 0;
  uint32_t eventDepth_ = 0;
  std::vector<Ref<Query>> activeQueries_;
  std::array<SegmentPtr, kQueryTargets> runningSegments_;
  std::unordered_map<uint16_t, uint64_t> reported_;  // code -> frame
};

}  // namespace rhi_gl

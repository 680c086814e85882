// Buffers, textures and their views.
#pragma once

#include "core.h"
#include "formats.h"
#include "rhi/backend/checks.h"

namespace rhi_gl {

using backend::Object;

struct RingPage;

inline constexpr uint32_t kRegisterBytes = 16;  // one float4 of a constant buffer

// One of the memories that a dynamic buffer takes turns in.
struct Version {
  GLuint name = 0;
  uint32_t uid = 0, offset = 0;
  std::byte* data = nullptr;
  uint64_t freeAfter = 0;  // the last frame that may read it
};

// Where a buffer's contents are. Constant dynamic buffers live in a slice of the context's ring (or at `home`), other
// dynamic buffers in one of their versions, and all else in one GL buffer for ever.
class Buffer final : public Object<IBuffer> {
 public:
  static Status Create(const CorePtr&, const BufferDesc&, const void* init, Ref<IBuffer>* out);
  ~Buffer() override;

  static constexpr uint32_t kNoQuickSize = ~0u;

  Usage GetUsage() const override { return desc_.usage; }
  const BufferDesc& Desc() const override { return desc_; }
  void SetName(const char*) override;

  // Fresh memory for the whole buffer, not in the GPU's hands; null: no memory. Dynamic buffers that are no constants.
  std::byte* Rename();
  // Copies what a recycled ring page still holds of this buffer to memory of its own.
  void MoveHome();
  bool IsRingConstant() const { return ringConstant_; }

  // Current contents: read by the context at each bind.
  GLuint name = 0;
  uint32_t uid = 0, offset = 0;
  std::byte* data = nullptr;  // mapped memory of the contents, or null
  uint32_t range = 0;         // bytes to bind: byteWidth rounded up for constants
  uint32_t boundSlots = 0;    // constant registers that show this buffer, as a mask
  uint32_t ringBytes = 0;     // what one update takes of the ring

  // Dynamic constants: the ring page that holds the contents, and the list of its inhabitants.
  RingPage* page = nullptr;
  std::byte* pageMemory = nullptr;
  uint64_t lastSlice = 0;  // the offset of the last slice that fits into a page
  Buffer *previousInPage = nullptr, *nextInPage = nullptr;

  // The size that UpdateConstants serves in the short way, and the one register that shows the buffer: those of the
  // last update. kNoQuickSize where there is no such register.
  uint32_t quickSize = kNoQuickSize, quickSlot = 0;

  bool mapped = false;
  bool gpuTouched = false;  // staging: copies were recorded that a Map must wait for

 private:
  friend class Object<IBuffer>;
  Buffer(const CorePtr&, const BufferDesc&);
  bool AllocateStorage(const void* init);
  bool AllocateFixed(const void* init, GLbitfield flags);
  bool AllocateVersions(const void* init);
  bool AddVersions();
  bool MakeHome();

  CorePtr core_;
  BufferDesc desc_;
  bool ringConstant_ = false;
  GLuint own_ = 0;  // fixed storage, or a constant's home
  uint32_t ownUid_ = 0;
  std::deque<Version> idle_;
  std::vector<GLuint> chunks_;
  Version current_;
};

// A texture; or, with Usage::Staging, a mapped buffer that holds all its subresources tightly packed.
class Texture final : public Object<ITexture> {
 public:
  static Status Create(const CorePtr&, const TextureDesc&, const SubresourceData* init, Ref<ITexture>* out);
  ~Texture() override;

  Usage GetUsage() const override { return desc_.usage; }
  const TextureDesc& Desc() const override { return desc_; }
  void SetName(const char*) override;

  bool IsStaging() const { return desc_.usage == Usage::Staging; }
  uint32_t SubresourceCount() const { return desc_.mipLevels * backend::SliceCount(desc_); }
  uint32_t MipOf(uint32_t subresource) const { return subresource % desc_.mipLevels; }
  uint32_t SliceOf(uint32_t subresource) const { return subresource / desc_.mipLevels; }
  backend::MipLayout Layout(uint32_t subresource) const { return backend::GetMipLayout(desc_, MipOf(subresource)); }
  // Staging: the byte offset of a subresource.
  uint64_t StagingOffset(uint32_t subresource) const { return offsets_[subresource]; }

  GLuint name = 0;
  uint32_t uid = 0;
  GLenum target = 0;
  GLuint stagingBuffer = 0;
  std::byte* stagingData = nullptr;
  uint32_t mappedCount = 0;
  std::vector<bool> mapped;  // staging: for each subresource
  bool gpuTouched = false;

 private:
  Texture(const CorePtr&, const TextureDesc&);
  bool AllocateStorage();
  bool AllocateStaging(const SubresourceData* init);
  void UploadAll(const SubresourceData* init);

  CorePtr core_;
  TextureDesc desc_;
  std::vector<uint64_t> offsets_;
};

// What the four kinds of views have in common.
struct ViewData {
  CorePtr core;
  Ref<IResource> resource;
  ViewDesc desc;
  Buffer* buffer = nullptr;    // of a structured buffer
  Texture* texture = nullptr;  // else
  GLuint name = 0;             // the texture itself, or a GL view of it
  bool owned = false;          // `name` is a GL view
  uint32_t uid = 0;
  GLenum target = 0;
  uint32_t stride = 0;
  // Targets: where in `name` the view begins.
  uint32_t level = 0, layer = 0;
  bool layered = false;

  ~ViewData();
};

template <class Interface>
class View final : public Object<Interface>, public ViewData {
 public:
  IResource* Resource() const override { return resource.get(); }
  const ViewDesc& Desc() const override { return desc; }
};
using ShaderResourceView = View<IShaderResourceView>;
using RenderTargetView = View<IRenderTargetView>;
using DepthStencilView = View<IDepthStencilView>;
using UnorderedAccessView = View<IUnorderedAccessView>;

// A view of the given mips and slices, as `format` and *target. Where that is GL_NONE it becomes the texture's own, or
// for a part of a cube a 2D array.
GLuint MakeGlView(const Texture&, Format, uint32_t firstMip, uint32_t mipCount, uint32_t firstSlice,
                  uint32_t sliceCount, GLenum* target);

Status CreateShaderResourceView(const CorePtr&, IResource*, const ViewDesc*, Ref<IShaderResourceView>* out);
Status CreateRenderTargetView(const CorePtr&, ITexture*, const ViewDesc*, Ref<IRenderTargetView>* out);
Status CreateDepthStencilView(const CorePtr&, ITexture*, const ViewDesc*, Ref<IDepthStencilView>* out);
Status CreateUnorderedAccessView(const CorePtr&, IResource*, const ViewDesc*, Ref<IUnorderedAccessView>* out);

// The resource as what it is, or null. Both classes are final, so comparing types is exact, and cheaper than a cast.
Buffer* AsBuffer(IResource*);
Texture* AsTexture(IResource*);

inline uint32_t AlignUp(uint32_t value, uint32_t alignment) { return (value + alignment - 1) / alignment * alignment; }

}  // namespace rhi_gl

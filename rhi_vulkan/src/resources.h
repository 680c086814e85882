// Buffers, textures and their views.
#pragma once

#include <typeinfo>

#include "barriers.h"
#include "core.h"

namespace rhi_vulkan {

// A VkBuffer with its memory and what the GPU last did with it.
struct GpuBuffer {
  VkBuffer handle = VK_NULL_HANDLE;
  Allocation memory;
  ResourceState state;
  uint64_t lastUse = 0;  // serial of the last copy from or to it; kept for staging

  Status Create(Core&, const char* name, VkDeviceSize size, VkBufferUsageFlags, MemoryKind);
  void Destroy(Core&);
};

class Buffer final : public VkObject<IBuffer> {
 public:
  Buffer(std::shared_ptr<Core> core, const BufferDesc& desc);
  ~Buffer() override;
  Status Create();  // dynamic: zeroed; others: not initialised

  Usage GetUsage() const override { return desc_.usage; }
  const BufferDesc& Desc() const override { return desc_; }
  void SetName(const char*) override;

  bool IsDynamic() const { return alignedWidth != 0; }
  VkBuffer Handle() const { return slice.page ? slice.page->buffer : gpu.handle; }
  uint32_t Offset() const { return slice.offset; }  // where the contents start in Handle()

  Slice slice;                // dynamic buffers: the current contents
  uint32_t alignedWidth = 0;  // dynamic buffers: what a slice takes of the ring; else 0
  uint32_t dirtyOnDiscard = 0;
  uint32_t unboundOffset = 0;
  uint32_t* offsetEntry = &unboundOffset;  // constant buffers: the context's entry to keep up to date
  GpuBuffer gpu;                           // all others
  bool mapped = false;
  const uint64_t id;

 private:
  void Destroy() noexcept override;

  std::string descName_;
  BufferDesc desc_;
};

struct SubresourceRange {
  uint32_t mip = 0, mips = 1, slice = 0, slices = 1;
};

class Texture final : public VkObject<ITexture> {
 public:
  Texture(std::shared_ptr<Core> core, const TextureDesc& desc);
  ~Texture() override;
  Status Create();

  Usage GetUsage() const override { return desc_.usage; }
  const TextureDesc& Desc() const override { return desc_; }
  void SetName(const char*) override;

  bool IsStaging() const { return desc_.usage == Usage::Staging; }
  uint32_t Slices() const { return backend::SliceCount(desc_); }
  uint32_t SubresourceCount() const { return desc_.mipLevels * Slices(); }
  SubresourceRange One(uint32_t subresource) const {
    return {subresource % desc_.mipLevels, 1, subresource / desc_.mipLevels, 1};
  }
  SubresourceRange All() const { return {0, desc_.mipLevels, 0, Slices()}; }
  // Layers as Vulkan's copies count them: for both aspects, or one of them.
  VkImageSubresourceLayers Layers(const SubresourceRange&) const;
  void Advance(const SubresourceRange&, const Access&, BarrierBatch&);

  VkImage image = VK_NULL_HANDLE;
  VkImageAspectFlags aspects;
  uint32_t pendingClears = 0;
  GpuBuffer staging;  // staging textures are buffers, each subresource tightly packed at offset[i]
  std::vector<VkDeviceSize> stagingOffset;
  std::vector<bool> mapped;  // staging, for each subresource

 private:
  Status CreateImage();
  Status CreateStaging();
  void AdvanceEach(const SubresourceRange&, const Access&, BarrierBatch&);

  Allocation memory_;
  std::string descName_;
  TextureDesc desc_;
  std::vector<ResourceState> states_;  // for each subresource; states_[0] stands for all while uniform_
  bool uniform_ = true;
};

// Views hold their resource. `texture` or `buffer` is set.
template <class Interface>
class View final : public VkObject<Interface> {
 public:
  View(std::shared_ptr<Core> core, IResource* resource, const ViewDesc& desc)
      : VkObject<Interface>(std::move(core)), desc_(desc), resource_(resource), id(this->core_->nextId++) {}
  ~View() override {
    if (view) this->core_->vk.vkDestroyImageView(this->core_->device, view, nullptr);
  }
  IResource* Resource() const override { return resource_.get(); }
  const ViewDesc& Desc() const override { return desc_; }
  SubresourceRange Range() const { return {desc_.firstMip, desc_.mipCount, desc_.firstSlice, desc_.sliceCount}; }
  uint32_t Width() const { return backend::MipSize(texture->Desc().width, desc_.firstMip); }
  uint32_t Height() const { return backend::MipSize(texture->Desc().height, desc_.firstMip); }
  uint32_t Layers() const {  // a target on a Tex3D shows all its depth slices
    const TextureDesc& d = texture->Desc();
    return d.dim == TextureDim::Tex3D ? backend::MipSize(d.depthOrArray, desc_.firstMip) : desc_.sliceCount;
  }

 private:
  ViewDesc desc_;
  Ref<IResource> resource_;

 public:
  Texture* texture = nullptr;
  Buffer* buffer = nullptr;
  VkImageView view = VK_NULL_HANDLE;
  const uint64_t id;
};

using ShaderView = View<IShaderResourceView>;
using TargetView = View<IRenderTargetView>;
using DepthView = View<IDepthStencilView>;
using UavView = View<IUnorderedAccessView>;

// The buffer behind a resource, or null for a texture. There are no other classes of resources, so this is a comparison
// of types and not a search.
inline Buffer* AsBuffer(IResource* resource) {
  return resource && typeid(*resource) == typeid(Buffer) ? static_cast<Buffer*>(resource) : nullptr;
}

// Whether the shader's register can show the view; else it reads 0.
template <class Interface>
bool Fits(const View<Interface>& view, const ShaderResource& declared) {
  const bool written = std::is_same_v<Interface, IUnorderedAccessView>;
  return backend::ShowsAs(view.texture ? &view.texture->Desc() : nullptr, view.Desc(), declared, written);
}

// Makes the image view that `need` (one Bind flag) asks for.
VkResult CreateImageView(Core&, const Texture&, const ViewDesc&, Bind need, VkImageView* out);

}  // namespace rhi_vulkan

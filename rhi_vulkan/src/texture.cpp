#include "formats.h"
#include "resources.h"

namespace rhi_vulkan {
namespace {

VkImageUsageFlags UsageOf(Bind bind) {
  VkImageUsageFlags usage = 0;
  if (bind & Bind::ShaderResource) usage |= VK_IMAGE_USAGE_SAMPLED_BIT;
  if (bind & Bind::RenderTarget) usage |= VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT;
  if (bind & Bind::DepthStencil) usage |= VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT;
  if (bind & Bind::UnorderedAccess) usage |= VK_IMAGE_USAGE_STORAGE_BIT;
  return usage;
}

// The formats of views: the texture's own and its sRGB twin.
struct ViewFormats {
  std::array<VkFormat, 2> formats{};
  uint32_t count = 0;
  explicit ViewFormats(Format format) {
    formats[count++] = ToVk(format);
    const Format twin = GetFormatInfo(format).sRGB ? ToLinear(format) : ToSRGB(format);
    if (twin != format) formats[count++] = ToVk(twin);
  }
};

VkImageCreateInfo ImageInfo(const TextureDesc& d) {
  VkImageCreateInfo info{VK_STRUCTURE_TYPE_IMAGE_CREATE_INFO};
  const bool is3D = d.dim == TextureDim::Tex3D;
  info.imageType = is3D ? VK_IMAGE_TYPE_3D : VK_IMAGE_TYPE_2D;
  info.format = ToVk(d.format);
  info.extent = {d.width, d.height, is3D ? d.depthOrArray : 1};
  info.mipLevels = d.mipLevels;
  info.arrayLayers = is3D ? 1 : d.depthOrArray;
  info.samples = VkSampleCountFlagBits(d.sampleCount);
  info.tiling = VK_IMAGE_TILING_OPTIMAL;
  info.usage = UsageOf(d.bind) | VK_IMAGE_USAGE_TRANSFER_SRC_BIT | VK_IMAGE_USAGE_TRANSFER_DST_BIT;
  if (d.dim == TextureDim::TexCube) info.flags |= VK_IMAGE_CREATE_CUBE_COMPATIBLE_BIT;
  if (is3D && (d.bind & Bind::RenderTarget)) info.flags |= VK_IMAGE_CREATE_2D_ARRAY_COMPATIBLE_BIT;
  return info;
}

VkImageViewType ViewType(const TextureDesc& d, const ViewDesc& v, Bind need) {
  const bool shader = need == Bind::ShaderResource, target = need == Bind::RenderTarget || need == Bind::DepthStencil;
  switch (d.dim) {
    case TextureDim::Tex2D:
    case TextureDim::Tex2DMS: return VK_IMAGE_VIEW_TYPE_2D;
    case TextureDim::Tex3D: return target ? VK_IMAGE_VIEW_TYPE_2D_ARRAY : VK_IMAGE_VIEW_TYPE_3D;
    case TextureDim::TexCube:
      return shader && v.sliceCount == 6 ? VK_IMAGE_VIEW_TYPE_CUBE : VK_IMAGE_VIEW_TYPE_2D_ARRAY;
    case TextureDim::Tex2DArray: return VK_IMAGE_VIEW_TYPE_2D_ARRAY;
  }
  return VK_IMAGE_VIEW_TYPE_2D;
}

}  // namespace

Texture::Texture(std::shared_ptr<Core> core, const TextureDesc& desc)
    : VkObject(std::move(core)), aspects(Aspects(desc.format)), descName_(desc.name ? desc.name : ""), desc_(desc) {
  desc_.name = descName_.c_str();
  backend::Object<ITexture>::SetName(desc_.name);
}

Texture::~Texture() {
  if (image) core_->vk.vkDestroyImage(core_->device, image, nullptr);
  core_->memory->Free(memory_);
  staging.Destroy(*core_);
}

void Texture::SetName(const char* name) {
  backend::Object<ITexture>::SetName(name);
  core_->SetName(VK_OBJECT_TYPE_IMAGE, uint64_t(image), Name().c_str());
}

Status Texture::Create() { return IsStaging() ? CreateStaging() : CreateImage(); }

Status Texture::CreateImage() {
  VkImageCreateInfo info = ImageInfo(desc_);
  const ViewFormats views(desc_.format);
  VkImageFormatListCreateInfo list{VK_STRUCTURE_TYPE_IMAGE_FORMAT_LIST_CREATE_INFO};
  list.viewFormatCount = views.count;
  list.pViewFormats = views.formats.data();
  if (views.count > 1) {
    info.flags |= VK_IMAGE_CREATE_MUTABLE_FORMAT_BIT;
    info.pNext = &list;
  }
  VkImageFormatProperties p{};
  const VkResult possible = core_->instance.vk.vkGetPhysicalDeviceImageFormatProperties(
      core_->adapter.handle, info.format, info.imageType, info.tiling, info.usage, info.flags, &p);
  if (possible != VK_SUCCESS || !(p.sampleCounts & info.samples)) {
    core_->log.Report(
        Severity::Error, MsgCode::CapMissing, desc_.name,
        "%s with these bind flags and %u samples is not offered by this adapter; ask CheckFormatSupport and "
        "CheckMultisample",
        ToString(desc_.format), desc_.sampleCount);
    return Status::Unsupported;
  }
  states_.resize(SubresourceCount());
  Status s = core_->Check(core_->vk.vkCreateImage(core_->device, &info, nullptr, &image), desc_.name, "vkCreateImage");
  if (s == Status::Ok) s = core_->Check(core_->memory->AllocateFor(image, &memory_), desc_.name, "memory of a texture");
  if (s == Status::Ok) core_->SetName(VK_OBJECT_TYPE_IMAGE, uint64_t(image), desc_.name);
  return s;
}

Status Texture::CreateStaging() {
  if (GetFormatInfo(desc_.format).stencil || desc_.dim == TextureDim::Tex2DMS) {
    core_->log.Report(Severity::Error, MsgCode::CapMissing, desc_.name,
                      "staging textures hold neither stencil nor samples; read depth-stencil back with ReadBack");
    return Status::Unsupported;
  }
  mapped.resize(SubresourceCount());
  VkDeviceSize size = 0;
  for (uint32_t i = 0; i < SubresourceCount(); ++i) {
    const backend::MipLayout m = backend::GetMipLayout(desc_, One(i).mip);
    stagingOffset.push_back(size);
    size += AlignUp(m.sliceBytes * m.depth, uint64_t(16));
  }
  return staging.Create(*core_, desc_.name, size, VK_BUFFER_USAGE_TRANSFER_SRC_BIT | VK_BUFFER_USAGE_TRANSFER_DST_BIT,
                        MemoryKind::Readback);
}

VkImageSubresourceLayers Texture::Layers(const SubresourceRange& r) const {
  return {aspects, r.mip, r.slice, r.slices};
}

void Texture::Advance(const SubresourceRange& r, const Access& use, BarrierBatch& batch) {
  const bool whole = r.mips == desc_.mipLevels && r.slices == Slices();
  if (!uniform_) return AdvanceEach(r, use, batch);
  ResourceState next = states_[0];
  const Dependency d = rhi_vulkan::Advance(next, use);
  if (next == states_[0] && !d.needed) return;
  if (whole) {
    states_[0] = next;
    if (d.needed) batch.Image(image, {aspects, 0, VK_REMAINING_MIP_LEVELS, 0, VK_REMAINING_ARRAY_LAYERS}, d);
    return;
  }
  std::fill(states_.begin() + 1, states_.end(), states_[0]);
  uniform_ = false;
  AdvanceEach(r, use, batch);
}

void Texture::AdvanceEach(const SubresourceRange& r, const Access& use, BarrierBatch& batch) {
  for (uint32_t mip = r.mip; mip < r.mip + r.mips; ++mip)
    for (uint32_t slice = r.slice, end = r.slice + r.slices; slice < end;) {
      // One barrier for a run of slices in the same state.
      const ResourceState before = states_[Subresource(mip, slice, desc_.mipLevels)];
      Dependency d;
      const uint32_t first = slice;
      for (; slice < end && states_[Subresource(mip, slice, desc_.mipLevels)] == before; ++slice)
        d = rhi_vulkan::Advance(states_[Subresource(mip, slice, desc_.mipLevels)], use);
      if (d.needed) batch.Image(image, {aspects, mip, 1, first, slice - first}, d);
    }
  if (r.mips != desc_.mipLevels || r.slices != Slices()) return;
  uniform_ = std::all_of(states_.begin(), states_.end(), [&](const ResourceState& s) { return s == states_[0]; });
}

VkResult CreateImageView(Core& core, const Texture& texture, const ViewDesc& v, Bind need, VkImageView* out) {
  const TextureDesc& d = texture.Desc();
  const bool target = need == Bind::RenderTarget || need == Bind::DepthStencil;
  VkImageViewUsageCreateInfo usage{VK_STRUCTURE_TYPE_IMAGE_VIEW_USAGE_CREATE_INFO};
  usage.usage = UsageOf(need);  // an sRGB view need not be storable only because the image is
  VkImageViewCreateInfo info{VK_STRUCTURE_TYPE_IMAGE_VIEW_CREATE_INFO, &usage};
  info.image = texture.image;
  info.viewType = ViewType(d, v, need);
  info.format = ToVk(v.format);
  // Shaders read the depth of a depth-stencil texture.
  const VkImageAspectFlags readable = texture.aspects & ~VkImageAspectFlags(VK_IMAGE_ASPECT_STENCIL_BIT);
  info.subresourceRange = {target ? texture.aspects : readable, v.firstMip, v.mipCount, v.firstSlice, v.sliceCount};
  if (d.dim == TextureDim::Tex3D && target)
    info.subresourceRange.layerCount = backend::MipSize(d.depthOrArray, v.firstMip);
  return core.vk.vkCreateImageView(core.device, &info, nullptr, out);
}

}  // namespace rhi_vulkan

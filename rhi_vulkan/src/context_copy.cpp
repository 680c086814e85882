// Copies, resolve, mips. None of them can be in a pass.
#include "context.h"
#include "formats.h"
#include "rhi/backend/data_checks.h"

namespace rhi_vulkan {
namespace {

VkOffset3D Offset(uint32_t x, uint32_t y, uint32_t z) { return {int32_t(x), int32_t(y), int32_t(z)}; }
VkExtent3D Extent(const Box& b) { return {b.right - b.left, b.bottom - b.top, b.back - b.front}; }

// Where a texel of a staging texture is.
VkDeviceSize StagingAt(const Texture& t, uint32_t subresource, uint32_t x, uint32_t y, uint32_t z) {
  const backend::MipLayout m = backend::GetMipLayout(t.Desc(), t.One(subresource).mip);
  const FormatInfo& f = GetFormatInfo(t.Desc().format);
  return t.stagingOffset[subresource] + z * m.sliceBytes + VkDeviceSize(y / f.blockSize) * m.rowBytes +
         VkDeviceSize(x / f.blockSize) * f.blockBytes;
}

}  // namespace

void Context::UseStaging(GpuBuffer& staging, Access use) {
  use.layout = VK_IMAGE_LAYOUT_UNDEFINED;
  const Dependency d = Advance(staging.state, use);
  if (d.needed) barriers_.Buffer(staging.handle, d);
}

// The CPU will look at what was copied to it, after waiting for this submission.
void Context::FinishStaging(GpuBuffer& staging, bool written) {
  staging.lastUse = core_->recording;
  if (!written) return;
  UseStaging(staging, kHostRead);
  RecordBarriers();
}

void Context::CopyResource(IResource* dst, IResource* src) {
  if (core_->lost) return;
  if (!dst || !src) return Complain(MsgCode::InvalidDesc, "", "CopyResource: a resource is null; the call is ignored");
  Buffer *dstBuffer = AsBuffer(dst), *srcBuffer = AsBuffer(src);
  if (!dstBuffer != !srcBuffer) {
    backend::CheckCopyKinds(dst->GetUsage()).Refuses(log_, "");
    return;
  }
  if (dstBuffer) {
    const backend::Misuse misuse = backend::CheckCopyAll(dstBuffer->Desc(), srcBuffer->Desc(), dst == src);
    if (!misuse.Refuses(log_, dstBuffer->Name().c_str())) CopyBuffers(*dstBuffer, 0, *srcBuffer, nullptr);
    return;
  }
  auto &to = static_cast<Texture&>(*dst), &from = static_cast<Texture&>(*src);
  if (backend::CheckCopyAll(to.Desc(), from.Desc(), dst == src).Refuses(log_, to.Name().c_str())) return;
  for (uint32_t i = 0; i < to.SubresourceCount(); ++i) CopyTextures({&to, i, 0, 0, 0}, {&from, i, 0, 0, 0}, nullptr);
}

void Context::CopySubresourceRegion(IResource* dst, uint32_t dstSubresource, uint32_t x, uint32_t y, uint32_t z,
                                    IResource* src, uint32_t srcSubresource, const Box* box) {
  if (core_->lost) return;
  if (!dst || !src)
    return Complain(MsgCode::InvalidDesc, "", "CopySubresourceRegion: a resource is null; the call is ignored");
  Buffer *dstBuffer = AsBuffer(dst), *srcBuffer = AsBuffer(src);
  if (!dstBuffer != !srcBuffer) {
    backend::CheckCopyKinds(dst->GetUsage()).Refuses(log_, "");
    return;
  }
  if (dstBuffer) {
    const backend::Misuse misuse = backend::CheckCopy(dstBuffer->Desc(), x, srcBuffer->Desc(), box, dst == src);
    if (!misuse.Refuses(log_, dstBuffer->Name().c_str())) CopyBuffers(*dstBuffer, x, *srcBuffer, box);
    return;
  }
  auto &to = static_cast<Texture&>(*dst), &from = static_cast<Texture&>(*src);
  const backend::Misuse misuse =
      backend::CheckCopy({to.Desc(), dstSubresource, x, y, z}, {from.Desc(), srcSubresource}, box, dst == src);
  if (misuse.Refuses(log_, to.Name().c_str())) return;
  CopyTextures({&to, dstSubresource, x, y, z}, {&from, srcSubresource, 0, 0, 0}, box);
}

void Context::CopyBuffers(Buffer& dst, uint32_t x, Buffer& src, const Box* box) {
  const uint32_t left = box ? box->left : 0, right = box ? box->right : src.Desc().byteWidth;
  if (left == right) return;
  LeavePass();
  if (&dst == &src) {  // one barrier for both sides
    Access both = kCopyDest;
    both.access |= kCopySource.access;
    Use(dst, both);
  } else {
    Use(src, kCopySource);
    Use(dst, kCopyDest);
  }
  RecordBarriers();
  const VkBufferCopy region{src.Offset() + left, x, right - left};
  vk_.vkCmdCopyBuffer(cmd_, src.Handle(), dst.Handle(), 1, &region);
  if (src.GetUsage() == Usage::Staging) FinishStaging(src.gpu, false);
  if (dst.GetUsage() == Usage::Staging) FinishStaging(dst.gpu, true);
}

void Context::CopyTextures(const TextureRegion& dst, const TextureRegion& src, const Box* box) {
  const backend::MipLayout m = backend::GetMipLayout(src.texture->Desc(), src.texture->One(src.subresource).mip);
  const Box b = box ? *box : Box{0, 0, 0, m.width, m.height, m.depth};
  if (b.left == b.right || b.top == b.bottom || b.front == b.back) return;
  const TextureRegion from{src.texture, src.subresource, b.left, b.top, b.front};
  LeavePass();
  const bool toStaging = dst.texture->IsStaging(), fromStaging = src.texture->IsStaging();
  if (toStaging && fromStaging) return CopyStaging(dst, from, b);
  if (toStaging) return CopyImageAndBuffer(from, dst, b, false);
  if (fromStaging) return CopyImageAndBuffer(dst, from, b, true);
  CopyImages(dst, from, b);
}

void Context::CopyImages(const TextureRegion& dst, const TextureRegion& src, const Box& box) {
  Use(*src.texture, src.texture->One(src.subresource), kCopySource);
  Use(*dst.texture, dst.texture->One(dst.subresource), kCopyDest);
  RecordBarriers();
  VkImageCopy region{};
  region.srcSubresource = src.texture->Layers(src.texture->One(src.subresource));
  region.srcOffset = Offset(src.x, src.y, src.z);
  region.dstSubresource = dst.texture->Layers(dst.texture->One(dst.subresource));
  region.dstOffset = Offset(dst.x, dst.y, dst.z);
  region.extent = Extent(box);
  vk_.vkCmdCopyImage(cmd_, src.texture->image, kCopySource.layout, dst.texture->image, kCopyDest.layout, 1, &region);
}

void Context::CopyImageAndBuffer(const TextureRegion& image, const TextureRegion& staging, const Box& box,
                                 bool toImage) {
  Texture &t = *image.texture, &s = *staging.texture;
  Use(t, t.One(image.subresource), toImage ? kCopyDest : kCopySource);
  UseStaging(s.staging, toImage ? kCopySource : kCopyDest);
  RecordBarriers();
  const backend::MipLayout m = backend::GetMipLayout(s.Desc(), s.One(staging.subresource).mip);
  const uint32_t block = GetFormatInfo(s.Desc().format).blockSize;
  VkBufferImageCopy region{};
  region.bufferOffset = StagingAt(s, staging.subresource, staging.x, staging.y, staging.z);
  region.bufferRowLength = AlignUp(m.width, block);
  region.bufferImageHeight = AlignUp(m.height, block);
  region.imageSubresource = t.Layers(t.One(image.subresource));
  region.imageOffset = Offset(image.x, image.y, image.z);
  region.imageExtent = Extent(box);
  if (toImage) {
    vk_.vkCmdCopyBufferToImage(cmd_, s.staging.handle, t.image, kCopyDest.layout, 1, &region);
  } else {
    vk_.vkCmdCopyImageToBuffer(cmd_, t.image, kCopySource.layout, s.staging.handle, 1, &region);
  }
  FinishStaging(s.staging, !toImage);
}

void Context::CopyStaging(const TextureRegion& dst, const TextureRegion& src, const Box& box) {
  const FormatInfo& f = GetFormatInfo(dst.texture->Desc().format);
  const VkDeviceSize bytes = VkDeviceSize((box.right - box.left + f.blockSize - 1) / f.blockSize) * f.blockBytes;
  std::vector<VkBufferCopy> rows;
  for (uint32_t z = 0; z < box.back - box.front; ++z)
    for (uint32_t y = 0; y < box.bottom - box.top; y += f.blockSize)
      rows.push_back({StagingAt(*src.texture, src.subresource, src.x, src.y + y, src.z + z),
                      StagingAt(*dst.texture, dst.subresource, dst.x, dst.y + y, dst.z + z), bytes});
  if (src.texture == dst.texture) {
    Access both = kCopyDest;
    both.access |= kCopySource.access;
    UseStaging(dst.texture->staging, both);
  } else {
    UseStaging(src.texture->staging, kCopySource);
    UseStaging(dst.texture->staging, kCopyDest);
  }
  RecordBarriers();
  vk_.vkCmdCopyBuffer(cmd_, src.texture->staging.handle, dst.texture->staging.handle, uint32_t(rows.size()),
                      rows.data());
  FinishStaging(src.texture->staging, false);
  FinishStaging(dst.texture->staging, true);
}

void Context::ResolveSubresource(ITexture* dst, uint32_t dstSubresource, ITexture* src, uint32_t srcSubresource,
                                 Format format) {
  if (core_->lost) return;
  if (!dst || !src)
    return Complain(MsgCode::InvalidDesc, "", "ResolveSubresource: a texture is null; the call is ignored");
  auto &to = static_cast<Texture&>(*dst), &from = static_cast<Texture&>(*src);
  const backend::Misuse misuse =
      backend::CheckResolve({to.Desc(), dstSubresource}, {from.Desc(), srcSubresource}, format);
  if (misuse.Refuses(log_, to.Name().c_str())) return;
  const backend::MipLayout m = backend::GetMipLayout(to.Desc(), to.One(dstSubresource).mip);
  LeavePass();
  Use(from, from.One(srcSubresource), kCopySource);
  Use(to, to.One(dstSubresource), kCopyDest);
  RecordBarriers();
  VkImageResolve region{};
  region.srcSubresource = from.Layers(from.One(srcSubresource));
  region.dstSubresource = to.Layers(to.One(dstSubresource));
  region.extent = {m.width, m.height, 1};
  vk_.vkCmdResolveImage(cmd_, from.image, kCopySource.layout, to.image, kCopyDest.layout, 1, &region);
}

void Context::GenerateMips(IShaderResourceView* target) {
  auto* view = static_cast<ShaderView*>(target);
  if (core_->lost) return;
  if (!view || !view->texture)
    return Complain(MsgCode::InvalidDesc, "", "GenerateMips needs a view of a texture; the call is ignored");
  Texture& t = *view->texture;
  const FormatSupport support = QueryFormatSupport(core_->instance.vk, core_->adapter.handle, t.Desc().format);
  if (backend::CheckGenerateMips(t.Desc(), view->Desc().format, support).Refuses(log_, t.Name().c_str())) return;
  LeavePass();
  const SubresourceRange range = view->Range();
  for (uint32_t mip = range.mip + 1; mip < range.mip + range.mips; ++mip) Blit(t, range, mip);
}

// One mip from the one above it. The linear filter meets four texels at their common corner: the box filter.
void Context::Blit(Texture& t, const SubresourceRange& range, uint32_t mip) {
  const SubresourceRange above{mip - 1, 1, range.slice, range.slices}, below{mip, 1, range.slice, range.slices};
  Use(t, above, kCopySource);
  Use(t, below, kCopyDest);
  RecordBarriers();
  const backend::MipLayout from = backend::GetMipLayout(t.Desc(), mip - 1), to = backend::GetMipLayout(t.Desc(), mip);
  VkImageBlit region{};
  region.srcSubresource = t.Layers(above);
  region.srcOffsets[1] = Offset(from.width, from.height, from.depth);
  region.dstSubresource = t.Layers(below);
  region.dstOffsets[1] = Offset(to.width, to.height, to.depth);
  vk_.vkCmdBlitImage(cmd_, t.image, kCopySource.layout, t.image, kCopyDest.layout, 1, &region, VK_FILTER_LINEAR);
}

}  // namespace rhi_vulkan

// IDevice::ReadBack: a copy, a submission, a wait.
#include <cstring>

#include "context.h"
#include "rhi/backend/data_checks.h"

namespace rhi_vulkan {
namespace {

// The bytes of one texel in a copy of the depth aspect.
uint32_t DepthBytes(Format format) { return format == Format::D16_UNorm ? 2 : 4; }

// Puts the two aspects of a depth-stencil texel together, as DXGI lays them out.
void Interleave(Format format, const uint8_t* depth, const uint8_t* stencil, uint8_t* out) {
  uint32_t d = 0;
  std::memcpy(&d, depth, 4);
  if (format == Format::D24_UNorm_S8_UInt) {
    d = (d & 0xFFFFFFu) | uint32_t(*stencil) << 24;
    std::memcpy(out, &d, 4);
    return;
  }
  const uint32_t s = *stencil;
  std::memcpy(out, &d, 4);
  std::memcpy(out + 4, &s, 4);
}

void CopyRows(const backend::MipLayout& m, Format format, const uint8_t* in, VkDeviceSize stencilAt, uint8_t* out,
              uint32_t rowPitch) {
  const bool both = GetFormatInfo(format).stencil;
  const uint32_t texelBytes = GetFormatInfo(format).blockBytes;
  for (size_t row = 0; row < size_t(m.rows) * m.depth; ++row) {
    if (!both) {
      std::memcpy(out + row * rowPitch, in + row * m.rowBytes, m.rowBytes);
      continue;
    }
    for (size_t x = 0; x < m.width; ++x)
      Interleave(format, in + (row * m.width + x) * 4, in + stencilAt + row * m.width + x,
                 out + row * rowPitch + x * texelBytes);
  }
}

}  // namespace

void Context::CopyToBuffer(Texture& texture, uint32_t subresource, const backend::MipLayout& m, GpuBuffer& out,
                           VkDeviceSize stencilAt) {
  Use(texture, texture.One(subresource), kCopySource);
  RecordBarriers();
  std::array<VkBufferImageCopy, 2> regions{};
  uint32_t count = 0;
  for (const VkImageAspectFlagBits aspect :
       {VK_IMAGE_ASPECT_COLOR_BIT, VK_IMAGE_ASPECT_DEPTH_BIT, VK_IMAGE_ASPECT_STENCIL_BIT}) {
    if (!(texture.aspects & aspect)) continue;
    VkBufferImageCopy& region = regions[count++];
    region.bufferOffset = aspect == VK_IMAGE_ASPECT_STENCIL_BIT ? stencilAt : 0;
    region.imageSubresource = texture.Layers(texture.One(subresource));
    region.imageSubresource.aspectMask = aspect;
    region.imageExtent = {m.width, m.height, m.depth};
  }
  vk_.vkCmdCopyImageToBuffer(cmd_, texture.image, kCopySource.layout, out.handle, count, regions.data());
  UseStaging(out, kCopyDest);
  FinishStaging(out, true);
}

Status Context::ReadTexture(Texture& texture, uint32_t subresource, void* out, size_t capacity, uint32_t rowPitch) {
  const TextureDesc& desc = texture.Desc();
  if (core_->lost) return Status::DeviceLost;
  const backend::Misuse misuse = backend::CheckReadBack(&desc, subresource, out, capacity, rowPitch);
  if (misuse.Refuses(log_, texture.Name().c_str())) return Status::InvalidArg;
  const backend::MipLayout m = backend::GetMipLayout(desc, texture.One(subresource).mip);
  const uint32_t pitch = rowPitch ? rowPitch : m.rowBytes;
  if (texture.IsStaging()) {
    if (Status s = WaitForSerial(texture.staging.lastUse); s != Status::Ok) return s;
    const uint8_t* in = texture.staging.memory.mapped + texture.stagingOffset[subresource];
    CopyRows(m, desc.format, in, 0, static_cast<uint8_t*>(out), pitch);
    return Status::Ok;
  }
  const bool both = GetFormatInfo(desc.format).stencil;
  const VkDeviceSize texels = VkDeviceSize(m.width) * m.height * m.depth;
  const VkDeviceSize stencilAt = both ? texels * DepthBytes(desc.format) : 0;
  const VkDeviceSize size = both ? stencilAt + texels : m.sliceBytes * m.depth;
  GpuBuffer buffer;
  Status s = buffer.Create(*core_, "rhi readback", size, VK_BUFFER_USAGE_TRANSFER_DST_BIT, MemoryKind::Readback);
  if (s == Status::Ok) {
    LeavePass();
    CopyToBuffer(texture, subresource, m, buffer, stencilAt);
    s = Finish();
  }
  if (s == Status::Ok) CopyRows(m, desc.format, buffer.memory.mapped, stencilAt, static_cast<uint8_t*>(out), pitch);
  buffer.Destroy(*core_);
  return s;
}

Status Context::ReadBuffer(Buffer& source, uint32_t offset, uint32_t size, void* out) {
  if (core_->lost) return Status::DeviceLost;
  const backend::Misuse misuse = backend::CheckReadBack(&source.Desc(), offset, size, out);
  if (misuse.Refuses(log_, source.Name().c_str())) return Status::InvalidArg;
  if (size == 0) return Status::Ok;
  if (source.IsDynamic()) {
    std::memcpy(out, source.slice.Data() + offset, size);
    return Status::Ok;
  }
  if (source.GetUsage() == Usage::Staging) {
    const Status s = WaitForSerial(source.gpu.lastUse);
    if (s == Status::Ok) std::memcpy(out, source.gpu.memory.mapped + offset, size);
    return s;
  }
  GpuBuffer buffer;
  Status s = buffer.Create(*core_, "rhi readback", size, VK_BUFFER_USAGE_TRANSFER_DST_BIT, MemoryKind::Readback);
  if (s == Status::Ok) {
    LeavePass();
    Use(source, kCopySource);
    RecordBarriers();
    const VkBufferCopy region{offset, 0, size};
    vk_.vkCmdCopyBuffer(cmd_, source.Handle(), buffer.handle, 1, &region);
    UseStaging(buffer, kCopyDest);
    FinishStaging(buffer, true);
    s = Finish();
  }
  if (s == Status::Ok) std::memcpy(out, buffer.memory.mapped, size);
  buffer.Destroy(*core_);
  return s;
}

}  // namespace rhi_vulkan

// Data from the CPU: contents of new resources, and UpdateSubresource.
#include <cstring>

#include "context.h"
#include "rhi/backend/data_checks.h"

namespace rhi_vulkan {
namespace {

Box WholeMip(const backend::MipLayout& m) { return {0, 0, 0, m.width, m.height, m.depth}; }

}  // namespace

void Context::Complain(MsgCode code, const char* object, const char* text) {
  log_.Report(Severity::Error, code, object, "%s", text);
}

Status Context::InitBuffer(Buffer& buffer, const void* data) {
  const uint32_t size = buffer.Desc().byteWidth;
  if (buffer.IsDynamic()) {
    std::memcpy(buffer.slice.Data(), data, size);
    return Status::Ok;
  }
  if (buffer.gpu.memory.mapped) {
    std::memcpy(buffer.gpu.memory.mapped, data, size);
    return Status::Ok;
  }
  Slice slice;
  core_->SpeakAgain();
  if (!ring_.Take(AlignUp(size, ring_.Alignment()), &slice)) return core_->Failure();
  std::memcpy(slice.Data(), data, size);
  const VkBufferCopy region{slice.offset, 0, size};
  const VkCommandBuffer setup = Setup();
  vk_.vkCmdCopyBuffer(setup, slice.page->buffer, buffer.gpu.handle, 1, &region);
  Access write = kCopyDest;
  write.layout = VK_IMAGE_LAYOUT_UNDEFINED;
  Advance(buffer.gpu.state, write);
  return Status::Ok;
}

Status Context::InitTexture(Texture& texture, const SubresourceData* data) {
  if (!texture.IsStaging()) {
    BarrierBatch barriers;
    texture.Advance(texture.All(), kCopyDest, barriers);
    stats_.barriers += barriers.Record(vk_, Setup());
  }
  core_->SpeakAgain();
  for (uint32_t i = 0; i < texture.SubresourceCount(); ++i) {
    const Box box = WholeMip(backend::GetMipLayout(texture.Desc(), texture.One(i).mip));
    if (!Upload(texture.IsStaging() ? VK_NULL_HANDLE : Setup(), texture, i, box, data[i])) return core_->Failure();
  }
  return Status::Ok;
}

void Context::UpdateSubresource(IResource* resource, uint32_t subresource, const Box* box, const void* data,
                                uint32_t rowPitch, uint32_t slicePitch) {
  if (core_->lost) return;
  if (!resource || !data)
    return Complain(MsgCode::InvalidDesc, "", "UpdateSubresource: the resource or the data is null; it is ignored");
  if (Buffer* buffer = AsBuffer(resource)) {
    const backend::Misuse misuse = backend::CheckUpdate(buffer->Desc(), box);
    if (!misuse.Refuses(log_, buffer->Name().c_str())) UpdateBuffer(*buffer, box, data);
    return;
  }
  auto& texture = static_cast<Texture&>(*resource);
  const backend::Misuse misuse = backend::CheckUpdate(texture.Desc(), subresource, box, rowPitch, slicePitch);
  if (!misuse.Refuses(log_, texture.Name().c_str()))
    UpdateTexture(texture, subresource, box, {data, rowPitch, slicePitch});
}

void Context::UpdateBuffer(Buffer& buffer, const Box* box, const void* data) {
  const uint32_t width = buffer.Desc().byteWidth;
  const uint32_t left = box ? box->left : 0, right = box ? box->right : width;
  const uint32_t size = right - left;
  Slice slice;
  if (size == 0 || !ring_.Take(AlignUp(size, ring_.Alignment()), &slice)) return;
  std::memcpy(slice.Data(), data, size);
  LeavePass();
  Use(buffer, kCopyDest);
  RecordBarriers();
  const VkBufferCopy region{slice.offset, left, size};
  vk_.vkCmdCopyBuffer(cmd_, slice.page->buffer, buffer.gpu.handle, 1, &region);
  dirty_ |= backend::DirtyVertexBuffers | backend::DirtyIndexBuffer | backend::DirtyConstants;
}

void Context::UpdateTexture(Texture& texture, uint32_t subresource, const Box* box, const SubresourceData& data) {
  const Box b = box ? *box : WholeMip(backend::GetMipLayout(texture.Desc(), texture.One(subresource).mip));
  if (b.left == b.right || b.top == b.bottom || b.front == b.back) return;
  LeavePass();
  Use(texture, texture.One(subresource), kCopyDest);
  RecordBarriers();
  Upload(cmd_, texture, subresource, b, data);
}

// Copies the rows to the ring, and from there into the subresource, which is in the layout for it. A staging texture is
// written directly.
bool Context::Upload(VkCommandBuffer cmd, Texture& texture, uint32_t subresource, const Box& b,
                     const SubresourceData& data) {
  TextureDesc part = texture.Desc();
  part.width = b.right - b.left;
  part.height = b.bottom - b.top;
  part.depthOrArray = b.back - b.front;
  const backend::MipLayout m = backend::GetMipLayout(part, 0);
  const uint32_t rowPitch = data.rowPitch ? data.rowPitch : m.rowBytes;
  const uint32_t slicePitch = data.slicePitch ? data.slicePitch : rowPitch * m.rows;
  const uint64_t size = m.sliceBytes * m.depth;
  Slice slice;
  if (!texture.IsStaging() && (size > 0xF0000000u || !ring_.Take(AlignUp(uint32_t(size), ring_.Alignment()), &slice)))
    return false;
  uint8_t* out =
      texture.IsStaging() ? texture.staging.memory.mapped + texture.stagingOffset[subresource] : slice.Data();
  for (uint32_t z = 0; z < m.depth; ++z)
    for (uint32_t row = 0; row < m.rows; ++row, out += m.rowBytes)
      std::memcpy(out, static_cast<const uint8_t*>(data.data) + size_t(z) * slicePitch + size_t(row) * rowPitch,
                  m.rowBytes);
  if (texture.IsStaging()) return true;
  VkBufferImageCopy region{};
  region.bufferOffset = slice.offset;
  region.imageSubresource = texture.Layers(texture.One(subresource));
  region.imageOffset = {int32_t(b.left), int32_t(b.top), int32_t(b.front)};
  region.imageExtent = {m.width, m.height, m.depth};
  vk_.vkCmdCopyBufferToImage(cmd, slice.page->buffer, texture.image, kCopyDest.layout, 1, &region);
  return true;
}

}  // namespace rhi_vulkan

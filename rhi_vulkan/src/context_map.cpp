// CPU access: constants, dynamic buffers, staging.
#include <cstring>

#include "context.h"
#include "rhi/backend/data_checks.h"

namespace rhi_vulkan {

// The hot path, with Draw: fresh memory for the buffer; draws already recorded keep the old.
inline bool Context::DiscardInPage(Buffer& buffer) {
  if (!ring_.TakeInPage(buffer.slice.page, buffer.alignedWidth, &buffer.slice.offset)) [[unlikely]]
    return false;
  *buffer.offsetEntry = buffer.slice.offset;
  dirty_ |= buffer.dirtyOnDiscard;
  stats_.ringBytes += buffer.alignedWidth;
  return true;
}

bool Context::DiscardInNewPage(Buffer& buffer) {
  Slice fresh;
  if (!ring_.Take(buffer.alignedWidth, &fresh)) return false;
  ring_.Repin(buffer.slice.page, fresh.page);
  buffer.slice = fresh;
  dirty_ |= backend::DirtyConstants | buffer.dirtyOnDiscard;  // another page: another descriptor
  stats_.ringBytes += buffer.alignedWidth;
  return true;
}

bool Context::Discard(Buffer& buffer) { return DiscardInPage(buffer) || DiscardInNewPage(buffer); }

void Context::UpdateConstants(IBuffer* target, const void* data, uint32_t size) {
  auto* buffer = static_cast<Buffer*>(target);
  if (!buffer || !(buffer->dirtyOnDiscard & kDirtyOffsets) || size > buffer->Desc().byteWidth ||
      !DiscardInPage(*buffer)) [[unlikely]]
    return UpdateInNewPage(buffer, data, size);
  std::memcpy(buffer->slice.Data(), data, size);
}

// UpdateConstants where the current page is full, or the arguments are wrong.
void Context::UpdateInNewPage(Buffer* buffer, const void* data, uint32_t size) {
  if (!buffer) return Report(Severity::Error, MsgCode::NothingBound, "", "UpdateConstants of no buffer");
  if (backend::CheckUpdateConstants(buffer->Desc(), size).Refuses(log_, buffer->Name().c_str())) return;
  if (DiscardInNewPage(*buffer)) std::memcpy(buffer->slice.Data(), data, size);
}

Status Context::MapError(MsgCode code, const char* object, const char* text) {
  log_.Report(Severity::Error, code, object, "%s", text);
  return Status::InvalidArg;
}

Status Context::Map(IResource* resource, uint32_t subresource, MapMode mode, Mapped* out) {
  if (!out) return Status::InvalidArg;
  *out = {};
  if (core_->lost) return Status::DeviceLost;
  if (!resource) return MapError(MsgCode::InvalidDesc, "", "Map: the resource is null");
  if (auto* buffer = AsBuffer(resource)) return MapBuffer(*buffer, mode, out);
  return MapTexture(static_cast<Texture&>(*resource), subresource, mode, out);
}

Status Context::MapBuffer(Buffer& buffer, MapMode mode, Mapped* out) {
  const char* name = buffer.Name().c_str();
  if (backend::CheckMap(buffer.Desc(), mode).Refuses(log_, name)) return Status::InvalidArg;
  if (buffer.mapped) return MapError(MsgCode::MapTwice, name, "the buffer is mapped already; call Unmap first");
  const bool discard = mode == MapMode::WriteDiscard;
  core_->SpeakAgain();
  if (discard && !Discard(buffer)) return core_->Failure();
  if (buffer.IsDynamic()) {
    out->data = buffer.slice.Data();
  } else {
    if (Status s = WaitForSerial(buffer.gpu.lastUse); s != Status::Ok) return s;
    out->data = buffer.gpu.memory.mapped;
  }
  out->rowPitch = out->slicePitch = buffer.Desc().byteWidth;
  buffer.mapped = true;
  return Status::Ok;
}

Status Context::MapTexture(Texture& texture, uint32_t subresource, MapMode mode, Mapped* out) {
  const char* name = texture.Name().c_str();
  if (backend::CheckMap(texture.Desc(), subresource, mode).Refuses(log_, name)) return Status::InvalidArg;
  if (texture.mapped[subresource])
    return MapError(MsgCode::MapTwice, name, "the subresource is mapped already; call Unmap first");
  if (Status s = WaitForSerial(texture.staging.lastUse); s != Status::Ok) return s;
  const backend::MipLayout m = backend::GetMipLayout(texture.Desc(), texture.One(subresource).mip);
  *out = {texture.staging.memory.mapped + texture.stagingOffset[subresource], m.rowBytes, uint32_t(m.sliceBytes)};
  texture.mapped[subresource] = true;
  return Status::Ok;
}

void Context::Unmap(IResource* resource, uint32_t subresource) {
  if (!resource) {
    MapError(MsgCode::InvalidDesc, "", "Unmap: the resource is null; the call is ignored");
    return;
  }
  bool wasMapped = false;
  if (auto* buffer = AsBuffer(resource)) {
    wasMapped = std::exchange(buffer->mapped, false);
  } else if (auto& texture = static_cast<Texture&>(*resource); subresource < texture.mapped.size()) {
    wasMapped = texture.mapped[subresource];
    texture.mapped[subresource] = false;
  }
  if (!wasMapped) MapError(MsgCode::MapMode, "", "Unmap of a resource that is not mapped");
}

}  // namespace rhi_vulkan

// Data from the CPU: Map, constants; and back: ReadBack.
#include <bit>
#include <cstring>

#include "context.h"
#include "rhi/backend/data_checks.h"

namespace rhi_gl {

using namespace backend;

namespace {

// `size` is one register or more. Cheaper than memcpy for as few as constants are, and from the back, where the end of
// the loop needs no comparison of its own.
inline void CopyRegisters(std::byte* to, const void* from, uint32_t size) {
  const auto* source = static_cast<const std::byte*>(from);
  uint64_t at = size;
  do {
    at -= kRegisterBytes;
    std::memcpy(to + at, source + at, kRegisterBytes);
  } while (at != 0);
}

}  // namespace

// The hottest call of all: its conditions are few, and its ways out are tail calls, so that it saves no registers.
void Context::UpdateConstants(IBuffer* target, const void* data, uint32_t size) {
  auto* buffer = static_cast<Buffer*>(target);
  if (!buffer || size != buffer->quickSize || !ring_.IsAtHand(*buffer)) [[unlikely]]
    return UpdateElsewhere(buffer, data, size);
  std::byte* const slice = ring_.Advance(*buffer);
  const uint32_t offset = buffer->offset;
  CopyRegisters(slice, data, size);
  glBindBufferRange(GL_UNIFORM_BUFFER, buffer->quickSlot, buffer->name, offset, buffer->range);
}

// Whatever is not as it was at the last update: the size, the page, the current context; and mistakes.
void Context::UpdateElsewhere(Buffer* buffer, const void* data, uint32_t size) {
  if (!buffer) return Refuse(MsgCode::NothingBound, "", "UpdateConstants", "the buffer is null");
  if (CheckUpdateConstants(buffer->Desc(), size).Refuses(log_, buffer->Desc().name)) return;
  std::byte* slice = Enter() ? ring_.Rename(*buffer) : nullptr;
  if (!slice) return;
  std::memcpy(slice, data, size);
  dirty_ |= buffer->boundSlots * DirtyConstantSlot;
  if (size == 0 || size % kRegisterBytes != 0 || !std::has_single_bit(buffer->boundSlots)) return;
  buffer->quickSize = size;
  buffer->quickSlot = uint32_t(std::countr_zero(buffer->boundSlots));
}

void Context::MarkMoved(const Buffer& buffer) {
  const Bind bind = buffer.Desc().bind;
  dirty_ |= buffer.boundSlots * DirtyConstantSlot;
  if (bind & Bind::VertexBuffer) dirty_ |= DirtyVertexBuffers;
  if (bind & Bind::IndexBuffer) dirty_ |= DirtyIndexBuffer;
  if (bind & Bind::ShaderResource) dirty_ |= 0xFu * DirtyResources;
}

Status Context::RefuseMap(const char* name, MsgCode code, const char* why) const {
  log_.Report(Severity::Error, code, name, "Map: %s", why);
  return Status::InvalidArg;
}

Status Context::WaitForCopies(bool* touched) {
  if (!std::exchange(*touched, false)) return Status::Ok;
  return FinishAll();
}

Status Context::MapBuffer(Buffer& b, MapMode mode, Mapped* out) {
  const char* name = b.Desc().name;
  const bool staging = b.GetUsage() == Usage::Staging, discard = mode == MapMode::WriteDiscard;
  if (CheckMap(b.Desc(), mode).Refuses(log_, name)) return Status::InvalidArg;
  if (b.mapped) return RefuseMap(name, MsgCode::MapTwice, "the buffer is mapped already; call Unmap first");
  if (staging)
    if (Status s = WaitForCopies(&b.gpuTouched); s != Status::Ok) return s;
  std::byte* data = b.data;
  if (discard) {
    data = b.IsRingConstant() ? ring_.Rename(b) : b.Rename();
    if (!b.IsRingConstant()) stats_.ringBytes += b.Desc().byteWidth;
    MarkMoved(b);
  }
  if (!data) return core_.IsLost() ? Status::DeviceLost : Status::OutOfMemory;
  b.mapped = true;
  *out = {data, b.Desc().byteWidth, b.Desc().byteWidth};
  return Status::Ok;
}

Status Context::MapTexture(Texture& t, uint32_t subresource, MapMode mode, Mapped* out) {
  const char* name = t.Desc().name;
  if (CheckMap(t.Desc(), subresource, mode).Refuses(log_, name)) return Status::InvalidArg;
  if (t.mapped[subresource]) return RefuseMap(name, MsgCode::MapTwice, "it is mapped already; call Unmap first");
  if (Status s = WaitForCopies(&t.gpuTouched); s != Status::Ok) return s;
  const MipLayout m = t.Layout(subresource);
  std::byte* data = t.stagingData + t.StagingOffset(subresource);
  t.mapped[subresource] = true;
  *out = {data, m.rowBytes, uint32_t(m.sliceBytes)};
  return Status::Ok;
}

Status Context::Map(IResource* resource, uint32_t subresource, MapMode mode, Mapped* out) {
  *out = {};
  if (!Settle()) return Status::DeviceLost;
  if (Buffer* b = AsBuffer(resource)) return MapBuffer(*b, mode, out);
  if (Texture* t = AsTexture(resource)) return MapTexture(*t, subresource, mode, out);
  return RefuseMap("", MsgCode::InvalidDesc, "the resource is null");
}

void Context::Unmap(IResource* resource, uint32_t subresource) {
  Buffer* b = AsBuffer(resource);
  Texture* t = AsTexture(resource);
  const bool known = t && subresource < t->mapped.size() && t->mapped[subresource];
  if (b ? !b->mapped : !known) {
    RefuseMap(b   ? b->Desc().name
              : t ? t->Desc().name
                  : "",
              resource ? MsgCode::MapMode : MsgCode::InvalidDesc, "Unmap of what is not mapped");
    return;
  }
  if (b) b->mapped = false;
  if (b) return;
  t->mapped[subresource] = false;
}

// --------------------------------------------------------------------------------------------------------- read-back

namespace {

void CopyStagingRows(const Texture& t, uint32_t subresource, std::byte* out, uint32_t rowPitch) {
  const MipLayout m = t.Layout(subresource);
  const std::byte* from = t.stagingData + t.StagingOffset(subresource);
  for (uint64_t row = 0; row < uint64_t(m.rows) * m.depth; ++row)
    std::memcpy(out + row * rowPitch, from + row * m.rowBytes, m.rowBytes);
}

}  // namespace

Status Context::ReadBack(ITexture* texture, uint32_t subresource, void* out, size_t capacity, uint32_t rowPitch) {
  const Texture* t = AsTexture(texture);
  const Misuse misuse = CheckReadBack(t ? &t->Desc() : nullptr, subresource, out, capacity, rowPitch);
  if (misuse.Refuses(log_, t ? t->Desc().name : "")) return Status::InvalidArg;
  if (rowPitch == 0) rowPitch = t->Layout(subresource).rowBytes;
  if (!Settle()) return Status::DeviceLost;
  if (Status s = FinishAll(); s != Status::Ok) return s;
  if (t->IsStaging()) {
    CopyStagingRows(*t, subresource, static_cast<std::byte*>(out), rowPitch);
    return Status::Ok;
  }
  TexelBlock block;
  MakeBlock(t->Desc(), t->MipOf(subresource), t->SliceOf(subresource), nullptr, &block);
  Download(*t, block, out, rowPitch, rowPitch * t->Layout(subresource).rows);
  return Status::Ok;
}

Status Context::ReadBack(IBuffer* buffer, uint32_t offset, uint32_t size, void* out) {
  const Buffer* b = AsBuffer(buffer);
  const Misuse misuse = CheckReadBack(b ? &b->Desc() : nullptr, offset, size, out);
  if (misuse.Refuses(log_, b ? b->Desc().name : "")) return Status::InvalidArg;
  if (!Settle()) return Status::DeviceLost;
  if (Status s = FinishAll(); s != Status::Ok) return s;
  glGetNamedBufferSubData(b->name, GLintptr(uint64_t(b->offset) + offset), size, out);
  return Status::Ok;
}

}  // namespace rhi_gl

// Data of the null device: Map, updates, copies, read-back.
#include <cstring>

#include "null_context.h"
#include "rhi/backend/data_checks.h"

namespace rhi::null_backend {

using namespace backend;

namespace {

Box Whole(const MipLayout& m) { return {0, 0, 0, m.width, m.height, m.depth}; }

struct Rows {  // memory of texels, at the first of them
  std::byte* data;
  uint64_t rowPitch, slicePitch;
};

Rows RowsAt(Texture& t, uint32_t subresource, uint32_t x, uint32_t y, uint32_t z) {
  const MipLayout m = t.Layout(subresource);
  const FormatInfo& f = GetFormatInfo(t.Desc().format);
  const uint64_t offset =
      z * m.sliceBytes + uint64_t(y / f.blockSize) * m.rowBytes + uint64_t(x / f.blockSize) * f.blockBytes;
  return {t.texels[subresource].data() + offset, m.rowBytes, m.sliceBytes};
}

void CopyRows(const Rows& to, const Rows& from, const Box& size, Format format) {
  const FormatInfo& f = GetFormatInfo(format);
  const uint32_t block = f.blockSize;
  const uint64_t bytes = uint64_t(size.right - size.left + block - 1) / block * f.blockBytes;
  const uint32_t rows = (size.bottom - size.top + block - 1) / block;
  for (uint64_t z = 0; z < size.back - size.front; ++z)
    for (uint64_t y = 0; y < rows; ++y)
      std::memcpy(to.data + z * to.slicePitch + y * to.rowPitch, from.data + z * from.slicePitch + y * from.rowPitch,
                  bytes);
}

}  // namespace

Buffer* AsBuffer(IResource* r) { return dynamic_cast<Buffer*>(r); }
Texture* AsTexture(IResource* r) { return dynamic_cast<Texture*>(r); }

Texture::Texture(const TextureDesc& d, const SubresourceData* init)
    : desc_(d), texels(d.mipLevels * backend::SliceCount(d)), mapped(texels.size()) {
  SetName(d.name);
  for (uint32_t i = 0; i < texels.size(); ++i) {
    const MipLayout m = Layout(i);
    texels[i].resize(m.sliceBytes * m.depth);
    if (!init || !init[i].data) continue;
    const uint64_t rowPitch = init[i].rowPitch ? init[i].rowPitch : m.rowBytes;
    const uint64_t slicePitch = init[i].slicePitch ? init[i].slicePitch : rowPitch * m.rows;
    const auto* data = static_cast<const std::byte*>(init[i].data);
    CopyRows(RowsAt(*this, i, 0, 0, 0), {const_cast<std::byte*>(data), rowPitch, slicePitch}, Whole(m), d.format);
  }
}

Status Context::Refuse(MsgCode code, const char* object, const char* text) {
  log_.Report(Severity::Error, code, object, "%s", text);
  return Status::InvalidArg;
}

// ------------------------------------------------------------------------------------------------------- Map and Unmap

Status Context::Map(IResource* resource, uint32_t subresource, MapMode mode, Mapped* out) {
  *out = {};
  if (!resource) return Refuse(MsgCode::InvalidDesc, "", "Map: the resource is null");
  Buffer* b = AsBuffer(resource);
  Texture* t = AsTexture(resource);
  const char* name = b ? b->Desc().name : t->Desc().name;
  const Misuse misuse = b ? CheckMap(b->Desc(), mode) : CheckMap(t->Desc(), subresource, mode);
  if (misuse.Refuses(log_, name)) return Status::InvalidArg;
  if (b ? b->mapped : bool(t->mapped[subresource]))
    return Refuse(MsgCode::MapTwice, name, "Map: it is mapped already; call Unmap first");
  if (b) {
    b->mapped = true;
    if (b->GetUsage() == Usage::Dynamic) stats_.ringBytes += b->bytes.size();
    *out = {b->bytes.data(), b->Desc().byteWidth, b->Desc().byteWidth};
    return Status::Ok;
  }
  t->mapped[subresource] = true;
  *out = {t->texels[subresource].data(), t->Layout(subresource).rowBytes, uint32_t(t->Layout(subresource).sliceBytes)};
  return Status::Ok;
}

void Context::Unmap(IResource* resource, uint32_t subresource) {
  Buffer* b = AsBuffer(resource);
  Texture* t = AsTexture(resource);
  const bool known = t && subresource < t->SubresourceCount() && t->mapped[subresource];
  if (b ? !b->mapped : !known) {
    Refuse(resource ? MsgCode::MapMode : MsgCode::InvalidDesc, "", "Unmap of what is not mapped; the call is ignored");
    return;
  }
  if (b) b->mapped = false;
  if (t) t->mapped[subresource] = false;
}

// ------------------------------------------------------------------------------------------------------------- updates

void Context::UpdateConstants(IBuffer* target, const void* data, uint32_t size) {
  Buffer* b = AsBuffer(target);
  if (!b) {
    Refuse(MsgCode::NothingBound, "", "UpdateConstants: the buffer is null; the call is ignored");
    return;
  }
  if (CheckUpdateConstants(b->Desc(), size).Refuses(log_, b->Desc().name)) return;
  std::memcpy(b->bytes.data(), data, size);
  stats_.ringBytes += size;
}

void Context::UpdateSubresource(IResource* dst, uint32_t subresource, const Box* box, const void* data,
                                uint32_t rowPitch, uint32_t slicePitch) {
  Buffer* b = AsBuffer(dst);
  Texture* t = AsTexture(dst);
  if ((!b && !t) || !data) {
    Refuse(MsgCode::InvalidDesc, "", "UpdateSubresource: the resource or the data is null");
    return;
  }
  const char* name = b ? b->Desc().name : t->Desc().name;
  const Misuse misuse =
      b ? CheckUpdate(b->Desc(), box) : CheckUpdate(t->Desc(), subresource, box, rowPitch, slicePitch);
  if (misuse.Refuses(log_, name)) return;
  if (b) {
    const uint32_t left = box ? box->left : 0, right = box ? box->right : b->Desc().byteWidth;
    std::memcpy(b->bytes.data() + left, data, right - left);
    return;
  }
  const Box range = box ? *box : Whole(t->Layout(subresource));
  const FormatInfo& f = GetFormatInfo(t->Desc().format);
  const uint32_t tight = (range.right - range.left + f.blockSize - 1) / f.blockSize * f.blockBytes;
  const uint64_t row = rowPitch ? rowPitch : tight;
  const uint64_t slice = slicePitch ? slicePitch : row * ((range.bottom - range.top + f.blockSize - 1) / f.blockSize);
  auto* from = const_cast<std::byte*>(static_cast<const std::byte*>(data));
  CopyRows(RowsAt(*t, subresource, range.left, range.top, range.front), {from, row, slice}, range, t->Desc().format);
}

// ------------------------------------------------------------------------------------------------------------- copies

void Context::CopyBuffers(Buffer& dst, uint32_t at, const Buffer& src, const Box* box) {
  const size_t left = box ? box->left : 0, right = box ? box->right : src.bytes.size();
  std::memcpy(dst.bytes.data() + at, src.bytes.data() + left, right - left);
}

void Context::CopyTextures(const Side& dst, const Side& src, const Box* box) {
  const Box s = box ? *box : Whole(src.texture.Layout(src.subresource));
  CopyRows(RowsAt(dst.texture, dst.subresource, dst.x, dst.y, dst.z),
           RowsAt(src.texture, src.subresource, s.left, s.top, s.front), s, dst.texture.Desc().format);
}

// Null, or a buffer and a texture.
bool Context::CheckKinds(IResource* dst, IResource* src) {
  if (!dst || !src) {
    Refuse(MsgCode::InvalidDesc, "", "a copy of a resource that is null; the call is ignored");
    return false;
  }
  return !AsBuffer(dst) == !AsBuffer(src) || !CheckCopyKinds(dst->GetUsage()).Refuses(log_, "");
}

void Context::CopyResource(IResource* dst, IResource* src) {
  if (!CheckKinds(dst, src)) return;
  if (Buffer* to = AsBuffer(dst)) {
    const Buffer& from = *AsBuffer(src);
    if (!CheckCopyAll(to->Desc(), from.Desc(), dst == src).Refuses(log_, to->Desc().name))
      CopyBuffers(*to, 0, from, nullptr);
    return;
  }
  Texture &to = *AsTexture(dst), &from = *AsTexture(src);
  if (CheckCopyAll(to.Desc(), from.Desc(), dst == src).Refuses(log_, to.Desc().name)) return;
  for (uint32_t i = 0; i < to.SubresourceCount(); ++i) CopyTextures({to, i, 0, 0, 0}, {from, i, 0, 0, 0}, nullptr);
}

void Context::CopySubresourceRegion(IResource* dst, uint32_t dstSubresource, uint32_t x, uint32_t y, uint32_t z,
                                    IResource* src, uint32_t srcSubresource, const Box* box) {
  if (!CheckKinds(dst, src)) return;
  if (Buffer* to = AsBuffer(dst)) {
    const Buffer& from = *AsBuffer(src);
    if (!CheckCopy(to->Desc(), x, from.Desc(), box, dst == src).Refuses(log_, to->Desc().name))
      CopyBuffers(*to, x, from, box);
    return;
  }
  Texture &to = *AsTexture(dst), &from = *AsTexture(src);
  const Misuse misuse = CheckCopy({to.Desc(), dstSubresource, x, y, z}, {from.Desc(), srcSubresource}, box, dst == src);
  if (!misuse.Refuses(log_, to.Desc().name))
    CopyTextures({to, dstSubresource, x, y, z}, {from, srcSubresource, 0, 0, 0}, box);
}

void Context::ResolveSubresource(ITexture* dst, uint32_t dstSubresource, ITexture* src, uint32_t srcSubresource,
                                 Format format) {
  if (!CheckKinds(dst, src)) return;
  Texture &to = *AsTexture(dst), &from = *AsTexture(src);
  const Misuse misuse = CheckResolve({to.Desc(), dstSubresource}, {from.Desc(), srcSubresource}, format);
  if (!misuse.Refuses(log_, to.Desc().name)) to.texels[dstSubresource] = from.texels[srcSubresource];
}

// Nothing is made; only the arguments are checked.
void Context::GenerateMips(IShaderResourceView* view) {
  const Texture* t = view ? AsTexture(view->Resource()) : nullptr;
  if (!t) {
    Refuse(MsgCode::InvalidDesc, "", "GenerateMips needs a view of a texture; the call is ignored");
    return;
  }
  const FormatSupport support = device_.CheckFormatSupport(t->Desc().format);
  CheckGenerateMips(t->Desc(), view->Desc().format, support).Refuses(log_, t->Desc().name);
}

// ----------------------------------------------------------------------------------------------------------- read-back

Status Context::ReadBack(ITexture* texture, uint32_t subresource, void* out, size_t capacity, uint32_t rowPitch) {
  Texture* t = AsTexture(texture);
  const Misuse misuse = CheckReadBack(t ? &t->Desc() : nullptr, subresource, out, capacity, rowPitch);
  if (misuse.Refuses(log_, t ? t->Desc().name : "")) return Status::InvalidArg;
  const MipLayout m = t->Layout(subresource);
  if (rowPitch == 0) rowPitch = m.rowBytes;
  CopyRows({static_cast<std::byte*>(out), rowPitch, uint64_t(rowPitch) * m.rows}, RowsAt(*t, subresource, 0, 0, 0),
           Whole(m), t->Desc().format);
  return Status::Ok;
}

Status Context::ReadBack(IBuffer* buffer, uint32_t offset, uint32_t size, void* out) {
  const Buffer* b = AsBuffer(buffer);
  const Misuse misuse = CheckReadBack(b ? &b->Desc() : nullptr, offset, size, out);
  if (misuse.Refuses(log_, b ? b->Desc().name : "")) return Status::InvalidArg;
  std::memcpy(out, b->bytes.data() + offset, size);
  return Status::Ok;
}

}  // namespace rhi::null_backend

// Data of the null device: Map, updates, copies, read-back.
#include <cstring>

#include "null_context.h"

namespace rhi::null_backend {

using backend::MipLayout;

namespace {

Box Whole(const MipLayout& m) { return {0, 0, 0, m.width, m.height, m.depth}; }

// Within the mip, and on whole blocks.
bool Fits(const Box& b, const MipLayout& m, Format format) {
  const uint32_t block = GetFormatInfo(format).blockSize;
  const auto edge = [block](uint32_t end, uint32_t whole) { return end % block == 0 || end == whole; };
  return b.left <= b.right && b.top <= b.bottom && b.front <= b.back && b.right <= m.width && b.bottom <= m.height &&
         b.back <= m.depth && b.left % block == 0 && b.top % block == 0 && edge(b.right, m.width) &&
         edge(b.bottom, m.height);
}

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
  const bool staging = resource->GetUsage() == Usage::Staging && (mode == MapMode::Read || mode == MapMode::Write);
  const bool dynamic =
      resource->GetUsage() == Usage::Dynamic && (mode == MapMode::WriteDiscard || mode == MapMode::WriteNoOverwrite);
  if (resource->GetUsage() == Usage::Immutable)
    return Refuse(MsgCode::ImmutableWrite, name, "Map: an Immutable resource cannot be mapped");
  if (!staging && !dynamic)
    return Refuse(MsgCode::MapMode, name,
                  "Map: Dynamic buffers take WriteDiscard and WriteNoOverwrite, Staging resources Read and Write");
  if (t && subresource >= t->SubresourceCount())
    return Refuse(MsgCode::SubresourceOutOfRange, name, "Map: the subresource does not exist");
  if (b ? b->mapped : bool(t->mapped[subresource]))
    return Refuse(MsgCode::MapTwice, name, "Map: it is mapped already; call Unmap first");
  if (b) {
    b->mapped = true;
    if (dynamic) stats_.ringBytes += b->bytes.size();
    *out = {b->bytes.data(), b->Desc().byteWidth, b->Desc().byteWidth};
    return Status::Ok;
  }
  t->mapped[subresource] = true;
  *out = {t->texels[subresource].data(), t->Layout(subresource).rowBytes, uint32_t(t->Layout(subresource).sliceBytes)};
  return Status::Ok;
}

void Context::Unmap(IResource* resource, uint32_t subresource) {
  if (Buffer* b = AsBuffer(resource)) b->mapped = false;
  Texture* t = AsTexture(resource);
  if (t && subresource < t->SubresourceCount()) t->mapped[subresource] = false;
}

// ------------------------------------------------------------------------------------------------------------- updates

bool Context::CheckWrite(const IResource* dst, const char* name) {
  if (dst->GetUsage() == Usage::Default || dst->GetUsage() == Usage::Staging) return true;
  Refuse(dst->GetUsage() == Usage::Immutable ? MsgCode::ImmutableWrite : MsgCode::MapMode, name,
         "the destination's usage must be Default or Staging; the call is ignored");
  return false;
}

void Context::UpdateConstants(IBuffer* target, const void* data, uint32_t size) {
  Buffer* b = AsBuffer(target);
  const bool constants = b && b->GetUsage() == Usage::Dynamic && (b->Desc().bind & Bind::ConstantBuffer);
  if (!constants || size > b->bytes.size()) {
    Refuse(!b          ? MsgCode::NothingBound
           : constants ? MsgCode::OutOfBounds
                       : MsgCode::MapMode,
           b ? b->Desc().name : "",
           "UpdateConstants needs a Dynamic constant buffer and at most its byteWidth of data; the call is ignored");
    return;
  }
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
  if (!CheckWrite(dst, name)) return;
  if (b) {
    const Box range = box ? *box : Box{0, 0, 0, b->Desc().byteWidth, 1, 1};
    const bool fits = range.left <= range.right && range.right <= b->bytes.size();
    if (fits) std::memcpy(b->bytes.data() + range.left, data, range.right - range.left);
    if (!fits) Refuse(MsgCode::OutOfBounds, name, "UpdateSubresource: the box is beyond the buffer");
    return;
  }
  if (subresource >= t->SubresourceCount()) {
    Refuse(MsgCode::SubresourceOutOfRange, name, "UpdateSubresource: the subresource does not exist");
    return;
  }
  const Box range = box ? *box : Whole(t->Layout(subresource));
  if (!Fits(range, t->Layout(subresource), t->Desc().format)) {
    Refuse(MsgCode::OutOfBounds, name, "UpdateSubresource: the box is beyond the subresource, or not on whole blocks");
    return;
  }
  const FormatInfo& f = GetFormatInfo(t->Desc().format);
  const uint32_t tight = (range.right - range.left + f.blockSize - 1) / f.blockSize * f.blockBytes;
  const uint64_t row = rowPitch ? rowPitch : tight;
  const uint64_t slice = slicePitch ? slicePitch : row * ((range.bottom - range.top + f.blockSize - 1) / f.blockSize);
  auto* from = const_cast<std::byte*>(static_cast<const std::byte*>(data));
  CopyRows(RowsAt(*t, subresource, range.left, range.top, range.front), {from, row, slice}, range, t->Desc().format);
}

// ------------------------------------------------------------------------------------------------------------- copies

void Context::CopyBuffers(Buffer& dst, uint32_t at, const Buffer& src, const Box* box) {
  if (!CheckWrite(&dst, dst.Desc().name)) return;
  const uint64_t left = box ? box->left : 0, right = box ? box->right : src.bytes.size();
  const bool fits = left <= right && right <= src.bytes.size() && at + (right - left) <= dst.bytes.size();
  const bool overlaps = &dst == &src && at < right && left < at + (right - left);
  if (fits && !overlaps)
    std::memcpy(dst.bytes.data() + at, src.bytes.data() + left, right - left);
  else
    Refuse(MsgCode::OutOfBounds, dst.Desc().name, "a copy reaches beyond the end of a buffer, or overlaps itself");
}

void Context::CopyTextures(const Side& dst, const Side& src, const Box* box) {
  const TextureDesc &a = dst.texture.Desc(), &b = src.texture.Desc();
  if (!CheckWrite(&dst.texture, a.name)) return;
  if (dst.subresource >= dst.texture.SubresourceCount() || src.subresource >= src.texture.SubresourceCount()) {
    Refuse(MsgCode::SubresourceOutOfRange, a.name, "a copy of a subresource that does not exist");
    return;
  }
  if (ToLinear(a.format) != ToLinear(b.format) || a.sampleCount != b.sampleCount) {
    Refuse(MsgCode::FormatMismatch, a.name, "a copy needs one format, or its sRGB twin, and one sample count");
    return;
  }
  const MipLayout from = src.texture.Layout(src.subresource), to = dst.texture.Layout(dst.subresource);
  const Box s = box ? *box : Whole(from);
  const Box d{dst.x, dst.y, dst.z, dst.x + (s.right - s.left), dst.y + (s.bottom - s.top), dst.z + (s.back - s.front)};
  const bool same = &dst.texture == &src.texture && dst.subresource == src.subresource;
  if (same || !Fits(s, from, b.format) || !Fits(d, to, a.format)) {
    Refuse(MsgCode::OutOfBounds, a.name, "a copy reaches beyond a subresource, or lies within one");
    return;
  }
  CopyRows(RowsAt(dst.texture, dst.subresource, d.left, d.top, d.front),
           RowsAt(src.texture, src.subresource, s.left, s.top, s.front), s, a.format);
}

void Context::CopyResource(IResource* dst, IResource* src) {
  Buffer *toBuffer = AsBuffer(dst), *fromBuffer = AsBuffer(src);
  Texture *to = AsTexture(dst), *from = AsTexture(src);
  const bool buffers = toBuffer && fromBuffer && toBuffer->bytes.size() == fromBuffer->bytes.size();
  if (buffers) return CopyBuffers(*toBuffer, 0, *fromBuffer, nullptr);
  if (!to || !from || to->Desc().width != from->Desc().width || to->Desc().height != from->Desc().height ||
      to->Desc().depthOrArray != from->Desc().depthOrArray || to->SubresourceCount() != from->SubresourceCount()) {
    Refuse(MsgCode::FormatMismatch, "", "CopyResource needs two buffers, or two textures, of one size; it is ignored");
    return;
  }
  for (uint32_t i = 0; i < to->SubresourceCount(); ++i) CopyTextures({*to, i, 0, 0, 0}, {*from, i, 0, 0, 0}, nullptr);
}

void Context::CopySubresourceRegion(IResource* dst, uint32_t dstSubresource, uint32_t x, uint32_t y, uint32_t z,
                                    IResource* src, uint32_t srcSubresource, const Box* box) {
  Buffer *toBuffer = AsBuffer(dst), *fromBuffer = AsBuffer(src);
  if (toBuffer && fromBuffer) return CopyBuffers(*toBuffer, x, *fromBuffer, box);
  Texture *to = AsTexture(dst), *from = AsTexture(src);
  if (to && from) return CopyTextures({*to, dstSubresource, x, y, z}, {*from, srcSubresource, 0, 0, 0}, box);
  Refuse(MsgCode::FormatMismatch, "", "CopySubresourceRegion needs two buffers, or two textures; it is ignored");
}

void Context::ResolveSubresource(ITexture* dst, uint32_t dstSubresource, ITexture* src, uint32_t srcSubresource,
                                 Format) {
  Texture *to = AsTexture(dst), *from = AsTexture(src);
  const bool fits = to && from && dstSubresource < to->SubresourceCount() &&
                    srcSubresource < from->SubresourceCount() && from->Desc().sampleCount > 1 &&
                    to->Desc().sampleCount == 1 && ToLinear(to->Desc().format) == ToLinear(from->Desc().format) &&
                    to->texels[dstSubresource].size() == from->texels[srcSubresource].size();
  if (fits)
    to->texels[dstSubresource] = from->texels[srcSubresource];
  else
    Refuse(MsgCode::FormatMismatch, to ? to->Desc().name : "",
           "ResolveSubresource needs a multisampled source and a destination of one sample, of one size and format");
}

// ----------------------------------------------------------------------------------------------------------- read-back

Status Context::ReadBack(ITexture* texture, uint32_t subresource, void* out, size_t capacity, uint32_t rowPitch) {
  Texture* t = AsTexture(texture);
  if (!t || subresource >= t->SubresourceCount())
    return Refuse(MsgCode::SubresourceOutOfRange, t ? t->Desc().name : "", "ReadBack: the subresource does not exist");
  if (t->Desc().sampleCount > 1)
    return Refuse(MsgCode::FormatMismatch, t->Desc().name, "ReadBack of a multisampled texture; resolve it first");
  const MipLayout m = t->Layout(subresource);
  if (rowPitch == 0) rowPitch = m.rowBytes;
  const uint64_t rows = uint64_t(m.rows) * m.depth;
  if (rowPitch < m.rowBytes || (rows - 1) * rowPitch + m.rowBytes > capacity)
    return Refuse(MsgCode::OutOfBounds, t->Desc().name,
                  "ReadBack needs room for all rows, and a rowPitch that holds one");
  CopyRows({static_cast<std::byte*>(out), rowPitch, uint64_t(rowPitch) * m.rows}, RowsAt(*t, subresource, 0, 0, 0),
           Whole(m), t->Desc().format);
  return Status::Ok;
}

Status Context::ReadBack(IBuffer* buffer, uint32_t offset, uint32_t size, void* out) {
  const Buffer* b = AsBuffer(buffer);
  if (!b || uint64_t(offset) + size > b->bytes.size())
    return Refuse(MsgCode::OutOfBounds, b ? b->Desc().name : "", "ReadBack beyond the end of the buffer");
  std::memcpy(out, b->bytes.data() + offset, size);
  return Status::Ok;
}

}  // namespace rhi::null_backend

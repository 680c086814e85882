// UpdateSubresource and copies, on the GPU's time line.
#include "context.h"

namespace rhi_gl {

using namespace backend;

namespace {

// Copies convert nothing: the formats are one, or twins in sRGB.
bool SameGroup(Format a, Format b) { return ToLinear(a) == ToLinear(b); }

bool BufferRange(const BufferDesc& desc, const Box* box, uint32_t* begin, uint32_t* size) {
  const uint32_t from = box ? box->left : 0, to = box ? box->right : desc.byteWidth;
  if (from >= to || to > desc.byteWidth) return false;
  *begin = from;
  *size = to - from;
  return true;
}

BufferPlace PlaceInStaging(const Texture& t, uint32_t subresource, const TexelBlock& b) {
  const FormatInfo& f = GetFormatInfo(t.Desc().format);
  const MipLayout m = t.Layout(subresource);
  const uint64_t z = b.z - t.SliceOf(subresource);  // the slice is in the subresource's own offset
  const uint64_t offset = t.StagingOffset(subresource) + z * m.sliceBytes + uint64_t(b.y / f.blockSize) * m.rowBytes +
                          uint64_t(b.x / f.blockSize) * f.blockBytes;
  return {t.stagingBuffer, offset, m.rowBytes, uint32_t(m.sliceBytes)};
}

bool BlockAligned(const Texture& t, const TexelBlock& b) {
  const uint32_t size = GetFormatInfo(t.Desc().format).blockSize;
  const MipLayout m = GetMipLayout(t.Desc(), b.mip);
  const auto edge = [&](uint32_t end, uint32_t whole) { return end % size == 0 || end == whole; };
  return b.x % size == 0 && b.y % size == 0 && edge(b.x + b.width, m.width) && edge(b.y + b.height, m.height);
}

const char* WhyNotCopy(const Texture& dst, const Texture& src) {
  if (!SameGroup(dst.Desc().format, src.Desc().format)) return "the formats differ; copies convert nothing";
  if (dst.Desc().sampleCount != src.Desc().sampleCount) return "the sample counts differ; use ResolveSubresource";
  return nullptr;
}

const char* WhyNotCopyAll(const Texture& dst, const Texture& src) {
  const TextureDesc &a = dst.Desc(), &b = src.Desc();
  const bool same = a.width == b.width && a.height == b.height && a.depthOrArray == b.depthOrArray &&
                    a.mipLevels == b.mipLevels && (a.dim == TextureDim::Tex3D) == (b.dim == TextureDim::Tex3D);
  return same ? WhyNotCopy(dst, src) : "CopyResource needs equal sizes, slices and mips";
}

}  // namespace

void Context::Refuse(MsgCode code, const char* name, const char* call, const char* why) {
  log_.Report(Severity::Error, code, name, "%s: %s; the call is ignored", call, why);
}

bool Context::CheckWritable(IResource* dst, const char* call) {
  if (!dst) {
    Refuse(MsgCode::InvalidDesc, "", call, "the destination is null");
    return false;
  }
  if (dst->GetUsage() == Usage::Default || dst->GetUsage() == Usage::Staging) return true;
  const Buffer* b = AsBuffer(dst);
  Refuse(MsgCode::ImmutableWrite, b ? b->Desc().name : AsTexture(dst)->Desc().name, call,
         "the destination's usage must be Default or Staging");
  return false;
}

// ------------------------------------------------------------------------------------------------- UpdateSubresource

void Context::UpdateSubresource(IResource* dst, uint32_t subresource, const Box* box, const void* data,
                                uint32_t rowPitch, uint32_t slicePitch) {
  if (!CheckWritable(dst, "UpdateSubresource")) return;
  if (dst->GetUsage() == Usage::Staging || !data)
    return Refuse(MsgCode::MapMode, "", "UpdateSubresource", "it needs Default usage and data; map staging resources");
  if (!Settle()) return;
  if (Buffer* b = AsBuffer(dst)) {
    UpdateBuffer(*b, box, data);
  } else {
    UpdateTexture(*AsTexture(dst), subresource, box, data, rowPitch, slicePitch);
  }
}

void Context::UpdateBuffer(Buffer& b, const Box* box, const void* data) {
  uint32_t begin = 0, size = 0;
  if (!BufferRange(b.Desc(), box, &begin, &size))
    return Refuse(MsgCode::OutOfBounds, b.Desc().name, "UpdateSubresource", "the box is empty or beyond the buffer");
  glNamedBufferSubData(b.name, begin, size, data);
}

void Context::UpdateTexture(Texture& t, uint32_t subresource, const Box* box, const void* data, uint32_t rowPitch,
                            uint32_t slicePitch) {
  TexelBlock block;
  if (subresource >= t.SubresourceCount() || t.Desc().dim == TextureDim::Tex2DMS)
    return Refuse(MsgCode::SubresourceOutOfRange, t.Desc().name, "UpdateSubresource",
                  "the subresource does not exist, or is multisampled");
  if (!MakeBlock(t.Desc(), t.MipOf(subresource), t.SliceOf(subresource), box, &block) || !BlockAligned(t, block))
    return Refuse(MsgCode::OutOfBounds, t.Desc().name, "UpdateSubresource",
                  "the box is empty, beyond the subresource, or not on whole blocks");
  Upload(t, block, data, rowPitch, slicePitch);
}

// ------------------------------------------------------------------------------------------------------------ copies

void Context::CopyResource(IResource* dst, IResource* src) {
  if (!CheckWritable(dst, "CopyResource")) return;
  Buffer *toBuffer = AsBuffer(dst), *fromBuffer = AsBuffer(src);
  if (toBuffer && fromBuffer) {
    if (toBuffer->Desc().byteWidth != fromBuffer->Desc().byteWidth)
      return Refuse(MsgCode::OutOfBounds, toBuffer->Desc().name, "CopyResource", "the buffers' sizes differ");
    return CopyBuffer(*toBuffer, 0, *fromBuffer, nullptr);
  }
  Texture *to = AsTexture(dst), *from = AsTexture(src);
  const char* why = to && from ? WhyNotCopyAll(*to, *from) : "both must be buffers, or both textures";
  if (why) return Refuse(MsgCode::FormatMismatch, "", "CopyResource", why);
  for (uint32_t i = 0; i < to->SubresourceCount(); ++i) CopyTexture(*to, i, 0, 0, 0, *from, i, nullptr);
}

void Context::CopySubresourceRegion(IResource* dst, uint32_t dstSubresource, uint32_t x, uint32_t y, uint32_t z,
                                    IResource* src, uint32_t srcSubresource, const Box* box) {
  if (!CheckWritable(dst, "CopySubresourceRegion")) return;
  Buffer *toBuffer = AsBuffer(dst), *fromBuffer = AsBuffer(src);
  if (toBuffer && fromBuffer) return CopyBuffer(*toBuffer, x, *fromBuffer, box);
  Texture *to = AsTexture(dst), *from = AsTexture(src);
  const char* why = to && from ? WhyNotCopy(*to, *from) : "both must be buffers, or both textures";
  if (why) return Refuse(MsgCode::FormatMismatch, "", "CopySubresourceRegion", why);
  CopyTexture(*to, dstSubresource, x, y, z, *from, srcSubresource, box);
}

void Context::CopyBuffer(Buffer& dst, uint32_t at, Buffer& src, const Box* box) {
  uint32_t begin = 0, size = 0;
  if (!BufferRange(src.Desc(), box, &begin, &size) || at > dst.Desc().byteWidth || size > dst.Desc().byteWidth - at)
    return Refuse(MsgCode::OutOfBounds, dst.Desc().name, "a buffer copy", "the range is empty or beyond a buffer");
  if (&dst == &src && begin < at + size && at < begin + size)
    return Refuse(MsgCode::OutOfBounds, dst.Desc().name, "a buffer copy", "the ranges overlap");
  if (!Settle()) return;
  glCopyNamedBufferSubData(src.name, dst.name, GLintptr(uint64_t(src.offset) + begin),
                           GLintptr(uint64_t(dst.offset) + at), size);
  dst.gpuTouched = src.gpuTouched = true;
}

void Context::CopyTexture(Texture& dst, uint32_t dstSub, uint32_t x, uint32_t y, uint32_t z, Texture& src,
                          uint32_t srcSub, const Box* box) {
  if (dstSub >= dst.SubresourceCount() || srcSub >= src.SubresourceCount())
    return Refuse(MsgCode::SubresourceOutOfRange, dst.Desc().name, "a texture copy", "a subresource does not exist");
  CopyPlace from{&src, srcSub, {}}, to{&dst, dstSub, {}};
  bool fits = MakeBlock(src.Desc(), src.MipOf(srcSub), src.SliceOf(srcSub), box, &from.block);
  const TexelBlock& b = from.block;
  const Box target{x, y, z, x + b.width, y + b.height, z + b.depth};
  fits = fits && MakeBlock(dst.Desc(), dst.MipOf(dstSub), dst.SliceOf(dstSub), &target, &to.block);
  if (!fits || !BlockAligned(src, from.block) || !BlockAligned(dst, to.block))
    return Refuse(MsgCode::OutOfBounds, dst.Desc().name, "a texture copy",
                  "a box is empty, beyond its subresource, or not on whole blocks");
  if (&dst == &src && dstSub == srcSub)
    return Refuse(MsgCode::OutOfBounds, dst.Desc().name, "a texture copy",
                  "source and destination are one subresource");
  if (!Settle()) return;
  CopyBlock(to, from);
}

void Context::CopyBlock(const CopyPlace& dst, const CopyPlace& src) {
  Texture &to = *dst.texture, &from = *src.texture;
  const TexelBlock &a = src.block, &b = dst.block;
  to.gpuTouched = from.gpuTouched = true;
  if (to.IsStaging() && from.IsStaging()) return CopyStaging(dst, src);
  if (to.IsStaging()) return DownloadToBuffer(from, a, PlaceInStaging(to, dst.subresource, b));
  if (from.IsStaging()) return UploadFromBuffer(to, b, PlaceInStaging(from, src.subresource, a));
  glCopyImageSubData(from.name, from.target, GLint(a.mip), GLint(a.x), GLint(a.y), GLint(a.z), to.name, to.target,
                     GLint(b.mip), GLint(b.x), GLint(b.y), GLint(b.z), GLsizei(a.width), GLsizei(a.height),
                     GLsizei(a.depth));
}

void Context::CopyStaging(const CopyPlace& dst, const CopyPlace& src) {
  const BufferPlace to = PlaceInStaging(*dst.texture, dst.subresource, dst.block),
                    from = PlaceInStaging(*src.texture, src.subresource, src.block);
  const Format format = src.texture->Desc().format;
  const uint32_t rowBytes = BlockRowBytes(format, src.block.width), rows = BlockRows(format, src.block.height);
  for (uint64_t z = 0; z < src.block.depth; ++z)
    for (uint64_t y = 0; y < rows; ++y)
      glCopyNamedBufferSubData(from.buffer, to.buffer, GLintptr(from.offset + z * from.slicePitch + y * from.rowPitch),
                               GLintptr(to.offset + z * to.slicePitch + y * to.rowPitch), rowBytes);
}

}  // namespace rhi_gl

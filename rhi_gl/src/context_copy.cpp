// UpdateSubresource and copies, on the GPU's time line.
#include "context.h"
#include "rhi/backend/data_checks.h"

namespace rhi_gl {

using namespace backend;

namespace {

BufferPlace PlaceInStaging(const Texture& t, uint32_t subresource, const TexelBlock& b) {
  const FormatInfo& f = GetFormatInfo(t.Desc().format);
  const MipLayout m = t.Layout(subresource);
  const uint64_t z = b.z - t.SliceOf(subresource);  // the slice is in the subresource's own offset
  const uint64_t offset = t.StagingOffset(subresource) + z * m.sliceBytes + uint64_t(b.y / f.blockSize) * m.rowBytes +
                          uint64_t(b.x / f.blockSize) * f.blockBytes;
  return {t.stagingBuffer, offset, m.rowBytes, uint32_t(m.sliceBytes)};
}

}  // namespace

void Context::Refuse(MsgCode code, const char* name, const char* call, const char* why) {
  log_.Report(Severity::Error, code, name, "%s: %s; the call is ignored", call, why);
}

// ------------------------------------------------------------------------------------------------- UpdateSubresource

void Context::UpdateSubresource(IResource* dst, uint32_t subresource, const Box* box, const void* data,
                                uint32_t rowPitch, uint32_t slicePitch) {
  if (!dst || !data) return Refuse(MsgCode::InvalidDesc, "", "UpdateSubresource", "the resource or the data is null");
  if (Buffer* b = AsBuffer(dst)) {
    if (!CheckUpdate(b->Desc(), box).Refuses(log_, b->Desc().name)) UpdateBuffer(*b, box, data);
    return;
  }
  Texture& t = *AsTexture(dst);
  if (!CheckUpdate(t.Desc(), subresource, box, rowPitch, slicePitch).Refuses(log_, t.Desc().name))
    UpdateTexture(t, subresource, box, data, rowPitch, slicePitch);
}

void Context::UpdateBuffer(Buffer& b, const Box* box, const void* data) {
  const uint32_t begin = box ? box->left : 0, size = (box ? box->right : b.Desc().byteWidth) - begin;
  if (size != 0 && Settle()) glNamedBufferSubData(b.name, begin, size, data);
}

void Context::UpdateTexture(Texture& t, uint32_t subresource, const Box* box, const void* data, uint32_t rowPitch,
                            uint32_t slicePitch) {
  TexelBlock block;  // none: the box is empty
  if (MakeBlock(t.Desc(), t.MipOf(subresource), t.SliceOf(subresource), box, &block) && Settle())
    Upload(t, block, data, rowPitch, slicePitch);
}

// ------------------------------------------------------------------------------------------------------------ copies

void Context::CopyResource(IResource* dst, IResource* src) {
  if (!dst || !src) return Refuse(MsgCode::InvalidDesc, "", "CopyResource", "a resource is null");
  Buffer *toBuffer = AsBuffer(dst), *fromBuffer = AsBuffer(src);
  if (!toBuffer != !fromBuffer) {
    CheckCopyKinds(dst->GetUsage()).Refuses(log_, "");
    return;
  }
  if (toBuffer) {
    if (!CheckCopyAll(toBuffer->Desc(), fromBuffer->Desc(), dst == src).Refuses(log_, toBuffer->Desc().name))
      CopyBuffer(*toBuffer, 0, *fromBuffer, nullptr);
    return;
  }
  Texture &to = *AsTexture(dst), &from = *AsTexture(src);
  if (CheckCopyAll(to.Desc(), from.Desc(), dst == src).Refuses(log_, to.Desc().name)) return;
  for (uint32_t i = 0; i < to.SubresourceCount(); ++i) CopyTexture(to, i, 0, 0, 0, from, i, nullptr);
}

void Context::CopySubresourceRegion(IResource* dst, uint32_t dstSubresource, uint32_t x, uint32_t y, uint32_t z,
                                    IResource* src, uint32_t srcSubresource, const Box* box) {
  if (!dst || !src) return Refuse(MsgCode::InvalidDesc, "", "CopySubresourceRegion", "a resource is null");
  Buffer *toBuffer = AsBuffer(dst), *fromBuffer = AsBuffer(src);
  if (!toBuffer != !fromBuffer) {
    CheckCopyKinds(dst->GetUsage()).Refuses(log_, "");
    return;
  }
  if (toBuffer) {
    if (!CheckCopy(toBuffer->Desc(), x, fromBuffer->Desc(), box, dst == src).Refuses(log_, toBuffer->Desc().name))
      CopyBuffer(*toBuffer, x, *fromBuffer, box);
    return;
  }
  Texture &to = *AsTexture(dst), &from = *AsTexture(src);
  const Misuse misuse = CheckCopy({to.Desc(), dstSubresource, x, y, z}, {from.Desc(), srcSubresource}, box, dst == src);
  if (!misuse.Refuses(log_, to.Desc().name)) CopyTexture(to, dstSubresource, x, y, z, from, srcSubresource, box);
}

void Context::CopyBuffer(Buffer& dst, uint32_t at, Buffer& src, const Box* box) {
  const uint32_t begin = box ? box->left : 0, size = (box ? box->right : src.Desc().byteWidth) - begin;
  if (size == 0 || !Settle()) return;
  glCopyNamedBufferSubData(src.name, dst.name, GLintptr(uint64_t(src.offset) + begin),
                           GLintptr(uint64_t(dst.offset) + at), size);
  dst.gpuTouched = src.gpuTouched = true;
}

void Context::CopyTexture(Texture& dst, uint32_t dstSub, uint32_t x, uint32_t y, uint32_t z, Texture& src,
                          uint32_t srcSub, const Box* box) {
  CopyPlace from{&src, srcSub, {}}, to{&dst, dstSub, {}};
  if (!MakeBlock(src.Desc(), src.MipOf(srcSub), src.SliceOf(srcSub), box, &from.block)) return;  // nothing in it
  const TexelBlock& b = from.block;
  const Box target{x, y, z, x + b.width, y + b.height, z + b.depth};
  if (MakeBlock(dst.Desc(), dst.MipOf(dstSub), dst.SliceOf(dstSub), &target, &to.block) && Settle())
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

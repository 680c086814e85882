// Clears, copies, resolves, mips.
#include "validation_context.h"

namespace rhi::validation {

using backend::GetMipLayout;
using backend::MipLayout;

namespace {

bool SameFormatGroup(Format a, Format b) { return ToLinear(a) == ToLinear(b); }

bool OnBlocks(const Box& b, const MipLayout& m, uint32_t block) {
  const auto edge = [block](uint32_t end, uint32_t whole) { return end % block == 0 || end == whole; };
  return b.left % block == 0 && b.top % block == 0 && edge(b.right, m.width) && edge(b.bottom, m.height);
}

}  // namespace

// ------------------------------------------------------------------------------------------------------------- clears

void Context::ClearRenderTargetView(IRenderTargetView* view, const float rgba[4]) {
  constexpr const char* kCall = "ClearRenderTargetView";
  if (!NotNull(kCall, view, "the view") || !NotNull(kCall, rgba, "the colour") || !v_.Owns(kCall, view)) return;
  inner_.ClearRenderTargetView(view, rgba);
}

void Context::ClearDepthStencilView(IDepthStencilView* view, bool clearDepth, float depth, bool clearStencil,
                                    uint8_t stencil) {
  constexpr const char* kCall = "ClearDepthStencilView";
  if (!NotNull(kCall, view, "the view") || !v_.Owns(kCall, view)) return;
  if (clearDepth && !(depth >= 0 && depth <= 1)) {
    v_.Error(MsgCode::OutOfBounds, view, "%s: depth %g is not within 0..1; the call is ignored", kCall, double(depth));
    return;
  }
  if (clearStencil && !GetFormatInfo(view->Desc().format).stencil)
    v_.Warn(MsgCode::FormatMismatch, view, "%s: %s has no stencil to clear; pass clearStencil = false", kCall,
            rhi::ToString(view->Desc().format));
  inner_.ClearDepthStencilView(view, clearDepth, depth, clearStencil, stencil);
}

// ------------------------------------------------------------------------------------------------------------- copies

bool Context::CheckWritable(const char* call, const IResource& dst) {
  const Usage usage = dst.GetUsage();
  if (usage == Usage::Default || usage == Usage::Staging) return true;
  return v_.Error(usage == Usage::Immutable ? MsgCode::ImmutableWrite : MsgCode::MapMode, &dst,
                  "%s: the destination is %s; it must be of Usage::Default or Staging; the call is ignored", call,
                  usage == Usage::Immutable ? "Immutable" : "Dynamic");
}

bool Context::CheckPair(const char* call, IResource* dst, IResource* src) {
  if (!NotNull(call, dst, "the destination") || !NotNull(call, src, "the source")) return false;
  if (!v_.Owns(call, dst) || !v_.Owns(call, src) || !CheckWritable(call, *dst)) return false;
  if (IsBuffer(dst) != IsBuffer(src))
    return v_.Error(MsgCode::FormatMismatch, dst,
                    "%s between a buffer and a texture; both must be of one kind; the call is ignored", call);
  return NotMapped(call, dst) && NotMapped(call, src);
}

bool Context::CheckFormats(const char* call, const ITexture& dst, const ITexture& src) {
  const TextureDesc &a = dst.Desc(), &b = src.Desc();
  if (!SameFormatGroup(a.format, b.format))
    return v_.Error(
        MsgCode::FormatMismatch, &dst,
        "%s from %s to %s; copies convert nothing, so take one format or its sRGB twin; the call is ignored", call,
        rhi::ToString(b.format), rhi::ToString(a.format));
  return a.sampleCount == b.sampleCount ||
         v_.Error(MsgCode::FormatMismatch, &dst,
                  "%s from %u samples to %u; use ResolveSubresource; the call is ignored", call, b.sampleCount,
                  a.sampleCount);
}

bool Context::CheckWholeTextures(const ITexture& dst, const ITexture& src) {
  const TextureDesc &a = dst.Desc(), &b = src.Desc();
  const bool same = a.width == b.width && a.height == b.height && a.depthOrArray == b.depthOrArray &&
                    a.mipLevels == b.mipLevels && (a.dim == TextureDim::Tex3D) == (b.dim == TextureDim::Tex3D);
  if (same) return CheckFormats("CopyResource", dst, src);
  return v_.Error(MsgCode::FormatMismatch, &dst,
                  "CopyResource from %u x %u x %u with %u mips to %u x %u x %u with %u; take equal sizes or "
                  "CopySubresourceRegion; the call is ignored",
                  b.width, b.height, b.depthOrArray, b.mipLevels, a.width, a.height, a.depthOrArray, a.mipLevels);
}

void Context::CopyResource(IResource* dst, IResource* src) {
  if (!CheckPair("CopyResource", dst, src)) return;
  if (dst == src) {
    v_.Error(MsgCode::OutOfBounds, dst, "CopyResource of a resource to itself; the call is ignored");
    return;
  }
  if (IsBuffer(dst)) {
    const uint32_t to = static_cast<IBuffer*>(dst)->Desc().byteWidth,
                   from = static_cast<IBuffer*>(src)->Desc().byteWidth;
    if (to != from) {
      v_.Error(
          MsgCode::FormatMismatch, dst,
          "CopyResource from a buffer of %u bytes to one of %u; take equal sizes or CopySubresourceRegion; the call "
          "is ignored",
          from, to);
      return;
    }
  } else if (!CheckWholeTextures(*static_cast<ITexture*>(dst), *static_cast<ITexture*>(src))) {
    return;
  }
  inner_.CopyResource(dst, src);
}

bool Context::CheckBufferRegion(const IBuffer& dst, uint32_t x, const IBuffer& src, const Box* box) {
  const uint32_t room = dst.Desc().byteWidth, size = src.Desc().byteWidth;
  const uint32_t left = box ? box->left : 0, right = box ? box->right : size;
  if (left > right || right > size || uint64_t(x) + (right - left) > room)
    return v_.Error(MsgCode::OutOfBounds, &dst,
                    "CopySubresourceRegion of bytes %u..%u of %u to byte %u of %u; the call is ignored", left, right,
                    size, x, room);
  if (&dst != &src || left >= uint64_t(x) + (right - left) || x >= right) return true;
  return v_.Error(
      MsgCode::OutOfBounds, &dst,
      "CopySubresourceRegion of bytes %u..%u to byte %u of the same buffer: the ranges overlap; copy by way "
      "of another buffer; the call is ignored",
      left, right, x);
}

bool Context::CheckTextureRegion(const Place& dst, const Place& src, const Box* box) {
  constexpr const char* kCall = "CopySubresourceRegion";
  const auto &to = static_cast<const ITexture&>(*dst.resource), &from = static_cast<const ITexture&>(*src.resource);
  if (!CheckFormats(kCall, to, from) || !Subresources(kCall, to, dst.subresource) ||
      !Subresources(kCall, from, src.subresource))
    return false;
  if (&to == &from && dst.subresource == src.subresource)
    return v_.Error(MsgCode::OutOfBounds, &to,
                    "%s within subresource %u; copy by way of another texture; the call is ignored", kCall,
                    dst.subresource);
  const MipLayout s = GetMipLayout(from.Desc(), src.subresource % from.Desc().mipLevels),
                  d = GetMipLayout(to.Desc(), dst.subresource % to.Desc().mipLevels);
  const Box b = box ? *box : Box{0, 0, 0, s.width, s.height, s.depth};
  const bool inSource = b.left <= b.right && b.top <= b.bottom && b.front <= b.back && b.right <= s.width &&
                        b.bottom <= s.height && b.back <= s.depth;
  const bool inDest = inSource && uint64_t(dst.x) + b.right - b.left <= d.width &&
                      uint64_t(dst.y) + b.bottom - b.top <= d.height && uint64_t(dst.z) + b.back - b.front <= d.depth;
  const uint32_t block = GetFormatInfo(from.Desc().format).blockSize;
  if (inDest && OnBlocks(b, s, block) && dst.x % block == 0 && dst.y % block == 0) return true;
  return v_.Error(MsgCode::OutOfBounds, &to,
                  "%s of (%u, %u, %u)..(%u, %u, %u) of %u x %u x %u to (%u, %u, %u) of %u x %u x %u; keep within both, "
                  "and on whole blocks of %u texels; the call is ignored",
                  kCall, b.left, b.top, b.front, b.right, b.bottom, b.back, s.width, s.height, s.depth, dst.x, dst.y,
                  dst.z, d.width, d.height, d.depth, block);
}

void Context::CopySubresourceRegion(IResource* dst, uint32_t dstSubresource, uint32_t x, uint32_t y, uint32_t z,
                                    IResource* src, uint32_t srcSubresource, const Box* box) {
  if (!CheckPair("CopySubresourceRegion", dst, src)) return;
  const bool ok = IsBuffer(dst)
                      ? CheckBufferRegion(*static_cast<IBuffer*>(dst), x, *static_cast<IBuffer*>(src), box)
                      : CheckTextureRegion({dst, dstSubresource, x, y, z}, {src, srcSubresource, 0, 0, 0}, box);
  if (ok) inner_.CopySubresourceRegion(dst, dstSubresource, x, y, z, src, srcSubresource, box);
}

// ---------------------------------------------------------------------------------------------------- resolve and mips

bool Context::CheckResolve(ITexture* dst, uint32_t dstSubresource, ITexture* src, uint32_t srcSubresource,
                           Format format) {
  constexpr const char* kCall = "ResolveSubresource";
  if (!CheckPair(kCall, dst, src)) return false;
  if (!Subresources(kCall, *dst, dstSubresource) || !Subresources(kCall, *src, srcSubresource)) return false;
  const TextureDesc &a = dst->Desc(), &b = src->Desc();
  if (b.sampleCount < 2 || a.sampleCount != 1 || a.usage != Usage::Default)
    return v_.Error(MsgCode::FormatMismatch, dst,
                    "%s from %u samples to %u; take a multisampled source and a Default destination of one sample "
                    "(CopyResource copies equal counts); the call is ignored",
                    kCall, b.sampleCount, a.sampleCount);
  if (format == Format::Unknown) format = b.format;
  if (!SameFormatGroup(a.format, format) || !SameFormatGroup(b.format, format) || GetFormatInfo(format).depth)
    return v_.Error(
        MsgCode::FormatMismatch, dst,
        "%s from %s to %s as %s; take one colour format, or its sRGB twin, for all three; the call is ignored", kCall,
        rhi::ToString(b.format), rhi::ToString(a.format), rhi::ToString(format));
  const MipLayout to = GetMipLayout(a, dstSubresource % a.mipLevels);
  return (to.width == b.width && to.height == b.height) ||
         v_.Error(MsgCode::FormatMismatch, dst, "%s from %u x %u to %u x %u; take equal sizes; the call is ignored",
                  kCall, b.width, b.height, to.width, to.height);
}

void Context::ResolveSubresource(ITexture* dst, uint32_t dstSubresource, ITexture* src, uint32_t srcSubresource,
                                 Format format) {
  if (CheckResolve(dst, dstSubresource, src, srcSubresource, format))
    inner_.ResolveSubresource(dst, dstSubresource, src, srcSubresource, format);
}

void Context::GenerateMips(IShaderResourceView* view) {
  constexpr const char* kCall = "GenerateMips";
  if (!NotNull(kCall, view, "the view") || !v_.Owns(kCall, view)) return;
  IResource* resource = view->Resource();
  if (IsBuffer(resource)) {
    v_.Error(MsgCode::InvalidDesc, view, "%s of a view of a buffer; it needs a view of a texture", kCall);
    return;
  }
  const TextureDesc& d = static_cast<ITexture*>(resource)->Desc();
  if (!(d.bind & Bind::RenderTarget) || !(d.bind & Bind::ShaderResource)) {
    v_.Error(MsgCode::WrongBindFlag, view,
             "%s: the texture was made with flags 0x%X; it needs Bind::RenderTarget and ShaderResource; the call is "
             "ignored",
             kCall, uint32_t(d.bind));
    return;
  }
  if (!(device_.CheckFormatSupport(d.format) & FormatSupport::MipAutogen) || d.sampleCount > 1) {
    v_.Error(MsgCode::FormatMismatch, view,
             "%s: %s of %u samples cannot be filtered; see FormatSupport::MipAutogen; the call is ignored", kCall,
             rhi::ToString(d.format), d.sampleCount);
    return;
  }
  inner_.GenerateMips(view);
}

}  // namespace rhi::validation

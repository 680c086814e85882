// Clears, copies, resolves, mips.
#include "validation_context.h"

namespace rhi::validation {

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

bool Context::Is(const Misuse& misuse, const IObject* object) {
  return misuse && !v_.Error(misuse.code, object, "%s; the call is ignored", misuse.text.c_str());
}

bool Context::CheckPair(const char* call, IResource* dst, IResource* src) {
  if (!NotNull(call, dst, "the destination") || !NotNull(call, src, "the source")) return false;
  if (!v_.Owns(call, dst) || !v_.Owns(call, src)) return false;
  if (IsBuffer(dst) != IsBuffer(src)) return !Is(backend::CheckCopyKinds(dst->GetUsage()), dst);
  return NotMapped(call, dst) && NotMapped(call, src);
}

void Context::CopyResource(IResource* dst, IResource* src) {
  if (!CheckPair("CopyResource", dst, src)) return;
  const Misuse misuse =
      IsBuffer(dst)
          ? backend::CheckCopyAll(static_cast<IBuffer*>(dst)->Desc(), static_cast<IBuffer*>(src)->Desc(), dst == src)
          : backend::CheckCopyAll(static_cast<ITexture*>(dst)->Desc(), static_cast<ITexture*>(src)->Desc(), dst == src);
  if (!Is(misuse, dst)) inner_.CopyResource(dst, src);
}

void Context::CopySubresourceRegion(IResource* dst, uint32_t dstSubresource, uint32_t x, uint32_t y, uint32_t z,
                                    IResource* src, uint32_t srcSubresource, const Box* box) {
  if (!CheckPair("CopySubresourceRegion", dst, src)) return;
  const Misuse misuse =
      IsBuffer(dst) ? backend::CheckCopy(static_cast<IBuffer*>(dst)->Desc(), x, static_cast<IBuffer*>(src)->Desc(), box,
                                         dst == src)
                    : backend::CheckCopy({static_cast<ITexture*>(dst)->Desc(), dstSubresource, x, y, z},
                                         {static_cast<ITexture*>(src)->Desc(), srcSubresource}, box, dst == src);
  if (!Is(misuse, dst)) inner_.CopySubresourceRegion(dst, dstSubresource, x, y, z, src, srcSubresource, box);
}

// ---------------------------------------------------------------------------------------------------- resolve and mips

void Context::ResolveSubresource(ITexture* dst, uint32_t dstSubresource, ITexture* src, uint32_t srcSubresource,
                                 Format format) {
  if (!CheckPair("ResolveSubresource", dst, src)) return;
  if (!Is(backend::CheckResolve({dst->Desc(), dstSubresource}, {src->Desc(), srcSubresource}, format), dst))
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
  if (!Is(backend::CheckGenerateMips(d, view->Desc().format, device_.CheckFormatSupport(d.format)), view))
    inner_.GenerateMips(view);
}

}  // namespace rhi::validation

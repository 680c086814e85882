// Clears, resolves and mips: what GL does through framebuffers besides drawing.
#include "context.h"
#include "rhi/backend/data_checks.h"

namespace rhi_gl {

using namespace backend;

// Direct3D's clears and copies know no scissor, masks or discard. The next draw sets them again.
bool Context::OpenGates() {
  if (!Settle()) return false;
  gl_.CloseClearGates();
  dirty_ |= DirtyRaster | DirtyBlendFactor;
  return true;
}

// The framebuffer that is drawn to where it shows the view, lest another one is bound for nothing.
Context::ClearPlace Context::PlaceOf(const RenderTargetView& view) {
  if (framebuffer_ && !(dirty_ & DirtyTargets) && framebuffer_->problem == MsgCode::None)
    for (uint32_t i = 0; i < state_.targetCount; ++i)
      if (state_.targets[i].get() == &view) return {framebuffer_->name, GLint(i)};
  TargetSet set;
  set.colors[0] = &view;
  set.colorCount = 1;
  return {core_.framebuffers.Get(set).name, 0};
}

void Context::ClearRenderTargetView(IRenderTargetView* target, const float rgba[4]) {
  const auto* view = static_cast<const RenderTargetView*>(target);
  if (!view) return Refuse(MsgCode::InvalidDesc, "", "ClearRenderTargetView", "the view is null");
  if (!OpenGates()) return;
  const ClearPlace place = PlaceOf(*view);
  gl_.OpenColorMask(uint32_t(place.drawBuffer));
  dirty_ |= DirtyBlend;
  if (!GetFormatInfo(view->desc.format).isInteger) {
    glClearNamedFramebufferfv(place.framebuffer, GL_COLOR, place.drawBuffer, rgba);
    return;
  }
  GLuint integers[4];
  std::transform(rgba, rgba + 4, integers, [](float f) { return f > 0 ? GLuint(f) : 0u; });
  glClearNamedFramebufferuiv(place.framebuffer, GL_COLOR, place.drawBuffer, integers);
}

void Context::ClearDepthStencilView(IDepthStencilView* target, bool clearDepth, float depth, bool clearStencil,
                                    uint8_t stencil) {
  const auto* view = static_cast<const DepthStencilView*>(target);
  if (!view) return Refuse(MsgCode::InvalidDesc, "", "ClearDepthStencilView", "the view is null");
  if (!OpenGates()) return;
  const bool bound = framebuffer_ && !(dirty_ & DirtyTargets) && state_.depthTarget.get() == view &&
                     framebuffer_->problem == MsgCode::None;
  TargetSet set;
  set.depth = view;
  const GLuint framebuffer = bound ? framebuffer_->name : core_.framebuffers.Get(set).name;
  gl_.OpenDepthStencilMasks();
  dirty_ |= DirtyDepthStencil;
  const GLint stencilValue = stencil;
  clearStencil = clearStencil && GetFormatInfo(view->desc.format).stencil;
  if (clearDepth && clearStencil) {
    glClearNamedFramebufferfi(framebuffer, GL_DEPTH_STENCIL, 0, depth, stencilValue);
  } else if (clearDepth) {
    glClearNamedFramebufferfv(framebuffer, GL_DEPTH, 0, &depth);
  } else if (clearStencil) {
    glClearNamedFramebufferiv(framebuffer, GL_STENCIL, 0, &stencilValue);
  }
}

namespace {

// A texture seen as `format`, level for level: by a GL view where that is not its own. The view shows all of the
// texture, because Mesa's blits forget where a view begins.
class FormatView {
 public:
  FormatView(const Texture& t, Format format) : whole_{t.name, t.target, format, 0, 0, false} {
    if (format == t.Desc().format) return;
    view_ = MakeGlView(t, format, 0, t.Desc().mipLevels, 0, SliceCount(t.Desc()), &whole_.target);
    whole_.texture = view_;
  }
  ~FormatView() { glDeleteTextures(1, &view_); }
  FormatView(const FormatView&) = delete;
  FormatView& operator=(const FormatView&) = delete;

  Attachment At(uint32_t mip, uint32_t slice) const {
    Attachment a = whole_;
    a.level = mip;
    a.layer = slice;
    return a;
  }

 private:
  GLuint view_ = 0;
  Attachment whole_;
};

}  // namespace

void Context::ResolveSubresource(ITexture* dst, uint32_t dstSubresource, ITexture* src, uint32_t srcSubresource,
                                 Format format) {
  const Texture *to = AsTexture(dst), *from = AsTexture(src);
  if (!to || !from) return Refuse(MsgCode::InvalidDesc, "", "ResolveSubresource", "a texture is null");
  const Misuse misuse = CheckResolve({to->Desc(), dstSubresource}, {from->Desc(), srcSubresource}, format);
  if (misuse.Refuses(log_, to->Desc().name)) return;
  format = from->Desc().format;
  if (!OpenGates()) return;
  const FormatView toView(*to, format), fromView(*from, format);
  const MipLayout m = to->Layout(dstSubresource);
  BlitPair().Blit(fromView.At(0, 0), m.width, m.height,
                  toView.At(to->MipOf(dstSubresource), to->SliceOf(dstSubresource)), m.width, m.height, GL_NEAREST);
}

void Context::GenerateMips(IShaderResourceView* target) {
  const auto* view = static_cast<const ShaderResourceView*>(target);
  if (!view || !view->texture) return Refuse(MsgCode::InvalidDesc, "", "GenerateMips", "it needs a view of a texture");
  const TextureDesc& desc = view->texture->Desc();
  if (!Enter()) return;
  const Misuse misuse = CheckGenerateMips(desc, view->desc.format, QueryFormatSupport(desc.format, core_.caps));
  if (misuse.Refuses(log_, desc.name) || !OpenGates()) return;
  if (desc.dim == TextureDim::Tex3D) {
    glGenerateTextureMipmap(view->name);  // slices of a Tex3D are filtered too, which a blit cannot
    return;
  }
  const FormatView texture(*view->texture, view->desc.format);
  const uint32_t lastMip = view->desc.firstMip + view->desc.mipCount - 1;
  BlitPair pair;
  for (uint32_t slice = view->desc.firstSlice; slice < view->desc.firstSlice + view->desc.sliceCount; ++slice)
    for (uint32_t mip = view->desc.firstMip; mip < lastMip; ++mip) {
      // Each level from the one above; sRGB texels are averaged as linear light, since GL_FRAMEBUFFER_SRGB is on.
      const MipLayout from = GetMipLayout(desc, mip), to = GetMipLayout(desc, mip + 1);
      pair.Blit(texture.At(mip, slice), from.width, from.height, texture.At(mip + 1, slice), to.width, to.height,
                GL_LINEAR);
    }
}

}  // namespace rhi_gl

#include "swap_chain.h"

#include "context.h"
#include "xlib_window.h"

namespace rhi_gl {
namespace {

constexpr uint32_t kDefaultFramebufferUid = 0;  // objects are numbered from 1

}  // namespace

Status SwapChain::Create(const CorePtr& core, const SwapChainDesc& desc, Ref<ISwapChain>* out) {
  if (Status s = CheckSwapChainDesc(desc, core->caps, core->log); s != Status::Ok) return s;
  auto swapChain = Ref<SwapChain>::Adopt(new SwapChain(core, desc));
  if (Status s = swapChain->OpenSurface(); s != Status::Ok) return s;
  if (Status s = swapChain->CreateBackBuffer(desc.width, desc.height); s != Status::Ok) return s;
  *out = swapChain;
  return Status::Ok;
}

SwapChain::~SwapChain() {
  core_->Discard(NameKind::Framebuffer, framebuffer_);
  if (surface_) core_->egl.DestroySurface(surface_);  // never current outside of Present
}

Status SwapChain::OpenSurface() {
  std::string why;
  surface_ = core_->egl.CreateWindowSurface(desc_.nativeWindow, &why);
  if (surface_) return Status::Ok;
  core_->log.Report(Severity::Error, MsgCode::CapMissing, "", "no swap chain: %s", why.c_str());
  return Status::Unsupported;
}

Status SwapChain::CreateBackBuffer(uint32_t width, uint32_t height) {
  Ref<ITexture> texture;
  const Status s = Texture::Create(core_, backend::BackBufferDesc(width, height, desc_.format), nullptr, &texture);
  if (s != Status::Ok) return s;
  const Texture& t = *AsTexture(texture.get());
  if (framebuffer_ == 0) glCreateFramebuffers(1, &framebuffer_);
  Attach(framebuffer_, 0, {t.name, t.target, t.Desc().format, 0, 0, false});
  backBuffer_ = texture;
  return Status::Ok;
}

Status SwapChain::Resize(uint32_t width, uint32_t height) {
  minimised_ = width == 0 || height == 0;
  if (minimised_) return Status::Ok;
  if (!core_->context || !core_->Alive()) return Status::DeviceLost;
  return CreateBackBuffer(width, height);  // the surface follows its window by itself
}

Status SwapChain::Present() {
  Context* context = core_->context;
  if (!context || !core_->Alive()) return Status::DeviceLost;
  if (lost_) return Status::SurfaceLost;
  if (minimised_) return Status::Ok;
  const TextureDesc& d = backBuffer_->Desc();
  const int interval = desc_.vsync ? 1 : 0;
  const Status s = context->ShowInWindow({desc_.nativeWindow, surface_, framebuffer_, d.width, d.height, interval});
  return s == Status::SurfaceLost ? LoseSurface() : s;
}

Status SwapChain::LoseSurface() {
  lost_ = true;
  core_->log.Report(Severity::Error, MsgCode::SurfaceLost, "",
                    "the window is gone; release the swap chain before its window is destroyed");
  return Status::SurfaceLost;
}

Status Context::ShowInWindow(const WindowPicture& from) {
  if (!OpenGates()) return Status::DeviceLost;
  // EGL does not tell; and to draw to a window that is gone may end the program by Xlib's error handler.
  XlibWindowInfo window;
  const auto id = static_cast<unsigned long>(reinterpret_cast<uintptr_t>(from.window));
  if (!QueryXlibSize(core_.egl.NativeDisplay(), id, &window) || !core_.egl.MakeCurrentOn(from.surface))
    return Status::SurfaceLost;
  core_.egl.SetSwapInterval(from.swapInterval);
  const bool same = window.width == from.width && window.height == from.height;
  glDisable(GL_FRAMEBUFFER_SRGB);  // the window gets the bits as they are
  // Bound, and not by name: Mesa follows the window only with framebuffers that are bound.
  gl_.UseFramebuffer(kDefaultFramebufferUid, 0);
  glBindFramebuffer(GL_READ_FRAMEBUFFER, from.framebuffer);
  glDrawBuffer(GL_BACK);
  glBlitFramebuffer(0, 0, GLint(from.width), GLint(from.height), 0, GLint(window.height), GLint(window.width), 0,
                    GL_COLOR_BUFFER_BIT, same ? GL_NEAREST : GL_LINEAR);
  glEnable(GL_FRAMEBUFFER_SRGB);
  const bool shown = core_.egl.Swap(from.surface);
  // No surface stays current: its window may go at any time, and other swap chains want their turn.
  core_.egl.MakeCurrent();
  dirty_ |= backend::DirtyTargets;
  dirty_ |= backend::DirtyViewports | backend::DirtyScissors;  // Mesa sets both when a context first meets a surface
  return shown ? Status::Ok : Status::SurfaceLost;
}

}  // namespace rhi_gl

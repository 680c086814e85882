#include "core.h"

#include "context.h"
#include "debug.h"
#include "depth_bias.h"

namespace rhi_gl {
namespace {

// The device whose context this thread has current, as far as we made it so.
thread_local std::weak_ptr<Core> threadOwner;

// A draw that takes longer than this is taken for a lost device.
constexpr GLuint64 kFenceTimeoutNs = 60'000'000'000;

void DeleteName(NameKind kind, GLuint name) {
  switch (kind) {
    case NameKind::Buffer: glDeleteBuffers(1, &name); break;
    case NameKind::Texture: glDeleteTextures(1, &name); break;
    case NameKind::Sampler: glDeleteSamplers(1, &name); break;
    case NameKind::Framebuffer: glDeleteFramebuffers(1, &name); break;
    case NameKind::Program: glDeleteProgram(name); break;
    case NameKind::Shader: glDeleteShader(name); break;
    case NameKind::VertexArray: glDeleteVertexArrays(1, &name); break;
    case NameKind::Query: glDeleteQueries(1, &name); break;
  }
}

void ClearErrors() {
  // A lost context reports its loss for ever.
  for (int i = 0; i < 16 && glGetError() != GL_NO_ERROR; ++i) {
  }
}

}  // namespace

bool FrameClock::Retire(bool wait) {
  const Pending& p = pending_.front();
  const GLenum result = glClientWaitSync(p.fence, wait ? GL_SYNC_FLUSH_COMMANDS_BIT : 0u, wait ? kFenceTimeoutNs : 0);
  if (result != GL_ALREADY_SIGNALED && result != GL_CONDITION_SATISFIED) return false;
  completed_ = p.frame;
  glDeleteSync(p.fence);
  pending_.pop_front();
  return true;
}

bool FrameClock::EndFrame(uint32_t framesInFlight) {
  pending_.push_back({current_, glFenceSync(GL_SYNC_GPU_COMMANDS_COMPLETE, 0)});
  glFlush();
  ++current_;
  while (!pending_.empty() && Retire(false)) {
  }
  while (pending_.size() > framesInFlight)
    if (!Retire(true)) return false;
  return true;
}

void FrameClock::Finished() {
  for (const Pending& p : pending_) glDeleteSync(p.fence);
  pending_.clear();
  completed_ = current_++;
}

Core::Core(const DeviceDesc& desc, const Caps& adapterCaps)
    : log(desc.sink), caps(adapterCaps), framebuffers(*this), programs(*this), validation(desc.apiValidation) {}

Core::~Core() {
  if (Enter()) Drain();  // else all ends with the context
  egl.Destroy();
}

bool Core::Start() {
  threadOwner = weak_from_this();
  if (validation) InstallDebugCallback(*this);
  glClipControl(GL_LOWER_LEFT, GL_ZERO_TO_ONE);  // the shaders turn the picture over: rhi/shader.h
  glProvokingVertex(GL_FIRST_VERTEX_CONVENTION);
  glEnable(GL_FRAMEBUFFER_SRGB);
  glEnable(GL_TEXTURE_CUBE_MAP_SEAMLESS);
  glDisable(GL_DITHER);
  glPixelStorei(GL_PACK_ALIGNMENT, 1);
  glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
  const std::vector<std::byte> zeros(kMaxConstantBufferBytes);
  return Allocates([&] {
    glCreateBuffers(1, &zeroBuffer);
    glNamedBufferStorage(zeroBuffer, GLsizeiptr(zeros.size()), zeros.data(), 0);
  });
}

void Core::ForgetThread() {
  if (const CorePtr owner = threadOwner.lock(); owner && owner->context) owner->context->LoseThread();
  threadOwner.reset();
}

bool Core::Enter() {
  if (lost_) return false;
  if (egl.IsCurrent()) return true;
  ForgetThread();
  if (!egl.MakeCurrent()) {
    if (egl.WasLost()) return Lose("EGL has lost the context");
    log.Report(Severity::Error, MsgCode::DeviceLost, "", "the GL context cannot be made current: %s (EGL error 0x%x)",
               egl.IsElsewhere() ? "it is still current on another thread; call WaitIdle there first" : "the driver refuses",
               unsigned(egl.Error()));
    return false;
  }
  threadOwner = weak_from_this();
  return true;
}

bool Core::Alive() {
  if (!Enter()) return false;
  // Asked once only: a driver that is done with a reset answers that all is well again.
  switch (glGetGraphicsResetStatus()) {
    case GL_NO_ERROR: return true;
    case GL_GUILTY_CONTEXT_RESET: return Lose("the GPU was reset because of this device's work");
    case GL_INNOCENT_CONTEXT_RESET: return Lose("the GPU was reset because of somebody else's work");
    default: return Lose("the GPU was reset");
  }
}

bool Core::Lose(const char* why) {
  if (lost_) return false;
  lost_ = true;
  if (context) context->LoseThread();  // whose way back is Enter
  log.Report(Severity::Error, MsgCode::DeviceLost, "",
             "%s; nothing more is done, release this device and its objects and make a new one", why);
  return false;
}

void Core::Leave() {
  ForgetThread();
  egl.Release();
}

// On a context of its own, so that the device's state stays as it is.
void Core::CalibrateDepthBias() {
  if (std::exchange(calibrated_, true)) return;
  ForgetThread();
  EglContext own;
  std::string why;  // without it the units stay what they mostly are
  if (own.Create(egl.Place(), {}, &why)) depthBiasUnits = MeasureDepthBiasUnits();
}

void Core::DiscardSync(GLsync sync) {
  if (sync) deadSyncs_.push_back(sync);
}

void Core::Drain() {
  for (const Dead& d : trash_) DeleteName(d.kind, d.name);
  trash_.clear();
  for (GLsync s : deadSyncs_) glDeleteSync(s);
  deadSyncs_.clear();
}

bool Core::BeginAllocation() {
  if (!Enter()) return false;
  Drain();
  ClearErrors();
  return allocating = true;
}

bool Core::EndAllocation() {
  allocating = false;
  return glGetError() != GL_OUT_OF_MEMORY;
}

Status Core::OutOfMemory(const char* name, const char* what) {
  if (!Alive()) return Status::DeviceLost;
  log.Report(Severity::Error, MsgCode::OutOfMemory, name, "GL has no memory for this %s", what);
  return Status::OutOfMemory;
}

void Core::Label(GLenum identifier, GLuint name, const char* label) {
  if (!validation || name == 0 || !label || !*label || !Enter()) return;
  const size_t length = std::min<size_t>(std::char_traits<char>::length(label), limits.maxLabel - 1);
  glObjectLabel(identifier, name, GLsizei(length), label);
}

void Core::Finish() {
  if (!Enter()) return;
  glFinish();
  frames.Finished();
}

}  // namespace rhi_gl

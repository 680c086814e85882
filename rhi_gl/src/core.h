// What all objects of one device share and keep alive: its GL context, messages, caps, frame fences, caches.
#pragma once

#include <epoxy/gl.h>

#include <deque>
#include <memory>

#include "egl_context.h"
#include "framebuffers.h"
#include "programs.h"
#include "rhi/backend/object.h"

namespace rhi_gl {

using namespace rhi;
using backend::MessageLog;

class BlendState;
class DepthStencilState;
class RasterizerState;
class SamplerState;
class Context;

// The kinds of GL names, for their deferred deletion.
enum class NameKind : uint8_t { Buffer, Texture, Sampler, Framebuffer, Program, Shader, VertexArray, Query };

struct Limits {
  uint32_t uniformAlignment = 256, storageAlignment = 256, maxAttribOffset = 2047, maxDebugGroups = 64,
           maxDebugMessage = 1024, maxLabel = 256;
};

// Counts frames and knows which the GPU has finished. Frame 1 is the first.
class FrameClock {
 public:
  uint64_t Current() const { return current_; }
  uint64_t Completed() const { return completed_; }
  // Ends the current frame; waits while more than `framesInFlight` frames are unfinished. False: the GPU does not
  // finish them.
  bool EndFrame(uint32_t framesInFlight);
  // After glFinish: all that was recorded is done.
  void Finished();

 private:
  struct Pending {
    uint64_t frame;
    GLsync fence;
  };
  bool Retire(bool wait);

  std::deque<Pending> pending_;
  uint64_t current_ = 1, completed_ = 0;
};

class Core : public std::enable_shared_from_this<Core> {
 public:
  Core(const DeviceDesc&, const Caps&);
  ~Core();
  Core(const Core&) = delete;
  Core& operator=(const Core&) = delete;

  // Takes the context, current, and sets what never changes. False: no memory even for that.
  bool Start();

  // Makes the context current on this thread, whoever else made his own current meanwhile. The device that was current
  // here learns it by Context::LoseThread, so that its draws need not ask each time. False: nothing can be done with
  // GL, because the device is lost (which was said then) or its context cannot be had (which is said now).
  bool Enter();
  // Enter, and asks the driver whether the context was reset. Where work ends up waiting, or something is made.
  bool Alive();
  // From now on every call gives DeviceLost or is ignored. Says so once; false.
  bool Lose(const char* why);
  bool IsLost() const { return lost_; }
  // Gives the thread's context up, so that another thread may use the device.
  void Leave();
  // A context of nobody's is about to be made current on this thread.
  static void ForgetThread();

  // Numbers are never used twice, unlike GL's names: the shadow of the state compares numbers.
  uint32_t NewUid() { return ++lastUid_; }

  // Deletes a name when the context is next current for something slow; GL itself waits for the GPU.
  void Discard(NameKind kind, GLuint name) {
    if (name != 0) trash_.push_back({kind, name});
  }
  void DiscardSync(GLsync);
  void Drain();

  // Measures depthBiasUnits at the first call: rasterizer states with a bias need it, others never do.
  void CalibrateDepthBias();

  // Runs `make` and tells whether memory sufficed.
  template <class F>
  bool Allocates(F&& make) {
    if (!BeginAllocation()) return false;
    make();
    return EndAllocation();
  }
  // Says that this memory is missing, and gives the status; DeviceLost where that is the reason.
  Status OutOfMemory(const char* name, const char* what);

  void Label(GLenum identifier, GLuint name, const char* label);
  // glFinish, and all frames are complete.
  void Finish();

  EglContext egl;
  MessageLog log;
  Caps caps;
  Limits limits;
  FrameClock frames;
  FramebufferCache framebuffers;
  ProgramCache programs;
  backend::Interner<BlendDesc, BlendState> blendStates;
  backend::Interner<DepthStencilDesc, DepthStencilState> depthStencilStates;
  backend::Interner<RasterizerDesc, RasterizerState> rasterizerStates;
  backend::Interner<SamplerDesc, SamplerState> samplerStates;
  float depthBiasUnits = 1;    // one of depthBias in GL's units, on depths in floats (depth_bias.h)
  GLuint zeroBuffer = 0;       // kMaxConstantBufferBytes of zeros: what is not bound reads 0
  Context* context = nullptr;  // of the device; null before and after it
  bool validation = false;
  bool allocating = false;  // GL_OUT_OF_MEMORY is expected and reported by us

 private:
  struct Dead {
    NameKind kind;
    GLuint name;
  };
  bool BeginAllocation();
  bool EndAllocation();

  bool lost_ = false, calibrated_ = false;
  uint32_t lastUid_ = 0;
  std::vector<Dead> trash_;
  std::vector<GLsync> deadSyncs_;
};

using CorePtr = std::shared_ptr<Core>;

}  // namespace rhi_gl

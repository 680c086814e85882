// Framebuffer objects, made once for each set of target views and forgotten when one of the views dies.
#pragma once

#include <epoxy/gl.h>

#include <array>
#include <string>
#include <unordered_map>

#include "rhi/messages.h"

namespace rhi_gl {

class Core;
struct ViewData;

// The targets of a draw in slot order, the depth-stencil view last. Null: nothing there.
struct TargetSet {
  std::array<const ViewData*, rhi::kMaxRenderTargets> colors{};
  uint32_t colorCount = 0;
  const ViewData* depth = nullptr;
};

struct Framebuffer {
  GLuint name = 0;
  uint32_t uid = 0;
  uint32_t samples = 1;
  bool floatDepth = false;
  // Why nothing can be drawn here; None: it can.
  rhi::MsgCode problem = rhi::MsgCode::None;
  std::string explanation;
};

class FramebufferCache {
 public:
  explicit FramebufferCache(Core& core) : core_(core) {}
  FramebufferCache(const FramebufferCache&) = delete;
  FramebufferCache& operator=(const FramebufferCache&) = delete;

  const Framebuffer& Get(const TargetSet&);
  void Forget(uint32_t viewUid);

 private:
  using Key = std::array<uint32_t, rhi::kMaxRenderTargets + 1>;  // uids of the views; 0: none
  struct Hash {
    size_t operator()(const Key&) const;
  };
  Framebuffer Make(const TargetSet&);
  bool TargetsAgree(const TargetSet&, Framebuffer*) const;

  Core& core_;
  std::unordered_map<Key, Framebuffer, Hash> made_;
};

// Attaches one mip and slice (or, layered, all slices) of a texture. `attachment` 0: where its format belongs.
struct Attachment {
  GLuint texture = 0;
  GLenum target = 0;
  rhi::Format format = rhi::Format::Unknown;
  uint32_t level = 0, layer = 0;
  bool layered = false;
};
void Attach(GLuint framebuffer, uint32_t colorIndex, const Attachment&);

// Copies a rectangle of (0, 0, width, height) between two framebuffers made on the spot: for resolves and mips. Scissor
// must be off.
class BlitPair {
 public:
  BlitPair();
  ~BlitPair();
  BlitPair(const BlitPair&) = delete;
  BlitPair& operator=(const BlitPair&) = delete;
  void Blit(const Attachment& from, uint32_t fromWidth, uint32_t fromHeight, const Attachment& to, uint32_t toWidth,
            uint32_t toHeight, GLenum filter);

 private:
  GLuint read_ = 0, draw_ = 0;
};

}  // namespace rhi_gl

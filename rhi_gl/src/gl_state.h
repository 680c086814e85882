// The shadow of GL's state: each setter calls GL only where the value differs. Objects are known by their uids, which
// are never used twice; GL's names are, so a name would not tell a new object from a dead one.
#pragma once

#include <epoxy/gl.h>

#include "rhi/types.h"

namespace rhi_gl {

inline constexpr uint32_t kUnknownUid = ~0u;
inline constexpr uint32_t kTextureUnits = 48;
inline constexpr uint32_t kStorageBlocks = 16;

class GlState {
 public:
  enum Toggle : uint32_t {
    DepthTest,
    StencilTest,
    CullFace,
    Scissor,
    OffsetFill,
    OffsetLine,
    DepthClamp,
    SampleMask,
    AlphaToCoverage,
    LineSmooth,
    StripCut,
    RasterizerDiscard,
    ToggleCount
  };

  GlState();

  void Set(Toggle toggle, bool on) {
    if (((toggles_ >> toggle) & 1u) == uint32_t(on)) return;
    Flip(toggle);
  }
  bool UseFramebuffer(uint32_t uid, GLuint name) {  // true: it was another
    if (framebuffer_ == uid) return false;
    framebuffer_ = uid;
    // For reading too, though nothing reads there: Mesa would look at each draw for what stands in for none.
    glBindFramebuffer(GL_FRAMEBUFFER, name);
    return true;
  }
  void UseProgram(uint32_t uid, GLuint name) {
    if (program_ == uid) return;
    program_ = uid;
    glUseProgram(name);
  }
  void UseVertexArray(uint32_t uid, GLuint name) {
    if (vertexArray_ == uid) return;
    vertexArray_ = uid;
    glBindVertexArray(name);
  }
  void UseTexture(uint32_t unit, uint32_t uid, GLuint name) {
    if (textures_[unit] == uid) return;
    textures_[unit] = uid;
    glBindTextureUnit(unit, name);
  }
  void UseSampler(uint32_t unit, uint32_t uid, GLuint name) {
    if (samplers_[unit] == uid) return;
    samplers_[unit] = uid;
    glBindSampler(unit, name);
  }
  void UseStorage(uint32_t block, uint32_t uid, GLuint name, uint32_t offset, uint32_t size);
  void UnbindStorage(uint32_t block) {
    storage_[block] = {};
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, block, 0);
  }
  void UseIndirect(uint32_t uid, GLuint name) {
    if (indirect_ == uid) return;
    indirect_ = uid;
    glBindBuffer(GL_DRAW_INDIRECT_BUFFER, name);
  }
  void UseDispatchIndirect(uint32_t uid, GLuint name) {
    if (dispatchIndirect_ == uid) return;
    dispatchIndirect_ = uid;
    glBindBuffer(GL_DISPATCH_INDIRECT_BUFFER, name);
  }

  // `biasUnits`: what one of depthBias is in GL's units (depth_bias.h).
  void SetRaster(const rhi::RasterizerDesc&, float biasUnits);
  void SetDepthStencil(const rhi::DepthStencilDesc&, uint32_t stencilRef);
  // `colors` false: no colour is written, whatever the descriptor says. Only the first `targets` are set.
  void SetBlend(const rhi::BlendDesc&, bool colors, uint32_t targets);
  void SetBlendFactor(const std::array<float, 4>&);
  void SetSampleMask(uint32_t mask, uint32_t samples);
  void SetViewports(const rhi::Viewport*, uint32_t count);
  void SetScissors(const rhi::Rect*, uint32_t count);

  // For clears, which in Direct3D know no masks and no scissor. What they change here differs afterwards, so the next
  // draw sets it right; the caller marks the state dirty.
  void OpenColorMask(uint32_t drawBuffer) {
    if (blend_[drawBuffer].writeMask != 0xF) SetColorMask(drawBuffer, 0xF);
  }
  void OpenDepthStencilMasks();
  void CloseClearGates() {
    Set(Scissor, false);
    Set(RasterizerDiscard, false);
  }

 private:
  void Flip(Toggle);
  void SetColorMask(uint32_t drawBuffer, uint8_t mask);
  void SetTargetBlend(uint32_t drawBuffer, const rhi::RenderTargetBlend&, uint8_t writeMask);
  void SetEquation(uint32_t drawBuffer, const rhi::RenderTargetBlend&);
  void SetStencilFace(GLenum face, rhi::StencilFace* shadow, const rhi::StencilFace&, const rhi::DepthStencilDesc&,
                      uint32_t ref);
  void SetDepthBias(const rhi::RasterizerDesc&, float biasUnits);

  uint32_t toggles_ = 0;
  uint32_t framebuffer_ = kUnknownUid, program_ = kUnknownUid, vertexArray_ = kUnknownUid, indirect_ = kUnknownUid,
           dispatchIndirect_ = kUnknownUid;
  std::array<uint32_t, kTextureUnits> textures_, samplers_;
  struct Range {
    uint32_t uid = kUnknownUid, offset = 0, size = 0;
    bool operator==(const Range&) const = default;
  };
  std::array<Range, kStorageBlocks> storage_;

  rhi::RasterizerDesc raster_{.cull = rhi::CullMode::Back, .frontCCW = false};  // GL's own; y is turned over
  float biasUnits_ = 1;
  rhi::DepthStencilDesc depth_{.depthEnable = false};
  uint32_t stencilRef_ = 0, stencilRead_ = 0xFF, stencilWrite_ = 0xFF;
  std::array<rhi::RenderTargetBlend, rhi::kMaxRenderTargets> blend_{};
  std::array<float, 4> blendFactor_{0, 0, 0, 0};
  uint32_t sampleMask_ = ~0u;
};

}  // namespace rhi_gl

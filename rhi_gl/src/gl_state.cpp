#include "gl_state.h"

#include <algorithm>
#include <bit>

#include "states.h"

namespace rhi_gl {
namespace {

constexpr std::array<GLenum, GlState::ToggleCount> kToggles{GL_DEPTH_TEST,
                                                            GL_STENCIL_TEST,
                                                            GL_CULL_FACE,
                                                            GL_SCISSOR_TEST,
                                                            GL_POLYGON_OFFSET_FILL,
                                                            GL_POLYGON_OFFSET_LINE,
                                                            GL_DEPTH_CLAMP,
                                                            GL_SAMPLE_MASK,
                                                            GL_SAMPLE_ALPHA_TO_COVERAGE,
                                                            GL_LINE_SMOOTH,
                                                            GL_PRIMITIVE_RESTART_FIXED_INDEX,
                                                            GL_RASTERIZER_DISCARD};

// Factors and operations as one number: one comparison instead of six.
uint64_t EquationOf(const RenderTargetBlend& b) {
  RenderTargetBlend equation = b;
  equation.enable = false;
  equation.writeMask = 0;
  return std::bit_cast<uint64_t>(equation);
}

bool HasBias(const RasterizerDesc& d) { return d.depthBias != 0 || d.slopeScaledBias != 0; }

}  // namespace

GlState::GlState() {
  textures_.fill(kUnknownUid);
  samplers_.fill(kUnknownUid);
}

void GlState::Flip(Toggle toggle) {
  toggles_ ^= 1u << toggle;
  if ((toggles_ >> toggle) & 1u) {
    glEnable(kToggles[toggle]);
  } else {
    glDisable(kToggles[toggle]);
  }
}

void GlState::UseStorage(uint32_t block, uint32_t uid, GLuint name, uint32_t offset, uint32_t size) {
  const Range range{uid, offset, size};
  if (storage_[block] == range) return;
  storage_[block] = range;
  glBindBufferRange(GL_SHADER_STORAGE_BUFFER, block, name, offset, size);
}

void GlState::SetDepthBias(const RasterizerDesc& d, float biasUnits) {
  Set(OffsetFill, HasBias(d));
  Set(OffsetLine, HasBias(d));
  if (!HasBias(d)) return;
  if (d.depthBias == raster_.depthBias && d.slopeScaledBias == raster_.slopeScaledBias &&
      d.depthBiasClamp == raster_.depthBiasClamp && biasUnits == biasUnits_)
    return;
  biasUnits_ = biasUnits;
  raster_.depthBias = d.depthBias;
  raster_.slopeScaledBias = d.slopeScaledBias;
  raster_.depthBiasClamp = d.depthBiasClamp;
  if (d.depthBiasClamp != 0) {
    glPolygonOffsetClampEXT(d.slopeScaledBias, float(d.depthBias) * biasUnits, d.depthBiasClamp);
  } else {
    glPolygonOffset(d.slopeScaledBias, float(d.depthBias) * biasUnits);
  }
}

void GlState::SetRaster(const RasterizerDesc& d, float biasUnits) {
  if (d.fill != raster_.fill) glPolygonMode(GL_FRONT_AND_BACK, d.fill == FillMode::Wireframe ? GL_LINE : GL_FILL);
  raster_.fill = d.fill;
  Set(CullFace, d.cull != CullMode::None);
  if (d.cull != CullMode::None && d.cull != raster_.cull) {
    glCullFace(d.cull == CullMode::Front ? GL_FRONT : GL_BACK);
    raster_.cull = d.cull;
  }
  if (d.frontCCW != raster_.frontCCW) glFrontFace(d.frontCCW ? GL_CW : GL_CCW);  // y is turned over
  raster_.frontCCW = d.frontCCW;
  SetDepthBias(d, biasUnits);
  Set(DepthClamp, !d.depthClip);
  Set(Scissor, d.scissor);
  Set(LineSmooth, d.antialiasedLine && !d.multisample);
}

void GlState::SetStencilFace(GLenum face, StencilFace* shadow, const StencilFace& f, const DepthStencilDesc& d,
                             uint32_t ref) {
  if (f.func != shadow->func || d.readMask != stencilRead_ || ref != stencilRef_)
    glStencilFuncSeparate(face, ToGl(f.func), GLint(ref), d.readMask);
  if (f.fail != shadow->fail || f.depthFail != shadow->depthFail || f.pass != shadow->pass)
    glStencilOpSeparate(face, ToGl(f.fail), ToGl(f.depthFail), ToGl(f.pass));
  *shadow = f;
}

void GlState::SetDepthStencil(const DepthStencilDesc& d, uint32_t stencilRef) {
  Set(DepthTest, d.depthEnable);
  if (d.depthEnable) {
    if (d.depthWrite != depth_.depthWrite) glDepthMask(d.depthWrite);
    if (d.depthFunc != depth_.depthFunc) glDepthFunc(ToGl(d.depthFunc));
    depth_.depthWrite = d.depthWrite;
    depth_.depthFunc = d.depthFunc;
  }
  Set(StencilTest, d.stencilEnable);
  if (!d.stencilEnable) return;
  SetStencilFace(GL_FRONT, &depth_.front, d.front, d, stencilRef);
  SetStencilFace(GL_BACK, &depth_.back, d.back, d, stencilRef);
  if (d.writeMask != stencilWrite_) glStencilMask(d.writeMask);
  stencilWrite_ = d.writeMask;
  stencilRead_ = d.readMask;
  stencilRef_ = stencilRef;
}

void GlState::OpenDepthStencilMasks() {
  if (!depth_.depthWrite) glDepthMask(GL_TRUE);
  depth_.depthWrite = true;
  if (stencilWrite_ != 0xFF) glStencilMask(0xFF);
  stencilWrite_ = 0xFF;
}

void GlState::SetColorMask(uint32_t drawBuffer, uint8_t mask) {
  blend_[drawBuffer].writeMask = mask;
  glColorMaski(drawBuffer, mask & 1, (mask >> 1) & 1, (mask >> 2) & 1, (mask >> 3) & 1);
}

// The switch comes last, so that it can be a jump.
inline void GlState::SetTargetBlend(uint32_t i, const RenderTargetBlend& b, uint8_t mask) {
  RenderTargetBlend& shadow = blend_[i];
  if (b.enable && EquationOf(b) != EquationOf(shadow)) SetEquation(i, b);
  if (mask != shadow.writeMask) SetColorMask(i, mask);
  if (b.enable == shadow.enable) return;
  shadow.enable = b.enable;
  if (b.enable) {
    glEnablei(GL_BLEND, i);
  } else {
    glDisablei(GL_BLEND, i);
  }
}

void GlState::SetEquation(uint32_t i, const RenderTargetBlend& b) {
  RenderTargetBlend& shadow = blend_[i];
  if (b.src != shadow.src || b.dest != shadow.dest || b.srcAlpha != shadow.srcAlpha || b.destAlpha != shadow.destAlpha)
    glBlendFuncSeparatei(i, ToGl(b.src), ToGl(b.dest), ToGl(b.srcAlpha), ToGl(b.destAlpha));
  if (b.op != shadow.op || b.opAlpha != shadow.opAlpha) glBlendEquationSeparatei(i, ToGl(b.op), ToGl(b.opAlpha));
  shadow = {shadow.enable, b.src, b.dest, b.op, b.srcAlpha, b.destAlpha, b.opAlpha, shadow.writeMask};
}

void GlState::SetBlend(const BlendDesc& d, bool colors, uint32_t targets) {
  Set(AlphaToCoverage, d.alphaToCoverage);
  const auto set = [&](uint32_t i, const RenderTargetBlend& b) { SetTargetBlend(i, b, colors ? b.writeMask : 0); };
  if (targets == 1) [[likely]]
    return set(0, d.rt[0]);
  for (uint32_t i = 0; i < targets; ++i) set(i, d.rt[d.independent ? i : 0]);
}

void GlState::SetBlendFactor(const std::array<float, 4>& f) {
  if (f == blendFactor_) return;
  blendFactor_ = f;
  glBlendColor(f[0], f[1], f[2], f[3]);
}

void GlState::SetSampleMask(uint32_t mask, uint32_t samples) {
  Set(SampleMask, samples > 1 && mask != ~0u);
  if (samples > 1 && mask != sampleMask_) {
    sampleMask_ = mask;
    glSampleMaski(0, mask);
  }
  // GL has no sample mask on targets of one sample, Direct3D has: without its only sample nothing is drawn.
  Set(RasterizerDiscard, samples == 1 && (mask & 1u) == 0);
}

void GlState::SetViewports(const Viewport* viewports, uint32_t count) {
  std::array<GLfloat, 4 * kMaxViewports> rects{};
  std::array<GLdouble, 2 * kMaxViewports> depths{};
  for (uint32_t i = 0; i < count; ++i) {
    const Viewport& v = viewports[i];
    const GLfloat rect[4] = {v.x, v.y, v.width, v.height};
    std::copy(rect, rect + 4, rects.begin() + 4 * i);
    depths[2 * i] = double(v.minDepth);
    depths[2 * i + 1] = double(v.maxDepth);
  }
  // Without a viewport nothing is drawn: one of no size.
  const GLsizei n = GLsizei(std::max(count, 1u));
  glViewportArrayv(0, n, rects.data());
  glDepthRangeArrayv(0, n, depths.data());
}

void GlState::SetScissors(const Rect* scissors, uint32_t count) {
  std::array<GLint, 4 * kMaxViewports> rects{};
  for (uint32_t i = 0; i < count; ++i) {
    const Rect& r = scissors[i];
    const GLint rect[4] = {r.left, r.top, std::max(0, r.right - r.left), std::max(0, r.bottom - r.top)};
    std::copy(rect, rect + 4, rects.begin() + 4 * i);
  }
  glScissorArrayv(0, GLsizei(kMaxViewports), rects.data());  // those not given are empty
}

}  // namespace rhi_gl

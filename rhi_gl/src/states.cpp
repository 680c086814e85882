#include "states.h"

#include "rhi/backend/checks.h"

namespace rhi_gl {
namespace {

// From Direct3D's numbers, which begin at 1, to GL's enums.
template <class E, size_t N>
GLenum Lookup(const std::array<GLenum, N>& table, E value) {
  const size_t i = size_t(value) - 1;
  return table[i < N ? i : 0];
}

// The living object of an equal descriptor, or a new one.
template <class State, class Desc, class Interface>
Status Intern(Status checked, const CorePtr& core, backend::Interner<Desc, State>& table, const Desc& desc,
              Ref<Interface>* out) {
  if (checked != Status::Ok) return checked;
  Ref<State> state = table.Find(desc);
  if (!state) {
    state = Ref<State>::Adopt(new State(core, desc));
    table.Remember(state.get());
  }
  *out = state;
  return Status::Ok;
}

GLenum ToGl(AddressMode mode) {
  constexpr std::array<GLenum, 4> kModes{GL_REPEAT, GL_MIRRORED_REPEAT, GL_CLAMP_TO_EDGE, GL_CLAMP_TO_BORDER};
  return Lookup(kModes, mode);
}

bool IsAnisotropic(const SamplerDesc& d) {
  return d.min == Filter::Anisotropic || d.mag == Filter::Anisotropic || d.mip == Filter::Anisotropic;
}

// Direct3D's anisotropic filter is one for all three; minification then is linear in every way.
GLenum MinFilter(const SamplerDesc& d) {
  if (IsAnisotropic(d)) return GL_LINEAR_MIPMAP_LINEAR;
  if (d.min == Filter::Point) return d.mip == Filter::Point ? GL_NEAREST_MIPMAP_NEAREST : GL_NEAREST_MIPMAP_LINEAR;
  return d.mip == Filter::Point ? GL_LINEAR_MIPMAP_NEAREST : GL_LINEAR_MIPMAP_LINEAR;
}

}  // namespace

GLenum ToGl(Comparison func) {
  constexpr std::array<GLenum, 8> kFuncs{GL_NEVER,   GL_LESS,     GL_EQUAL,  GL_LEQUAL,
                                         GL_GREATER, GL_NOTEQUAL, GL_GEQUAL, GL_ALWAYS};
  return Lookup(kFuncs, func);
}

GLenum ToGl(StencilOp op) {
  constexpr std::array<GLenum, 8> kOps{GL_KEEP, GL_ZERO,   GL_REPLACE,   GL_INCR,
                                       GL_DECR, GL_INVERT, GL_INCR_WRAP, GL_DECR_WRAP};
  return Lookup(kOps, op);
}

GLenum ToGl(BlendOp op) {
  constexpr std::array<GLenum, 5> kOps{GL_FUNC_ADD, GL_FUNC_SUBTRACT, GL_FUNC_REVERSE_SUBTRACT, GL_MIN, GL_MAX};
  return Lookup(kOps, op);
}

GLenum ToGl(Blend factor) {
  constexpr std::array<GLenum, 17> kFactors{GL_ZERO,
                                            GL_ONE,
                                            GL_SRC_COLOR,
                                            GL_ONE_MINUS_SRC_COLOR,
                                            GL_SRC_ALPHA,
                                            GL_ONE_MINUS_SRC_ALPHA,
                                            GL_DST_ALPHA,
                                            GL_ONE_MINUS_DST_ALPHA,
                                            GL_DST_COLOR,
                                            GL_ONE_MINUS_DST_COLOR,
                                            GL_SRC_ALPHA_SATURATE,
                                            GL_CONSTANT_COLOR,
                                            GL_ONE_MINUS_CONSTANT_COLOR,
                                            GL_SRC1_COLOR,
                                            GL_ONE_MINUS_SRC1_COLOR,
                                            GL_SRC1_ALPHA,
                                            GL_ONE_MINUS_SRC1_ALPHA};
  return Lookup(kFactors, factor);
}

SamplerState::SamplerState(const CorePtr& core, const SamplerDesc& desc) : core_(core), desc_(desc) {
  uid = core->NewUid();
  glCreateSamplers(1, &name);
  glSamplerParameteri(name, GL_TEXTURE_WRAP_S, GLint(ToGl(desc.u)));
  glSamplerParameteri(name, GL_TEXTURE_WRAP_T, GLint(ToGl(desc.v)));
  glSamplerParameteri(name, GL_TEXTURE_WRAP_R, GLint(ToGl(desc.w)));
  glSamplerParameteri(name, GL_TEXTURE_MIN_FILTER, GLint(MinFilter(desc)));
  const bool point = desc.mag == Filter::Point && !IsAnisotropic(desc);
  glSamplerParameteri(name, GL_TEXTURE_MAG_FILTER, point ? GL_NEAREST : GL_LINEAR);
  glSamplerParameterf(name, GL_TEXTURE_LOD_BIAS, desc.mipBias);
  glSamplerParameterf(name, GL_TEXTURE_MIN_LOD, desc.minLod);
  glSamplerParameterf(name, GL_TEXTURE_MAX_LOD, desc.maxLod);
  glSamplerParameterfv(name, GL_TEXTURE_BORDER_COLOR, desc.border.data());
  if (desc.comparison) glSamplerParameteri(name, GL_TEXTURE_COMPARE_MODE, GL_COMPARE_REF_TO_TEXTURE);
  glSamplerParameteri(name, GL_TEXTURE_COMPARE_FUNC, GLint(rhi_gl::ToGl(desc.func)));
  if (IsAnisotropic(desc) && core->caps.samplerAnisotropy)
    glSamplerParameterf(name, GL_TEXTURE_MAX_ANISOTROPY_EXT, float(desc.maxAniso));
}

SamplerState::~SamplerState() {
  core_->samplerStates.Forget(this);
  core_->Discard(NameKind::Sampler, name);
}

Status CreateBlendState(const CorePtr& core, const BlendDesc& desc, Ref<IBlendState>* out) {
  return Intern(backend::CheckBlendDesc(desc, core->caps, core->log), core, core->blendStates, desc, out);
}

Status CreateDepthStencilState(const CorePtr& core, const DepthStencilDesc& desc, Ref<IDepthStencilState>* out) {
  return Intern(backend::CheckDepthStencilDesc(desc, core->log), core, core->depthStencilStates, desc, out);
}

Status CreateRasterizerState(const CorePtr& core, const RasterizerDesc& desc, Ref<IRasterizerState>* out) {
  const Status checked = backend::CheckRasterizerDesc(desc, core->caps, core->log);
  if (checked == Status::Ok && desc.depthBias != 0) core->CalibrateDepthBias();
  return Intern(checked, core, core->rasterizerStates, desc, out);
}

Status CreateSamplerState(const CorePtr& core, const SamplerDesc& desc, Ref<ISamplerState>* out) {
  return Intern(backend::CheckSamplerDesc(desc, core->caps, core->log), core, core->samplerStates, desc, out);
}

}  // namespace rhi_gl

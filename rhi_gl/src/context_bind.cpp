#include <bit>

#include "context.h"

namespace rhi_gl {
namespace {

// One texel of zeros for a sampler of this kind.
GLuint MakeZeroTexture(TextureDim dim, bool integer) {
  const GLenum target = TargetOf(dim), internal = integer ? GL_RGBA8UI : GL_RGBA8;
  GLuint name = 0;
  glCreateTextures(target, 1, &name);
  if (dim == TextureDim::Tex2DMS) {
    glTextureStorage2DMultisample(name, 2, internal, 1, 1, GL_TRUE);
  } else if (dim == TextureDim::Tex2DArray || dim == TextureDim::Tex3D) {
    glTextureStorage3D(name, 1, internal, 1, 1, 1);
  } else {
    glTextureStorage2D(name, 1, internal, 1, 1);
  }
  glClearTexImage(name, 0, integer ? GL_RGBA_INTEGER : GL_RGBA, GL_UNSIGNED_BYTE, nullptr);
  return name;
}

bool Fits(const ViewData& view, const ShaderResource& declared, bool written) {
  return backend::ShowsAs(view.texture ? &view.texture->Desc() : nullptr, view.desc, declared, written);
}

}  // namespace

void Context::SetConstantBuffers(uint32_t first, uint32_t count, IBuffer* const* buffers) {
  // Buffers know the registers that show them, so that an update finds its register without a search.
  UnmarkConstants();
  ContextBase::SetConstantBuffers(first, count, buffers);
  for (uint32_t i = 0; i < kMaxConstantBuffers; ++i)
    if (auto* b = static_cast<Buffer*>(state_.constants[i].get())) b->boundSlots |= 1u << i;
}

void Context::UnmarkConstants() {
  for (const Ref<IBuffer>& bound : state_.constants)
    if (auto* b = static_cast<Buffer*>(bound.get())) {
      b->boundSlots = 0;
      b->quickSize = Buffer::kNoQuickSize;
    }
}

void Context::ClearState() {
  UnmarkConstants();
  ContextBase::ClearState();
}

void Context::BindConstants(uint32_t slots) {
  dirty_ &= ~(0xFu * DirtyConstantSlot);
  for (; slots != 0; slots &= slots - 1) {
    const uint32_t slot = uint32_t(std::countr_zero(slots));
    const auto* buffer = static_cast<const Buffer*>(state_.constants[slot].get());
    if (buffer) [[likely]] {
      glBindBufferRange(GL_UNIFORM_BUFFER, slot, buffer->name, GLintptr(buffer->offset), GLsizeiptr(buffer->range));
    } else {
      glBindBufferRange(GL_UNIFORM_BUFFER, slot, core_.zeroBuffer, 0, kMaxConstantBufferBytes);
    }
  }
}

void Context::BindStage(Stage stage, const Shader& shader) {
  for (uint32_t i = 0; i < shader.pairs.size(); ++i) BindPair(kGlUnitBase[size_t(stage)] + i, stage, shader, i);
  for (uint32_t i = 0; i < shader.storage.size(); ++i)
    BindStorage(kGlBufferBase[size_t(stage)] + i, stage, *shader.storage[i]);
}

void Context::BindPair(uint32_t unit, Stage stage, const Shader& shader, uint32_t pair) {
  const ShaderTexturePair slots = shader.reflection.pairs[pair];
  const ShaderResource& declared = *shader.pairs[pair];
  const auto* view = static_cast<const ShaderResourceView*>(state_.resources[size_t(stage)][slots.texture].get());
  if (view && Fits(*view, declared, false)) {
    gl_.UseTexture(unit, view->uid, view->name);
  } else {
    ReportUnbound(stage, declared, view != nullptr);
    BindDummy(unit, declared);
  }
  const auto* sampler = static_cast<const SamplerState*>(loadSampler_.get());
  if (slots.sampler != kNoSampler) {
    sampler = static_cast<const SamplerState*>(state_.samplers[size_t(stage)][slots.sampler].get());
    if (!sampler) sampler = static_cast<const SamplerState*>(defaultSampler_.get());
  }
  gl_.UseSampler(unit, sampler->uid, sampler->name);
}

void Context::ReportUnbound(Stage stage, const ShaderResource& declared, bool other) {
  if (other) {
    ReportOnce(Severity::Error, MsgCode::ViewMismatch,
               "%s t%u: the view is of another kind, dimension or type of texels than the shader's %s; it reads 0",
               ToString(stage), declared.slot, declared.name);
  } else {
    ReportOnce(Severity::Warning, MsgCode::NothingBound,
               "%s t%u: nothing is bound where the shader reads %s; it reads 0", ToString(stage), declared.slot,
               declared.name);
  }
}

void Context::BindDummy(uint32_t unit, const ShaderResource& declared) {
  GLuint& name = dummies_[size_t(declared.dim)][declared.integer];
  uint32_t& uid = dummyUids_[size_t(declared.dim)][declared.integer];
  if (name == 0) {
    name = MakeZeroTexture(declared.dim, declared.integer);
    uid = core_.NewUid();
  }
  gl_.UseTexture(unit, uid, name);
}

void Context::BindStorage(uint32_t block, Stage stage, const ShaderResource& declared) {
  const auto* view = static_cast<const ShaderResourceView*>(state_.resources[size_t(stage)][declared.slot].get());
  if (!view || !view->buffer) {
    ReportUnbound(stage, declared, view != nullptr);
    gl_.UseStorage(block, 0, core_.zeroBuffer, 0, kMaxConstantBufferBytes);
    return;
  }
  const Buffer& b = *view->buffer;
  gl_.UseStorage(block, b.uid, b.name, b.offset + view->desc.firstElement * view->stride,
                 view->desc.elementCount * view->stride);
}

void Context::BindUavs(const Shader& shader) {
  for (const ShaderResource* declared : shader.writable) {
    const auto* view = static_cast<const UnorderedAccessView*>(state_.uavs[declared->slot].get());
    const bool wantsBuffer = declared->kind == ShaderResourceKind::RWStructuredBuffer;
    if (view && !Fits(*view, *declared, true)) {
      ReportOnce(Severity::Error, MsgCode::ViewMismatch,
                 "u%u: the view is of another kind, dimension or type of texels than the shader's %s; it reads 0 and "
                 "writes are dropped",
                 declared->slot, declared->name);
      view = nullptr;
    } else if (!view) {
      ReportOnce(Severity::Warning, MsgCode::NothingBound,
                 "u%u: nothing is bound where the shader uses %s; it reads 0 and writes are dropped", declared->slot,
                 declared->name);
    }
    if (wantsBuffer) {
      BindUavBuffer(declared->slot, view);
    } else {
      BindUavTexture(declared->slot, view);
    }
  }
}

void Context::BindUavBuffer(uint32_t slot, const UnorderedAccessView* view) {
  // Nothing bound: a block with nothing behind it, whose reads robust access makes 0.
  if (!view) return gl_.UnbindStorage(kGlUavBufferBase + slot);
  const Buffer& b = *view->buffer;
  gl_.UseStorage(kGlUavBufferBase + slot, b.uid, b.name, view->desc.firstElement * view->stride,
                 view->desc.elementCount * view->stride);
}

void Context::BindUavTexture(uint32_t slot, const UnorderedAccessView* view) {
  const uint32_t uid = view ? view->uid : 0;
  if (images_[slot] == uid) return;
  images_[slot] = uid;
  glBindImageTexture(slot, view ? view->name : 0, 0, GL_TRUE, 0, GL_READ_WRITE,
                     view ? GetGlFormat(view->desc.format).internal : GLenum(GL_RGBA8));
}

}  // namespace rhi_gl

// State objects: interned descriptors. Only samplers are objects of GL's too.
#pragma once

#include "core.h"

namespace rhi_gl {

using backend::Object;

class BlendState final : public Object<IBlendState> {
 public:
  BlendState(const CorePtr& core, const BlendDesc& desc) : core_(core), desc_(desc) {}
  ~BlendState() override { core_->blendStates.Forget(this); }
  const BlendDesc& Desc() const override { return desc_; }

 private:
  CorePtr core_;
  BlendDesc desc_;
};

class DepthStencilState final : public Object<IDepthStencilState> {
 public:
  DepthStencilState(const CorePtr& core, const DepthStencilDesc& desc) : core_(core), desc_(desc) {}
  ~DepthStencilState() override { core_->depthStencilStates.Forget(this); }
  const DepthStencilDesc& Desc() const override { return desc_; }

 private:
  CorePtr core_;
  DepthStencilDesc desc_;
};

class RasterizerState final : public Object<IRasterizerState> {
 public:
  RasterizerState(const CorePtr& core, const RasterizerDesc& desc) : core_(core), desc_(desc) {}
  ~RasterizerState() override { core_->rasterizerStates.Forget(this); }
  const RasterizerDesc& Desc() const override { return desc_; }

 private:
  CorePtr core_;
  RasterizerDesc desc_;
};

class SamplerState final : public Object<ISamplerState> {
 public:
  SamplerState(const CorePtr& core, const SamplerDesc& desc);
  ~SamplerState() override;
  const SamplerDesc& Desc() const override { return desc_; }

  GLuint name = 0;
  uint32_t uid = 0;

 private:
  CorePtr core_;
  SamplerDesc desc_;
};

Status CreateBlendState(const CorePtr&, const BlendDesc&, Ref<IBlendState>* out);
Status CreateDepthStencilState(const CorePtr&, const DepthStencilDesc&, Ref<IDepthStencilState>* out);
Status CreateRasterizerState(const CorePtr&, const RasterizerDesc&, Ref<IRasterizerState>* out);
Status CreateSamplerState(const CorePtr&, const SamplerDesc&, Ref<ISamplerState>* out);

GLenum ToGl(Comparison);
GLenum ToGl(StencilOp);
GLenum ToGl(BlendOp);
GLenum ToGl(Blend);

}  // namespace rhi_gl

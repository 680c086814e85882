// What the techniques share: states, constants, the solid pass, and how a part of an animal is bound.
#pragma once

#include "creation.h"
#include "fur/groom.h"
#include "technique.h"

namespace fur {

// Registers that every pass fills alike, and the states that all use. glTF: counter-clockwise faces are front.
class PassBinding {
 public:
  PassBinding(Creation&, float volumeMipBias);

  void BindFrame(rhi::IContext&, const FrameInputs&) const;
  // Every texture of the material on every graphics stage, t0..t8 and s0, s1 (fur_volume.hlsli; t5..t7: the presets'
  // opacity map, map of fins and furless spots); b1.
  void SetMaterial(rhi::IContext&, const GpuMaterial&) const;
  // b2. `material`: what grows on the part.
  void SetObject(rhi::IContext&, const FrameInputs&, size_t animal, const GpuPart&, const GpuMaterial& material) const;
  void SetDraw(rhi::IContext&, const glm::vec4&) const;  // b3
  // `counting`: the shader that replaces every pixel shader.
  static void SetShaders(rhi::IContext&, const FrameInputs&, rhi::IShader* vs, rhi::IShader* gs, rhi::IShader* ps);
  static void SetVertices(rhi::IContext&, rhi::IBuffer* vertices, uint32_t stride, rhi::IBuffer* indices);
  rhi::IRasterizerState* Cull(const glm::dmat4& placement, const GpuPart&, rhi::CullMode) const;

  rhi::Ref<rhi::IDepthStencilState> depthWrite, depthRead;
  rhi::Ref<rhi::IBlendState> opaque;

 private:
  rhi::Ref<rhi::IRasterizerState> cullBack_, cullFront_, cullNone_;  // cullFront: cullBack of a mirrored part
  rhi::Ref<rhi::IBuffer> frame_, object_, draw_;
  rhi::Ref<rhi::ISamplerState> volumeSampler_;
};

// How a part's fur leans.
FurSway PartSway(const FrameInputs&, size_t animal, const GpuPart&, const GpuMaterial&);

// The solid pass: skin and bald parts.
class BasePass {
 public:
  // `furred`: the pixel shader of furred materials; null: that of all others.
  BasePass(Creation&, Look, const rhi::ShaderBlob* furred = nullptr);
  void Draw(rhi::IContext&, const PassBinding&, const GpuModel&, const FrameInputs&) const;
  // Skin with fur, or bare skin; in colour, or its depth alone.
  enum class Skin { Furred, Bare };
  enum class Output { Color, Depth };
  void Draw(rhi::IContext&, const PassBinding&, const GpuModel&, const FrameInputs&, Skin, Output) const;

 private:
  void DrawPart(rhi::IContext&, const PassBinding&, const GpuModel&, const FrameInputs&, size_t animal, const GpuPart&,
                rhi::IShader* ps) const;
  rhi::IShader* PixelShader(const GpuMaterial&) const;
  void SetStates(rhi::IContext&, const PassBinding&) const;

  rhi::Ref<rhi::IShader> vs_, ps_, furred_, wet_;
  rhi::Ref<rhi::IInputLayout> layout_;
  rhi::Ref<rhi::IBlendState> noColor_;
};

// The vertex layout of fur::Vertex.
rhi::Ref<rhi::IInputLayout> ModelLayout(Creation&, rhi::IShader* vs);

// One pass of a frame as a debug event, counted by its query where there is one.
template <class F>
void RunPass(rhi::IContext& context, const FrameInputs& in, Pass pass, F draw) {
  constexpr const char* kNames[kPassCount] = {"base", "fins", "shells"};
  rhi::IQuery* query = in.passQueries.empty() ? nullptr : in.passQueries[size_t(pass)].get();
  context.BeginEvent(kNames[size_t(pass)]);
  if (query) context.Begin(query);
  draw();
  if (query) context.End(query);
  context.EndEvent();
}

}  // namespace fur

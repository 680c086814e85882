#include "pass.h"

#include <cmath>
#include <cstddef>

#include "fur_shaders/fur_shaders.h"

namespace fur {
namespace {

FrameConstants MakeFrameConstants(const FrameInputs& in) {
  FrameConstants f{};
  f.eyeWorld = glm::vec4(in.eye, 1);
  // No direction at all: from above.
  const double length = glm::length(in.light.direction);
  const bool isDirection = length > 0 && std::isfinite(length);
  f.lightDirection = glm::vec4(isDirection ? in.light.direction / length : glm::dvec3(0, -1, 0), 0);
  f.lightDiffuse = glm::vec4(in.light.diffuse, 1);
  f.lightAmbient = glm::vec4(in.light.ambient, 1);
  f.lightSpecular = glm::vec4(in.light.specular, 1);
  return f;
}

}  // namespace

FurSway PartSway(const FrameInputs& in, size_t animal, const GpuPart& part, const GpuMaterial& material) {
  return MakeFurSway(material.groom, in.placements[animal], part.transform, in.motion.time, in.OffsetOf(animal));
}

ObjectConstants MakeObjectConstants(const glm::dmat4& objectToWorld, const FrameInputs& in) {
  glm::dmat4 objectToEye = objectToWorld;
  objectToEye[3] -= glm::dvec4(in.eye, 0);
  ObjectConstants o{};
  o.objectToClip = in.worldToClip * objectToWorld;
  o.objectToEye = objectToEye;
  o.normalToWorld = glm::dmat4(NormalMatrix(glm::dmat3(objectToWorld)));
  // A mirrored cross product points the other way.
  o.normalToWorld[3][3] = glm::determinant(glm::dmat3(objectToWorld)) < 0 ? -1 : 1;
  return o;
}

PassBinding::PassBinding(Creation& c, float volumeMipBias)
    : depthWrite(c.Depth({.depthFunc = rhi::Comparison::Greater})),
      depthRead(c.Depth({.depthWrite = false, .depthFunc = rhi::Comparison::Greater})),
      opaque(c.Blend(rhi::Blend::One, rhi::Blend::Zero)),
      cullBack_(c.Raster(rhi::CullMode::Back, true)),
      cullFront_(c.Raster(rhi::CullMode::Back, false)),
      cullNone_(c.Raster(rhi::CullMode::None, true)),
      frame_(c.DynamicConstants(sizeof(FrameConstants), "frame constants")),
      object_(c.DynamicConstants(sizeof(ObjectConstants), "object constants")),
      draw_(c.DynamicConstants(sizeof(DrawConstants), "draw constants")),
      volumeSampler_(c.Sampler(rhi::AddressMode::Wrap, volumeMipBias)) {}

void PassBinding::BindFrame(rhi::IContext& context, const FrameInputs& in) const {
  const FrameConstants frame = MakeFrameConstants(in);
  context.UpdateConstants(frame_.get(), &frame, sizeof frame);
  rhi::IBuffer* const buffers[] = {frame_.get(), nullptr, object_.get(), draw_.get()};
  context.SetConstantBuffers(0, 4, buffers);
}

void PassBinding::SetMaterial(rhi::IContext& context, const GpuMaterial& m) const {
  rhi::IBuffer* const constants[] = {m.constants.get()};
  context.SetConstantBuffers(1, 1, constants);
  rhi::IShaderResourceView* const views[] = {m.baseColor.get(), m.normal.get(), m.specular.get(), m.lengthMap.get(),
                                             m.furVolume.get(), m.opacityMap.get(), m.finMap.get(), m.spots.get(),
                                             m.furTint.get()};
  rhi::ISamplerState* const samplers[] = {m.surfaceSampler.get(), volumeSampler_.get()};
  for (const rhi::Stage stage : {rhi::Stage::Vertex, rhi::Stage::Geometry, rhi::Stage::Pixel}) {
    context.SetShaderResources(stage, 0, uint32_t(std::size(views)), views);
    context.SetSamplers(stage, 0, 2, samplers);
  }
}

void PassBinding::SetObject(rhi::IContext& context, const FrameInputs& in, size_t animal, const GpuPart& part,
                            const GpuMaterial& material) const {
  ObjectConstants o = MakeObjectConstants(in.placements[animal] * part.transform, in);
  const FurSway sway = PartSway(in, animal, part, material);
  o.comb = glm::vec4(sway.comb, sway.bend);
  o.gravity = glm::vec4(sway.gravity, 0);
  o.wind = glm::vec4(sway.wind, 0);
  o.windWave = glm::vec4(sway.wave, sway.phase);
  context.UpdateConstants(object_.get(), &o, sizeof o);
}

void PassBinding::SetDraw(rhi::IContext& context, const glm::vec4& values) const {
  const DrawConstants constants{values};
  context.UpdateConstants(draw_.get(), &constants, sizeof constants);
}

void PassBinding::SetShaders(rhi::IContext& context, const FrameInputs& in, rhi::IShader* vs, rhi::IShader* gs,
                             rhi::IShader* ps) {
  context.VSSetShader(vs);
  context.GSSetShader(gs);
  context.PSSetShader(in.countingShader ? in.countingShader : ps);
}

void PassBinding::SetVertices(rhi::IContext& context, rhi::IBuffer* vertices, uint32_t stride, rhi::IBuffer* indices) {
  const uint32_t offset = 0;
  context.IASetVertexBuffers(0, 1, &vertices, &stride, &offset);
  context.IASetIndexBuffer(indices, rhi::Format::R32_UInt, 0);
}

rhi::IRasterizerState* PassBinding::Cull(const glm::dmat4& placement, const GpuPart& part,
                                         rhi::CullMode cull) const {
  if (cull == rhi::CullMode::None) return cullNone_.get();
  const bool mirrored = part.mirrored != (glm::determinant(glm::dmat3(placement)) < 0);
  return (mirrored == (cull == rhi::CullMode::Back) ? cullFront_ : cullBack_).get();
}

rhi::Ref<rhi::IInputLayout> ModelLayout(Creation& c, rhi::IShader* vs) {
  using rhi::Format;
  constexpr rhi::InputElement kElements[] = {
      {.semantic = "POSITION", .format = Format::RGB32_Float, .offset = offsetof(Vertex, position)},
      {.semantic = "NORMAL", .format = Format::RGB32_Float, .offset = offsetof(Vertex, normal)},
      {.semantic = "TANGENT", .format = Format::RGBA32_Float, .offset = offsetof(Vertex, tangent)},
      {.semantic = "TEXCOORD", .format = Format::RG32_Float, .offset = offsetof(Vertex, uv)}};
  rhi::Ref<rhi::IInputLayout> layout;
  if (vs)
    c.Check(c.Device().CreateInputLayout(kElements, uint32_t(std::size(kElements)), vs, &layout), "the vertex layout");
  return layout;
}

BasePass::BasePass(Creation& c, Look look, const rhi::ShaderBlob* furred)
    : vs_(c.Shader(shaders::base_VSMain)),
      ps_(c.Shader(look == Look::Seed ? shaders::base_PSMain_seed : shaders::base_PSMain)),
      furred_(furred ? c.Shader(*furred) : ps_),
      wet_(furred ? furred_ : c.Shader(look == Look::Seed ? shaders::base_PSMain_seed_wet : shaders::base_PSMain_wet)),
      layout_(ModelLayout(c, vs_.get())),
      noColor_(c.NoColor()) {}

void BasePass::Draw(rhi::IContext& context, const PassBinding& binding, const GpuModel& model,
                    const FrameInputs& in) const {
  SetStates(context, binding);
  for (size_t animal = 0; animal < in.placements.size(); ++animal)
    for (const GpuPart& part : model.parts)
      DrawPart(context, binding, model, in, animal, part, PixelShader(model.materials[part.material]));
}

void BasePass::Draw(rhi::IContext& context, const PassBinding& binding, const GpuModel& model, const FrameInputs& in,
                    Skin skin, Output output) const {
  SetStates(context, binding);
  if (output == Output::Depth) context.OMSetBlendState(noColor_.get());
  for (size_t animal = 0; animal < in.placements.size(); ++animal)
    for (const GpuPart& part : model.parts) {
      const GpuMaterial& material = model.materials[part.material];
      if ((material.shells == 0) != (skin == Skin::Bare)) continue;
      DrawPart(context, binding, model, in, animal, part, output == Output::Color ? PixelShader(material) : nullptr);
    }
}

void BasePass::SetStates(rhi::IContext& context, const PassBinding& binding) const {
  context.IASetInputLayout(layout_.get());
  context.IASetPrimitiveTopology(rhi::PrimitiveTopology::TriangleList);
  context.OMSetBlendState(binding.opaque.get());
  context.OMSetDepthStencilState(binding.depthWrite.get());
}

rhi::IShader* BasePass::PixelShader(const GpuMaterial& material) const {
  if (material.shells == 0) return ps_.get();
  return material.wet ? wet_.get() : furred_.get();
}

void BasePass::DrawPart(rhi::IContext& context, const PassBinding& binding, const GpuModel& model, const FrameInputs& in,
                        size_t animal, const GpuPart& part, rhi::IShader* ps) const {
  const GpuMaterial& material = model.materials[part.material];
  const GpuGeometry& g = model.geometry[part.primitive];
  context.RSSetState(binding.Cull(in.placements[animal], part,
                                  material.doubleSided ? rhi::CullMode::None : rhi::CullMode::Back));
  PassBinding::SetShaders(context, in, vs_.get(), nullptr, ps);
  binding.SetMaterial(context, material);
  PassBinding::SetVertices(context, g.vertices.get(), sizeof(Vertex), g.indices.get());
  binding.SetObject(context, in, animal, part, material);
  context.DrawIndexed(g.indexCount, 0, 0);
  ++in.counts->draws;
  in.counts->triangles += g.indexCount / 3;
}

}  // namespace fur

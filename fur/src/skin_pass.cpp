#include "skin_pass.h"

#include <algorithm>

#include "fur_shaders/fur_shaders.h"

namespace fur {
namespace {

// Corners of what a box covers in clip space: x, y of the lower left, x, y of the upper right.
constexpr glm::vec4 kWholeFrame{-1, -1, 1, 1}, kNothing{1, 1, -1, -1};

glm::vec4 Around(const glm::vec4& a, const glm::vec4& b) {
  return {std::min(a.x, b.x), std::min(a.y, b.y), std::max(a.z, b.z), std::max(a.w, b.w)};
}

glm::vec4 RectangleOf(const Bounds& bounds, const glm::dmat4& objectToClip) {
  glm::vec4 rectangle = kNothing;
  for (int i = 0; i < 8; ++i) {
    const glm::dvec3 corner(i & 1 ? bounds.max.x : bounds.min.x, i & 2 ? bounds.max.y : bounds.min.y,
                            i & 4 ? bounds.max.z : bounds.min.z);
    const glm::dvec4 p = objectToClip * glm::dvec4(corner, 1);
    if (!(p.w > 0)) return kWholeFrame;  // beside or behind the eye
    const glm::vec2 at = glm::clamp(glm::dvec2(p) / p.w, -1.0, 1.0);
    rectangle = Around(rectangle, {at, at});
  }
  return rectangle;
}

}  // namespace

Result<Done> CheckSkinSamples(const RenderSettings& s) {
  if (s.skinSamples == 0 || s.skinSamples == s.samples) return Done{};
  if (s.technique == Technique::Seed)
    return Error{ErrorCode::Usage, "technique seed and its presets draw skin and fur with the same samples; leave out "
                                   "--skin-samples"};
  if (s.samples != 1 || s.skinSamples != 4)
    return Error{ErrorCode::Usage, "the skin can have 4 samples where the fur has 1, and no fewer than the fur"};
  return Done{};
}

SkinPass::SkinPass(Creation& c, const RenderSettings& settings) : base_(c, settings.look) {
  if (settings.skinSamples <= settings.samples) return;
  c.Check(MakeTargets(c.Device(), settings, settings.skinSamples, &apart_), "the skin's targets");
  if (apart_.color)
    c.Check(c.Device().CreateShaderResourceView(apart_.color.get(), nullptr, &apartView_), "the skin's view");
  vs_ = c.Shader(shaders::skin_resolve_VSMain);
  ps_ = c.Shader(shaders::skin_resolve_PSMain);
  raster_ = c.Raster(rhi::CullMode::None, false);
  noDepth_ = c.Depth({.depthEnable = false, .depthWrite = false});
}

void SkinPass::Draw(rhi::IContext& context, const PassBinding& binding, const GpuModel& model,
                    const FrameInputs& in) const {
  if (!apart_.color || in.countingShader) return base_.Draw(context, binding, model, in);
  BindTargets(context, apart_);
  ClearTargets(context, apart_, in.background);
  base_.Draw(context, binding, model, in);
  BindTargets(context, *in.targets);
  Resolve(context, binding, model, in);
  base_.DrawDepth(context, binding, model, in);
}

void SkinPass::Resolve(rhi::IContext& context, const PassBinding& binding, const GpuModel& model,
                       const FrameInputs& in) const {
  glm::vec4 rectangle = kNothing;
  for (const glm::dmat4& placement : in.placements)
    rectangle = Around(rectangle, RectangleOf(model.bounds, in.worldToClip * placement));
  if (rectangle.x >= rectangle.z || rectangle.y >= rectangle.w) return;  // no skin in the frame
  context.IASetInputLayout(nullptr);
  context.IASetPrimitiveTopology(rhi::PrimitiveTopology::TriangleStrip);
  PassBinding::SetShaders(context, in, vs_.get(), nullptr, ps_.get());
  context.RSSetState(raster_.get());
  context.OMSetBlendState(binding.opaque.get());
  context.OMSetDepthStencilState(noDepth_.get());
  binding.SetDraw(context, rectangle);
  rhi::IShaderResourceView* view = apartView_.get();
  context.PSSetShaderResources(0, 1, &view);
  context.Draw(4, 0);
  view = nullptr;
  context.PSSetShaderResources(0, 1, &view);  // the next frame draws to it
}

}  // namespace fur

#include "skin_pass.h"

#include <algorithm>
#include <cmath>

#include "fur_shaders/fur_shaders.h"

namespace fur {
namespace {

constexpr uint32_t kGrain = 64;  // of the target's sides, so that it is not made anew for every pixel

// What drawing a triangle of skin once more costs, in pixels that are cleared and blended: two boxes are one where that is
// cheaper. Measured on llvmpipe, where it matters.
constexpr double kPixelsOfATriangle = 10;

PixelBox Around(const PixelBox& a, const PixelBox& b) {
  return {std::min(a.left, b.left), std::min(a.top, b.top), std::max(a.right, b.right), std::max(a.bottom, b.bottom)};
}

// Of a box in the picture, with a pixel around it.
PixelBox Covered(const Bounds& bounds, const glm::dmat4& objectToClip, uint32_t width, uint32_t height) {
  const glm::dvec2 size(width, height);
  glm::dvec2 low(INFINITY), high(-INFINITY);
  for (int i = 0; i < 8; ++i) {
    const glm::dvec3 corner(i & 1 ? bounds.max.x : bounds.min.x, i & 2 ? bounds.max.y : bounds.min.y,
                            i & 4 ? bounds.max.z : bounds.min.z);
    const glm::dvec4 p = objectToClip * glm::dvec4(corner, 1);
    if (!(p.w > 0) || !std::isfinite(p.x / p.w) || !std::isfinite(p.y / p.w)) return {0, 0, int32_t(width), int32_t(height)};
    const glm::dvec2 at = glm::dvec2(0.5 + 0.5 * p.x / p.w, 0.5 - 0.5 * p.y / p.w) * size;
    low = glm::min(low, at), high = glm::max(high, at);
  }
  low = glm::clamp(glm::floor(low) - 1.0, glm::dvec2(0), size);
  high = glm::clamp(glm::ceil(high) + 1.0, glm::dvec2(0), size);
  return {int32_t(low.x), int32_t(low.y), int32_t(high.x), int32_t(high.y)};
}

uint64_t SkinTriangles(const GpuModel& model) {
  uint64_t triangles = 0;
  for (const GpuPart& part : model.parts) triangles += model.geometry[part.primitive].indexCount / 3;
  return triangles;
}

uint32_t Rounded(int32_t side, uint32_t most) { return std::min((uint32_t(side) + kGrain - 1) / kGrain * kGrain, most); }

}  // namespace

Result<Done> CheckSkinSamples(const RenderSettings& s) {
  if (s.skinSamples == 0 || s.skinSamples == s.samples) return Done{};
  if (s.technique == Technique::Seed)
    return Error{ErrorCode::Usage, "technique seed and its presets draw skin and fur with the same samples; leave out "
                                   "--skin-samples"};
  if (s.samples != 1 || s.skinSamples != 4)
    return Error{ErrorCode::Usage, "bare skin (--skin-samples) can have 4 samples where the fur (--samples) has 1, and no fewer"};
  return Done{};
}

std::vector<PixelBox> BoxesOfBarePieces(const GpuModel& model, const FrameInputs& in, uint32_t width, uint32_t height) {
  const double drawing = kPixelsOfATriangle * double(SkinTriangles(model)) * double(in.placements.size());
  std::vector<PixelBox> boxes;
  const auto add = [&](PixelBox box) {
    for (size_t i = 0; i < boxes.size();) {
      const PixelBox both = Around(box, boxes[i]);
      if (!boxes[i].Overlaps(box) && both.Area() > box.Area() + boxes[i].Area() + drawing) {
        ++i;
        continue;
      }
      box = both;
      boxes.erase(boxes.begin() + ptrdiff_t(i));
      i = 0;  // the larger one may take in those before
    }
    boxes.push_back(box);
  };
  for (const glm::dmat4& placement : in.placements)
    for (const GpuPart& part : model.parts)
      for (const Bounds& piece : model.geometry[part.primitive].pieces) {
        const PixelBox box = Covered(piece, in.worldToClip * placement * part.transform, width, height);
        if (!box.Empty()) add(box);
      }
  return boxes;
}

SkinPass::SkinPass(Creation& c, const RenderSettings& settings)
    : device_(c.Device()), settings_(settings), base_(c, settings.look) {
  if (settings.skinSamples <= settings.samples) return;
  vs_ = c.Shader(shaders::skin_resolve_VSMain);
  ps_ = c.Shader(shaders::skin_resolve_PSMain);
  raster_ = c.Raster(rhi::CullMode::None, false);
  noDepth_ = c.Depth({.depthEnable = false, .depthWrite = false});
  over_ = c.Blend(rhi::Blend::One, rhi::Blend::InvSrcAlpha);
}

void SkinPass::Draw(rhi::IContext& context, const PassBinding& binding, const GpuModel& model, const FrameInputs& in) {
  std::vector<PixelBox> boxes;
  if (ps_ && !in.countingShader) boxes = BoxesOfBarePieces(model, in, settings_.width, settings_.height);
  if (boxes.empty() || !MakeApart(boxes)) return base_.Draw(context, binding, model, in);
  base_.Draw(context, binding, model, in, BasePass::Skin::Furred, BasePass::Output::Color);
  base_.Draw(context, binding, model, in, BasePass::Skin::Bare, BasePass::Output::Depth);
  for (const PixelBox& box : boxes) {
    DrawApart(context, binding, model, in, box);
    Blend(context, binding, in, box);
  }
  SetFrameViewport(context, 0, 0);
}

void SkinPass::DrawApart(rhi::IContext& context, const PassBinding& binding, const GpuModel& model, const FrameInputs& in,
                         const PixelBox& box) const {
  BindTargets(context, apart_);
  ClearTargets(context, apart_, glm::vec4(0));
  SetFrameViewport(context, -box.left, -box.top);
  base_.Draw(context, binding, model, in, BasePass::Skin::Furred, BasePass::Output::Depth);
  base_.Draw(context, binding, model, in, BasePass::Skin::Bare, BasePass::Output::Color);
}

void SkinPass::Blend(rhi::IContext& context, const PassBinding& binding, const FrameInputs& in, const PixelBox& box) const {
  constexpr uint32_t kSlot = 9;  // skin_resolve.hlsl: beyond a material's
  BindTargets(context, *in.targets);
  context.IASetInputLayout(nullptr);
  context.IASetPrimitiveTopology(rhi::PrimitiveTopology::TriangleStrip);
  PassBinding::SetShaders(context, in, vs_.get(), nullptr, ps_.get());
  context.RSSetState(raster_.get());
  context.OMSetBlendState(over_.get());
  context.OMSetDepthStencilState(noDepth_.get());
  binding.SetDraw(context, {box.left, box.top, 0, 0});
  rhi::IShaderResourceView* view = apartView_.get();
  context.PSSetShaderResources(kSlot, 1, &view);
  const rhi::Viewport viewport{.x = float(box.left), .y = float(box.top), .width = float(box.right - box.left),
                               .height = float(box.bottom - box.top)};
  context.RSSetViewports(1, &viewport);
  context.Draw(4, 0);
  ++in.counts->draws;
  in.counts->triangles += 2;
  view = nullptr;
  context.PSSetShaderResources(kSlot, 1, &view);  // what comes next draws to it
}

// False where there is no memory for it: the frame then keeps its one sample.
bool SkinPass::MakeApart(const std::vector<PixelBox>& boxes) {
  uint32_t width = apartWidth_, height = apartHeight_;
  for (const PixelBox& box : boxes) {
    width = std::max(width, Rounded(box.right - box.left, settings_.width));
    height = std::max(height, Rounded(box.bottom - box.top, settings_.height));
  }
  if (width == apartWidth_ && height == apartHeight_) return true;
  RenderSettings s = settings_;
  s.width = width, s.height = height;
  Targets made;
  rhi::Ref<rhi::IShaderResourceView> view;
  if (MakeTargets(device_, s, s.skinSamples, &made) != rhi::Status::Ok) return false;
  if (device_.CreateShaderResourceView(made.color.get(), nullptr, &view) != rhi::Status::Ok) return false;
  apart_ = std::move(made), apartView_ = std::move(view), apartWidth_ = width, apartHeight_ = height;
  return true;
}

void SkinPass::SetFrameViewport(rhi::IContext& context, int32_t left, int32_t top) const {
  const rhi::Viewport viewport{.x = float(left), .y = float(top), .width = float(settings_.width),
                               .height = float(settings_.height)};
  context.RSSetViewports(1, &viewport);
}

}  // namespace fur

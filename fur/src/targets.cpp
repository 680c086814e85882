#include "targets.h"

namespace fur {
namespace {

rhi::Format PictureFormat(Look look) {
  return look == Look::Correct ? rhi::Format::RGBA8_UNorm_sRGB : rhi::Format::RGBA8_UNorm;
}

}  // namespace

rhi::Format FrameFormat(const RenderSettings& s) {
  switch (s.target) {
    case TargetFormat::Float16: return rhi::Format::RGBA16_Float;
    case TargetFormat::Float32: return rhi::Format::RGBA32_Float;
    default: return PictureFormat(s.look);
  }
}

rhi::Status MakeTargets(rhi::IDevice& device, const RenderSettings& s, uint32_t samples, Targets* t) {
  using namespace rhi;
  t->format = FrameFormat(s);
  TextureDesc color{.dim = samples > 1 ? TextureDim::Tex2DMS : TextureDim::Tex2D, .width = s.width, .height = s.height,
                    .sampleCount = samples, .format = t->format, .bind = Bind::RenderTarget | Bind::ShaderResource,
                    .name = "colour"};
  TextureDesc depth = color;
  depth.format = Format::D32_Float;
  depth.bind = Bind::DepthStencil;
  depth.name = "depth";
  Status status = device.CreateTexture(color, nullptr, &t->color);
  if (status == Status::Ok) status = device.CreateTexture(depth, nullptr, &t->depth);
  if (status == Status::Ok) status = device.CreateRenderTargetView(t->color.get(), nullptr, &t->colorView);
  if (status == Status::Ok) status = device.CreateDepthStencilView(t->depth.get(), nullptr, &t->depthView);
  return status;
}

void BindTargets(rhi::IContext& context, const Targets& targets) {
  rhi::IRenderTargetView* const views[] = {targets.colorView.get()};
  context.OMSetRenderTargets(1, views, targets.depthView.get());
}

void ClearTargets(rhi::IContext& context, const Targets& targets, const glm::vec4& background) {
  context.ClearRenderTargetView(targets.colorView.get(), &background.x);
  context.ClearDepthStencilView(targets.depthView.get(), true, 0, false, 0);
}

}  // namespace fur

#include "emitted.h"

#include "technique.h"

namespace fur::test {
namespace {

struct Probe {
  rhi::Ref<rhi::ITexture> color, depth;
  rhi::Ref<rhi::IRenderTargetView> colorView;
  rhi::Ref<rhi::IDepthStencilView> depthView;
  rhi::Ref<rhi::IQuery> query;
};

Probe MakeProbe(rhi::IDevice& device) {
  Probe p;
  rhi::TextureDesc desc{
      .width = 96, .height = 64, .format = rhi::Format::RGBA8_UNorm_sRGB, .bind = rhi::Bind::RenderTarget};
  EXPECT_EQ(device.CreateTexture(desc, nullptr, &p.color), rhi::Status::Ok);
  desc.format = rhi::Format::D32_Float;
  desc.bind = rhi::Bind::DepthStencil;
  EXPECT_EQ(device.CreateTexture(desc, nullptr, &p.depth), rhi::Status::Ok);
  EXPECT_EQ(device.CreateRenderTargetView(p.color.get(), nullptr, &p.colorView), rhi::Status::Ok);
  EXPECT_EQ(device.CreateDepthStencilView(p.depth.get(), nullptr, &p.depthView), rhi::Status::Ok);
  EXPECT_EQ(device.CreateQuery({rhi::QueryType::PipelineStatistics}, &p.query), rhi::Status::Ok);
  return p;
}

}  // namespace

uint64_t EmittedTriangles(TestDevice& testDevice, const Model& model, const RenderSettings& settings,
                          const Camera& camera, const glm::dmat4& placement) {
  rhi::IDevice& device = *testDevice;
  const Probe probe = MakeProbe(device);
  Result<GpuModel> gpu = UploadModel(device, model, settings);
  Result<std::unique_ptr<ITechnique>> technique = settings.technique == Technique::Seed
                                                      ? MakeSeedTechnique(device, settings)
                                                      : MakeShellsTechnique(device, settings);
  if (!gpu || !technique || !probe.query) {
    ADD_FAILURE() << "cannot prepare the probe";
    return 0;
  }
  FrameCounts counts;
  FrameInputs in{.eye = camera.eye,
                 .worldToClip = ProjectionMatrix(camera, 1.5) * ViewMatrix(camera),
                 .placements = {&placement, 1},
                 .counts = &counts};
  rhi::IContext& context = *device.ImmediateContext();
  rhi::IRenderTargetView* const views[] = {probe.colorView.get()};
  const rhi::Viewport viewport{.width = 96, .height = 64};
  context.OMSetRenderTargets(1, views, probe.depthView.get());
  context.ClearDepthStencilView(probe.depthView.get(), true, 0, false, 0);
  context.RSSetViewports(1, &viewport);
  context.Begin(probe.query.get());
  (*technique)->Draw(context, *gpu, in);
  context.End(probe.query.get());
  EXPECT_EQ(device.WaitIdle(), rhi::Status::Ok);
  rhi::PipelineStatistics statistics{};
  rhi::Status status = rhi::Status::StillDrawing;
  for (int i = 0; i < 1000 && status == rhi::Status::StillDrawing; ++i)
    status = context.GetData(probe.query.get(), &statistics, sizeof statistics, true);
  EXPECT_EQ(status, rhi::Status::Ok);
  return statistics.gsPrimitives;
}

}  // namespace fur::test

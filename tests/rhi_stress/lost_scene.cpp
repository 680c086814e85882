#include "lost_scene.h"

#include <algorithm>
#include <cstddef>
#include <functional>
#include <random>

namespace rhi_stress {

using namespace rhi;

namespace {

constexpr std::array<float, 8> kCorners{0, 0, 1, 0, 0, 1, 1, 1};
constexpr std::array<uint16_t, 4> kIndices{0, 1, 2, 3};
struct AllArgs {
  DrawArgs draw{4, 1, 0, 0};
  DrawIndexedArgs indexed{4, 1, 0, 0, 0};
  DispatchArgs dispatch{1, 1, 1};
};
constexpr InputElement kElement{.semantic = "POSITION", .format = Format::RG32_Float};

}  // namespace

LostScene::LostScene(Rig& rig) {
  IDevice& d = *rig.device;
  target = rig.MakeTarget(8);
  samples = rig.MakeTarget(8, 4);
  picture = rig.Texture({.width = 8,
                         .height = 8,
                         .mipLevels = 0,
                         .format = Format::RGBA8_UNorm,
                         .bind = Bind::ShaderResource | Bind::RenderTarget});
  depth = rig.Texture({.width = 8, .height = 8, .format = Format::D32_Float, .bind = Bind::DepthStencil});
  stagingTexture = rig.Texture(
      {.width = 8, .height = 8, .format = Format::RGBA8_UNorm, .usage = Usage::Staging, .bind = Bind::None});
  constants = rig.Constants();
  vertices = rig.Buffer({.byteWidth = sizeof kCorners, .bind = Bind::VertexBuffer}, kCorners.data());
  indices = rig.Buffer({.byteWidth = sizeof kIndices, .bind = Bind::IndexBuffer}, kIndices.data());
  const AllArgs all;
  args = rig.Buffer({.byteWidth = sizeof all, .bind = Bind::IndirectArgs}, &all);
  words = rig.Buffer({.byteWidth = 64, .bind = Bind::UnorderedAccess, .structureStride = 16});
  staging = rig.Buffer({.byteWidth = 64, .usage = Usage::Staging});
  mapped = rig.Buffer({.byteWidth = 64, .usage = Usage::Staging});
  view = rig.View(picture.get());
  rig.Require(d.CreateDepthStencilView(depth.get(), nullptr, &depthView), "CreateDepthStencilView");
  rig.Require(d.CreateUnorderedAccessView(words.get(), nullptr, &writable), "CreateUnorderedAccessView");
  vs = rig.Shader(stress_shaders::stress_VSRect);
  mesh = rig.Shader(stress_shaders::stress_VSMesh);
  ps = rig.Shader(stress_shaders::stress_PSTint);
  pictured = rig.Shader(stress_shaders::stress_PSPicture);
  cs = rig.Shader(stress_shaders::stress_CSFill);
  rig.Require(d.CreateInputLayout(&kElement, 1, mesh.get(), &layout), "CreateInputLayout");
  rig.Require(d.CreateBlendState({}, &blend), "CreateBlendState");
  rig.Require(d.CreateDepthStencilState({}, &depthState), "CreateDepthStencilState");
  rig.Require(d.CreateRasterizerState({}, &raster), "CreateRasterizerState");
  rig.Require(d.CreateSamplerState({.maxLod = 5}, &sampler), "CreateSamplerState");
  rig.Require(d.CreateQuery({QueryType::Event}, &event), "CreateQuery");
  rig.Require(d.CreateQuery({QueryType::Occlusion}, &occlusion), "CreateQuery");
  rig.Require(d.CreateQuery({QueryType::Timestamp}, &timestamp), "CreateQuery");
  Mapped open{};
  rig.Require(rig.context->Map(mapped.get(), 0, MapMode::Write, &open), "Map");
}

void LostScene::Record(Rig& rig) {
  IContext& c = *rig.context;
  constexpr Rgba32F kBlack{0, 0, 0, 1};
  const std::array<Rgba8, 64> texels{};
  const uint32_t stride = 8, zero = 0;
  IBuffer* vertexBuffer = vertices.get();
  IShaderResourceView* shown = view.get();
  ISamplerState* sampling = sampler.get();
  IUnorderedAccessView* written = writable.get();
  IRenderTargetView* drawnTo = target.view.get();
  const Rect scissor{0, 0, 8, 8};
  c.BeginEvent("frame");
  c.UpdateSubresource(picture.get(), 0, nullptr, texels.data(), 32, 256);
  c.GenerateMips(view.get());
  c.CSSetShader(cs.get());
  c.CSSetUnorderedAccessViews(0, 1, &written);
  c.Dispatch(1, 1, 1);
  c.DispatchIndirect(args.get(), offsetof(AllArgs, dispatch));
  c.CSSetShader(nullptr);
  c.ClearRenderTargetView(drawnTo, kBlack.data());
  c.ClearRenderTargetView(samples.view.get(), kBlack.data());
  c.ClearDepthStencilView(depthView.get(), true, 1, false, 0);
  rig.SetTarget(target);
  c.OMSetRenderTargets(1, &drawnTo, depthView.get());
  c.OMSetBlendState(blend.get());
  c.OMSetDepthStencilState(depthState.get());
  c.RSSetState(raster.get());
  c.RSSetScissorRects(1, &scissor);
  c.IASetInputLayout(layout.get());
  c.IASetVertexBuffers(0, 1, &vertexBuffer, &stride, &zero);
  c.IASetIndexBuffer(indices.get(), Format::R16_UInt, 0);
  c.PSSetShaderResources(0, 1, &shown);
  c.PSSetSamplers(0, 1, &sampling);
  rig.SetConstants(constants.get(), {.rectangle = {0, 0, 1, -1}});
  c.Begin(occlusion.get());
  rig.DrawRect(mesh.get(), pictured.get());
  c.DrawIndexed(4, 0, 0);
  c.DrawInstanced(4, 1, 0, 0);
  c.DrawIndexedInstanced(4, 1, 0, 0, 0);
  c.DrawInstancedIndirect(args.get(), offsetof(AllArgs, draw));
  c.DrawIndexedInstancedIndirect(args.get(), offsetof(AllArgs, indexed));
  c.End(occlusion.get());
  c.End(timestamp.get());
  c.ResolveSubresource(target.texture.get(), 0, samples.texture.get(), 0, Format::RGBA8_UNorm);
  c.CopySubresourceRegion(stagingTexture.get(), 0, 0, 0, 0, target.texture.get(), 0, nullptr);
  c.CopyResource(staging.get(), words.get());
  c.End(event.get());
  c.EndEvent();
}

void LostScene::ExpectLost(Rig& rig) {
  IDevice& d = *rig.device;
  IContext& c = *rig.context;
  const auto lost = [](Status status, const char* call) { EXPECT_EQ(status, Status::DeviceLost) << call; };
  const auto make = [&](const char* call, auto ref, auto create) {
    lost(create(&ref), call);
    EXPECT_FALSE(ref) << call;
  };
  make("CreateBuffer", Ref<IBuffer>(),
       [&](auto* out) { return d.CreateBuffer({.byteWidth = 64, .bind = Bind::VertexBuffer}, nullptr, out); });
  make("CreateTexture", Ref<ITexture>(),
       [&](auto* out) { return d.CreateTexture({.format = Format::RGBA8_UNorm}, nullptr, out); });
  make("shader view", view, [&](auto* out) { return d.CreateShaderResourceView(picture.get(), nullptr, out); });
  make("target view", target.view, [&](auto* out) { return d.CreateRenderTargetView(picture.get(), nullptr, out); });
  make("depth view", depthView, [&](auto* out) { return d.CreateDepthStencilView(depth.get(), nullptr, out); });
  make("write view", writable, [&](auto* out) { return d.CreateUnorderedAccessView(words.get(), nullptr, out); });
  make("shader", vs, [&](auto* out) { return d.CreateShader(stress_shaders::stress_VSRect, out); });
  make("layout", layout, [&](auto* out) { return d.CreateInputLayout(&kElement, 1, mesh.get(), out); });
  make("blend", blend, [&](auto* out) { return d.CreateBlendState({}, out); });
  make("depth", depthState, [&](auto* out) { return d.CreateDepthStencilState({}, out); });
  make("raster", raster, [&](auto* out) { return d.CreateRasterizerState({}, out); });
  make("sampler", sampler, [&](auto* out) { return d.CreateSamplerState({}, out); });
  make("query", event, [&](auto* out) { return d.CreateQuery({}, out); });
  PipelineKeyDesc key;
  key.vs = vs.get();
  lost(d.PrecachePipeline(key), "PrecachePipeline");
  EXPECT_EQ(d.GetPipelineCacheBlob(nullptr, 0), 0u);
  Mapped open{};
  lost(c.Map(staging.get(), 0, MapMode::Read, &open), "Map of a buffer");
  lost(c.Map(stagingTexture.get(), 0, MapMode::Read, &open), "Map of a texture");
  lost(c.Map(constants.get(), 0, MapMode::WriteDiscard, &open), "Map of constants");
  EXPECT_EQ(open.data, nullptr);
  c.Unmap(mapped.get(), 0);
  std::array<uint8_t, 256> bytes{};
  lost(d.ReadBack(target.texture.get(), 0, bytes.data(), bytes.size()), "ReadBack of a texture");
  lost(d.ReadBack(words.get(), 0, 64, bytes.data()), "ReadBack of a buffer");
  for (IQuery* query : {event.get(), occlusion.get(), timestamp.get()})
    lost(c.GetData(query, bytes.data(), 8, true), "GetData");
  for (int frame = 0; frame < 40; ++frame) {  // more than there are batches
    Record(rig);
    if (frame % 2) c.Flush();
    c.EndFrame();
  }
  lost(d.WaitIdle(), "WaitIdle");
  c.ClearState();
}

void LostScene::Release(uint32_t seed, Ref<IDevice>* device) {
  std::vector<std::function<void()>> releases;
  const auto add = [&](auto&... refs) { (releases.push_back([&refs] { refs = nullptr; }), ...); };
  add(target.texture, target.view, samples.texture, samples.view, picture, depth, stagingTexture);
  add(constants, vertices, indices, args, words, staging, mapped, view, depthView, writable);
  add(vs, mesh, ps, pictured, cs, layout, blend, depthState, raster, sampler, event, occlusion, timestamp);
  if (device) add(*device);
  std::shuffle(releases.begin(), releases.end(), std::mt19937(seed));
  for (const auto& release : releases) release();
}

}  // namespace rhi_stress

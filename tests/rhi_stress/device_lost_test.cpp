// A device that is lost: in whichever call, it is said once, every later call says so or does nothing, nothing hangs,
// all can be released in any order, and a new device works.
#include "lost_scene.h"

namespace rhi_stress {
namespace {

using namespace rhi;

struct Loss {
  const char* name;
  const char* function;             // of the driver, that fails
  Status (*run)(Rig&, LostScene&);  // what is then called
  int32_t result = kDeviceLost;
};

std::array<uint8_t, 256> bytes;

Status Frames(Rig& rig, LostScene& scene, int count) {
  for (int i = 0; i < count; ++i) {
    rig.context->EndFrame();
    scene.Record(rig);
  }
  return Status::DeviceLost;
}
Status Flush(Rig& rig, LostScene&) { return rig.context->Flush(), Status::DeviceLost; }
Status OneFrame(Rig& rig, LostScene& scene) { return Frames(rig, scene, 1); }
Status SomeFrames(Rig& rig, LostScene& scene) { return Frames(rig, scene, 4); }
Status WaitIdle(Rig& rig, LostScene&) { return rig.device->WaitIdle(); }
Status ReadTexture(Rig& rig, LostScene& scene) {
  return rig.device->ReadBack(scene.target.texture.get(), 0, bytes.data(), bytes.size());
}
Status ReadBuffer(Rig& rig, LostScene& scene) { return rig.device->ReadBack(scene.words.get(), 0, 64, bytes.data()); }
Status MapBuffer(Rig& rig, LostScene& scene) {
  Mapped mapped;
  return rig.context->Map(scene.staging.get(), 0, MapMode::Read, &mapped);
}
Status MapTexture(Rig& rig, LostScene& scene) {
  Mapped mapped;
  return rig.context->Map(scene.stagingTexture.get(), 0, MapMode::Read, &mapped);
}
Status GetData(Rig& rig, LostScene& scene) {
  Status status = Status::StillDrawing;
  while (status == Status::StillDrawing) status = rig.context->GetData(scene.occlusion.get(), bytes.data(), 8, true);
  return status;
}
Status CreateBuffer(Rig& rig, LostScene&) {
  Ref<IBuffer> none;
  return rig.device->CreateBuffer({.byteWidth = 64u << 20, .bind = Bind::VertexBuffer}, nullptr, &none);
}
Status CreateDynamicBuffer(Rig& rig, LostScene&) {
  Ref<IBuffer> none;
  return rig.device->CreateBuffer({.byteWidth = 64u << 20, .usage = Usage::Dynamic, .bind = Bind::VertexBuffer},
                                  nullptr, &none);
}
Status CreateTexture(Rig& rig, LostScene&) {
  Ref<ITexture> none;
  return rig.device->CreateTexture({.width = 2048, .height = 2048, .format = Format::RGBA32_Float}, nullptr, &none);
}
Status CreateView(Rig& rig, LostScene& scene) {
  Ref<IShaderResourceView> none;
  return rig.device->CreateShaderResourceView(scene.picture.get(), nullptr, &none);
}
Status CreateSampler(Rig& rig, LostScene&) {
  Ref<ISamplerState> none;
  return rig.device->CreateSamplerState({.maxLod = 3}, &none);
}
Status CreateShader(Rig& rig, LostScene&) {
  Ref<IShader> none;
  return rig.device->CreateShader(stress_shaders::stress_PSTinted, &none);
}
Status CreateComputeShader(Rig& rig, LostScene&) {
  Ref<IShader> none;
  return rig.device->CreateShader(stress_shaders::stress_CSFill, &none);
}
Status Precache(Rig& rig, LostScene& scene) {
  PipelineKeyDesc key;
  key.vs = scene.vs.get();
  key.ps = scene.ps.get();
  key.rtv[0] = Format::RGBA8_UNorm;
  key.rtvCount = 1;
  return rig.device->PrecachePipeline(key);
}

const Loss kLosses[] = {{"FlushSubmits", "vkQueueSubmit2", Flush},
                        {"FlushLooks", "vkGetSemaphoreCounterValue", Flush},
                        {"EndFrameSubmits", "vkQueueSubmit2", OneFrame},
                        {"EndFrameWaits", "vkWaitSemaphores", SomeFrames},
                        {"WaitIdleSubmits", "vkQueueSubmit2", WaitIdle},
                        {"WaitIdleWaits", "vkWaitSemaphores", WaitIdle},
                        {"ReadTextureSubmits", "vkQueueSubmit2", ReadTexture},
                        {"ReadTextureWaits", "vkWaitSemaphores", ReadTexture},
                        {"ReadBufferSubmits", "vkQueueSubmit2", ReadBuffer},
                        {"ReadBufferWaits", "vkWaitSemaphores", ReadBuffer},
                        {"MapBufferSubmits", "vkQueueSubmit2", MapBuffer},
                        {"MapBufferWaits", "vkWaitSemaphores", MapBuffer},
                        {"MapTextureSubmits", "vkQueueSubmit2", MapTexture},
                        {"MapTextureWaits", "vkWaitSemaphores", MapTexture},
                        {"GetDataSubmits", "vkQueueSubmit2", GetData},
                        {"GetDataLooks", "vkGetSemaphoreCounterValue", GetData},
                        {"GetDataReads", "vkGetQueryPoolResults", GetData},
                        {"CreateBuffer", "vkCreateBuffer", CreateBuffer},
                        {"CreateDynamicBuffer", "vkCreateBuffer", CreateDynamicBuffer},
                        {"CreateTexture", "vkCreateImage", CreateTexture},
                        {"CreateView", "vkCreateImageView", CreateView},
                        {"CreateSampler", "vkCreateSampler", CreateSampler},
                        {"CreateShader", "vkCreateShaderModule", CreateShader},
                        {"CreateComputeShader", "vkCreateComputePipelines", CreateComputeShader},
                        {"PrecachePipeline", "vkCreateGraphicsPipelines", Precache},
                        // What is recorded cannot run any more, so the contents of resources are unknown.
                        {"CommandsWithoutMemory", "vkEndCommandBuffer", Flush, kOutOfHostMemory},
                        {"NoCommandsBegun", "vkBeginCommandBuffer", Flush, kOutOfHostMemory},
                        {"WaitWithoutMemory", "vkWaitSemaphores", WaitIdle, kOutOfHostMemory}};

class DeviceLostTest : public testing::TestWithParam<Loss> {
 protected:
  void TearDown() override { TheLostLayer().pass(); }
};

TEST_P(DeviceLostTest, IsSaidOnceAndNothingHangs) {
  const Loss& loss = GetParam();
  for (uint32_t round = 0; round < 3; ++round) {
    Rig rig(Backend::Vulkan, true);
    LostScene scene(rig);
    scene.Record(rig);
    rig.sink.Expect(MsgCode::DeviceLost, "the layer loses the device");
    TheLostLayer().fail(loss.function, loss.result, 0, 1);
    EXPECT_EQ(loss.run(rig, scene), Status::DeviceLost);
    EXPECT_EQ(TheLostLayer().failures(), 1u) << loss.function << " was not called";
    scene.ExpectLost(rig);
    EXPECT_EQ(rig.sink.Count(MsgCode::DeviceLost), 1) << rig.sink.Dump();
    rig.context->ClearState();
    rig.context = nullptr;
    scene.Release(round, &rig.device);
    rig.sink.Verify();
    TheLostLayer().pass();
  }
  Rig next(Backend::Vulkan, true);
  next.ExpectUsable();
  next.Finish();
  next.sink.Verify();
}

INSTANTIATE_TEST_SUITE_P(Stress, DeviceLostTest, testing::ValuesIn(kLosses),
                         [](const auto& which) { return std::string(which.param.name); });

// The other device of the process does not notice.
TEST(DeviceLost, OtherDevicesGoOn) {
  Rig lost(Backend::Vulkan, true), other(Backend::Vulkan, true);
  lost.sink.Expect(MsgCode::DeviceLost, "the layer loses the device");
  TheLostLayer().fail("vkQueueSubmit2", kDeviceLost, 0, 1);
  lost.context->Flush();
  other.ExpectUsable();
  EXPECT_EQ(lost.device->WaitIdle(), Status::DeviceLost);
  other.Finish();
  lost.sink.Verify();
  other.sink.Verify();
  TheLostLayer().pass();
}

// The number is stable: programs look for it.
TEST(DeviceLost, HasItsNumber) { EXPECT_EQ(int(MsgCode::DeviceLost), 901); }

// A driver without shaderDrawParameters: where a draw starts is told to the shader by other means.
TEST(HiddenFeature, DrawsStartAnywhereWithoutDrawParameters) {
  TheLostLayer().hideDrawParameters(true);
  Rig rig(Backend::Vulkan, true);
  TheLostLayer().hideDrawParameters(false);
  const Target target = rig.MakeTarget(8);
  const Ref<IShader> vs = rig.Shader(stress_shaders::stress_VSRect), ps = rig.Shader(stress_shaders::stress_PSTint);
  const DrawArgs args{4, 1, 100, 7};
  const Ref<IBuffer> indirect = rig.Buffer({.byteWidth = sizeof args, .bind = Bind::IndirectArgs}, &args);
  const Ref<IBuffer> constants = rig.Constants();
  rig.context->ClearRenderTargetView(target.view.get(), Rgba32F{0, 0, 0, 0}.data());
  rig.SetTarget(target);
  rig.context->VSSetShader(vs.get());
  rig.context->PSSetShader(ps.get());
  rig.context->IASetPrimitiveTopology(PrimitiveTopology::TriangleStrip);
  for (uint32_t x = 0; x < 8; ++x) {
    const float left = float(x) / 4 - 1;
    rig.SetConstants(constants.get(),
                     {.tint = {0, 1, float(x + 1) / 255, 1}, .rectangle = {left, 1, left + 0.25f, -1}});
    if (x % 3 == 1) {
      rig.context->DrawInstancedIndirect(indirect.get(), 0);
    } else {
      rig.context->DrawInstanced(4, 1, 5 * x, x);
    }
  }
  EXPECT_TRUE(Matches(rig.Read(target.texture.get()), [](uint32_t x, uint32_t) {
    return Rgba8{0, 255, uint8_t(x + 1), 255};
  }));
  rig.Finish();
  rig.sink.Verify();
}

}  // namespace
}  // namespace rhi_stress

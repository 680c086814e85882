// No memory, in any call of the driver: a status or a message, never a trap, and the device goes on.
#include "lost_scene.h"
#include "rhi_vulkan/rhi_vulkan.h"

namespace rhi_stress {
namespace {

using namespace rhi;

class OutOfMemoryTest : public testing::TestWithParam<int32_t> {
 protected:
  void SetUp() override {
    rig = std::make_unique<Rig>(Backend::Vulkan, true);
    rig->sink.Expect(MsgCode::OutOfMemory, "the layer takes the memory away");
  }
  void TearDown() override {
    TheLostLayer().pass();
    rig->ExpectUsable();
    rig->Finish();
    rig->sink.Verify();
  }
  void Fail(const char* function, uint32_t times = kForever) { TheLostLayer().fail(function, GetParam(), 0, times); }
  // While `function` fails, `create` gives OutOfMemory and one message; afterwards, Ok.
  template <class Interface, class Create>
  void ExpectRefused(const char* function, Create create) {
    const int before = rig->sink.Count(MsgCode::OutOfMemory);
    Ref<Interface> made;
    Fail(function);
    EXPECT_EQ(create(&made), Status::OutOfMemory) << function;
    EXPECT_FALSE(made) << function;
    EXPECT_EQ(rig->sink.Count(MsgCode::OutOfMemory), before + 1) << rig->sink.Dump();
    TheLostLayer().pass();
    EXPECT_EQ(create(&made), Status::Ok) << function;
    EXPECT_TRUE(made) << function;
  }
  // Draws a red rectangle over a blue target, on the left half.
  Target DrawHalf(IShader* vs, IShader* ps) {
    const Target target = rig->MakeTarget(8);
    rig->context->ClearRenderTargetView(target.view.get(), Rgba32F{0, 0, 1, 1}.data());
    rig->SetTarget(target);
    rig->SetConstants(rig->Constants().get(), {.tint = {1, 0, 0, 1}, .rectangle = {-1, 1, 0, -1}});
    rig->DrawRect(vs, ps);
    return target;
  }
  void ExpectHalf(const Target& target, bool drawn) {
    EXPECT_TRUE(Matches(rig->Read(target.texture.get()), [&](uint32_t x, uint32_t) {
      return drawn && x < 4 ? Rgba8{255, 0, 0, 255} : Rgba8{0, 0, 255, 255};
    }));
  }
  std::unique_ptr<Rig> rig;
};

TEST_P(OutOfMemoryTest, Buffers) {
  for (const Usage usage : {Usage::Default, Usage::Dynamic, Usage::Staging})
    for (const char* function : {"vkCreateBuffer", "vkAllocateMemory"})
      ExpectRefused<IBuffer>(function, [&](Ref<IBuffer>* out) {
        const Bind bind = usage == Usage::Staging ? Bind::None : Bind::VertexBuffer;
        return rig->device->CreateBuffer({.byteWidth = 64u << 20, .usage = usage, .bind = bind}, nullptr, out);
      });
}

TEST_P(OutOfMemoryTest, Textures) {
  const std::vector<uint8_t> texels(16u << 20);
  const SubresourceData init{texels.data(), 1024 * 16, uint32_t(texels.size())};
  for (const char* function : {"vkCreateImage", "vkAllocateMemory"})
    ExpectRefused<ITexture>(function, [&](Ref<ITexture>* out) {
      return rig->device->CreateTexture({.width = 1024, .height = 1024, .format = Format::RGBA32_Float}, &init, out);
    });
}

TEST_P(OutOfMemoryTest, ViewsSamplersShaders) {
  const Ref<ITexture> picture = rig->Plain(4, {1, 2, 3, 4});
  ExpectRefused<IShaderResourceView>("vkCreateImageView", [&](auto* out) {
    return rig->device->CreateShaderResourceView(picture.get(), nullptr, out);
  });
  ExpectRefused<ISamplerState>("vkCreateSampler",
                               [&](auto* out) { return rig->device->CreateSamplerState({.maxLod = 3}, out); });
  ExpectRefused<IShader>("vkCreateShaderModule",
                         [&](auto* out) { return rig->device->CreateShader(stress_shaders::stress_PSTint, out); });
  ExpectRefused<IShader>("vkCreateComputePipelines",
                         [&](auto* out) { return rig->device->CreateShader(stress_shaders::stress_CSFill, out); });
}

// The draw is skipped; the next frame tries again.
TEST_P(OutOfMemoryTest, Pipelines) {
  const Ref<IShader> vs = rig->Shader(stress_shaders::stress_VSRect), ps = rig->Shader(stress_shaders::stress_PSTint);
  Fail("vkCreateGraphicsPipelines");
  const Target without = DrawHalf(vs.get(), ps.get());
  EXPECT_EQ(rig->sink.Count(MsgCode::OutOfMemory), 1) << rig->sink.Dump();
  TheLostLayer().pass();
  rig->context->EndFrame();
  const Target with = DrawHalf(vs.get(), ps.get());
  ExpectHalf(without, false);
  ExpectHalf(with, true);
  PipelineKeyDesc key;
  key.vs = vs.get();
  key.rtv[0] = Format::RGBA16_Float;
  key.rtvCount = 1;
  Fail("vkCreateGraphicsPipelines");
  EXPECT_EQ(rig->device->PrecachePipeline(key), Status::OutOfMemory);
  TheLostLayer().pass();
  EXPECT_EQ(rig->device->PrecachePipeline(key), Status::Ok);
}

TEST_P(OutOfMemoryTest, DescriptorPools) {
  const Ref<IShader> vs = rig->Shader(stress_shaders::stress_VSRect), ps = rig->Shader(stress_shaders::stress_PSTint);
  for (const char* function : {"vkCreateDescriptorPool", "vkAllocateDescriptorSets"}) {
    Fail(function);
    const Target without = DrawHalf(vs.get(), ps.get());
    EXPECT_GE(TheLostLayer().failures(), 1u) << function;
    TheLostLayer().pass();
    ExpectHalf(without, false);
    ExpectHalf(DrawHalf(vs.get(), ps.get()), true);
  }
}

TEST_P(OutOfMemoryTest, DispatchWithoutDescriptors) {
  LostScene scene(*rig);
  IUnorderedAccessView* written = scene.writable.get();
  rig->context->CSSetShader(scene.cs.get());
  rig->context->CSSetUnorderedAccessViews(0, 1, &written);
  Fail("vkAllocateDescriptorSets");
  rig->context->Dispatch(1, 1, 1);
  TheLostLayer().pass();
  rig->context->Dispatch(1, 1, 1);
  std::array<uint32_t, 4> word{};
  rig->Require(rig->device->ReadBack(scene.words.get(), 16, 16, word.data()), "ReadBack");
  EXPECT_EQ(word, (std::array<uint32_t, 4>{1, 1, 2, 3}));
  rig->context->Unmap(scene.mapped.get(), 0);
}

// Frames go on with the command buffers that there are.
TEST_P(OutOfMemoryTest, CommandBuffers) {
  const Ref<IShader> vs = rig->Shader(stress_shaders::stress_VSRect), ps = rig->Shader(stress_shaders::stress_PSTint);
  for (const char* function : {"vkAllocateCommandBuffers", "vkCreateCommandPool"}) {
    Fail(function);
    for (int frame = 0; frame < 20; ++frame) {
      const Target target = DrawHalf(vs.get(), ps.get());
      rig->context->EndFrame();
      if (frame % 7 == 0) ExpectHalf(target, true);
    }
    TheLostLayer().pass();
  }
  // A device on its own has none to fall back on.
  Fail("vkAllocateCommandBuffers", 1);
  Ref<IDevice> none;
  DeviceDesc desc;
  desc.preferSoftware = true;
  desc.sink = &rig->sink;
  EXPECT_EQ(rhi_vulkan::CreateDevice(desc, &none), Status::OutOfMemory);
  EXPECT_FALSE(none);
}

// The constants stay what they were, and that is said.
TEST_P(OutOfMemoryTest, RingPages) {
  const Ref<IBuffer> big = rig->Buffer({.byteWidth = 48u << 20, .usage = Usage::Dynamic, .bind = Bind::VertexBuffer});
  Mapped mapped{};
  Fail("vkAllocateMemory");
  EXPECT_EQ(rig->context->Map(big.get(), 0, MapMode::WriteDiscard, &mapped), Status::OutOfMemory);
  TheLostLayer().pass();
  EXPECT_EQ(rig->context->Map(big.get(), 0, MapMode::WriteDiscard, &mapped), Status::Ok);
  rig->context->Unmap(big.get(), 0);
}

// Calls without a status say it once a frame; calls with one always do.
TEST_P(OutOfMemoryTest, IsSaidOnceAFrame) {
  const Ref<IBuffer> constants =
      rig->Buffer({.byteWidth = 16384, .usage = Usage::Dynamic, .bind = Bind::ConstantBuffer});
  const std::vector<uint8_t> data(16384);
  Fail("vkCreateBuffer");
  for (int frame = 1; frame <= 3; ++frame) {
    // More than the pages of the ring hold.
    for (int i = 0; i < 1000; ++i) rig->context->UpdateConstants(constants.get(), data.data(), 16384);
    EXPECT_GE(TheLostLayer().failures(), 2u);
    EXPECT_EQ(rig->sink.Count(MsgCode::OutOfMemory), 2 * frame - 1) << rig->sink.Dump();
    Ref<IBuffer> none;
    EXPECT_EQ(rig->device->CreateBuffer({.byteWidth = 64, .usage = Usage::Dynamic, .bind = Bind::ConstantBuffer},
                                        nullptr, &none),
              Status::OutOfMemory);
    EXPECT_EQ(rig->sink.Count(MsgCode::OutOfMemory), 2 * frame) << rig->sink.Dump();
    rig->context->EndFrame();
    rig->Require(rig->device->WaitIdle(), "WaitIdle");
  }
}

TEST_P(OutOfMemoryTest, ASubmissionIsTriedAgain) {
  rig->sink.Allow(MsgCode::OutOfMemory, "");
  const Ref<IShader> vs = rig->Shader(stress_shaders::stress_VSRect), ps = rig->Shader(stress_shaders::stress_PSTint);
  Fail("vkQueueSubmit2", 1);
  const Target target = DrawHalf(vs.get(), ps.get());
  ExpectHalf(target, true);
  EXPECT_EQ(TheLostLayer().failures(), 1u);
  Fail("vkCreateBuffer", 1);  // for the message that every test here expects
  Ref<IBuffer> none;
  EXPECT_EQ(rig->device->CreateBuffer({.byteWidth = 64, .bind = Bind::VertexBuffer}, nullptr, &none),
            Status::OutOfMemory);
}

INSTANTIATE_TEST_SUITE_P(Stress, OutOfMemoryTest, testing::Values(kOutOfHostMemory, kOutOfDeviceMemory),
                         [](const auto& which) { return which.param == kOutOfHostMemory ? "host" : "device"; });

// Every call of a small program fails, one after the other, from the making of the device to its end: alone, or with
// all calls of that function that follow.
class EveryCallFails : public testing::TestWithParam<const char*> {
 protected:
  void SetUp() override { TheLostLayer().saveCaches(true); }  // so that all functions are called
  void TearDown() override {
    TheLostLayer().pass();
    TheLostLayer().saveCaches(false);
  }
  static int Said(const TestSink& sink) { return sink.Count(MsgCode::OutOfMemory) + sink.Count(MsgCode::DeviceLost); }
  // One life of a device; what it refuses it has to say.
  static void Live(TestSink& sink, bool validation) {
    sink.Allow(MsgCode::OutOfMemory, "one call fails");
    sink.Allow(MsgCode::DeviceLost, "one call fails, perhaps one that the device cannot do without");
    Ref<IDevice> device;
    DeviceDesc desc;
    desc.apiValidation = validation;
    desc.preferSoftware = true;
    desc.sink = &sink;
    if (rhi_vulkan::CreateDevice(desc, &device) != Status::Ok) return;
    Rig rig(device);
    try {
      LostScene scene(rig);
      for (int frame = 0; frame < 4; ++frame) {
        scene.Record(rig);
        rig.context->EndFrame();
      }
      std::array<uint8_t, 256> out{};
      rig.device->ReadBack(scene.target.texture.get(), 0, out.data(), out.size());
      rig.device->GetPipelineCacheBlob(out.data(), out.size());
      rig.context->GetData(scene.occlusion.get(), out.data(), 8, true);
      rig.context->Unmap(scene.mapped.get(), 0);
    } catch (const std::runtime_error&) {
      // an object was refused
    }
  }
};

TEST_P(EveryCallFails, OneAfterTheOther) {
  const std::string function = GetParam();
  // There is a second try, or nothing more to be done.
  const bool hasNext = function == "vkAllocateMemory" || function == "vkMapMemory" || function == "vkQueueSubmit2";
  const bool silent = hasNext || function == "vkDeviceWaitIdle";
  uint32_t calls = 0;
  for (; calls < 500; ++calls) {
    const int32_t result = calls % 2 ? kOutOfHostMemory : kOutOfDeviceMemory;
    TestSink sink;
    TheLostLayer().fail(function.c_str(), result, calls, kForever);
    Live(sink, true);
    const bool failed = TheLostLayer().failures() != 0;
    EXPECT_TRUE(!hasNext || !failed || Said(sink) > 0) << "calls from " << calls << " on failed and nobody said so";
    sink.Verify();
    if (!failed || HasFailure()) break;
    TheLostLayer().fail(function.c_str(), result, calls, 1);
    Live(sink, false);
    const bool alone = TheLostLayer().failures() != 0;  // a life in which less fails may need fewer calls
    EXPECT_TRUE(silent || !alone || Said(sink) > 0) << "call " << calls << " failed and nobody said so";
    sink.Verify();
  }
  RecordProperty("calls", int(calls));
  if (function == "vkQueueWaitIdle") return;  // nobody needs it
  EXPECT_GE(calls, 1u) << function << " was never called";
}

std::vector<const char*> Functions() {
  std::vector<const char*> all;
  for (const char* const* f = TheLostLayer().functions(); *f; ++f) all.push_back(*f);
  return all;
}
INSTANTIATE_TEST_SUITE_P(Stress, EveryCallFails, testing::ValuesIn(Functions()),
                         [](const auto& which) { return std::string(which.param); });

}  // namespace
}  // namespace rhi_stress

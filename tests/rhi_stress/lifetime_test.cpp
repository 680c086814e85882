// Objects that are released while the GPU works with them, after their device, and on two devices at once.
#include <algorithm>
#include <random>

#include "rig.h"

namespace rhi_stress {
namespace {

using namespace rhi;

class LifetimeTest : public StressTest {
 protected:
  void ReleaseInFlight(uint32_t frames);
  void DeviceFirst(bool validation);
};

// A picture of one colour onto one pixel of a target, by objects that are gone when the function returns.
void DrawWithPassingObjects(Rig& rig, const Target& result, uint32_t size, uint32_t number) {
  const Target passing = rig.MakeTarget(4);
  const Ref<ITexture> picture = rig.Plain(2, {uint8_t(number + 1), 2, 3, 255});
  const Ref<IShaderResourceView> view = rig.View(picture.get());
  const Ref<IBuffer> constants = rig.Constants();
  IShaderResourceView* bound = view.get();
  rig.context->ClearRenderTargetView(passing.view.get(), Rgba32F{0, 0, 0, 0}.data());
  rig.SetTarget(passing);
  rig.context->PSSetShaderResources(0, 1, &bound);
  rig.SetConstants(constants.get(), {});
  rig.DrawRect(rig.Shader(stress_shaders::stress_VSRect).get(), rig.Shader(stress_shaders::stress_PSPicture).get());
  const Box pixel{1, 1, 0, 2, 2, 1};
  rig.context->CopySubresourceRegion(result.texture.get(), 0, number % size, number / size, 0, passing.texture.get(), 0,
                                     &pixel);
  rig.context->ClearState();
}

void LifetimeTest::ReleaseInFlight(uint32_t frames) {
  constexpr uint32_t kSize = 16;
  const Target result = rig->MakeTarget(kSize);
  rig->context->ClearRenderTargetView(result.view.get(), Rgba32F{0, 0, 0, 0}.data());
  for (uint32_t frame = 0; frame < frames; ++frame) {
    DrawWithPassingObjects(*rig, result, kSize, frame);
    rig->context->EndFrame();
  }
  EXPECT_TRUE(Matches(rig->Read(result.texture.get()), [frames](uint32_t x, uint32_t y) {
    const uint32_t frame = y * kSize + x;
    return frame < frames ? Rgba8{uint8_t(frame + 1), 2, 3, 255} : Rgba8{0, 0, 0, 0};
  }));
}

TEST_P(LifetimeTest, ReleasedWhileInFlight) {
  Open(false);
  ReleaseInFlight(200);
}

TEST_P(LifetimeTest, ReleasedWhileInFlightUnderValidation) {
  Open(kValidation);
  ReleaseInFlight(24);
}

// Objects of every kind, some of them bound and drawn with.
std::vector<Ref<IObject>> ObjectsOfEveryKind(Rig& rig) {
  std::vector<Ref<IObject>> all;
  const auto keep = [&](const auto& object) {
    all.push_back(Ref<IObject>(object));
    return object.get();
  };
  const auto make = [&](auto method, const auto& desc, auto ref) {
    rig.Require((rig.device.get()->*method)(desc, &ref), "creation of an object");
    return keep(ref);
  };
  const Target target = rig.MakeTarget(8);
  keep(target.texture);
  keep(target.view);
  const Ref<ITexture> picture = rig.Plain(4, {1, 2, 3, 255});
  IShaderResourceView* view = keep(rig.View(keep(picture)));
  ISamplerState* sampler = make(&IDevice::CreateSamplerState, SamplerDesc{.maxLod = 3}, Ref<ISamplerState>());
  rig.context->OMSetBlendState(make(&IDevice::CreateBlendState, BlendDesc{}, Ref<IBlendState>()));
  rig.context->RSSetState(make(&IDevice::CreateRasterizerState, RasterizerDesc{}, Ref<IRasterizerState>()));
  rig.context->OMSetDepthStencilState(
      make(&IDevice::CreateDepthStencilState, DepthStencilDesc{}, Ref<IDepthStencilState>()));
  IQuery* query = make(&IDevice::CreateQuery, QueryDesc{QueryType::Occlusion}, Ref<IQuery>());
  keep(rig.Buffer({.byteWidth = 256, .usage = Usage::Staging}));
  keep(rig.Buffer({.byteWidth = 256, .usage = Usage::Dynamic, .bind = Bind::VertexBuffer}));
  rig.SetTarget(target);
  rig.context->PSSetShaderResources(0, 1, &view);
  rig.context->PSSetSamplers(0, 1, &sampler);
  rig.SetConstants(keep(rig.Constants()), {});
  rig.context->Begin(query);
  rig.DrawRect(keep(rig.Shader(stress_shaders::stress_VSRect)), keep(rig.Shader(stress_shaders::stress_PSPicture)));
  rig.context->End(query);
  return all;
}

void LifetimeTest::DeviceFirst(bool validation) {
  std::mt19937 random(7);
  for (int round = 0; round < 6; ++round) {
    Open(validation);
    std::vector<Ref<IObject>> objects = ObjectsOfEveryKind(*rig);
    if (round % 3 == 0) rig->context->EndFrame();  // else: recorded, never submitted
    if (round % 3 == 1) rig->context->Flush();
    rig->context = nullptr;
    rig->device = nullptr;
    std::shuffle(objects.begin(), objects.end(), random);
    while (!objects.empty()) objects.pop_back();
    rig->sink.Verify();
  }
}

TEST_P(LifetimeTest, DeviceReleasedBeforeItsObjects) { DeviceFirst(false); }
TEST_P(LifetimeTest, DeviceReleasedBeforeItsObjectsUnderValidation) { DeviceFirst(kValidation); }

STRESS_ON_EVERY_BACKEND(LifetimeTest);

struct Painter {  // one of two devices that take turns
  Painter(Backend backend, bool validation, const Rgba32F& paint) : rig(backend, validation), color(paint) {
    target = rig.MakeTarget(16);
    constants = rig.Constants();
    vs = rig.Shader(stress_shaders::stress_VSRect);
    ps = rig.Shader(stress_shaders::stress_PSTint);
  }
  void Begin() {
    rig.context->ClearRenderTargetView(target.view.get(), Rgba32F{0, 0, 0, 1}.data());
    rig.SetTarget(target);
  }
  void DrawColumn(uint32_t column) {
    const float left = float(column) / 8 - 1;
    rig.SetConstants(constants.get(), {.tint = color, .rectangle = {left, 1, left + 0.125f, -1}});
    rig.DrawRect(vs.get(), ps.get());
  }
  Rig rig;
  Rgba32F color;
  Target target;
  Ref<IBuffer> constants;
  Ref<IShader> vs, ps;
};

void Interleave(Backend first, Backend second, bool validation, int frames) {
  Painter a(first, validation, {1, 0, 0, 1}), b(second, validation, {0, 1, 0, 1});
  for (int frame = 0; frame < frames; ++frame) {
    a.Begin();
    b.Begin();
    for (uint32_t column = 0; column < 16; column += 2) {
      a.DrawColumn(column);
      b.DrawColumn(column + 1);
    }
    a.rig.context->EndFrame();
    b.rig.context->EndFrame();
  }
  EXPECT_TRUE(Matches(a.rig.Read(a.target.texture.get()), [](uint32_t x, uint32_t) {
    return x % 2 == 0 ? Rgba8{255, 0, 0, 255} : Rgba8{0, 0, 0, 255};
  }));
  EXPECT_TRUE(Matches(b.rig.Read(b.target.texture.get()), [](uint32_t x, uint32_t) {
    return x % 2 == 1 ? Rgba8{0, 255, 0, 255} : Rgba8{0, 0, 0, 255};
  }));
  for (Painter* p : {&a, &b}) {
    p->rig.Finish();
    p->rig.sink.Verify();
  }
}

constexpr Backend kVulkan = Backend::Vulkan, kGl = Backend::OpenGL;
TEST(TwoDevices, VulkanAndVulkan) { Interleave(kVulkan, kVulkan, false, 200); }
TEST(TwoDevices, GlAndGl) { Interleave(kGl, kGl, false, 200); }
TEST(TwoDevices, VulkanAndGl) { Interleave(kVulkan, kGl, false, 200); }
TEST(TwoDevices, VulkanAndGlUnderValidation) { Interleave(kVulkan, kGl, true, 10); }

}  // namespace
}  // namespace rhi_stress

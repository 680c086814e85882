// A small frame on the real backends, behind the validation: the picture is right and there is no message.
#include <array>

#include "fixture.h"
#include "rhi_gl/rhi_gl.h"
#include "rhi_validation_shaders/shaders.h"
#include "rhi_vulkan/rhi_vulkan.h"

namespace validation_test {
namespace {

using namespace rhi;

class BackendsTest : public testing::TestWithParam<Backend> {
 protected:
  void SetUp() override {
    DeviceDesc desc;
    desc.apiValidation = desc.syncValidation = desc.preferSoftware = true;
    desc.sink = &sink;
    Ref<IDevice> inner;
    const Status s =
        GetParam() == Backend::Vulkan ? rhi_vulkan::CreateDevice(desc, &inner) : rhi_gl::CreateDevice(desc, &inner);
    ASSERT_EQ(s, Status::Ok) << sink.Dump();
    device = WrapWithValidation(inner, &sink);
    std::erase_if(sink.entries, [](const auto& e) { return e.severity == Severity::Info; });
  }
  void NoProblems() {
    for (const auto& e : sink.entries) EXPECT_LT(e.severity, Severity::Warning) << sink.Dump();
    sink.entries.clear();
  }
  KeepingSink sink;
  Ref<IDevice> device;
};

struct Vertex {
  float position[4];
};

TEST_P(BackendsTest, ClearDrawReadBack) {
  {
    IContext& c = *device->ImmediateContext();
    Ref<IShader> vs, ps;
    ASSERT_EQ(device->CreateShader(validation_shaders::triangle_VSMain, &vs), Status::Ok) << sink.Dump();
    ASSERT_EQ(device->CreateShader(validation_shaders::triangle_PSMain, &ps), Status::Ok) << sink.Dump();
    const InputElement position{.semantic = "POSITION", .format = Format::RGBA32_Float};
    Ref<IInputLayout> layout;
    ASSERT_EQ(device->CreateInputLayout(&position, 1, vs.get(), &layout), Status::Ok) << sink.Dump();
    const Vertex corners[4] = {{{-1, 1, 0, 1}}, {{0, 1, 0, 1}}, {{-1, -1, 0, 1}}, {{0, -1, 0, 1}}};  // the left half
    Ref<IBuffer> vertices, constants;
    ASSERT_EQ(device->CreateBuffer({.byteWidth = sizeof corners, .bind = Bind::VertexBuffer, .name = "corners"},
                                   corners, &vertices),
              Status::Ok);
    ASSERT_EQ(
        device->CreateBuffer({.byteWidth = 16, .usage = Usage::Dynamic, .bind = Bind::ConstantBuffer, .name = "tint"},
                             nullptr, &constants),
        Status::Ok);
    const std::array<uint8_t, 4> half{128, 128, 128, 128};
    const SubresourceData texel{half.data(), 4, 4};
    Ref<ITexture> color, grey;
    ASSERT_EQ(
        device->CreateTexture({.width = 8, .height = 8, .format = Format::RGBA8_UNorm, .bind = Bind::RenderTarget},
                              nullptr, &color),
        Status::Ok);
    ASSERT_EQ(device->CreateTexture({.format = Format::RGBA8_UNorm}, &texel, &grey), Status::Ok);
    Ref<IRenderTargetView> rtv;
    Ref<IShaderResourceView> srv;
    Ref<ISamplerState> sampler;
    ASSERT_EQ(device->CreateRenderTargetView(color.get(), nullptr, &rtv), Status::Ok);
    ASSERT_EQ(device->CreateShaderResourceView(grey.get(), nullptr, &srv), Status::Ok);
    ASSERT_EQ(device->CreateSamplerState({}, &sampler), Status::Ok);

    const float blue[4] = {0, 0, 1, 1}, tint[4] = {1, 0, 1, 1};
    const Viewport viewport{0, 0, 8, 8, 0, 1};
    const uint32_t stride = sizeof(Vertex), offset = 0;
    IRenderTargetView* target = rtv.get();
    IBuffer *vertexBuffer = vertices.get(), *constantBuffer = constants.get();
    IShaderResourceView* view = srv.get();
    ISamplerState* s = sampler.get();
    for (int frame = 0; frame < 3; ++frame) {
      c.OMSetRenderTargets(1, &target, nullptr);
      c.ClearRenderTargetView(target, blue);
      c.RSSetViewports(1, &viewport);
      c.VSSetShader(vs.get());
      c.PSSetShader(ps.get());
      c.IASetInputLayout(layout.get());
      c.IASetPrimitiveTopology(PrimitiveTopology::TriangleStrip);
      c.IASetVertexBuffers(0, 1, &vertexBuffer, &stride, &offset);
      c.SetConstantBuffers(3, 1, &constantBuffer);
      c.PSSetShaderResources(0, 1, &view);
      c.PSSetSamplers(0, 1, &s);
      c.UpdateConstants(constantBuffer, tint, sizeof tint);
      c.Draw(4, 0);
      c.EndFrame();
    }
    std::vector<std::array<uint8_t, 4>> pixels(64);
    ASSERT_EQ(device->ReadBack(color.get(), 0, pixels.data(), 256), Status::Ok) << sink.Dump();
    for (uint32_t i = 0; i < 64; ++i) {
      const bool left = i % 8 < 4;
      EXPECT_EQ(pixels[i], (left ? std::array<uint8_t, 4>{128, 0, 128, 128} : std::array<uint8_t, 4>{0, 0, 255, 255}))
          << i;
    }
    EXPECT_EQ(device->GetStats(true).draws, 3u);
    NoProblems();
  }
  device = nullptr;  // nothing is left alive, and the drivers are content
  NoProblems();
}

// What the validation refuses does not reach the backend.
TEST_P(BackendsTest, RefusedCallsStayAway) {
  IContext& c = *device->ImmediateContext();
  c.Draw(3, 0);
  ASSERT_EQ(sink.entries.size(), 1u) << sink.Dump();
  EXPECT_EQ(sink.entries[0].code, MsgCode::NoVertexShader);
  EXPECT_EQ(device->GetStats(true).draws, 0u);
}

INSTANTIATE_TEST_SUITE_P(Validation, BackendsTest, testing::Values(Backend::Vulkan, Backend::OpenGL),
                         [](const auto& one) { return std::string(one.param == Backend::Vulkan ? "vulkan" : "gl"); });

}  // namespace
}  // namespace validation_test

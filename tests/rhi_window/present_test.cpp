// Present: the window shows the back buffer, bit for bit.
#include "scene.h"

namespace rhi_test {
namespace {

using namespace rhi;
using PresentTest = WindowTest;

constexpr uint32_t kWidth = 320, kHeight = 240;

// All is bound once: Present disturbs nothing that is bound, and keeps what is in the back buffer.
TEST_P(PresentTest, MovingTriangleOfSixtyFrames) {
  Window window(kWidth, kHeight);
  const Ref<ISwapChain> swapChain = MakeSwapChain(window, {.width = kWidth, .height = kHeight});
  scene->SetTarget(swapChain->BackBuffer());
  for (int frame = 0; frame < 60; ++frame) {
    scene->Draw(float(frame) * 0.1f);
    ASSERT_EQ(swapChain->Present(), Status::Ok) << sink.Dump();
    device->ImmediateContext()->EndFrame();
    if (frame % 20 != 19) continue;
    ASSERT_TRUE(Shows(window, *swapChain)) << frame;
  }
  EXPECT_TRUE(HoldsTheScene(*swapChain, 5.9f));
}

// A driver that sets the viewport to a window's size when it first meets it does so behind our back.
TEST_P(PresentTest, ViewportSurvives) {
  Window window(kWidth, kHeight);
  const Ref<ISwapChain> swapChain = MakeSwapChain(window, {.width = kWidth, .height = kHeight});
  scene->SetTarget(swapChain->BackBuffer());
  const Viewport part{40, 30, 100, 50, 0, 1};
  device->ImmediateContext()->RSSetViewports(1, &part);
  scene->Draw(1);
  const Pixels before = Read(*device, swapChain->BackBuffer());
  for (int i = 0; i < 2; ++i) {
    ASSERT_EQ(swapChain->Present(), Status::Ok);
    scene->Draw(1);
    EXPECT_TRUE(SamePixels(Read(*device, swapChain->BackBuffer()), before));
  }
}

TEST_P(PresentTest, FramesMayEndBeforePresent) {
  Window window(kWidth, kHeight);
  const Ref<ISwapChain> swapChain = MakeSwapChain(window, {.width = kWidth, .height = kHeight});
  scene->SetTarget(swapChain->BackBuffer());
  for (int frame = 0; frame < 5; ++frame) {
    scene->Draw(float(frame));
    device->ImmediateContext()->EndFrame();
    ASSERT_EQ(swapChain->Present(), Status::Ok);
  }
  EXPECT_TRUE(Shows(window, *swapChain));
}

TEST_P(PresentTest, WithoutVsync) {
  Window window(kWidth, kHeight);
  const Ref<ISwapChain> swapChain =
      MakeSwapChain(window, {.width = kWidth, .height = kHeight, .bufferCount = 3, .vsync = false});
  for (int frame = 0; frame < 20; ++frame) Frame(*swapChain, float(frame));
  EXPECT_TRUE(Shows(window, *swapChain));
}

// Also the sRGB ones: the window gets the bits that the back buffer holds, not their linear values.
TEST_P(PresentTest, EveryEightBitFormat) {
  for (const Format format :
       {Format::RGBA8_UNorm, Format::RGBA8_UNorm_sRGB, Format::BGRA8_UNorm, Format::BGRA8_UNorm_sRGB}) {
    Window window(kWidth, kHeight);
    const Ref<ISwapChain> swapChain = MakeSwapChain(window, {.width = kWidth, .height = kHeight, .format = format});
    EXPECT_EQ(swapChain->BackBuffer()->Desc().format, format);
    for (int frame = 0; frame < 3; ++frame) Frame(*swapChain, float(frame));
    EXPECT_TRUE(Shows(window, *swapChain)) << ToString(format);
  }
}

// Converted to what the window has.
TEST_P(PresentTest, WideFormats) {
  for (const Format format : {Format::R10G10B10A2_UNorm, Format::RGBA16_Float}) {
    Window window(kWidth, kHeight);
    const Ref<ISwapChain> swapChain = MakeSwapChain(window, {.width = kWidth, .height = kHeight, .format = format});
    Ref<IRenderTargetView> view;
    ASSERT_EQ(device->CreateRenderTargetView(swapChain->BackBuffer(), nullptr, &view), Status::Ok);
    const float color[4] = {1, 0.5f, 0, 1};
    device->ImmediateContext()->ClearRenderTargetView(view.get(), color);
    ASSERT_EQ(swapChain->Present(), Status::Ok);
    ASSERT_EQ(device->WaitIdle(), Status::Ok);
    const Pixels shot = window.Shot();
    EXPECT_EQ(shot.rgb[0], 255) << ToString(format);
    EXPECT_NEAR(shot.rgb[1], 128, 1) << ToString(format);
    EXPECT_EQ(shot.rgb[2], 0) << ToString(format);
  }
}

TEST_P(PresentTest, TwoWindowsOfOneDevice) {
  Window left(kWidth, kHeight, 0, 0), right(200, 300, 400, 100);
  const Ref<ISwapChain> first = MakeSwapChain(left, {.width = kWidth, .height = kHeight}),
                        second = MakeSwapChain(right, {.width = 200, .height = 300, .format = Format::RGBA8_UNorm});
  for (int frame = 0; frame < 10; ++frame) {
    Frame(*first, float(frame));
    Frame(*second, float(frame) + 2.5f);
  }
  EXPECT_TRUE(Shows(left, *first));
  EXPECT_TRUE(Shows(right, *second));
}

TEST_P(PresentTest, TwoDevicesWithAWindowEach) {
  Window left(kWidth, kHeight, 0, 0), right(200, 300, 400, 100);
  const Ref<ISwapChain> first = MakeSwapChain(left, {.width = kWidth, .height = kHeight});
  Ref<IDevice> other;
  ASSERT_EQ(CreateDevice(GetParam(), WindowDeviceDesc(&sink), &other), Status::Ok);
  Scene otherScene(*other);
  otherScene.Bind();
  Ref<ISwapChain> second;
  ASSERT_EQ(other->CreateSwapChain({.nativeWindow = right.Native(), .width = 200, .height = 300}, &second), Status::Ok);
  otherScene.SetTarget(second->BackBuffer());
  for (int frame = 0; frame < 5; ++frame) {
    Frame(*first, float(frame));
    otherScene.Draw(float(frame) + 2.5f);
    ASSERT_EQ(second->Present(), Status::Ok);
    other->ImmediateContext()->EndFrame();
  }
  EXPECT_TRUE(Shows(left, *first));
  EXPECT_TRUE(SamePixels(right.Shot(), Read(*other, second->BackBuffer())));
}

// The back buffer is a texture like any other: it can be read by shaders and written by copies.
TEST_P(PresentTest, BackBufferIsAnOrdinaryTexture) {
  Window window(64, 64);
  const Ref<ISwapChain> swapChain = MakeSwapChain(window, {.width = 64, .height = 64, .format = Format::RGBA8_UNorm});
  std::vector<uint8_t> texels;
  for (uint32_t i = 0; i < 64 * 64; ++i)
    texels.insert(texels.end(), {uint8_t(i % 64 * 4), uint8_t(i / 64 * 4), 77, 255});
  device->ImmediateContext()->UpdateSubresource(swapChain->BackBuffer(), 0, nullptr, texels.data(), 64 * 4, 0);
  Ref<IShaderResourceView> view;
  EXPECT_EQ(device->CreateShaderResourceView(swapChain->BackBuffer(), nullptr, &view), Status::Ok);
  ASSERT_EQ(swapChain->Present(), Status::Ok);
  EXPECT_TRUE(Shows(window, *swapChain));
  const Pixels shot = window.Shot();
  EXPECT_EQ(shot.rgb[3 * 5], 5 * 4);           // x grows to the right
  EXPECT_EQ(shot.rgb[3 * 64 * 9 + 1], 9 * 4);  // y grows to the bottom
}

WINDOW_TESTS_ON_EVERY_BACKEND(PresentTest);

}  // namespace
}  // namespace rhi_test

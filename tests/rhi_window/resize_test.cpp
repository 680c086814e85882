// Windows that change their size, hide, or go.
#include "scene.h"

namespace rhi_test {
namespace {

using namespace rhi;
using ResizeTest = WindowTest;

struct Size {
  uint32_t width, height;
};

TEST_P(ResizeTest, WindowAndBackBufferTogether) {
  Window window(320, 240);
  const Ref<ISwapChain> swapChain = MakeSwapChain(window, {.width = 320, .height = 240});
  Frame(*swapChain, 0);
  for (const Size size : {Size{400, 300}, Size{123, 457}, Size{640, 480}, Size{64, 32}, Size{320, 240}}) {
    window.SetSize(size.width, size.height);
    ASSERT_EQ(swapChain->Resize(size.width, size.height), Status::Ok);
    EXPECT_EQ(swapChain->BackBuffer()->Desc().width, size.width);
    EXPECT_EQ(swapChain->BackBuffer()->Desc().height, size.height);
    for (int frame = 0; frame < 4; ++frame) Frame(*swapChain, float(frame));
    EXPECT_TRUE(Shows(window, *swapChain)) << size.width << " x " << size.height;
  }
}

// The old back buffer lives on while somebody holds it, and may still be bound.
TEST_P(ResizeTest, OldBackBufferStaysUsable) {
  Window window(320, 240);
  const Ref<ISwapChain> swapChain = MakeSwapChain(window, {.width = 320, .height = 240});
  const Ref<ITexture> old(swapChain->BackBuffer());
  scene->SetTarget(old.get());
  scene->Draw(1);
  ASSERT_EQ(swapChain->Resize(200, 100), Status::Ok);
  EXPECT_NE(old.get(), swapChain->BackBuffer());
  const Pixels before = Read(*device, old.get());
  scene->Draw(1);
  EXPECT_TRUE(SamePixels(before, Read(*device, old.get())));
}

// Nobody told the swap chain: the picture is scaled to the window.
TEST_P(ResizeTest, PictureIsScaledToTheWindow) {
  Window window(128, 128);
  const Ref<ISwapChain> swapChain = MakeSwapChain(window, {.width = 128, .height = 128, .format = Format::RGBA8_UNorm});
  std::vector<uint8_t> texels;
  for (uint32_t i = 0; i < 128 * 128; ++i)
    texels.insert(texels.end(), {uint8_t(i % 128 < 64 ? 0 : 255), uint8_t(i / 128 < 64 ? 0 : 255), 100, 255});
  device->ImmediateContext()->UpdateSubresource(swapChain->BackBuffer(), 0, nullptr, texels.data(), 128 * 4, 0);
  ASSERT_EQ(swapChain->Present(), Status::Ok);
  for (const Size size : {Size{256, 128}, Size{300, 200}, Size{80, 60}}) {
    window.SetSize(size.width, size.height);
    for (int frame = 0; frame < 4; ++frame) {
      ASSERT_EQ(swapChain->Present(), Status::Ok) << sink.Dump();
      device->ImmediateContext()->EndFrame();
    }
    ASSERT_EQ(device->WaitIdle(), Status::Ok);
    const Pixels shot = window.Shot();
    ASSERT_EQ(shot.width, size.width);
    for (const uint32_t x : {1u, 3u})
      for (const uint32_t y : {1u, 3u}) {
        const size_t at = 3 * (size_t(size.height * y / 4) * size.width + size.width * x / 4);
        EXPECT_EQ(shot.rgb[at], x == 1 ? 0 : 255) << x << ' ' << y << ' ' << size.width;
        EXPECT_EQ(shot.rgb[at + 1], y == 1 ? 0 : 255) << x << ' ' << y << ' ' << size.width;
        EXPECT_EQ(shot.rgb[at + 2], 100);
      }
  }
}

// Back buffers smaller and greater than the window that never changes.
TEST_P(ResizeTest, BackBufferOfAnotherSizeThanTheWindow) {
  Window window(160, 120);
  const Ref<ISwapChain> swapChain = MakeSwapChain(window, {.width = 160, .height = 120});
  for (const Size size : {Size{320, 240}, Size{40, 30}}) {
    ASSERT_EQ(swapChain->Resize(size.width, size.height), Status::Ok);
    for (int frame = 0; frame < 3; ++frame) Frame(*swapChain, 0.5f);
    ASSERT_EQ(device->WaitIdle(), Status::Ok);
    const Pixels shot = window.Shot(), back = Read(*device, swapChain->BackBuffer());
    EXPECT_EQ(shot.width, 160u);
    EXPECT_TRUE(std::equal(shot.rgb.begin(), shot.rgb.begin() + 3, back.rgb.begin()));  // the background
  }
  ASSERT_EQ(swapChain->Resize(160, 120), Status::Ok);
  Frame(*swapChain, 0.5f);
  EXPECT_TRUE(Shows(window, *swapChain));
}

TEST_P(ResizeTest, MinimisedAndRestored) {
  Window window(320, 240);
  const Ref<ISwapChain> swapChain = MakeSwapChain(window, {.width = 320, .height = 240});
  Frame(*swapChain, 0);
  const ITexture* const before = swapChain->BackBuffer();
  ASSERT_EQ(swapChain->Resize(0, 0), Status::Ok);
  EXPECT_EQ(swapChain->BackBuffer(), before);
  window.Iconify();
  for (int frame = 0; frame < 5; ++frame) Frame(*swapChain, float(frame));  // draws as ever, presents nothing
  window.Restore();
  ASSERT_EQ(swapChain->Resize(320, 240), Status::Ok);
  for (int frame = 0; frame < 3; ++frame) Frame(*swapChain, float(frame));
  EXPECT_TRUE(Shows(window, *swapChain));
}

// Nobody said that the window is hidden: Present goes on without an error.
TEST_P(ResizeTest, HiddenWithoutAWord) {
  Window window(320, 240);
  const Ref<ISwapChain> swapChain = MakeSwapChain(window, {.width = 320, .height = 240});
  window.Iconify();
  for (int frame = 0; frame < 5; ++frame) Frame(*swapChain, float(frame));
  window.Restore();
  for (int frame = 0; frame < 3; ++frame) Frame(*swapChain, float(frame));
  EXPECT_TRUE(Shows(window, *swapChain));
}

// The window goes first, which is wrong: a status and a message, and the process lives.
TEST_P(ResizeTest, WindowIsDestroyedFirst) {
  Window window(320, 240);
  const Ref<ISwapChain> swapChain = MakeSwapChain(window, {.width = 320, .height = 240});
  Frame(*swapChain, 0);
  ASSERT_EQ(device->WaitIdle(), Status::Ok);
  sink.Expect(MsgCode::SurfaceLost, "the window is gone");
  window.Destroy();
  for (int frame = 0; frame < 3; ++frame) EXPECT_EQ(swapChain->Present(), Status::SurfaceLost);
  EXPECT_EQ(sink.Count(MsgCode::SurfaceLost), 1);
  EXPECT_EQ(TakeXErrors(), "");
}

WINDOW_TESTS_ON_EVERY_BACKEND(ResizeTest);

}  // namespace
}  // namespace rhi_test

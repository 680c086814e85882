// What makes no swap chain gives a status and a message that tells what to do.
#include "scene.h"

namespace rhi_test {
namespace {

using namespace rhi;
using RefusalTest = WindowTest;

TEST_P(RefusalTest, HeadlessDevice) {
  DeviceDesc desc = WindowDeviceDesc(&sink);
  desc.nativeDisplay = nullptr;
  Ref<IDevice> headless;
  ASSERT_EQ(CreateDevice(GetParam(), desc, &headless), Status::Ok);
  EXPECT_FALSE(headless->GetCaps().swapChain);
  Window window(64, 64);
  sink.Expect(MsgCode::CapMissing, "headless");
  Ref<ISwapChain> none;
  EXPECT_EQ(headless->CreateSwapChain({.nativeWindow = window.Native(), .width = 64, .height = 64}, &none),
            Status::Unsupported);
  EXPECT_FALSE(none);
  EXPECT_NE(sink.LastText(MsgCode::CapMissing).find("DeviceDesc::nativeDisplay"), std::string::npos);
}

TEST_P(RefusalTest, BadDescriptors) {
  Window window(64, 64);
  sink.Expect(MsgCode::InvalidDesc, "no window; no size");
  sink.Expect(MsgCode::CapMissing, "formats that cannot be shown");
  Ref<ISwapChain> none;
  EXPECT_EQ(device->CreateSwapChain({.width = 64, .height = 64}, &none), Status::InvalidArg);
  EXPECT_EQ(device->CreateSwapChain({.nativeWindow = window.Native(), .width = 0, .height = 64}, &none),
            Status::InvalidArg);
  for (const Format format : {Format::Unknown, Format::D32_Float, Format::R32_UInt, Format::BC1_UNorm})
    EXPECT_EQ(
        device->CreateSwapChain({.nativeWindow = window.Native(), .width = 64, .height = 64, .format = format}, &none),
        Status::Unsupported)
        << ToString(format);
  EXPECT_FALSE(none);
}

TEST_P(RefusalTest, WindowThatIsGone) {
  Window window(64, 64);
  void* const id = window.Native();
  window.Destroy();
  sink.Allow(MsgCode::CapMissing, "no window");
  sink.Allow(MsgCode::SurfaceLost, "no window");
  Ref<ISwapChain> none;
  EXPECT_NE(device->CreateSwapChain({.nativeWindow = id, .width = 64, .height = 64}, &none), Status::Ok);
  EXPECT_FALSE(none);
  EXPECT_NE(sink.Dump(), "");
}

TEST_P(RefusalTest, BackBufferBeyondTheLimits) {
  Window window(64, 64);
  const Ref<ISwapChain> swapChain = MakeSwapChain(window, {.width = 64, .height = 64});
  sink.Expect(MsgCode::CapMissing, "too large");
  EXPECT_EQ(swapChain->Resize(1u << 20, 64), Status::Unsupported);
  EXPECT_EQ(swapChain->BackBuffer()->Desc().width, 64u);
  Frame(*swapChain, 0);
  EXPECT_TRUE(Shows(window, *swapChain));
}

WINDOW_TESTS_ON_EVERY_BACKEND(RefusalTest);

}  // namespace
}  // namespace rhi_test

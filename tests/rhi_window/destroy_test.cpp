// Swap chains, views, back buffers and devices are released in every order.
#include <algorithm>

#include "scene.h"

namespace rhi_test {
namespace {

using namespace rhi;
using DestroyTest = WindowTest;

TEST_P(DestroyTest, EveryOrder) {
  std::array<int, 4> order{0, 1, 2, 3};
  do {
    Window window(100, 80);
    Ref<IDevice> own;
    ASSERT_EQ(CreateDevice(GetParam(), WindowDeviceDesc(&sink), &own), Status::Ok);
    Ref<ISwapChain> swapChain;
    ASSERT_EQ(own->CreateSwapChain({.nativeWindow = window.Native(), .width = 100, .height = 80}, &swapChain),
              Status::Ok);
    Ref<ITexture> backBuffer(swapChain->BackBuffer());
    Ref<IRenderTargetView> view;
    ASSERT_EQ(own->CreateRenderTargetView(backBuffer.get(), nullptr, &view), Status::Ok);
    const float color[4] = {1, 0, 0, 1};
    own->ImmediateContext()->ClearRenderTargetView(view.get(), color);
    ASSERT_EQ(swapChain->Present(), Status::Ok);
    for (const int what : order) {
      if (what == 0) own = nullptr;
      if (what == 1) swapChain = nullptr;
      if (what == 2) backBuffer = nullptr;
      if (what == 3) view = nullptr;
    }
  } while (std::next_permutation(order.begin(), order.end()));
}

TEST_P(DestroyTest, TwoSwapChainsInBothOrders) {
  for (const bool firstFirst : {true, false}) {
    Window left(100, 80), right(100, 80, 200, 0);
    Ref<ISwapChain> first = MakeSwapChain(left, {.width = 100, .height = 80}),
                    second = MakeSwapChain(right, {.width = 100, .height = 80});
    Frame(*first, 1);
    Frame(*second, 2);
    (firstFirst ? first : second) = nullptr;
    Frame(firstFirst ? *second : *first, 3);
    EXPECT_TRUE(firstFirst ? Shows(right, *second) : Shows(left, *first));
  }
}

// A swap chain without its device shows nothing more, and says so.
TEST_P(DestroyTest, PresentWithoutADevice) {
  Window window(100, 80);
  Ref<IDevice> own;
  ASSERT_EQ(CreateDevice(GetParam(), WindowDeviceDesc(&sink), &own), Status::Ok);
  Ref<ISwapChain> swapChain;
  ASSERT_EQ(own->CreateSwapChain({.nativeWindow = window.Native(), .width = 100, .height = 80}, &swapChain),
            Status::Ok);
  own = nullptr;
  EXPECT_EQ(swapChain->Present(), Status::DeviceLost);
  EXPECT_EQ(swapChain->Resize(50, 40), Status::DeviceLost);
}

TEST_P(DestroyTest, OneWindowManySwapChains) {
  Window window(100, 80);
  for (int i = 0; i < 5; ++i) {
    const Ref<ISwapChain> swapChain = MakeSwapChain(window, {.width = 100, .height = 80});
    Frame(*swapChain, float(i));
    EXPECT_TRUE(Shows(window, *swapChain)) << i;
  }
}

WINDOW_TESTS_ON_EVERY_BACKEND(DestroyTest);

}  // namespace
}  // namespace rhi_test

#include "scene.h"

#include <chrono>
#include <cmath>
#include <cstdlib>
#include <memory>
#include <stdexcept>
#include <thread>

#include "rhi_gl/rhi_gl.h"
#include "rhi_vulkan/rhi_vulkan.h"
#include "rhi_window_shaders/shaders.h"

namespace rhi_test {

using namespace rhi;

namespace {

void Require(Status status, const char* what) {
  if (status != Status::Ok) throw std::runtime_error(std::string(what) + " gave " + ToString(status));
}

bool IsBgra(Format format) { return ToLinear(format) == Format::BGRA8_UNorm; }

// A tester who wants to look sets RHI_WINDOW_PICTURES to a folder.
void Keep(const Pixels& shot) {
  const char* folder = std::getenv("RHI_WINDOW_PICTURES");
  if (!folder) return;
  static int number = 0;
  std::string name = testing::UnitTest::GetInstance()->current_test_info()->name();
  for (char& c : name)
    if (c == '/') c = '_';
  WritePng(std::string(folder) + "/" + name + "_" + std::to_string(number++) + ".png", shot);
}

}  // namespace

std::string BackendName(Backend b) { return b == Backend::Vulkan ? "vulkan" : "gl"; }

Status CreateDevice(Backend backend, const DeviceDesc& desc, Ref<IDevice>* device) {
  return backend == Backend::Vulkan ? rhi_vulkan::CreateDevice(desc, device) : rhi_gl::CreateDevice(desc, device);
}

DeviceDesc WindowDeviceDesc(IMessageSink* sink) {
  DeviceDesc desc;
  desc.nativeDisplay = NativeDisplay();
  desc.apiValidation = desc.syncValidation = desc.preferSoftware = true;
  desc.sink = sink;
  return desc;
}

Pixels Read(IDevice& device, ITexture* texture) {
  const TextureDesc& d = texture->Desc();
  std::vector<uint8_t> texels(size_t(d.width) * d.height * 4);
  Require(device.ReadBack(texture, 0, texels.data(), texels.size()), "ReadBack");
  Pixels p{d.width, d.height, {}};
  const size_t red = IsBgra(d.format) ? 2 : 0;
  for (size_t i = 0; i < texels.size(); i += 4)
    p.rgb.insert(p.rgb.end(), {texels[i + red], texels[i + 1], texels[i + 2 - red]});
  return p;
}

testing::AssertionResult SamePixels(const Pixels& a, const Pixels& b) {
  if (a.width != b.width || a.height != b.height)
    return testing::AssertionFailure() << a.width << " x " << a.height << " and " << b.width << " x " << b.height;
  size_t wrong = 0, first = 0;
  for (size_t i = 0; i < a.rgb.size(); i += 3) {
    if (std::equal(&a.rgb[i], &a.rgb[i] + 3, &b.rgb[i])) continue;
    if (wrong++ == 0) first = i;
  }
  if (wrong == 0) return testing::AssertionSuccess();
  auto result = testing::AssertionFailure();
  result << wrong << " of " << a.rgb.size() / 3 << " pixels differ, the first at " << first / 3 % a.width << ", "
         << first / 3 / a.width << ":";
  for (size_t i = first; i < first + 3; ++i) result << ' ' << +a.rgb[i] << '/' << +b.rgb[i];
  return result;
}

Scene::Scene(IDevice& device) : device_(device), context_(*device.ImmediateContext()) {
  Require(device.CreateShader(window_shaders::window_VSTriangle, &vs_), "CreateShader");
  Require(device.CreateShader(window_shaders::window_PSTriangle, &ps_), "CreateShader");
  Require(device.CreateBuffer({.byteWidth = 16, .usage = Usage::Dynamic, .bind = Bind::ConstantBuffer}, nullptr,
                              &constants_),
          "CreateBuffer");
  constexpr uint32_t kSize = 16;
  std::vector<uint8_t> texels;
  for (uint32_t y = 0; y < kSize; ++y)
    for (uint32_t x = 0; x < kSize; ++x)
      texels.insert(texels.end(), {uint8_t(x * 17), uint8_t(y * 17), uint8_t((x ^ y) & 4 ? 220 : 30), 255});
  const SubresourceData init{texels.data(), kSize * 4, 0};
  Require(device.CreateTexture({.width = kSize, .height = kSize, .format = Format::RGBA8_UNorm}, &init, &texture_),
          "CreateTexture");
  Require(device.CreateShaderResourceView(texture_.get(), nullptr, &view_), "CreateShaderResourceView");
  Require(device.CreateSamplerState({.u = AddressMode::Wrap, .v = AddressMode::Wrap}, &sampler_), "CreateSamplerState");
}

void Scene::Bind() {
  context_.VSSetShader(vs_.get());
  context_.PSSetShader(ps_.get());
  IBuffer* constants = constants_.get();
  context_.SetConstantBuffers(3, 1, &constants);
  IShaderResourceView* view = view_.get();
  context_.PSSetShaderResources(0, 1, &view);
  ISamplerState* sampler = sampler_.get();
  context_.PSSetSamplers(0, 1, &sampler);
  context_.IASetPrimitiveTopology(PrimitiveTopology::TriangleList);
}

void Scene::SetTarget(ITexture* target) {
  Require(device_.CreateRenderTargetView(target, nullptr, &target_), "CreateRenderTargetView");
  IRenderTargetView* view = target_.get();
  context_.OMSetRenderTargets(1, &view, nullptr);
  const Viewport viewport{0, 0, float(target->Desc().width), float(target->Desc().height), 0, 1};
  context_.RSSetViewports(1, &viewport);
}

void Scene::Draw(float time) {
  const float place[4] = {0.25f * std::sin(time), 0.2f * std::cos(time * 1.3f), 0, 0};
  const float background[4] = {0.125f, 0.25f, 0.5f, 1};
  context_.ClearRenderTargetView(target_.get(), background);
  context_.UpdateConstants(constants_.get(), place, sizeof place);
  context_.Draw(3, 0);
}

void WindowTest::SetUp() {
  ASSERT_EQ(DisplayProblem(), "");
  TakeXErrors();
  ASSERT_EQ(CreateDevice(GetParam(), WindowDeviceDesc(&sink), &device), Status::Ok) << sink.Dump();
  ASSERT_TRUE(device->GetCaps().swapChain);
  scene = std::make_unique<Scene>(*device);
  scene->Bind();
}

void WindowTest::TearDown() {
  scene = nullptr;
  if (device) device->ImmediateContext()->ClearState();
  device = nullptr;
  sink.Verify();
  EXPECT_EQ(TakeXErrors(), "");
}

Ref<ISwapChain> WindowTest::MakeSwapChain(const Window& window, SwapChainDesc desc) {
  desc.nativeWindow = window.Native();
  Ref<ISwapChain> swapChain;
  const Status s = device->CreateSwapChain(desc, &swapChain);
  if (s != Status::Ok)
    throw std::runtime_error(std::string("CreateSwapChain gave ") + ToString(s) + "\n" + sink.Dump());
  return swapChain;
}

void WindowTest::Frame(ISwapChain& swapChain, float time) {
  scene->SetTarget(swapChain.BackBuffer());
  scene->Draw(time);
  ASSERT_EQ(swapChain.Present(), Status::Ok) << sink.Dump();
  device->ImmediateContext()->EndFrame();
}

testing::AssertionResult WindowTest::Shows(const Window& window, ISwapChain& swapChain) {
  const Pixels expected = Read(*device, swapChain.BackBuffer());
  const auto deadline = std::chrono::steady_clock::now() + std::chrono::seconds(3);
  Pixels shot = window.Shot();
  while (shot != expected && std::chrono::steady_clock::now() < deadline) {
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
    shot = window.Shot();
  }
  Keep(shot);
  return SamePixels(shot, expected);
}

testing::AssertionResult WindowTest::HoldsTheScene(ISwapChain& swapChain, float time) {
  const TextureDesc& d = swapChain.BackBuffer()->Desc();
  Ref<ITexture> other;
  const Status s = device->CreateTexture(
      {.width = d.width, .height = d.height, .format = d.format, .bind = Bind::RenderTarget}, nullptr, &other);
  if (s != Status::Ok) return testing::AssertionFailure() << "no texture: " << ToString(s);
  scene->SetTarget(other.get());
  scene->Draw(time);
  return SamePixels(Read(*device, swapChain.BackBuffer()), Read(*device, other.get()));
}

}  // namespace rhi_test

// Ten thousand small frames, each with objects of its own: memory stays as it is, and nobody says a word.
#include <unistd.h>

#include <fstream>
#include <random>

#include "rig.h"

namespace rhi_stress {
namespace {

using namespace rhi;

double ResidentMegabytes() {
  uint64_t total = 0, resident = 0;
  std::ifstream("/proc/self/statm") >> total >> resident;
  return double(resident) * double(sysconf(_SC_PAGESIZE)) / (1024.0 * 1024.0);
}

class MemoryTest : public StressTest {
 protected:
  static constexpr uint32_t kSize = 64;

  void Begin() {
    vs_ = rig->Shader(stress_shaders::stress_VSMesh);
    ps_ = rig->Shader(stress_shaders::stress_PSPicture);
  }
  void Frame(uint32_t number);
  template <class T>
  T* Keep(const Ref<T>& object) {
    kept_.push_back(Ref<IObject>(object));
    return object.get();
  }
  void MakeStates(uint32_t number);
  void MakePicture(uint32_t number);
  void MakeMesh();
  void ReleaseSome();
  void CheckPicture(ITexture*, uint32_t number);

  std::mt19937 random_{1};
  std::vector<Ref<IObject>> kept_;
  Ref<IShader> vs_, ps_;
  uint32_t newPipelinesEvery_ = 500;
};

// Of each kind a few descriptors: equal ones are one object, and ids of descriptors are kept for the device's life.
void MemoryTest::MakeStates(uint32_t number) {
  Ref<IBlendState> blend;
  Ref<IRasterizerState> raster;
  Ref<IDepthStencilState> depth;
  BlendDesc blendDesc;
  blendDesc.rt[0].enable = number & 1;
  rig->Require(rig->device->CreateBlendState(blendDesc, &blend), "CreateBlendState");
  rig->Require(rig->device->CreateRasterizerState({.cull = CullMode::None, .depthBias = int32_t(number % 3)}, &raster),
               "CreateRasterizerState");
  rig->Require(
      rig->device->CreateDepthStencilState({.depthEnable = number % 2 == 0, .readMask = uint8_t(number % 5)}, &depth),
      "CreateDepthStencilState");
  rig->context->OMSetBlendState(Keep(blend));
  rig->context->RSSetState(Keep(raster));
  rig->context->OMSetDepthStencilState(Keep(depth));
}

void MemoryTest::MakePicture(uint32_t number) {
  const Ref<ITexture> picture = rig->Plain(8, {uint8_t(number), uint8_t(number >> 8), 7, 255});
  Ref<ISamplerState> sampler;
  rig->Require(rig->device->CreateSamplerState({.mipBias = float(number % 4)}, &sampler), "CreateSamplerState");
  IShaderResourceView* view = Keep(rig->View(Keep(picture)));
  ISamplerState* bound = Keep(sampler);
  rig->context->PSSetShaderResources(0, 1, &view);
  rig->context->PSSetSamplers(0, 1, &bound);
}

void MemoryTest::MakeMesh() {
  constexpr std::array<float, 8> kCorners{0, 0, 1, 0, 0, 1, 1, 1};
  const InputElement element{.semantic = "POSITION", .format = Format::RG32_Float};
  Ref<IInputLayout> layout;
  rig->Require(rig->device->CreateInputLayout(&element, 1, vs_.get(), &layout), "CreateInputLayout");
  const Usage usages[] = {Usage::Immutable, Usage::Default, Usage::Dynamic};
  const Usage usage = usages[random_() % 3];
  IBuffer* buffer =
      Keep(rig->Buffer({.byteWidth = sizeof kCorners, .usage = usage, .bind = Bind::VertexBuffer}, kCorners.data()));
  const uint32_t stride = 8, offset = 0;
  rig->context->IASetInputLayout(Keep(layout));
  rig->context->IASetVertexBuffers(0, 1, &buffer, &stride, &offset);
}

void MemoryTest::ReleaseSome() {
  while (kept_.size() > 40) {
    std::swap(kept_[random_() % kept_.size()], kept_.back());
    kept_.pop_back();
  }
}

void MemoryTest::CheckPicture(ITexture* texture, uint32_t number) {
  EXPECT_TRUE(Matches(rig->Read(texture),
                      [number](uint32_t, uint32_t) {
                        return Rgba8{uint8_t(number), uint8_t(number >> 8), 7, 255};
                      }))
      << "frame " << number;
}

void MemoryTest::Frame(uint32_t number) {
  const Target target = rig->MakeTarget(kSize);
  Keep(target.view);
  // Shaders come and go in every frame; those made now are drawn with only sometimes, because a driver compiles code
  // for each new pair.
  IShader* vs = Keep(rig->Shader(stress_shaders::stress_VSMesh));
  IShader* ps = Keep(rig->Shader(stress_shaders::stress_PSPicture));
  const bool fresh = number % newPipelinesEvery_ == 0;
  rig->context->ClearRenderTargetView(target.view.get(), Rgba32F{0, 0, 0, 0}.data());
  rig->SetTarget(target);
  MakeStates(number);
  MakePicture(number);
  MakeMesh();
  rig->SetConstants(Keep(rig->Constants()), {});
  rig->DrawRect(fresh ? vs : vs_.get(), fresh ? ps : ps_.get());
  if (number % 1000 == 999) CheckPicture(target.texture.get(), number);
  rig->context->EndFrame();
  Keep(target.texture);
  ReleaseSome();
}

// 8,000 frames may add 4 MB, which is 524 bytes a frame: less than one of the about 15 objects that each frame makes,
// so none of them is lost. Rings, pools and the drivers' caches have their size after 2,000 frames; what is left is the
// allocator's fragmentation and the drivers' code for new pipelines.
TEST_P(MemoryTest, TenThousandFramesStayFlat) {
  if (kAddressSanitizer) GTEST_SKIP() << "the address sanitizer keeps what is freed";
  Open(false);
  Begin();
  double early = 0;
  for (uint32_t frame = 0; frame < 10000; ++frame) {
    if (frame == 2000) early = ResidentMegabytes();
    Frame(frame);
  }
  const double late = ResidentMegabytes();
  RecordProperty("resident_early_mb", std::to_string(early));
  RecordProperty("resident_late_mb", std::to_string(late));
  std::printf("resident memory: %.1f MB after 2,000 frames, %.1f MB after 10,000\n", early, late);
  EXPECT_LE(late - early, 4.0);
  kept_.clear();
}

TEST_P(MemoryTest, TheSameUnderValidation) {
  Open(kValidation);
  Begin();
  newPipelinesEvery_ = 20;
  for (uint32_t frame = 0; frame < 150; ++frame) Frame(frame);
  kept_.clear();
}

STRESS_ON_EVERY_BACKEND(MemoryTest);

}  // namespace
}  // namespace rhi_stress

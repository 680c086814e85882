// Errors from below: no memory, a driver that refuses a shader, a cap that is missing. Each is a status and a message,
// and the device goes on.
#include <sys/resource.h>

#include <fstream>

#include "rig.h"

namespace rhi_stress {
namespace {

using namespace rhi;

class ErrorPathTest : public StressTest {
 protected:
  bool WasRefused(Status status) const { return status == Status::OutOfMemory || status == Status::Unsupported; }
  int Refusals() const { return rig->sink.Count(MsgCode::OutOfMemory) + rig->sink.Count(MsgCode::CapMissing); }
  void AllowRefusals() {
    rig->sink.Allow(MsgCode::OutOfMemory, "more than there is");
    rig->sink.Allow(MsgCode::CapMissing, "more than the driver offers");
  }
  void ExpectCompileFailed(const ShaderBlob& blob) {
    const int before = rig->sink.Count(MsgCode::ShaderRejected);
    Ref<IShader> none;
    EXPECT_EQ(rig->device->CreateShader(blob, &none), Status::CompileFailed);
    EXPECT_FALSE(none);
    EXPECT_EQ(rig->sink.Count(MsgCode::ShaderRejected), before + 1) << rig->sink.Dump();
  }
};

// Within every limit that the caps state, and terabytes in all.
TEST_P(ErrorPathTest, TextureThatNobodyHasMemoryFor) {
  Open(false);
  AllowRefusals();
  const Caps& caps = rig->device->GetCaps();
  Ref<ITexture> none;
  const Status status = rig->device->CreateTexture({.dim = TextureDim::Tex2DArray,
                                                    .width = caps.maxTexture2D,
                                                    .height = caps.maxTexture2D,
                                                    .depthOrArray = caps.maxArrayLayers,
                                                    .format = Format::RGBA32_Float},
                                                   nullptr, &none);
  EXPECT_TRUE(WasRefused(status)) << ToString(status);
  EXPECT_FALSE(none);
  EXPECT_EQ(Refusals(), 1) << rig->sink.Dump();
  rig->ExpectUsable();
}

// Lets the process have `bytes` more of address space than now, for as long as it lives.
class AddressSpaceLimit {
 public:
  explicit AddressSpaceLimit(uint64_t bytes) {
    uint64_t pages = 0;
    std::ifstream("/proc/self/statm") >> pages;
    getrlimit(RLIMIT_AS, &before_);
    rlimit now = before_;
    now.rlim_cur = pages * 4096 + bytes;
    setrlimit(RLIMIT_AS, &now);
  }
  ~AddressSpaceLimit() { setrlimit(RLIMIT_AS, &before_); }
  AddressSpaceLimit(const AddressSpaceLimit&) = delete;
  AddressSpaceLimit& operator=(const AddressSpaceLimit&) = delete;

 private:
  rlimit before_{};
};

// A software driver takes its memory from the process, so the process's limit is the driver's.
TEST_P(ErrorPathTest, BufferWhenMemoryRunsOut) {
  if (kAddressSanitizer) GTEST_SKIP() << "the address sanitizer maps terabytes";
  Open(false);
  if (!rig->device->GetCaps().software) GTEST_SKIP() << "not a software driver: its memory is its own";
  AllowRefusals();
  for (const Usage usage : {Usage::Default, Usage::Dynamic, Usage::Staging}) {
    const Bind bind = usage == Usage::Staging ? Bind::None : Bind::VertexBuffer;
    const int before = Refusals();
    Ref<IBuffer> none;
    Status status = Status::Ok;
    {
      const AddressSpaceLimit limit(64u << 20);
      status = rig->device->CreateBuffer({.byteWidth = 1u << 30, .usage = usage, .bind = bind}, nullptr, &none);
    }
    EXPECT_TRUE(WasRefused(status)) << ToString(status) << ", usage " << int(usage);
    EXPECT_FALSE(none);
    EXPECT_EQ(Refusals(), before + 1) << rig->sink.Dump();
    rig->ExpectUsable();
  }
}

TEST_P(ErrorPathTest, ShaderThatDoesNotCompile) {
  Open(kValidation);
  rig->sink.Expect(MsgCode::ShaderRejected, "the shader is broken");
  if (GetParam() == Backend::OpenGL)
    rig->sink.Allow(MsgCode::ApiValidation, "GL's debug output has a word of its own about it");
  const ShaderBlob& good = stress_shaders::stress_PSTint;
  ShaderBlob blob = good;
  blob.name = "broken";
  blob.glsl = "#version 450\nlayout(location = 0) out vec4 color;\nvoid main() { color = nothing; }\n";
  std::vector<uint32_t> words(good.spirv.begin(), good.spirv.end());
  words[0] ^= 1;  // not SPIR-V's number
  blob.spirv = {words.data(), uint32_t(words.size())};
  ExpectCompileFailed(blob);
  words[0] ^= 1;
  for (const uint32_t size : {3u, 5u, 6u, uint32_t(words.size()) / 2, uint32_t(words.size()) - 1}) {
    blob.spirv.size = size;
    ExpectCompileFailed(blob);
  }
  rig->ExpectUsable();
}

// An instruction that claims more words than there are, and one of none.
TEST_P(ErrorPathTest, ShaderWithWrongWordCounts) {
  if (GetParam() != Backend::Vulkan) GTEST_SKIP() << "only Vulkan reads SPIR-V";
  Open(kValidation);
  rig->sink.Expect(MsgCode::ShaderRejected, "the shader is broken");
  const ShaderBlob& good = stress_shaders::stress_VSRect;
  for (const uint32_t first : {0x7FFF0011u, 0x00000011u}) {
    std::vector<uint32_t> words(good.spirv.begin(), good.spirv.end());
    words[5] = first;
    ShaderBlob blob = good;
    blob.spirv = {words.data(), uint32_t(words.size())};
    ExpectCompileFailed(blob);
  }
  rig->ExpectUsable();
}

TEST_P(ErrorPathTest, MissingCapIsNamed) {
  Open(kValidation);
  rig->sink.Expect(MsgCode::CapMissing, "no driver has 64 samples");
  Ref<ITexture> none;
  EXPECT_EQ(rig->device->CreateTexture({.dim = TextureDim::Tex2DMS,
                                        .width = 8,
                                        .height = 8,
                                        .sampleCount = 64,
                                        .format = Format::RGBA8_UNorm,
                                        .bind = Bind::RenderTarget},
                                       nullptr, &none),
            Status::Unsupported);
  EXPECT_NE(rig->sink.LastText(MsgCode::CapMissing).find("64 samples"), std::string::npos) << rig->sink.Dump();
  rig->ExpectUsable();
}

// 10,000 updates and draws in each of four frames: after the first frame nothing is made, and no pass is broken.
TEST_P(ErrorPathTest, TenThousandUpdatesBreakNothing) {
  Open(false);
  const Target target = rig->MakeTarget(64);
  const Ref<IBuffer> constants = rig->Constants();
  const Ref<IShader> vs = rig->Shader(stress_shaders::stress_VSRect);
  const Ref<IShader> ps[2] = {rig->Shader(stress_shaders::stress_PSTint), rig->Shader(stress_shaders::stress_PSTinted)};
  for (int frame = 0; frame < 4; ++frame) {
    rig->device->GetStats(true);
    rig->context->ClearRenderTargetView(target.view.get(), Rgba32F{0, 0, 0, 0}.data());
    rig->SetTarget(target);
    for (uint32_t i = 0; i < 10000; ++i) {
      const float x = float(i % 64) / 32 - 1, y = 1 - float(i / 64 % 64) / 32;
      rig->SetConstants(constants.get(), {.tint = {1, 0, 1, 1}, .rectangle = {x, y, x + 0.03125f, y - 0.03125f}});
      rig->DrawRect(vs.get(), ps[i / 100 % 2].get());
    }
    rig->context->EndFrame();
    const Stats stats = rig->device->GetStats(false);
    EXPECT_EQ(stats.draws, 10000u);
    EXPECT_EQ(stats.passBreaks, 0u);
    EXPECT_LE(stats.pipelineLookups, 100u);
    EXPECT_GE(stats.ringBytes, 10000u * sizeof(DrawConstants));
    if (frame == 0) continue;
    EXPECT_EQ(stats.pipelineMisses, 0u) << "frame " << frame;
  }
  EXPECT_TRUE(Matches(rig->Read(target.texture.get()), [](auto, auto) { return Rgba8{255, 0, 255, 255}; }));
}

STRESS_ON_EVERY_BACKEND(ErrorPathTest);

}  // namespace
}  // namespace rhi_stress

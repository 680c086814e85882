#include "planted.h"

#include "conformance.h"

namespace conformance {
namespace {

using rhi_test::BothCase;
using rhi_test::RhiCase;

Image Gray(uint8_t first) {
  Image image = FromRgba8(8, 8, std::vector<uint8_t>(256, 128));
  image.bytes[4] = first;
  return image;
}

class OneLsb : public testing::Test {
  void TestBody() override {
    EXPECT_TRUE(Matches(Gray(129), [](uint32_t, uint32_t) { return Rgba8{128, 128, 128, 128}; }));
  }
};

// A message that nobody expects: a resource that Direct3D would refuse.
class Message : public RhiCase {
 public:
  Message() : RhiCase(rhi::Backend::Vulkan) {}
  void TestBody() override {
    rhi::Ref<rhi::ITexture> none;
    EXPECT_NE(device.CreateTexture({.width = 0}, nullptr, &none), rhi::Status::Ok);
  }
};

class Skip : public RhiCase {
 public:
  Skip() : RhiCase(rhi::Backend::OpenGL) {}
  void TestBody() override { GTEST_SKIP() << "this adapter lacks Caps::geometryShader (planted)"; }
};

// One byte of a buffer is another on GL.
class Bytes : public RhiCase {
 public:
  explicit Bytes(rhi::Backend b) : RhiCase(b) {}
  void TestBody() override {
    const std::vector<uint8_t> data{1, 2, uint8_t(backend == rhi::Backend::Vulkan ? 3 : 4), 4};
    gpu.Read(gpu.BufferOf(rhi::Bind::VertexBuffer, data).get(), 0, 4);
  }
};

class PicturesOfBoth : public BothCase {
  void TestBody() override { EXPECT_TRUE(SameImage(Gray(127), Gray(128))); }
};

template <class Make>
void Register(const char* name, Make make) {
  testing::RegisterTest("PlantedTest", name, nullptr, nullptr, __FILE__, __LINE__,
                        [make]() -> testing::Test* { return make(); });
}

}  // namespace

void RegisterPlanted() {
  Register("OneLsb", [] { return static_cast<testing::Test*>(new OneLsb); });
  Register("Message/vulkan", [] { return static_cast<testing::Test*>(new Message); });
  Register("Skip/gl", [] { return static_cast<testing::Test*>(new Skip); });
  Register("Bytes/vulkan", [] { return static_cast<testing::Test*>(new Bytes(rhi::Backend::Vulkan)); });
  Register("Bytes/gl", [] { return static_cast<testing::Test*>(new Bytes(rhi::Backend::OpenGL)); });
  Register("Pictures/both", [] { return static_cast<testing::Test*>(new PicturesOfBoth); });
}

}  // namespace conformance

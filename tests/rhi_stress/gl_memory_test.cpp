// OpenGL has no memory for one storage: a status and a message, and the device goes on.
#include <epoxy/gl.h>

#include <functional>
#include <utility>

#include "rig.h"

namespace rhi_stress {
namespace {

using namespace rhi;

// Storage is not made, and the next glGetError says that memory is out.
class NoMemory {
 public:
  NoMemory() { failed_ = false; }
  ~NoMemory() {
    epoxy_glNamedBufferStorage = bufferStorage_;
    epoxy_glTextureStorage2D = textureStorage2D_;
    epoxy_glTextureStorage3D = textureStorage3D_;
    epoxy_glTextureStorage2DMultisample = multisample_;
    epoxy_glMapNamedBufferRange = map_;
    epoxy_glGetError = error_;
  }
  NoMemory(const NoMemory&) = delete;
  NoMemory& operator=(const NoMemory&) = delete;

 private:
  static inline bool failed_ = false;
  template <class F>
  static F Replace(F& entry, F with) {
    return std::exchange(entry, with);
  }
  PFNGLNAMEDBUFFERSTORAGEPROC bufferStorage_ = Replace<PFNGLNAMEDBUFFERSTORAGEPROC>(
      epoxy_glNamedBufferStorage, +[](GLuint, GLsizeiptr, const void*, GLbitfield) { failed_ = true; });
  PFNGLTEXTURESTORAGE2DPROC textureStorage2D_ = Replace<PFNGLTEXTURESTORAGE2DPROC>(
      epoxy_glTextureStorage2D, +[](GLuint, GLsizei, GLenum, GLsizei, GLsizei) { failed_ = true; });
  PFNGLTEXTURESTORAGE3DPROC textureStorage3D_ = Replace<PFNGLTEXTURESTORAGE3DPROC>(
      epoxy_glTextureStorage3D, +[](GLuint, GLsizei, GLenum, GLsizei, GLsizei, GLsizei) { failed_ = true; });
  PFNGLTEXTURESTORAGE2DMULTISAMPLEPROC multisample_ = Replace<PFNGLTEXTURESTORAGE2DMULTISAMPLEPROC>(
      epoxy_glTextureStorage2DMultisample,
      +[](GLuint, GLsizei, GLenum, GLsizei, GLsizei, GLboolean) { failed_ = true; });
  PFNGLMAPNAMEDBUFFERRANGEPROC map_ = Replace<PFNGLMAPNAMEDBUFFERRANGEPROC>(
      epoxy_glMapNamedBufferRange, +[](GLuint, GLintptr, GLsizeiptr, GLbitfield) -> void* { return nullptr; });
  PFNGLGETERRORPROC error_ = Replace<PFNGLGETERRORPROC>(
      epoxy_glGetError, +[] { return std::exchange(failed_, false) ? GLenum(GL_OUT_OF_MEMORY) : GLenum(GL_NO_ERROR); });
};

struct Case {
  const char* name;
  std::function<Status(Rig&)> call;  // OutOfMemory, and nothing is made
};
void PrintTo(const Case& one, std::ostream* out) { *out << one.name; }

Case Buffer(const char* name, BufferDesc desc, bool init = false) {
  return {name, [=](Rig& rig) {
            const std::array<uint8_t, 64> data{};
            Ref<IBuffer> none;
            const Status s = rig.device->CreateBuffer(desc, init ? data.data() : nullptr, &none);
            EXPECT_FALSE(none);
            return s;
          }};
}

Case Texture(const char* name, TextureDesc desc) {
  desc.width = desc.height = 8;
  desc.format = Format::RGBA8_UNorm;
  return {name, [=](Rig& rig) {
            Ref<ITexture> none;
            const Status s = rig.device->CreateTexture(desc, nullptr, &none);
            EXPECT_FALSE(none);
            return s;
          }};
}

std::vector<Case> Cases() {
  constexpr Bind v = Bind::VertexBuffer;
  return {Buffer("DefaultBuffer", {.byteWidth = 64, .bind = v}),
          Buffer("ImmutableBuffer", {.byteWidth = 64, .usage = Usage::Immutable, .bind = v}, true),
          Buffer("DynamicBuffer", {.byteWidth = 64, .usage = Usage::Dynamic, .bind = v}),
          Buffer("StagingBuffer", {.byteWidth = 64, .usage = Usage::Staging}),
          Buffer("Constants", {.byteWidth = 64, .usage = Usage::Dynamic, .bind = Bind::ConstantBuffer}, true),
          Texture("Texture2D", {}),
          Texture("Texture3D", {.dim = TextureDim::Tex3D, .depthOrArray = 4}),
          Texture("Multisampled", {.dim = TextureDim::Tex2DMS, .sampleCount = 4, .bind = Bind::RenderTarget}),
          Texture("StagingTexture", {.usage = Usage::Staging, .bind = Bind::None})};
}

class GlMemoryTest : public testing::TestWithParam<Case> {};

TEST_P(GlMemoryTest, IsAStatusAndTheDeviceGoesOn) {
  Rig rig(Backend::OpenGL, true);
  rig.sink.Expect(MsgCode::OutOfMemory, "the driver says so");
  {
    const NoMemory none;
    EXPECT_EQ(GetParam().call(rig), Status::OutOfMemory);
    EXPECT_EQ(rig.sink.Count(MsgCode::OutOfMemory), 1) << rig.sink.Dump();
  }
  rig.ExpectUsable();
  rig.Finish();
  rig.sink.Verify();
}

INSTANTIATE_TEST_SUITE_P(Of, GlMemoryTest, testing::ValuesIn(Cases()),
                         [](const auto& one) { return std::string(one.param.name); });

// The ring has no page yet, and a dynamic buffer no second version.
TEST(GlGrowthTest, IsAMessageAndAStatus) {
  Rig rig(Backend::OpenGL, true);
  rig.sink.Expect(MsgCode::OutOfMemory, "the driver says so");
  const Ref<IBuffer> constants = rig.Constants();
  const Ref<IBuffer> dynamic = rig.Buffer({.byteWidth = 64, .usage = Usage::Dynamic, .bind = Bind::VertexBuffer});
  {
    const NoMemory none;
    rig.SetConstants(constants.get(), {});
    EXPECT_EQ(rig.sink.Count(MsgCode::OutOfMemory), 1) << rig.sink.Dump();
    Mapped m;
    EXPECT_EQ(rig.context->Map(dynamic.get(), 0, MapMode::WriteDiscard, &m), Status::OutOfMemory);
    EXPECT_EQ(rig.sink.Count(MsgCode::OutOfMemory), 2) << rig.sink.Dump();
  }
  rig.ExpectUsable();
  Mapped m;
  EXPECT_EQ(rig.context->Map(dynamic.get(), 0, MapMode::WriteDiscard, &m), Status::Ok);
  rig.context->Unmap(dynamic.get(), 0);
  rig.Finish();
  rig.sink.Verify();
}

}  // namespace
}  // namespace rhi_stress

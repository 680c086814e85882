// The workload by hand on OpenGL: a persistently mapped ring, direct state access, state set only where it changes.
#include <epoxy/egl.h>
#include <epoxy/gl.h>

#include <cstring>
#include <stdexcept>

#include "rhi_overhead_shaders/shaders.h"
#include "workload.h"

namespace rhi_overhead {
namespace {

void Require(bool ok, const char* what) {
  if (!ok) throw std::runtime_error(std::string("raw GL: ") + what + " failed");
}

class RawGl final : public Loop {
 public:
  RawGl();
  ~RawGl() override;
  void Frame(uint32_t switchEvery) override;
  std::vector<uint8_t> Picture() override;

 private:
  void MakeContext();
  void MakeTarget();
  void MakeRing();

  EGLDisplay display_ = nullptr;
  EGLContext context_ = nullptr;
  GLuint texture_ = 0, framebuffer_ = 0, array_ = 0, ring_ = 0, firstVertex_ = 0;
  std::array<GLuint, 2> programs_{};
  uint8_t* mapped_ = nullptr;
  uint32_t stride_ = 0;
};

// The same text that the RHI gives to the driver: a vertex shader that is the last stage turns the picture over.
GLuint Compile(GLenum stage, const char* glsl, bool lastStage) {
  const std::string text(glsl);
  const size_t body = text.find('\n') + 1;
  const std::string macro = lastStage ? std::string("#define ") + rhi::kGlLastStageMacro + "\n" : "";
  const std::string source = text.substr(0, body) + macro + text.substr(body);
  const char* begin = source.c_str();
  const GLuint shader = glCreateShader(stage);
  glShaderSource(shader, 1, &begin, nullptr);
  glCompileShader(shader);
  return shader;
}

GLuint Link(GLuint vs, GLuint ps) {
  const GLuint program = glCreateProgram();
  glAttachShader(program, vs);
  glAttachShader(program, ps);
  glLinkProgram(program);
  GLint linked = GL_FALSE;
  glGetProgramiv(program, GL_LINK_STATUS, &linked);
  Require(linked, "glLinkProgram");
  return program;
}

RawGl::RawGl() {
  MakeContext();
  MakeTarget();
  MakeRing();
  const GLuint vs = Compile(GL_VERTEX_SHADER, overhead_shaders::pixel_VSPixel.glsl, true);
  programs_[0] = Link(vs, Compile(GL_FRAGMENT_SHADER, overhead_shaders::pixel_PSColor.glsl, false));
  programs_[1] = Link(vs, Compile(GL_FRAGMENT_SHADER, overhead_shaders::pixel_PSSwapped.glsl, false));
  glClipControl(GL_LOWER_LEFT, GL_ZERO_TO_ONE);
  glEnable(GL_CULL_FACE);
  glFrontFace(GL_CCW);  // clockwise, turned over
  glDisable(GL_DITHER);
  glBlendFuncSeparate(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA, GL_ONE, GL_ZERO);
}

RawGl::~RawGl() {
  eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
  eglDestroyContext(display_, context_);
}

void RawGl::MakeContext() {
  display_ = eglGetPlatformDisplayEXT(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, nullptr);
  Require(display_ && eglInitialize(display_, nullptr, nullptr), "eglInitialize (surfaceless)");
  eglBindAPI(EGL_OPENGL_API);
  const EGLint attributes[] = {
      EGL_CONTEXT_MAJOR_VERSION,           4,       EGL_CONTEXT_MINOR_VERSION, 5, EGL_CONTEXT_OPENGL_PROFILE_MASK,
      EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT, EGL_NONE};
  context_ = eglCreateContext(display_, nullptr, EGL_NO_CONTEXT, attributes);
  Require(context_ && eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, context_), "eglCreateContext");
}

void RawGl::MakeTarget() {
  glCreateTextures(GL_TEXTURE_2D, 1, &texture_);
  glTextureStorage2D(texture_, 1, GL_RGBA8, kSize, kSize);
  glCreateFramebuffers(1, &framebuffer_);
  glNamedFramebufferTexture(framebuffer_, GL_COLOR_ATTACHMENT0, texture_, 0);
  glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_);
  glViewport(0, 0, kSize, kSize);
  glCreateVertexArrays(1, &array_);
  glBindVertexArray(array_);
}

void RawGl::MakeRing() {
  // The shader compiler's block for the first vertex: 0. It comes first because Mesa finds the buffer of name 1 for 50
  // instructions less than any other, and no real program has its ring there.
  const std::array<uint32_t, 4> zeros{};
  glCreateBuffers(1, &firstVertex_);
  glNamedBufferStorage(firstVertex_, sizeof zeros, zeros.data(), 0);
  glBindBufferRange(GL_UNIFORM_BUFFER, rhi::kGlDrawParametersBlock, firstVertex_, 0, sizeof zeros);
  GLint alignment = 0;
  glGetIntegerv(GL_UNIFORM_BUFFER_OFFSET_ALIGNMENT, &alignment);
  const uint32_t unit = uint32_t(alignment), size = uint32_t(sizeof(DrawConstants));
  stride_ = (size + unit - 1) / unit * unit;
  constexpr GLbitfield kFlags = GL_MAP_WRITE_BIT | GL_MAP_PERSISTENT_BIT | GL_MAP_COHERENT_BIT;
  const GLsizeiptr bytes = GLsizeiptr(stride_) * kDraws;
  glCreateBuffers(1, &ring_);
  glNamedBufferStorage(ring_, bytes, nullptr, kFlags);
  mapped_ = static_cast<uint8_t*>(glMapNamedBufferRange(ring_, 0, bytes, kFlags));
  Require(mapped_ != nullptr, "glMapNamedBufferRange");
}

void RawGl::Frame(uint32_t switchEvery) {
  constexpr GLfloat kBlack[4] = {0, 0, 0, 0};
  const DrawConstants* constants = Constants().data();
  glClearNamedFramebufferfv(framebuffer_, GL_COLOR, 0, kBlack);
  uint32_t head = 0;
  for (uint32_t i = 0; i < kDraws; ++i) {
    if (i % switchEvery == 0) {
      const uint32_t which = i / switchEvery & 1;
      glUseProgram(programs_[which]);
      if (which) {
        glEnable(GL_BLEND);
      } else {
        glDisable(GL_BLEND);
      }
    }
    std::memcpy(mapped_ + head, &constants[i], sizeof(DrawConstants));
    glBindBufferRange(GL_UNIFORM_BUFFER, kConstantSlot, ring_, head, sizeof(DrawConstants));
    glDrawArrays(GL_TRIANGLES, 0, 3);
    head += stride_;
  }
  glFinish();
}

std::vector<uint8_t> RawGl::Picture() {
  std::vector<uint8_t> bytes(size_t(kSize) * kSize * 4);
  glGetTextureImage(texture_, 0, GL_RGBA, GL_UNSIGNED_BYTE, GLsizei(bytes.size()), bytes.data());
  return bytes;
}

}  // namespace

std::unique_ptr<Loop> MakeRawGl() { return std::make_unique<RawGl>(); }

}  // namespace rhi_overhead

#include "depth_bias.h"

#include <epoxy/gl.h>

#include <cmath>

namespace rhi_gl {
namespace {

constexpr float kDepth = 0.75f;  // its exponent is -1
constexpr float kUnits = 1024;

GLuint MakeProgram() {
  const char* text =
      "#version 450 core\n"
      "void main() { gl_Position = vec4(gl_VertexID == 1 ? 3 : -1, gl_VertexID == 2 ? 3 : -1, 0.75, 1); }\n";
  const GLuint shader = glCreateShader(GL_VERTEX_SHADER), program = glCreateProgram();
  glShaderSource(shader, 1, &text, nullptr);
  glCompileShader(shader);
  glAttachShader(program, shader);
  glLinkProgram(program);
  glDeleteShader(shader);
  return program;
}

// Binds a framebuffer of one pixel that has a depth and nothing else. Texture and framebuffer end with the context.
void UseFloatDepth() {
  GLuint texture = 0, framebuffer = 0;
  glCreateTextures(GL_TEXTURE_2D, 1, &texture);
  glTextureStorage2D(texture, 1, GL_DEPTH_COMPONENT32F, 1, 1);
  glCreateFramebuffers(1, &framebuffer);
  glNamedFramebufferTexture(framebuffer, GL_DEPTH_ATTACHMENT, texture, 0);
  glNamedFramebufferDrawBuffer(framebuffer, GL_NONE);
  glNamedFramebufferReadBuffer(framebuffer, GL_NONE);
  glBindFramebuffer(GL_FRAMEBUFFER, framebuffer);
  glViewport(0, 0, 1, 1);
}

}  // namespace

float MeasureDepthBiasUnits() {
  GLuint array = 0;
  glCreateVertexArrays(1, &array);
  glBindVertexArray(array);
  glUseProgram(MakeProgram());
  UseFloatDepth();
  glClipControl(GL_LOWER_LEFT, GL_ZERO_TO_ONE);
  glEnable(GL_DEPTH_TEST);
  glDepthFunc(GL_ALWAYS);
  glEnable(GL_POLYGON_OFFSET_FILL);
  glPolygonOffset(0, kUnits);
  glDrawArrays(GL_TRIANGLES, 0, 3);
  float depth = 0;
  glReadPixels(0, 0, 1, 1, GL_DEPTH_COMPONENT, GL_FLOAT, &depth);
  const float unit = (depth - kDepth) / kUnits;
  return unit > 0 ? std::exp2(std::round(std::log2(std::ldexp(1.0f, -1 - 23) / unit))) : 1;
}

}  // namespace rhi_gl

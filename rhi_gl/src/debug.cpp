#include "debug.h"

#include <cstring>

#include "core.h"

namespace rhi_gl {
namespace {

Severity ToSeverity(GLenum type, GLenum severity) {
  if (type == GL_DEBUG_TYPE_ERROR || type == GL_DEBUG_TYPE_UNDEFINED_BEHAVIOR) return Severity::Error;
  if (severity == GL_DEBUG_SEVERITY_HIGH) return Severity::Error;
  // What a driver says about speed (where a buffer lies, a shader's statistics) is no fault of the caller.
  if (type == GL_DEBUG_TYPE_PERFORMANCE || type == GL_DEBUG_TYPE_OTHER) return Severity::Info;
  return severity == GL_DEBUG_SEVERITY_MEDIUM ? Severity::Warning : Severity::Info;
}

void GLAPIENTRY OnDebugMessage(GLenum source, GLenum type, GLuint id, GLenum severity, GLsizei, const GLchar* text,
                               const void* user) {
  const Core& core = *static_cast<const Core*>(user);
  if (source == GL_DEBUG_SOURCE_APPLICATION) return;  // our own debug groups
  if (core.allocating && std::strstr(text, "GL_OUT_OF_MEMORY")) return;
  core.log.Forward({ToSeverity(type, severity), MsgCode::ApiValidation, "", text, int32_t(id)});
}

}  // namespace

void InstallDebugCallback(Core& core) {
  glEnable(GL_DEBUG_OUTPUT);
  glEnable(GL_DEBUG_OUTPUT_SYNCHRONOUS);
  glDebugMessageControl(GL_DONT_CARE, GL_DONT_CARE, GL_DONT_CARE, 0, nullptr, GL_TRUE);
  glDebugMessageCallback(OnDebugMessage, &core);
}

}  // namespace rhi_gl

#include "programs.h"

#include <vector>

#include "core.h"
#include "shaders.h"

namespace rhi_gl {

GLuint LinkProgram(std::initializer_list<const Shader*> shaders, std::string* log) {
  const GLuint name = glCreateProgram();
  for (const Shader* s : shaders)
    if (s) glAttachShader(name, s->name);
  glLinkProgram(name);
  for (const Shader* s : shaders)
    if (s) glDetachShader(name, s->name);
  GLint linked = GL_FALSE, length = 0;
  glGetProgramiv(name, GL_LINK_STATUS, &linked);
  if (linked) return name;
  glGetProgramiv(name, GL_INFO_LOG_LENGTH, &length);
  log->resize(size_t(std::max(length, 1)));
  glGetProgramInfoLog(name, GLsizei(log->size()), nullptr, log->data());
  glDeleteProgram(name);
  return 0;
}

const Program& ProgramCache::Get(const Shader* vs, const Shader* gs, const Shader* ps, bool* made) {
  const Key key{vs->uid, gs ? gs->uid : 0, ps ? ps->uid : 0};
  const auto found = made_.find(key);
  *made = found == made_.end();
  return *made ? made_.emplace(key, Make(vs, gs, ps)).first->second : found->second;
}

Program ProgramCache::Make(const Shader* vs, const Shader* gs, const Shader* ps) {
  std::string why;
  Program p;
  p.uid = core_.NewUid();
  p.usesVertexId = vs->reflection.usesVertexId;
  p.name = LinkProgram({vs, gs, ps}, &why);
  if (p.name == 0)
    core_.log.Report(Severity::Error, MsgCode::ShaderRejected, vs->Name().c_str(),
                     "the driver cannot link %s, %s and %s: %s", vs->Name().c_str(), gs ? gs->Name().c_str() : "no GS",
                     ps ? ps->Name().c_str() : "no PS", why.c_str());
  return p;
}

void ProgramCache::Forget(uint32_t shaderUid) {
  std::erase_if(made_, [&](const auto& entry) {
    const auto& [key, program] = entry;
    if (std::find(key.begin(), key.end(), shaderUid) == key.end()) return false;
    core_.Discard(NameKind::Program, program.name);
    return true;
  });
}

}  // namespace rhi_gl

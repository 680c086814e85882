#include "programs.h"

#include <vector>

#include "core.h"
#include "shaders.h"

namespace rhi_gl {

namespace {

GLenum StageEnum(Stage stage) {
  switch (stage) {
    case Stage::Vertex: return GL_VERTEX_SHADER;
    case Stage::Geometry: return GL_GEOMETRY_SHADER;
    case Stage::Pixel: return GL_FRAGMENT_SHADER;
    case Stage::Compute: return GL_COMPUTE_SHADER;
  }
  return GL_VERTEX_SHADER;
}

// The macro of the last stage goes behind the #version line, which must be the first.
GLuint CompileShader(Stage stage, const char* glsl, bool lastStage, std::string* log) {
  const GLuint name = glCreateShader(StageEnum(stage));
  const std::string text(glsl);
  const size_t body = text.find('\n') + 1;
  const std::string source =
      lastStage ? text.substr(0, body) + "#define " + rhi::kGlLastStageMacro + "\n" + text.substr(body) : text;
  const char* const begin = source.c_str();
  glShaderSource(name, 1, &begin, nullptr);
  glCompileShader(name);
  GLint compiled = GL_FALSE, length = 0;
  glGetShaderiv(name, GL_COMPILE_STATUS, &compiled);
  if (compiled) return name;
  glGetShaderiv(name, GL_INFO_LOG_LENGTH, &length);
  log->resize(size_t(std::max(length, 1)));
  glGetShaderInfoLog(name, GLsizei(log->size()), nullptr, log->data());
  glDeleteShader(name);
  return 0;
}

}  // namespace

GLuint LinkProgram(std::initializer_list<GLuint> shaders, std::string* log) {
  const GLuint name = glCreateProgram();
  for (GLuint s : shaders)
    if (s) glAttachShader(name, s);
  glLinkProgram(name);
  for (GLuint s : shaders)
    if (s) glDetachShader(name, s);
  GLint linked = GL_FALSE, length = 0;
  glGetProgramiv(name, GL_LINK_STATUS, &linked);
  if (linked) return name;
  glGetProgramiv(name, GL_INFO_LOG_LENGTH, &length);
  log->resize(size_t(std::max(length, 1)));
  glGetProgramInfoLog(name, GLsizei(log->size()), nullptr, log->data());
  glDeleteProgram(name);
  return 0;
}

const ShaderCode* ProgramCache::Compile(Stage stage, const char* glsl, bool lastStage, std::string* log) {
  const std::string key = char('0' + int(stage) * 2 + lastStage) + std::string(glsl);
  if (const auto found = codes_.find(key); found != codes_.end()) return &found->second;
  ShaderCode code;
  code.shader = CompileShader(stage, glsl, lastStage, log);
  if (code.shader == 0) return nullptr;
  if (stage == Stage::Compute && (code.computeProgram = LinkProgram({code.shader}, log)) == 0) {
    glDeleteShader(code.shader);
    return nullptr;
  }
  code.uid = core_.NewUid();
  return &codes_.emplace(key, code).first->second;
}

const Program& ProgramCache::Get(const Shader* vs, const Shader* gs, const Shader* ps, uint64_t* misses) {
  const Key key{vs->code->uid, gs ? gs->code->uid : 0, ps ? ps->code->uid : 0};
  const Recent& recent = recent_[(key[0] + key[1] + key[2]) % recent_.size()];
  if (recent.key[0] != key[0] || recent.key[1] != key[1] || recent.key[2] != key[2]) [[unlikely]]
    return Find(key, vs, gs, ps, misses);
  return *recent.program;
}

const Program& ProgramCache::Find(const Key& key, const Shader* vs, const Shader* gs, const Shader* ps,
                                  uint64_t* misses) {
  auto found = made_.find(key);
  if (found == made_.end()) {
    ++*misses;
    found = made_.emplace(key, Make(vs, gs, ps)).first;
  }
  recent_[(key[0] + key[1] + key[2]) % recent_.size()] = {key, &found->second};
  return found->second;
}

Program ProgramCache::Make(const Shader* vs, const Shader* gs, const Shader* ps) {
  std::string why;
  Program p;
  p.uid = core_.NewUid();
  p.usesVertexId = vs->reflection.usesVertexId;
  p.readsResources = vs->readsResources || (gs && gs->readsResources) || (ps && ps->readsResources);
  const ShaderCode* vertexCode = gs ? Compile(Stage::Vertex, vs->glsl, false, &why) : vs->code;
  p.name =
      LinkProgram({vertexCode ? vertexCode->shader : 0, gs ? gs->code->shader : 0, ps ? ps->code->shader : 0}, &why);
  if (p.name == 0 && core_.Alive())
    core_.log.Report(Severity::Error, MsgCode::ShaderRejected, vs->Name().c_str(),
                     "the driver cannot link %s, %s and %s: %s", vs->Name().c_str(), gs ? gs->Name().c_str() : "no GS",
                     ps ? ps->Name().c_str() : "no PS", why.c_str());
  return p;
}

}  // namespace rhi_gl

#include "shaders.h"

#include <algorithm>

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

bool IsWritable(const ShaderResource& r) {
  return r.kind == ShaderResourceKind::RWTexture || r.kind == ShaderResourceKind::RWStructuredBuffer;
}

bool BySlot(const ShaderResource* a, const ShaderResource* b) { return a->slot < b->slot; }

const ShaderResource* FindTexture(const ShaderReflection& reflection, uint8_t slot) {
  for (const ShaderResource& r : reflection.resources)
    if (r.kind == ShaderResourceKind::Texture && r.slot == slot) return &r;
  return nullptr;
}

std::string CompileLog(GLuint shader) {
  GLint length = 0;
  glGetShaderiv(shader, GL_INFO_LOG_LENGTH, &length);
  std::string log(size_t(std::max(length, 1)), '\0');
  glGetShaderInfoLog(shader, GLsizei(log.size()), nullptr, log.data());
  return log;
}

Status Reject(const Core& core, const char* name, const char* what, const char* why) {
  core.log.Report(Severity::Error, MsgCode::ShaderRejected, name, "%s: %s", what, why);
  return Status::CompileFailed;
}

}  // namespace

Status Shader::Create(const CorePtr& core, const ShaderBlob& blob, Ref<IShader>* out) {
  if (!blob.glsl || !*blob.glsl) {
    Reject(*core, blob.name, "the shader has no GLSL", "compile it with the GL target");
    return Status::InvalidArg;
  }
  core->Enter();
  auto shader = Ref<Shader>::Adopt(new Shader(core, blob));
  shader->SetName(blob.name);
  if (!shader->SortResources())
    return Reject(*core, blob.name, "its tables break the contract of rhi/shader.h",
                  "more pairs or structured buffers than GL has places for, or a pair without its texture");
  if (Status s = shader->Compile(blob); s != Status::Ok) return s;
  if (blob.stage == Stage::Compute)
    if (Status s = shader->LinkCompute(blob); s != Status::Ok) return s;
  *out = shader;
  return Status::Ok;
}

Shader::~Shader() {
  core_->programs.Forget(uid);
  core_->Discard(NameKind::Shader, name);
  core_->Discard(NameKind::Program, computeProgram);
}

bool Shader::SortResources() {
  for (const ShaderTexturePair& pair : reflection.pairs) pairs.push_back(FindTexture(reflection, pair.texture));
  for (const ShaderResource& r : reflection.resources) {
    if (r.kind == ShaderResourceKind::StructuredBuffer) storage.push_back(&r);
    if (IsWritable(r)) writable.push_back(&r);
  }
  std::sort(storage.begin(), storage.end(), BySlot);
  for (const ShaderInput& input : reflection.inputs) inputMask |= 1u << input.location;
  const bool complete = std::find(pairs.begin(), pairs.end(), nullptr) == pairs.end();
  return complete && pairs.size() <= kMaxShaderResources && storage.size() <= kGlMaxBuffers[size_t(stage)];
}

Status Shader::Compile(const ShaderBlob& blob) {
  name = glCreateShader(StageEnum(stage));
  uid = core_->NewUid();
  glShaderSource(name, 1, &blob.glsl, nullptr);
  glCompileShader(name);
  core_->Label(GL_SHADER, name, blob.name);
  GLint compiled = GL_FALSE;
  glGetShaderiv(name, GL_COMPILE_STATUS, &compiled);
  if (compiled) return Status::Ok;
  return Reject(*core_, blob.name, "the driver cannot compile it", CompileLog(name).c_str());
}

Status Shader::LinkCompute(const ShaderBlob& blob) {
  std::string why;
  computeProgram = LinkProgram({this}, &why);
  computeUid = core_->NewUid();
  return computeProgram ? Status::Ok : Reject(*core_, blob.name, "the driver cannot link it", why.c_str());
}

}  // namespace rhi_gl

#include "shaders.h"

#include <algorithm>

namespace rhi_gl {
namespace {

bool IsWritable(const ShaderResource& r) {
  return r.kind == ShaderResourceKind::RWTexture || r.kind == ShaderResourceKind::RWStructuredBuffer;
}

bool BySlot(const ShaderResource* a, const ShaderResource* b) { return a->slot < b->slot; }

const ShaderResource* FindTexture(const ShaderReflection& reflection, uint8_t slot) {
  for (const ShaderResource& r : reflection.resources)
    if (r.kind == ShaderResourceKind::Texture && r.slot == slot) return &r;
  return nullptr;
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
  auto shader = Ref<Shader>::Adopt(new Shader(core, blob));
  shader->SetName(blob.name);
  if (!shader->SortResources())
    return Reject(*core, blob.name, "its tables break the contract of rhi/shader.h",
                  "more pairs or structured buffers than GL has places for, or a pair without its texture");
  std::string why;
  shader->code = core->programs.Compile(blob.stage, blob.glsl, blob.stage == Stage::Vertex, &why);
  if (!shader->code && !core->Alive()) return Status::DeviceLost;
  if (!shader->code) return Reject(*core, blob.name, "the driver cannot compile or link it", why.c_str());
  core->Label(GL_SHADER, shader->code->shader, blob.name);
  *out = shader;
  return Status::Ok;
}

bool Shader::SortResources() {
  for (const ShaderTexturePair& pair : reflection.pairs) pairs.push_back(FindTexture(reflection, pair.texture));
  for (const ShaderResource& r : reflection.resources) {
    if (r.kind == ShaderResourceKind::StructuredBuffer) storage.push_back(&r);
    if (IsWritable(r)) writable.push_back(&r);
  }
  std::sort(storage.begin(), storage.end(), BySlot);
  readsResources = !pairs.empty() || !storage.empty();
  for (const ShaderInput& input : reflection.inputs) inputMask |= 1u << input.location;
  const bool complete = std::find(pairs.begin(), pairs.end(), nullptr) == pairs.end();
  return complete && pairs.size() <= kMaxShaderResources && storage.size() <= kGlMaxBuffers[size_t(stage)];
}

}  // namespace rhi_gl

// Compiled shaders and input layouts.
#pragma once

#include "core.h"

namespace rhi_gl {

using backend::Object;

class Shader final : public Object<IShader> {
 public:
  static Status Create(const CorePtr&, const ShaderBlob&, Ref<IShader>* out);
  Stage GetStage() const override { return stage; }

  const ShaderCode* code = nullptr;
  Stage stage;
  const char* glsl;  // the blob's text, which has static lifetime
  ShaderReflection reflection;
  uint32_t inputMask = 0;                       // vertex: attribute locations
  bool readsResources = false;                  // there are pairs or storage
  std::vector<const ShaderResource*> pairs;     // the texture of each of reflection.pairs
  std::vector<const ShaderResource*> storage;   // structured t registers in the order of their storage blocks
  std::vector<const ShaderResource*> writable;  // u registers

 private:
  Shader(const CorePtr& core, const ShaderBlob& blob)
      : stage(blob.stage), glsl(blob.glsl), reflection(blob.reflection), core_(core) {}
  bool SortResources();

  CorePtr core_;
};

// A vertex array object, and the shadow of what is bound to it: buffers belong to the object, not to the context.
struct VertexArray {
  struct BoundBuffer {
    uint32_t uid = ~0u, offset = 0, stride = 0;
    bool operator==(const BoundBuffer&) const = default;
  };
  GLuint name = 0;
  uint32_t uid = 0;
  uint32_t slotMask = 0;  // vertex buffer slots that are read
  std::array<BoundBuffer, kMaxVertexBuffers> buffers;
  uint32_t indexUid = ~0u;
};

class InputLayout final : public Object<IInputLayout> {
 public:
  static Status Create(const CorePtr&, const InputElement*, uint32_t count, IShader* vs, Ref<IInputLayout>* out);
  ~InputLayout() override;

  VertexArray array;
  uint32_t attributeMask = 0;  // locations that are fed

 private:
  explicit InputLayout(const CorePtr& core) : core_(core) {}
  Status AddElement(const InputElement&, uint32_t location);
  Status CheckElement(const InputElement&) const;

  CorePtr core_;
  std::array<const InputElement*, kMaxVertexBuffers> slotElements_{};  // during Create only
};

}  // namespace rhi_gl

// Compiled shaders by their text, and linked programs by their shaders. Like a pipeline cache they live as long as the
// device: a shader made again from the same text costs neither a compilation nor a link.
#pragma once

#include <epoxy/gl.h>

#include <array>
#include <string>
#include <unordered_map>

#include "rhi/types.h"

namespace rhi_gl {

class Core;
class Shader;

// What GL made of one GLSL text.
struct ShaderCode {
  GLuint shader = 0;
  uint32_t uid = 0;
  GLuint computeProgram = 0;
};

struct Program {
  GLuint name = 0;  // 0: the driver refused to link it; a message said why
  uint32_t uid = 0;
  bool usesVertexId = false, readsResources = false;
};

// Links compiled shaders, of which 0 is none; 0 and the driver's log when it refuses.
GLuint LinkProgram(std::initializer_list<GLuint> shaders, std::string* log);

class ProgramCache {
 public:
  explicit ProgramCache(Core& core) : core_(core) {}
  ProgramCache(const ProgramCache&) = delete;
  ProgramCache& operator=(const ProgramCache&) = delete;

  // `gs` and `ps` may be null. Counts in *misses where it was not there yet. Programs stay where they are.
  const Program& Get(const Shader* vs, const Shader* gs, const Shader* ps, uint64_t* misses);

  // The code of this text, compiled now if it is new; null, and the driver's log, when it refuses. `lastStage`: no
  // other stage stands between a vertex shader and the rasterizer (rhi/shader.h).
  const ShaderCode* Compile(rhi::Stage, const char* glsl, bool lastStage, std::string* log);

 private:
  using Key = std::array<uint32_t, 3>;
  struct Hash {
    size_t operator()(const Key& k) const {
      return size_t(((uint64_t(k[0]) * 0x9E3779B1u + k[1]) * 0x85EBCA77u) ^ (uint64_t(k[2]) * 0xC2B2AE3Du));
    }
  };
  const Program& Find(const Key&, const Shader* vs, const Shader* gs, const Shader* ps, uint64_t* misses);
  Program Make(const Shader* vs, const Shader* gs, const Shader* ps);

  Core& core_;
  std::unordered_map<std::string, ShaderCode> codes_;  // by stage and text
  std::unordered_map<Key, Program, Hash> made_;
  // What was asked for last, by a few bits of the key: a frame's programs are few, and asked for by turns.
  struct Recent {
    Key key{};
    const Program* program = nullptr;
  };
  std::array<Recent, 64> recent_;
};

}  // namespace rhi_gl

#include "spirv_to_glsl.h"

#include <algorithm>
#include <spirv_glsl.hpp>

#include "error.h"
#include "options.h"

namespace shaderc {
namespace {

constexpr uint32_t kMaxPairs = 16;  // units of one stage

class GlslCompiler : public spirv_cross::CompilerGLSL {
 public:
  using CompilerGLSL::CompilerGLSL;

 protected:
  // gl_BaseVertexARB is 0 in draws without an index buffer, whose gl_VertexID starts at the first vertex.
  std::string builtin_to_glsl(spv::BuiltIn builtIn, spv::StorageClass storage) override {
    const std::string text = CompilerGLSL::builtin_to_glsl(builtIn, storage);
    return builtIn == spv::BuiltInBaseVertex ? "(" + text + " + rhi_FirstVertex)" : text;
  }
};

constexpr const char* kFlip = "gl_Position.y = -gl_Position.y;";  // what SPIRV-Cross writes for flip_vert_y

void SetOptions(GlslCompiler& c) {
  spirv_cross::CompilerGLSL::Options o;
  o.version = 450;
  o.vertex.flip_vert_y = true;
  o.vertex.support_nonzero_base_instance = false;
  // A loop's phi is declared before it and set in its body, but read in the for statement, which Mesa takes for a read of
  // something uninitialised; it says so only while its own shader cache is cold.
  o.force_zero_initialized_variables = true;
  c.set_common_options(o);
}

// Names with the stage in them: GL matches the blocks and samplers of a program's stages by name and then insists that
// layouts and bindings agree.
class Binder {
 public:
  Binder(GlslCompiler& c, Reflection& r, rhi::Stage stage) : c_(c), r_(r), stage_(stage), prefix_(StagePrefix(stage)) {}

  void Run() {
    for (const ConstantBuffer& b : r_.constantBuffers) BindBlock(b.id, b.slot, 'b', b.slot, b.name);
    uint32_t structured = 0;
    for (const Resource& r : r_.resources) BindResource(r, structured);
    if (structured > rhi::kGlMaxBuffers[size_t(stage_)])
      throw CompileError("too many structured buffers: " + std::to_string(structured) + ", at most " +
                         std::to_string(rhi::kGlMaxBuffers[size_t(stage_)]) + " in this stage");
    BindPairs();
  }

 private:
  std::string NameOf(char letter, uint32_t slot, const std::string& name) const {
    return prefix_ + "_" + letter + std::to_string(slot) + "_" + name;
  }
  void BindBlock(uint32_t id, uint32_t binding, char letter, uint32_t slot, const std::string& name) {
    c_.set_decoration(id, spv::DecorationBinding, binding);
    c_.set_name(c_.get_type_from_variable(id).self, NameOf(letter, slot, name) + "Block");
    c_.set_name(id, NameOf(letter, slot, name));
  }
  void BindResource(const Resource& r, uint32_t& structured) {
    const size_t s = size_t(stage_);
    switch (r.kind) {
      case rhi::ShaderResourceKind::Texture: return;  // by BindPairs
      case rhi::ShaderResourceKind::StructuredBuffer:
        return BindBlock(r.id, rhi::kGlBufferBase[s] + structured++, 't', r.slot, r.name);
      case rhi::ShaderResourceKind::RWStructuredBuffer:
        return BindBlock(r.id, rhi::kGlUavBufferBase + r.slot, 'u', r.slot, r.name);
      case rhi::ShaderResourceKind::RWTexture:
        c_.set_decoration(r.id, spv::DecorationBinding, r.slot);
        c_.set_name(r.id, NameOf('u', r.slot, r.name));
    }
  }

  struct Pair {
    rhi::ShaderTexturePair slots;
    uint32_t id;
  };
  template <class List>
  static uint8_t SlotOf(const List& list, uint32_t id, uint8_t other) {
    for (const auto& x : list)
      if (x.id == id) return x.slot;
    return other;
  }
  std::vector<Pair> FindPairs() {
    std::vector<Pair> pairs;
    for (const auto& p : c_.get_combined_image_samplers())
      pairs.push_back(
          {{SlotOf(r_.resources, p.image_id, 0), SlotOf(r_.samplers, p.sampler_id, rhi::kNoSampler)}, p.combined_id});
    std::sort(pairs.begin(), pairs.end(), [](const Pair& a, const Pair& b) {
      return std::pair(a.slots.texture, a.slots.sampler) < std::pair(b.slots.texture, b.slots.sampler);
    });
    return pairs;
  }
  void BindPairs() {
    const std::vector<Pair> pairs = FindPairs();
    if (pairs.size() > kMaxPairs)
      throw CompileError("too many pairs of a texture and a sampler: " + std::to_string(pairs.size()) + ", at most 16");
    for (uint32_t i = 0; i < pairs.size(); ++i) {
      const auto [texture, sampler] = pairs[i].slots;
      const std::string suffix = sampler == rhi::kNoSampler ? "_load" : "_s" + std::to_string(sampler);
      c_.set_name(pairs[i].id, prefix_ + "_t" + std::to_string(texture) + suffix);
      c_.set_decoration(pairs[i].id, spv::DecorationBinding, rhi::kGlUnitBase[size_t(stage_)] + i);
      r_.pairs.push_back(pairs[i].slots);
    }
  }

  GlslCompiler& c_;
  Reflection& r_;
  rhi::Stage stage_;
  std::string prefix_;
};

bool ReadsBaseVertex(const GlslCompiler& c) {
  const auto inputs = c.get_shader_resources().builtin_inputs;
  return std::any_of(inputs.begin(), inputs.end(), [](const auto& r) { return r.builtin == spv::BuiltInBaseVertex; });
}

void ReplaceAll(std::string& text, const std::string& what, const std::string& with) {
  for (size_t at = text.find(what); at != std::string::npos; at = text.find(what, at + with.size()))
    text.replace(at, what.size(), with);
}

// Row 0 is the top: the last stage before the rasterizer turns the picture over (docs/rhi.md). A vertex shader is the
// last one only without a geometry shader, which the backend says by a macro when it compiles.
void FlipLastStage(std::string& source, rhi::Stage stage) {
  if (stage == rhi::Stage::Geometry) ReplaceAll(source, "EmitVertex();", std::string(kFlip) + "\n    EmitVertex();");
  if (stage == rhi::Stage::Vertex)
    ReplaceAll(source, kFlip, "\n#ifdef " + std::string(rhi::kGlLastStageMacro) + "\n    " + kFlip + "\n#endif");
}

GlslResult Translate(const std::vector<uint32_t>& words, rhi::Stage stage) {
  GlslCompiler c(words);
  GlslResult result;
  result.reflection = Reflect(c, stage);
  SetOptions(c);
  if (ReadsBaseVertex(c))
    c.add_header_line("layout(std140, binding = " + std::to_string(rhi::kGlDrawParametersBlock) +
                      ") uniform rhi_DrawParameters { int rhi_FirstVertex; };");
  c.build_dummy_sampler_for_combined_images();
  c.build_combined_image_samplers();
  Binder(c, result.reflection, stage).Run();
  result.source = c.compile();
  FlipLastStage(result.source, stage);
  return result;
}

}  // namespace

GlslResult SpirvToGlsl(const std::vector<uint32_t>& words, rhi::Stage stage) {
  try {
    return Translate(words, stage);
  } catch (const spirv_cross::CompilerError& e) {
    throw CompileError(std::string("GLSL cannot express this shader: ") + e.what());
  }
}

}  // namespace shaderc

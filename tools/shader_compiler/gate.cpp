#include "gate.h"

#include <GLSL.std.450.h>

#include <algorithm>
#include <set>

namespace shaderc {
namespace {

constexpr const char* kExplicit =
    " sums in an order that differs between drivers; spell the sum out (see the shader helpers, e.g. "
    "(a.x*b.x + a.y*b.y) + a.z*b.z)";

const char* RefusedOp(spv::Op op) {
  switch (op) {
    case spv::OpDot: return "dot() or mul() of vectors";
    case spv::OpMatrixTimesVector:
    case spv::OpVectorTimesMatrix: return "mul() of a matrix and a vector";
    case spv::OpMatrixTimesMatrix: return "mul() of matrices";
    default: return nullptr;
  }
}

const char* RefusedExt(uint32_t op) {
  switch (op) {
    case GLSLstd450Normalize: return "normalize()";
    case GLSLstd450Length: return "length()";
    case GLSLstd450Distance: return "distance()";
    case GLSLstd450Reflect: return "reflect()";
    case GLSLstd450Refract: return "refract()";
    case GLSLstd450FMix: return "lerp()";
    case GLSLstd450SmoothStep: return "smoothstep()";
    case GLSLstd450FaceForward: return "faceforward()";
    case GLSLstd450Cross: return "cross()";
    case GLSLstd450Determinant: return "determinant()";
    case GLSLstd450MatrixInverse: return "the inverse of a matrix";
    default: return nullptr;
  }
}

void AddSums(const Module& module, std::vector<Problem>& problems) {
  const std::vector<Where> places = module.Places();
  for (size_t i = 0; i < module.code.size(); ++i) {
    const Instruction& in = module.code[i];
    const char* what = in.op == spv::OpExtInst ? RefusedExt(in.words[3]) : RefusedOp(in.op);
    if (what) problems.emplace_back(places[i], std::string(what) + kExplicit);
  }
}

// glslang puts every hidden counter of Append, Consume and IncrementCounter at the same binding.
void AddCounters(const Module& module, std::vector<Problem>& problems) {
  for (const auto& [id, name] : module.Names()) {
    const size_t at = name.find("@count");
    if (at == std::string::npos || !module.FindVariable(id)) continue;
    const std::string text = "'" + name.substr(0, at) +
                             "' uses a hidden counter (Append, Consume, IncrementCounter, DecrementCounter); keep the "
                             "count in a buffer of your own";
    problems.emplace_back(Where{}, text);
  }
}

// Follows SV_Position from its variable to the values loaded from it.
class PositionReads {
 public:
  explicit PositionReads(uint32_t variable) : pointers_{variable} {}

  // True when `i` reads w, or passes on the whole vector so that w can no longer be told apart.
  bool Refused(const Instruction& i) {
    const auto& w = i.words;
    switch (i.op) {
      case spv::OpLoad:
        if (pointers_.contains(w[2])) loaded_.insert(w[1]);
        return false;
      case spv::OpAccessChain:
      case spv::OpInBoundsAccessChain: return pointers_.contains(w[2]) && !NotW(w[3]);
      case spv::OpCompositeExtract: return loaded_.contains(w[2]) && w[3] == 3;
      case spv::OpVectorShuffle: return ShuffleTakesW(w);
      case spv::OpStore: return loaded_.contains(w[1]);
      case spv::OpCompositeInsert: return loaded_.contains(w[2]);
      case spv::OpExtInst: return AnyLoaded(w, 4);
      default: return i.words.size() > 2 && AnyLoaded(w, 2);
    }
  }
  void NoteConstant(const Instruction& i) {
    if (i.op == spv::OpConstant && i.words.size() == 3 && i.words[2] < 3) notW_.insert(i.words[1]);
  }

 private:
  bool NotW(uint32_t index) const { return notW_.contains(index); }
  bool AnyLoaded(const std::vector<uint32_t>& w, size_t first) const {
    return std::any_of(w.begin() + ptrdiff_t(std::min(first, w.size())), w.end(),
                       [this](uint32_t id) { return loaded_.contains(id); });
  }
  bool ShuffleTakesW(const std::vector<uint32_t>& w) const {
    for (size_t i = 4; i < w.size(); ++i) {
      if (loaded_.contains(w[2]) && w[i] == 3) return true;
      if (!loaded_.contains(w[3])) continue;
      // The second vector's components start after the first's; unless both are the position, we do not know where.
      if (loaded_.contains(w[2]) ? w[i] == 7 : w[i] >= 5) return true;
    }
    return false;
  }
  std::set<uint32_t> pointers_, loaded_, notW_;
};

void AddPositionW(const Module& module, std::vector<Problem>& problems) {
  const auto variable = module.FindBuiltIn(spv::BuiltInFragCoord);
  if (!variable) return;
  PositionReads reads(*variable);
  const std::vector<Where> places = module.Places();
  bool inFunction = false;
  for (size_t i = 0; i < module.code.size(); ++i) {
    reads.NoteConstant(module.code[i]);
    inFunction = inFunction || module.code[i].op == spv::OpFunction;
    if (inFunction && module.code[i].op != spv::OpLine && reads.Refused(module.code[i]))
      problems.emplace_back(places[i],
                            "reads SV_Position.w, or the whole of SV_Position, in a pixel shader: w is 1/w here; "
                            "read .xyz, or pass w in a TEXCOORD");
  }
}

}  // namespace

void GateSource(const Module& module) {
  std::vector<Problem> problems;
  AddSums(module, problems);
  AddCounters(module, problems);
  ThrowIfAny(std::move(problems));
}

void GateOptimized(const Module& module, rhi::Stage stage) {
  std::vector<Problem> problems;
  AddSums(module, problems);
  if (stage == rhi::Stage::Pixel) AddPositionW(module, problems);
  if (stage == rhi::Stage::Vertex && module.FindBuiltIn(spv::BuiltInLayer))
    problems.emplace_back(Where{}, "SV_RenderTargetArrayIndex can be written in a geometry shader only");
  ThrowIfAny(std::move(problems));
}

bool ReadsUndefined(const Module& module) {
  return std::any_of(module.code.begin(), module.code.end(), [](const Instruction& i) { return i.op == spv::OpUndef; });
}

}  // namespace shaderc

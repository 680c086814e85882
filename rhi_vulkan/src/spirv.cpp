#include "spirv.h"

#include <cstring>
#include <map>

namespace rhi_vulkan {
namespace {

enum Op : uint32_t {
  OpExtension = 10,
  OpEntryPoint = 15,
  OpCapability = 17,
  OpTypeVoid = 19,
  OpTypeFloat = 22,
  OpTypePointer = 32,
  OpConstant = 43,
  OpConstantNull = 46,
  OpFunction = 54,
  OpFunctionEnd = 56,
  OpVariable = 59,
  OpStore = 62,
  OpDecorate = 71,
  OpLabel = 248
};
constexpr uint32_t kStorageOutput = 3, kDecorationBuiltIn = 11, kDecorationLocation = 30, kBuiltInPointSize = 1;
constexpr uint32_t kCapabilityDrawParameters = 4427, kBuiltInBaseVertex = 4424, kBuiltInDrawIndex = 4426;
constexpr uint32_t kStoragePrivate = 6;

// Calls f(opcode, words, count) for each instruction.
template <class F>
void ForEach(const Array<uint32_t>& spirv, F f) {
  for (uint32_t i = kSpirvHeaderWords; i < spirv.size;) {
    const uint32_t count = spirv[i] >> 16;
    if (count == 0 || count > spirv.size - i) return;
    f(spirv[i] & 0xFFFF, spirv.data + i, count);
    i += count;
  }
}

void Emit(std::vector<uint32_t>& out, uint32_t op, std::initializer_list<uint32_t> words) {
  out.push_back(uint32_t(words.size() + 1) << 16 | op);
  out.insert(out.end(), words);
}

// What WithPointSize must know before it writes.
struct VertexModule {
  uint32_t floatType = 0, entry = 0;
  bool hasPointSize = false;
};

VertexModule Survey(const Array<uint32_t>& spirv) {
  VertexModule m;
  ForEach(spirv, [&](uint32_t op, const uint32_t* w, uint32_t count) {
    if (op == OpEntryPoint && count > 3) m.entry = w[2];
    if (op == OpTypeFloat && count > 2 && w[2] == 32) m.floatType = w[1];
    if (op == OpDecorate && count > 3 && w[2] == kDecorationBuiltIn && w[3] == kBuiltInPointSize) m.hasPointSize = true;
  });
  return m;
}

// The variables of BaseVertex and BaseInstance, with the type that each points to.
struct BaseVariables {
  std::vector<uint32_t> ids;
  std::map<uint32_t, uint32_t> pointee;  // of pointer types

  explicit BaseVariables(const Array<uint32_t>& spirv) {
    ForEach(spirv, [&](uint32_t op, const uint32_t* w, uint32_t count) {
      if (op == OpDecorate && count > 3 && w[2] == kDecorationBuiltIn && w[3] >= kBuiltInBaseVertex &&
          w[3] <= kBuiltInDrawIndex)
        ids.push_back(w[1]);
      if (op == OpTypePointer && count > 3) pointee[w[1]] = w[3];
    });
  }
  bool Has(uint32_t id) const { return std::find(ids.begin(), ids.end(), id) != ids.end(); }
};

// The entry point's interface without those variables; they follow the name, which ends with a zero byte.
void EmitEntryPoint(std::vector<uint32_t>& out, const uint32_t* w, uint32_t count, const BaseVariables& bases) {
  uint32_t named = 3;
  while (named < count && (w[named] >> 24) != 0) ++named;
  const size_t start = out.size();
  for (uint32_t i = 0; i < count; ++i)
    if (i <= named || !bases.Has(w[i])) out.push_back(w[i]);
  out[start] = uint32_t(out.size() - start) << 16 | OpEntryPoint;
}

}  // namespace

std::vector<uint32_t> WithoutDrawParameters(const Array<uint32_t>& spirv) {
  const BaseVariables bases(spirv);
  std::vector<uint32_t> out(spirv.data, spirv.data + kSpirvHeaderWords);
  ForEach(spirv, [&](uint32_t op, const uint32_t* w, uint32_t count) {
    if (op == OpCapability && w[1] == kCapabilityDrawParameters) return;
    if (op == OpExtension && std::strcmp(reinterpret_cast<const char*>(w + 1), "SPV_KHR_shader_draw_parameters") == 0)
      return;
    if (op == OpDecorate && bases.Has(w[1])) return;
    if (op == OpEntryPoint) return EmitEntryPoint(out, w, count, bases);
    if (op == OpVariable && bases.Has(w[2])) {
      const uint32_t pointer = out[3]++, null = out[3]++, type = bases.pointee.at(w[1]);
      Emit(out, OpTypePointer, {pointer, kStoragePrivate, type});
      Emit(out, OpConstantNull, {type, null});
      return Emit(out, OpVariable, {pointer, w[2], kStoragePrivate, null});
    }
    out.insert(out.end(), w, w + count);
  });
  return out;
}

// Drivers trust what they are given, so a damaged module must not reach them: the instructions fill the words exactly,
// and the last one ends a function.
bool IsSpirv(const Array<uint32_t>& spirv) {
  if (spirv.size <= kSpirvHeaderWords || spirv[0] != kSpirvMagic) return false;
  uint32_t words = kSpirvHeaderWords, last = 0;
  bool hasEntry = false;
  ForEach(spirv, [&](uint32_t op, const uint32_t*, uint32_t count) {
    words += count;
    last = op;
    hasEntry = hasEntry || op == OpEntryPoint;
  });
  return words == spirv.size && last == OpFunctionEnd && hasEntry;
}

uint32_t ColorOutputs(const Array<uint32_t>& spirv) {
  std::vector<uint32_t> outputs;
  ForEach(spirv, [&](uint32_t op, const uint32_t* w, uint32_t count) {
    if (op == OpVariable && count >= 4 && w[3] == kStorageOutput) outputs.push_back(w[2]);
  });
  uint32_t mask = 0;
  ForEach(spirv, [&](uint32_t op, const uint32_t* w, uint32_t count) {
    if (op != OpDecorate || count < 4 || w[2] != kDecorationLocation || w[3] >= kMaxRenderTargets) return;
    if (std::find(outputs.begin(), outputs.end(), w[1]) != outputs.end()) mask |= 1u << w[3];
  });
  return mask;
}

std::vector<uint32_t> WithPointSize(const Array<uint32_t>& spirv) {
  const VertexModule m = Survey(spirv);
  std::vector<uint32_t> out(spirv.data, spirv.data + kSpirvHeaderWords);
  const bool patch = m.floatType && m.entry && !m.hasPointSize;
  const uint32_t variable = out[3], pointer = out[3] + 1, one = out[3] + 2;
  if (patch) out[3] += 3;
  bool types = false, functions = false, inEntry = false, storeDue = false;
  ForEach(spirv, [&](uint32_t op, const uint32_t* w, uint32_t count) {
    if (patch && !types && op >= OpTypeVoid && op < OpTypeVoid + 20) {
      types = true;
      Emit(out, OpDecorate, {variable, kDecorationBuiltIn, kBuiltInPointSize});
    }
    if (patch && !functions && op == OpFunction) {
      functions = true;
      Emit(out, OpTypePointer, {pointer, kStorageOutput, m.floatType});
      Emit(out, OpConstant, {m.floatType, one, 0x3F800000});
      Emit(out, OpVariable, {pointer, variable, kStorageOutput});
    }
    if (storeDue && op != OpVariable) {  // a function's variables come first
      storeDue = false;
      Emit(out, OpStore, {variable, one});
    }
    if (op == OpFunction) inEntry = w[2] == m.entry;
    if (patch && op == OpLabel && inEntry) {
      storeDue = true;
      inEntry = false;  // only its first block
    }
    const size_t start = out.size();
    out.insert(out.end(), w, w + count);
    if (!patch || op != OpEntryPoint) return;
    out.push_back(variable);
    out[start] += 1u << 16;
  });
  return out;
}

}  // namespace rhi_vulkan

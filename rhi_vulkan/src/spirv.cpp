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
  OpTypeStruct = 30,
  OpTypePointer = 32,
  OpConstant = 43,
  OpFunction = 54,
  OpFunctionEnd = 56,
  OpVariable = 59,
  OpLoad = 61,
  OpStore = 62,
  OpAccessChain = 65,
  OpDecorate = 71,
  OpMemberDecorate = 72,
  OpIAdd = 128,
  OpIMul = 132,
  OpLabel = 248
};
constexpr uint32_t kStorageUniform = 2, kStorageOutput = 3, kStoragePrivate = 6, kStoragePushConstant = 9;
constexpr uint32_t kDecorationBlock = 2, kDecorationBuiltIn = 11, kDecorationLocation = 30, kDecorationBinding = 33,
                   kDecorationDescriptorSet = 34, kDecorationOffset = 35;
constexpr uint32_t kBuiltInPointSize = 1, kBuiltInBaseVertex = 4424, kBuiltInBaseInstance = 4425;
constexpr uint32_t kCapabilityDrawParameters = 4427;

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

// What is added to a vertex shader: instructions of three places, and ids that are new.
struct Addition {
  uint32_t entry;  // the function that `code` goes to, at its start
  std::vector<uint32_t> annotations, globals, code;

  // Appends the module with the addition; `own` writes an instruction of the module, or leaves it out.
  template <class Own>
  void Insert(const Array<uint32_t>& spirv, std::vector<uint32_t>& out, Own own) const {
    bool types = false, functions = false, inEntry = false, due = false;
    const auto append = [&](const std::vector<uint32_t>& words) { out.insert(out.end(), words.begin(), words.end()); };
    ForEach(spirv, [&](uint32_t op, const uint32_t* w, uint32_t count) {
      if (!std::exchange(types, types || (op >= OpTypeVoid && op <= OpTypePointer)) && types) append(annotations);
      if (!std::exchange(functions, functions || op == OpFunction) && functions) append(globals);
      if (due && op != OpVariable) {  // a function's variables come first
        due = false;
        append(code);
      }
      if (op == OpFunction) inEntry = w[2] == entry;
      if (op == OpLabel && inEntry) {
        due = true;
        inEntry = false;  // only its first block
      }
      own(op, w, count);
    });
  }
};

// What must be known of a vertex shader before it is written.
struct VertexModule {
  uint32_t floatType = 0, entry = 0;
  bool hasPointSize = false;
  uint32_t baseVertex = 0, baseInstance = 0;     // the variables; 0: not there
  std::map<uint32_t, uint32_t> pointee, typeOf;  // of pointer types, of variables

  explicit VertexModule(const Array<uint32_t>& spirv) {
    ForEach(spirv, [&](uint32_t op, const uint32_t* w, uint32_t count) {
      if (op == OpEntryPoint && count > 3) entry = w[2];
      if (op == OpTypeFloat && count > 2 && w[2] == 32) floatType = w[1];
      if (op == OpTypePointer && count > 3) pointee[w[1]] = w[3];
      if (op == OpVariable && count > 3) typeOf[w[2]] = w[1];
      if (op != OpDecorate || count < 4 || w[2] != kDecorationBuiltIn) return;
      if (w[3] == kBuiltInPointSize) hasPointSize = true;
      if (w[3] == kBuiltInBaseVertex) baseVertex = w[1];
      if (w[3] == kBuiltInBaseInstance) baseInstance = w[1];
    });
  }
  bool IsBase(uint32_t id) const { return id != 0 && (id == baseVertex || id == baseInstance); }
  uint32_t ValueType(uint32_t variable) const { return pointee.at(typeOf.at(variable)); }
};

// The entry point's interface without those variables; they follow the name, which ends with a zero byte.
void EmitEntryPoint(std::vector<uint32_t>& out, const uint32_t* w, uint32_t count, const VertexModule& m) {
  uint32_t named = 3;
  while (named < count && (w[named] >> 24) != 0) ++named;
  const size_t start = out.size();
  for (uint32_t i = 0; i < count; ++i)
    if (i <= named || !m.IsBase(w[i])) out.push_back(w[i]);
  out[start] = uint32_t(out.size() - start) << 16 | OpEntryPoint;
}

// Declares DrawStarts and the block at kStartsBinding, and computes, at the entry's start, the private variables that
// take the place of the built-in ones: pushed + indirect * block, so that no branch and no other type is needed.
class StartsAddition {
 public:
  Addition added;
  uint32_t privatePointer;

  StartsAddition(const VertexModule& m, uint32_t* nextId) : next_(nextId) {
    added.entry = m.entry;
    type_ = m.ValueType(m.baseVertex ? m.baseVertex : m.baseInstance);
    const uint32_t block = Id(), pushPointer = Id(), blockPointer = Id();
    pushed_ = Id();
    copied_ = Id();
    pushMember_ = Id();
    copyMember_ = Id();
    privatePointer = Id();
    Emit(added.annotations, OpDecorate, {block, kDecorationBlock});
    for (uint32_t i = 0; i < 3; ++i) Emit(added.annotations, OpMemberDecorate, {block, i, kDecorationOffset, 4 * i});
    Emit(added.annotations, OpDecorate, {copied_, kDecorationDescriptorSet, kVkConstantSet});
    Emit(added.annotations, OpDecorate, {copied_, kDecorationBinding, kStartsBinding});
    Emit(added.globals, OpTypeStruct, {block, type_, type_, type_});
    Emit(added.globals, OpTypePointer, {pushPointer, kStoragePushConstant, block});
    Emit(added.globals, OpTypePointer, {blockPointer, kStorageUniform, block});
    Emit(added.globals, OpTypePointer, {pushMember_, kStoragePushConstant, type_});
    Emit(added.globals, OpTypePointer, {copyMember_, kStorageUniform, type_});
    Emit(added.globals, OpTypePointer, {privatePointer, kStoragePrivate, type_});
    for (uint32_t i = 0; i < 3; ++i) Emit(added.globals, OpConstant, {type_, index_[i] = Id(), i});
    Emit(added.globals, OpVariable, {pushPointer, pushed_, kStoragePushConstant});
    Emit(added.globals, OpVariable, {blockPointer, copied_, kStorageUniform});
    for (const uint32_t variable : {m.baseVertex, m.baseInstance})
      if (variable) Emit(added.globals, OpVariable, {privatePointer, variable, kStoragePrivate});
    if (m.baseVertex) Compute(m.baseVertex, 0);
    if (m.baseInstance) Compute(m.baseInstance, 1);
  }

 private:
  uint32_t Id() { return (*next_)++; }
  uint32_t Load(uint32_t variable, uint32_t pointer, uint32_t member) {
    const uint32_t place = Id(), value = Id();
    Emit(added.code, OpAccessChain, {pointer, place, variable, index_[member]});
    Emit(added.code, OpLoad, {type_, value, place});
    return value;
  }
  void Compute(uint32_t variable, uint32_t member) {
    const uint32_t direct = Load(pushed_, pushMember_, member), isIndirect = Load(pushed_, pushMember_, 2);
    const uint32_t copied = Load(copied_, copyMember_, member), product = Id(), sum = Id();
    Emit(added.code, OpIMul, {type_, product, copied, isIndirect});
    Emit(added.code, OpIAdd, {type_, sum, direct, product});
    Emit(added.code, OpStore, {variable, sum});
  }

  uint32_t* next_;
  uint32_t type_, pushed_, copied_, pushMember_, copyMember_;
  std::array<uint32_t, 3> index_{};
};

}  // namespace

std::vector<uint32_t> WithoutDrawParameters(const Array<uint32_t>& spirv) {
  const VertexModule m(spirv);
  std::vector<uint32_t> out(spirv.data, spirv.data + kSpirvHeaderWords);
  if (!m.baseVertex && !m.baseInstance) return {spirv.begin(), spirv.end()};
  uint32_t next = out[3];
  const StartsAddition starts(m, &next);
  out[3] = next;
  starts.added.Insert(spirv, out, [&](uint32_t op, const uint32_t* w, uint32_t count) {
    if (op == OpCapability && w[1] == kCapabilityDrawParameters) return;
    if (op == OpExtension && std::strcmp(reinterpret_cast<const char*>(w + 1), "SPV_KHR_shader_draw_parameters") == 0)
      return;
    if (op == OpDecorate && m.IsBase(w[1])) return;
    if (op == OpVariable && m.IsBase(w[2])) return;
    if (op == OpEntryPoint) return EmitEntryPoint(out, w, count, m);
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
  const VertexModule m(spirv);
  if (!m.floatType || !m.entry || m.hasPointSize) return {spirv.begin(), spirv.end()};
  std::vector<uint32_t> out(spirv.data, spirv.data + kSpirvHeaderWords);
  const uint32_t variable = out[3]++, pointer = out[3]++, one = out[3]++;
  Addition added{m.entry, {}, {}, {}};
  Emit(added.annotations, OpDecorate, {variable, kDecorationBuiltIn, kBuiltInPointSize});
  Emit(added.globals, OpTypePointer, {pointer, kStorageOutput, m.floatType});
  Emit(added.globals, OpConstant, {m.floatType, one, 0x3F800000});
  Emit(added.globals, OpVariable, {pointer, variable, kStorageOutput});
  Emit(added.code, OpStore, {variable, one});
  added.Insert(spirv, out, [&](uint32_t op, const uint32_t* w, uint32_t count) {
    const size_t start = out.size();
    out.insert(out.end(), w, w + count);
    if (op != OpEntryPoint) return;
    out.push_back(variable);
    out[start] += 1u << 16;
  });
  return out;
}

}  // namespace rhi_vulkan

// Numbers out of buffers.
#include <algorithm>
#include <cstring>

#include "gltf_internal.h"

namespace fur::gltf {
namespace {

// More would be a mistake or an attack: an accessor without a buffer view may claim any count for free.
constexpr uint64_t kMaxComponents = uint64_t{1} << 26;

size_t ComponentSize(const Document& doc, int accessor, int type) {
  switch (type) {
    case TINYGLTF_COMPONENT_TYPE_BYTE:
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE: return 1;
    case TINYGLTF_COMPONENT_TYPE_SHORT:
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT: return 2;
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT:
    case TINYGLTF_COMPONENT_TYPE_FLOAT: return 4;
    default: doc.Malformed("accessors[", accessor, "].componentType is ", type, ", which is none of glTF's");
  }
}

unsigned ComponentCount(const Document& doc, int accessor) {
  const tinygltf::Accessor& a = doc.model.accessors[accessor];
  switch (a.type) {
    case TINYGLTF_TYPE_SCALAR: return 1;
    case TINYGLTF_TYPE_VEC2: return 2;
    case TINYGLTF_TYPE_VEC3: return 3;
    case TINYGLTF_TYPE_VEC4: return 4;
    case TINYGLTF_TYPE_MAT2: return 4;
    case TINYGLTF_TYPE_MAT3: return 9;
    case TINYGLTF_TYPE_MAT4: return 16;
    default: doc.Malformed("accessors[", accessor, "].type is unknown");
  }
}

// Elements at `data`, `stride` bytes apart. The range lies inside the buffer.
struct Source {
  const uint8_t* data = nullptr;
  size_t stride = 0;
};

Source Locate(const Document& doc, const std::string& what, int view, uint64_t offset, uint64_t count,
              uint64_t elementSize, bool useStride) {
  const tinygltf::BufferView& v = doc.model.bufferViews[view];
  const uint64_t stride = useStride && v.byteStride != 0 ? v.byteStride : elementSize;
  if (stride < elementSize) doc.Malformed(what, ": byteStride ", stride, " is less than an element's ", elementSize);
  const uint64_t end = count == 0 ? offset : offset + stride * (count - 1) + elementSize;
  if (end > v.byteLength) doc.Malformed(what, " needs ", end, " bytes, but bufferViews[", view, "] has ", v.byteLength);
  const std::vector<unsigned char>& bytes = doc.model.buffers[v.buffer].data;
  if (v.byteOffset + v.byteLength > bytes.size()) doc.Malformed("bufferViews[", view, "] is out of its buffer's range");
  return {bytes.data() + v.byteOffset + offset, stride};
}

template <class T>
double Load(const uint8_t* at) {  // any alignment
  T value;
  std::memcpy(&value, at, sizeof value);
  return static_cast<double>(value);
}

double LoadComponent(const uint8_t* at, int type) {
  switch (type) {
    case TINYGLTF_COMPONENT_TYPE_BYTE: return Load<int8_t>(at);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE: return Load<uint8_t>(at);
    case TINYGLTF_COMPONENT_TYPE_SHORT: return Load<int16_t>(at);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT: return Load<uint16_t>(at);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT: return Load<uint32_t>(at);
    default: return Load<float>(at);
  }
}

double Normalize(double value, int type) {  // glTF 2.0, section 3.11
  switch (type) {
    case TINYGLTF_COMPONENT_TYPE_BYTE: return std::max(value / 127.0, -1.0);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE: return value / 255.0;
    case TINYGLTF_COMPONENT_TYPE_SHORT: return std::max(value / 32767.0, -1.0);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT: return value / 65535.0;
    default: return value;
  }
}

struct Located {
  Source base;  // no data: zeros
  Source sparseIndices, sparseValues;
};

Located LocateAll(const Document& doc, int accessor) {
  const tinygltf::Accessor& a = doc.model.accessors[accessor];
  const std::string what = Text("accessors[", accessor, "]");
  const unsigned components = ComponentCount(doc, accessor);
  const size_t elementSize = components * ComponentSize(doc, accessor, a.componentType);
  if (a.count > kMaxComponents / components) doc.Malformed(what, ".count is ", a.count, ", which is too many");
  Located located;
  if (a.bufferView >= 0) located.base = Locate(doc, what, a.bufferView, a.byteOffset, a.count, elementSize, true);
  if (!a.sparse.isSparse) return located;
  const auto& s = a.sparse;
  const uint64_t count = static_cast<uint64_t>(s.count);
  if (count > a.count) doc.Malformed(what, ".sparse.count is ", count, ", more than the accessor's ", a.count);
  const int type = s.indices.componentType;
  if (type != TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE && type != TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT &&
      type != TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT)
    doc.Malformed(what, ".sparse.indices.componentType is ", type, ", expected an unsigned type");
  located.sparseIndices =
      Locate(doc, what + ".sparse.indices", s.indices.bufferView, static_cast<uint64_t>(s.indices.byteOffset), count,
             ComponentSize(doc, accessor, type), false);
  located.sparseValues = Locate(doc, what + ".sparse.values", s.values.bufferView,
                                static_cast<uint64_t>(s.values.byteOffset), count, elementSize, false);
  return located;
}

void LoadElement(const uint8_t* at, size_t componentSize, Numbers* numbers, size_t element) {
  for (unsigned c = 0; c < numbers->components; ++c) {
    const double value = LoadComponent(at + c * componentSize, numbers->componentType);
    numbers->values[element * numbers->components + c] =
        numbers->normalized ? Normalize(value, numbers->componentType) : value;
  }
}

}  // namespace

void CheckAccessor(const Document& doc, int accessor) { LocateAll(doc, accessor); }

Numbers ReadAccessor(const Document& doc, int accessor) {
  const tinygltf::Accessor& a = doc.model.accessors[accessor];
  const Located located = LocateAll(doc, accessor);
  const size_t componentSize = ComponentSize(doc, accessor, a.componentType);
  Numbers numbers{a.count, ComponentCount(doc, accessor), a.componentType, a.normalized, {}};
  numbers.values.assign(a.count * numbers.components, 0.0);
  if (located.base.data != nullptr)
    for (size_t i = 0; i < a.count; ++i)
      LoadElement(located.base.data + i * located.base.stride, componentSize, &numbers, i);
  if (!a.sparse.isSparse) return numbers;
  for (size_t i = 0; i < static_cast<size_t>(a.sparse.count); ++i) {
    const double target =
        LoadComponent(located.sparseIndices.data + i * located.sparseIndices.stride, a.sparse.indices.componentType);
    if (target >= static_cast<double>(a.count))
      doc.Malformed("accessors[", accessor, "].sparse replaces element ", target, " of ", a.count);
    LoadElement(located.sparseValues.data + i * located.sparseValues.stride, componentSize, &numbers,
                static_cast<size_t>(target));
  }
  return numbers;
}

}  // namespace fur::gltf

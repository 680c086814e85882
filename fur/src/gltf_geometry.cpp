// A glTF primitive as triangles.
#include <algorithm>
#include <cmath>

#include "finite.h"
#include "gltf_internal.h"

namespace fur::gltf {
namespace {

// What the attribute may hold. glTF itself is stricter; the integer types are those of KHR_mesh_quantization.
struct Shape {
  unsigned components;
  bool integersMustBeNormalized;
};

class PrimitiveReader {
 public:
  PrimitiveReader(Document& doc, size_t mesh, size_t primitive)
      : doc_(doc),
        source_(doc.model.meshes[mesh].primitives[primitive]),
        what_(Text("meshes[", mesh, "].primitives[", primitive, "]")) {
    const std::string& name = doc.model.meshes[mesh].name;
    draft_.primitive.name = name.empty() ? Text("mesh ", mesh) : name;
    if (doc.model.meshes[mesh].primitives.size() > 1) draft_.primitive.name += Text("/", primitive);
  }

  Draft Read() {
    const std::string& name = draft_.primitive.name;
    if (source_.mode != TINYGLTF_MODE_TRIANGLES && source_.mode != TINYGLTF_MODE_TRIANGLE_STRIP &&
        source_.mode != TINYGLTF_MODE_TRIANGLE_FAN) {
      doc_.Warn(name, ": left out, it has points or lines (mode ", source_.mode, ")");
      return std::move(draft_);
    }
    if (!source_.targets.empty()) doc_.Warn(name, ": morph targets are ignored");
    ReadPositions();
    ReadIndices();
    if (draft_.primitive.indices.empty()) {
      doc_.Warn(name, ": left out, it has no triangles");
      return std::move(draft_);
    }
    ReadNormals();
    ReadTangents();
    ReadUvs();
    ReadJoints();
    return std::move(draft_);
  }

 private:
  Document& doc_;
  const tinygltf::Primitive& source_;
  std::string what_;
  Draft draft_;

  int Find(const std::string& attribute) const {
    const auto it = source_.attributes.find(attribute);
    return it == source_.attributes.end() ? -1 : it->second;
  }

  Numbers Attribute(const std::string& name, int accessor, Shape shape) const {
    Numbers n = ReadAccessor(doc_, accessor);
    const std::string at = Text(what_, ".", name);
    if (n.components != shape.components)
      doc_.Malformed(at, " has ", n.components, " numbers an element, expected ", shape.components);
    if (n.componentType == TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT) doc_.Malformed(at, " has 32-bit integers");
    if (shape.integersMustBeNormalized && n.componentType != TINYGLTF_COMPONENT_TYPE_FLOAT && !n.normalized)
      doc_.Malformed(at, " has integers that are not normalized");
    const size_t vertices = draft_.primitive.vertices.size();
    if (name != "POSITION" && n.count != vertices)
      doc_.Malformed(at, " has ", n.count, " elements, but POSITION has ", vertices);
    return n;
  }

  glm::vec3 Vec3(const Numbers& n, size_t i) const {
    const double* v = &n.values[i * n.components];
    return glm::vec3(v[0], v[1], v[2]);
  }

  void ReadPositions() {
    const int accessor = Find("POSITION");
    if (accessor < 0) doc_.Malformed(what_, " has no POSITION");
    const Numbers n = Attribute("POSITION", accessor, {3, false});
    draft_.primitive.vertices.resize(n.count);
    for (size_t i = 0; i < n.count; ++i) {
      const glm::vec3 p = Vec3(n, i);
      if (!IsFinite(p))
        doc_.Malformed(what_, ".POSITION of vertex ", i, " is not finite");
      draft_.primitive.vertices[i].position = p;
    }
  }

  // The list of vertex numbers, before strips and fans become triangles.
  std::vector<uint32_t> VertexNumbers() const {
    const size_t vertices = draft_.primitive.vertices.size();
    std::vector<uint32_t> list;
    if (source_.indices < 0) {
      list.resize(vertices);
      for (size_t i = 0; i < vertices; ++i) list[i] = static_cast<uint32_t>(i);
      return list;
    }
    const Numbers n = ReadAccessor(doc_, source_.indices);
    const double restart = RestartValue(n);
    list.reserve(n.count);
    for (size_t i = 0; i < n.count; ++i) {
      if (n.values[i] == restart) doc_.Malformed(what_, ".indices[", i, "] is a primitive restart, which glTF forbids");
      if (n.values[i] >= static_cast<double>(vertices))
        doc_.Malformed(what_, ".indices[", i, "] is ", static_cast<uint64_t>(n.values[i]), ", but there are ", vertices,
                       " vertices");
      list.push_back(static_cast<uint32_t>(n.values[i]));
    }
    return list;
  }

  // Checks the type on the way.
  double RestartValue(const Numbers& n) const {
    if (n.components != 1 || n.normalized) doc_.Malformed(what_, ".indices must be plain scalars");
    switch (n.componentType) {
      case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE: return 0xFF;
      case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT: return 0xFFFF;
      case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT: return 0xFFFFFFFF;
      default: doc_.Malformed(what_, ".indices has component type ", n.componentType, ", expected an unsigned integer");
    }
  }

  void ReadIndices() {
    const std::vector<uint32_t> list = VertexNumbers();
    std::vector<uint32_t>& out = draft_.primitive.indices;
    if (source_.mode == TINYGLTF_MODE_TRIANGLES) {
      if (list.size() % 3 != 0) doc_.Malformed(what_, " has ", list.size(), " indices, which is no multiple of 3");
      out = list;
      return;
    }
    const bool fan = source_.mode == TINYGLTF_MODE_TRIANGLE_FAN;
    for (size_t i = 0; i + 2 < list.size(); ++i) {
      // glTF 2.0, section 3.7.2.1: every second triangle of a strip is turned over.
      const size_t odd = i % 2;
      if (fan)
        out.insert(out.end(), {list[i + 1], list[i + 2], list[0]});
      else
        out.insert(out.end(), {list[i], list[i + 1 + odd], list[i + 2 - odd]});
    }
  }

  void ReadNormals() {
    const int accessor = Find("NORMAL");
    if (accessor < 0) return;
    const Numbers n = Attribute("NORMAL", accessor, {3, true});
    for (size_t i = 0; i < n.count; ++i) draft_.primitive.vertices[i].normal = Vec3(n, i);
    draft_.hasNormals = true;
  }

  // Without normals glTF asks to ignore the tangents, because they would not be perpendicular to those that are made.
  void ReadTangents() {
    const int accessor = Find("TANGENT");
    if (accessor < 0 || !draft_.hasNormals) return;
    const Numbers n = Attribute("TANGENT", accessor, {4, true});
    for (size_t i = 0; i < n.count; ++i)
      draft_.primitive.vertices[i].tangent = glm::vec4(Vec3(n, i), n.values[i * 4 + 3] < 0 ? -1.0f : 1.0f);
    draft_.hasTangents = true;
  }

  void ReadUvs() {
    const int accessor = Find("TEXCOORD_0");
    if (accessor < 0) return;
    const Numbers n = Attribute("TEXCOORD_0", accessor, {2, false});
    size_t bad = 0;
    for (size_t i = 0; i < n.count; ++i) {
      const glm::vec2 uv(n.values[i * 2], n.values[i * 2 + 1]);
      const bool finite = std::isfinite(uv.x) && std::isfinite(uv.y);
      draft_.primitive.vertices[i].uv = finite ? uv : glm::vec2(0);
      bad += finite ? 0 : 1;
    }
    if (bad != 0)
      doc_.Warn(draft_.primitive.name, ": ", bad, " texture coordinates are not finite; they are taken as 0");
    draft_.hasUvs = true;
  }

  void ReadJoints() {
    for (int set = 0;; ++set) {
      const std::string joints = Text("JOINTS_", set), weights = Text("WEIGHTS_", set);
      const int j = Find(joints), w = Find(weights);
      if (j < 0 && w < 0) return;
      if (j < 0 || w < 0) doc_.Malformed(what_, " has one of ", joints, " and ", weights, " without the other");
      const Numbers jointNumbers = Attribute(joints, j, {4, false});
      if (jointNumbers.componentType != TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE &&
          jointNumbers.componentType != TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT)
        doc_.Malformed(what_, ".", joints, " must have unsigned 8- or 16-bit integers");
      draft_.joints.push_back(jointNumbers.values);
      draft_.weights.push_back(Attribute(weights, w, {4, true}).values);
    }
  }
};

}  // namespace

Draft ReadPrimitive(Document& doc, size_t mesh, size_t primitive) {
  Draft draft = PrimitiveReader(doc, mesh, primitive).Read();
  const int material = doc.model.meshes[mesh].primitives[primitive].material;
  // The default material stands behind the file's own.
  draft.primitive.material = static_cast<uint32_t>(material < 0 ? doc.model.materials.size() : material);
  return draft;
}

}  // namespace fur::gltf

// The node hierarchy and skins.
#include <algorithm>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/gtc/quaternion.hpp>

#include "finite.h"
#include "gltf_internal.h"

namespace fur::gltf {
namespace {

glm::dmat4 MatrixFrom(std::span<const double> columnMajor) {
  glm::dmat4 m(1);
  for (int i = 0; i < 16; ++i) m[i / 4][i % 4] = columnMajor[i];
  return m;
}

glm::dmat4 LocalTransform(Document& doc, size_t node) {
  const tinygltf::Node& n = doc.model.nodes[node];
  if (!n.matrix.empty()) return MatrixFrom(n.matrix);
  glm::dmat4 m(1);
  if (!n.translation.empty()) m = glm::translate(m, glm::dvec3(n.translation[0], n.translation[1], n.translation[2]));
  if (!n.rotation.empty()) {
    const glm::dquat q(n.rotation[3], n.rotation[0], n.rotation[1], n.rotation[2]);  // w first
    if (glm::length(q) > 0)
      m *= glm::mat4_cast(glm::normalize(q));
    else
      doc.Warn("nodes[", node, "].rotation is zero; it is ignored");
  }
  if (!n.scale.empty()) m = glm::scale(m, glm::dvec3(n.scale[0], n.scale[1], n.scale[2]));
  return m;
}

// Refuses what has two parents, so that the rest is trees and cycles.
std::vector<int> FindParents(const Document& doc) {
  std::vector<int> parents(doc.model.nodes.size(), -1);
  for (size_t i = 0; i < parents.size(); ++i) {
    for (const int child : doc.model.nodes[i].children) {
      if (parents[child] >= 0)
        doc.Malformed("nodes[", child, "] has two parents, nodes[", parents[child], "] and nodes[", i, "]");
      parents[child] = static_cast<int>(i);
    }
  }
  return parents;
}

// Parents come before children. A cycle hangs from no root, so that its nodes are never reached.
std::vector<glm::dmat4> GlobalTransforms(Document& doc, const std::vector<int>& parents) {
  std::vector<glm::dmat4> global(parents.size(), glm::dmat4(1));
  std::vector<bool> reached(parents.size(), false);
  std::vector<size_t> pending;
  for (size_t i = 0; i < parents.size(); ++i)
    if (parents[i] < 0) pending.push_back(i);
  while (!pending.empty()) {
    const size_t node = pending.back();
    pending.pop_back();
    reached[node] = true;
    global[node] = LocalTransform(doc, node);
    if (parents[node] >= 0) global[node] = global[parents[node]] * global[node];
    if (!IsFinite(global[node])) doc.Malformed("the transform of nodes[", node, "] is not finite");
    pending.insert(pending.end(), doc.model.nodes[node].children.begin(), doc.model.nodes[node].children.end());
  }
  const auto lost = std::find(reached.begin(), reached.end(), false);
  if (lost != reached.end()) doc.Malformed("nodes[", lost - reached.begin(), "] is part of a cycle or hangs from one");
  return global;
}

std::vector<int> SceneRoots(const Document& doc, const std::vector<int>& parents) {
  std::vector<int> roots;
  if (doc.model.scenes.empty()) {
    for (size_t i = 0; i < parents.size(); ++i)
      if (parents[i] < 0) roots.push_back(static_cast<int>(i));
    return roots;
  }
  const int scene = std::max(doc.model.defaultScene, 0);
  roots = doc.model.scenes[scene].nodes;
  std::vector<bool> seen(parents.size(), false);
  for (const int root : roots) {
    if (parents[root] >= 0) doc.Malformed("scenes[", scene, "] lists nodes[", root, "], which is not a root");
    if (seen[root]) doc.Malformed("scenes[", scene, "] lists nodes[", root, "] twice");
    seen[root] = true;
  }
  return roots;
}

std::vector<glm::dmat4> JointMatrices(const Document& doc, const Hierarchy& hierarchy, int skin) {
  const tinygltf::Skin& s = doc.model.skins[skin];
  if (s.joints.empty()) doc.Malformed("skins[", skin, "] has no joints");
  std::vector<glm::dmat4> matrices(s.joints.size());
  for (size_t i = 0; i < matrices.size(); ++i) matrices[i] = hierarchy.global[s.joints[i]];
  if (s.inverseBindMatrices < 0) return matrices;
  const Numbers n = ReadAccessor(doc, s.inverseBindMatrices);
  if (n.components != 16 || n.componentType != TINYGLTF_COMPONENT_TYPE_FLOAT ||
      doc.model.accessors[s.inverseBindMatrices].type != TINYGLTF_TYPE_MAT4)
    doc.Malformed("skins[", skin, "].inverseBindMatrices must be 4x4 matrices of floats");
  if (n.count < matrices.size())
    doc.Malformed("skins[", skin, "] has ", matrices.size(), " joints, but ", n.count, " inverse bind matrices");
  for (size_t i = 0; i < matrices.size(); ++i) {
    matrices[i] = matrices[i] * MatrixFrom(std::span(n.values).subspan(i * 16, 16));
    if (!IsFinite(matrices[i])) doc.Malformed("skins[", skin, "]: the matrix of joint ", i, " is not finite");
  }
  return matrices;
}

// Weights should sum to 1; quantized ones do so only nearly.
glm::dmat4 Blend(const Document& doc, const Draft& draft, std::span<const glm::dmat4> joints, size_t vertex) {
  glm::dmat4 sum(0);
  double total = 0;
  for (size_t i = 0; i < 4 * draft.joints.size(); ++i) {
    const size_t slot = vertex * 4 + i % 4;
    const double weight = draft.weights[i / 4][slot];
    const size_t joint = static_cast<size_t>(draft.joints[i / 4][slot]);
    if (joint >= joints.size())
      doc.Malformed(draft.primitive.name, ": vertex ", vertex, " follows joint ", joint, " of ", joints.size());
    if (!std::isfinite(weight) || weight < 0)
      doc.Malformed(draft.primitive.name, ": vertex ", vertex, " has a joint weight that is negative or not finite");
    sum += weight * joints[joint];
    total += weight;
  }
  if (total > 0) return sum / total;
  return joints[static_cast<size_t>(draft.joints[0][vertex * 4])];  // no weight at all: its first joint carries it
}

}  // namespace

Hierarchy ReadHierarchy(Document& doc) {
  const std::vector<int> parents = FindParents(doc);
  Hierarchy hierarchy{GlobalTransforms(doc, parents), {}};
  std::vector<int> pending = SceneRoots(doc, parents);
  std::reverse(pending.begin(), pending.end());
  while (!pending.empty()) {
    const int node = pending.back();
    pending.pop_back();
    const tinygltf::Node& n = doc.model.nodes[node];
    if (n.mesh >= 0)
      hierarchy.placements.push_back(
          {static_cast<size_t>(node), static_cast<size_t>(n.mesh), n.skin, hierarchy.global[node]});
    pending.insert(pending.end(), n.children.rbegin(), n.children.rend());
  }
  return hierarchy;
}

void ApplySkin(Document& doc, const Hierarchy& hierarchy, int skin, Draft* draft) {
  const std::vector<glm::dmat4> joints = JointMatrices(doc, hierarchy, skin);
  std::vector<Vertex>& vertices = draft->primitive.vertices;
  for (size_t i = 0; i < vertices.size(); ++i) {
    const glm::dmat4 m = Blend(doc, *draft, joints, i);
    const glm::dmat3 linear(m);
    Vertex& v = vertices[i];
    v.position = glm::vec3(m * glm::dvec4(glm::dvec3(v.position), 1.0));
    if (!IsFinite(v.position))
      doc.Malformed(draft->primitive.name, ": the skin moves vertex ", i, " out of range");
    // Normals transform by the cofactor matrix: the inverse transpose up to a factor, and defined for singular ones.
    const glm::dmat3 cofactor(glm::cross(linear[1], linear[2]), glm::cross(linear[2], linear[0]),
                              glm::cross(linear[0], linear[1]));
    const double side = glm::determinant(linear) < 0 ? -1.0 : 1.0;
    const glm::dvec3 normal = side * (cofactor * glm::dvec3(v.normal)), tangent = linear * glm::dvec3(v.tangent);
    v.normal = glm::vec3(normal / std::max(glm::length(normal), 1e-300));
    v.tangent =
        glm::vec4(glm::vec3(tangent / std::max(glm::length(tangent), 1e-300)), v.tangent.w * static_cast<float>(side));
  }
}

}  // namespace fur::gltf

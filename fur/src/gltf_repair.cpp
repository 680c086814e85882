// Normals, texture coordinates and tangents that a file lacks or has broken.
#include <algorithm>
#include <array>
#include <cmath>

#include "finite.h"
#include "fur/topology.h"
#include "gltf_internal.h"

namespace fur::gltf {
namespace {

// A zero or non-finite vector stays unusable: false.
bool Normalize(glm::dvec3* v) {
  const double length = glm::length(*v);
  if (!IsFinite(*v) || !(length > 0) || !std::isfinite(length)) return false;
  *v /= length;
  return true;
}

glm::dvec3 AnyPerpendicular(const glm::dvec3& n) {
  // The axis least along n, so that the cross product is never short.
  const glm::dvec3 a = glm::abs(n);
  const glm::dvec3 axis = a.x <= a.y && a.x <= a.z ? glm::dvec3(1, 0, 0)
                          : a.y <= a.z             ? glm::dvec3(0, 1, 0)
                                                   : glm::dvec3(0, 0, 1);
  return glm::normalize(glm::cross(glm::cross(n, axis), n));
}

glm::dvec3 Position(const Primitive& p, uint32_t vertex) { return glm::dvec3(p.vertices[vertex].position); }

// Twice the triangle's area long.
glm::dvec3 FaceNormal(const Primitive& p, size_t triangle) {
  const uint32_t* i = &p.indices[triangle * 3];
  const glm::dvec3 a = Position(p, i[0]);
  return glm::cross(Position(p, i[1]) - a, Position(p, i[2]) - a);
}

// glTF asks for flat normals where a file has none. Fur on flat normals would part along every edge, so that vertices
// at one position share the area-weighted mean instead.
std::vector<glm::dvec3> SmoothNormals(const Primitive& p) {
  const Weld weld = WeldByPosition(p.vertices);
  std::vector<glm::dvec3> shared(weld.representative.size(), glm::dvec3(0)), own(p.vertices.size(), glm::dvec3(0));
  for (size_t i = 0; i < p.indices.size(); ++i) {
    const glm::dvec3 face = FaceNormal(p, i / 3);
    shared[weld.welded[p.indices[i]]] += face;
    own[p.indices[i]] += face;
  }
  for (size_t i = 0; i < own.size(); ++i) {
    glm::dvec3 normal = shared[weld.welded[i]];
    // Two sheets back to back cancel out; then each vertex keeps its own side's normal.
    const bool cancelled = glm::length(normal) <= 1e-6 * glm::length(own[i]);
    if (cancelled || !Normalize(&normal)) normal = own[i];
    own[i] = Normalize(&normal) ? normal : glm::dvec3(0, 1, 0);  // a vertex of degenerate triangles only
  }
  return own;
}

void CompleteNormals(Document& doc, Draft* draft) {
  Primitive& p = draft->primitive;
  std::vector<glm::dvec3> made;
  size_t bad = 0;
  for (size_t i = 0; i < p.vertices.size(); ++i) {
    glm::dvec3 normal(p.vertices[i].normal);
    if (!draft->hasNormals || !Normalize(&normal)) {
      if (made.empty()) made = SmoothNormals(p);
      normal = made[i];
      ++bad;
    }
    p.vertices[i].normal = glm::vec3(normal);
  }
  if (draft->hasNormals && bad != 0)
    doc.Warn(p.name, ": ", bad, " of ", p.vertices.size(), " normals are zero or not finite; they were made anew");
}

// 0..5: +x -x +y -y +z -z, the axis nearest to the triangle's normal.
int DominantAxis(const glm::dvec3& n) {
  const glm::dvec3 a = glm::abs(n);
  const int axis = a.x >= a.y && a.x >= a.z ? 0 : a.y >= a.z ? 1 : 2;
  return axis * 2 + (n[axis] < 0 ? 1 : 0);
}

// Seen from outside, u grows to the right and v downwards on every side of the box: no side is mirrored.
glm::dvec2 BoxUv(const glm::dvec3& p, int side) {
  switch (side) {
    case 0: return {-p.z, -p.y};
    case 1: return {p.z, -p.y};
    case 2: return {p.x, p.z};
    case 3: return {p.x, -p.z};
    case 4: return {p.x, -p.y};
    default: return {-p.x, -p.y};
  }
}

// Projects each triangle along the axis nearest to its normal: no triangle is stretched by more than sqrt(3). Vertices
// are split where sides meet, so that no triangle spans two of them. The model's diameter maps to 1.
void MakeBoxUvs(double diameter, Draft* draft) {
  Primitive& p = draft->primitive;
  const double scale = draft->unitScale / diameter;
  constexpr uint32_t kNone = ~0u;
  std::vector<std::array<uint32_t, 6>> copies(p.vertices.size());
  for (auto& c : copies) c.fill(kNone);
  std::vector<Vertex> vertices;
  vertices.reserve(p.vertices.size());
  for (size_t i = 0; i < p.indices.size(); i += 3) {
    const int side = DominantAxis(FaceNormal(p, i / 3));  // from the old vertices, which stay until the end
    for (size_t corner = i; corner < i + 3; ++corner) {
      const uint32_t old = p.indices[corner];
      uint32_t& copy = copies[old][static_cast<size_t>(side)];
      if (copy == kNone) {
        copy = static_cast<uint32_t>(vertices.size());
        vertices.push_back(p.vertices[old]);
        vertices.back().uv = glm::vec2(BoxUv(glm::dvec3(vertices.back().position), side) * scale);
      }
      p.indices[corner] = copy;
    }
  }
  p.vertices = std::move(vertices);
}

struct Frame {
  glm::dvec3 u{0}, v{0};  // directions in which u and v grow
};

// The gradients of u and v over a triangle, times twice its area in UV space, so that large triangles weigh more.
Frame TriangleFrame(const Primitive& p, const uint32_t* i) {
  const glm::dvec3 e1 = Position(p, i[1]) - Position(p, i[0]), e2 = Position(p, i[2]) - Position(p, i[0]);
  const glm::dvec2 uv0(p.vertices[i[0]].uv);
  const glm::dvec2 d1 = glm::dvec2(p.vertices[i[1]].uv) - uv0, d2 = glm::dvec2(p.vertices[i[2]].uv) - uv0;
  const double side = d1.x * d2.y - d1.y * d2.x < 0 ? -1.0 : 1.0;
  Frame frame{side * (e1 * d2.y - e2 * d1.y), side * (e2 * d1.x - e1 * d2.x)};
  // The direction counts, not how finely the texture lies there.
  const double area = glm::length(glm::cross(e1, e2));
  const bool ok = d1.x * d2.y != d1.y * d2.x && Normalize(&frame.u) && Normalize(&frame.v);
  return ok ? Frame{frame.u * area, frame.v * area} : Frame{};
}

// The least of MikkTSpace's rules: tangents are averaged for each vertex as the file splits it and made perpendicular
// to the normal. Vertices that mirrored and unmirrored triangles share are not split; the larger side decides.
void MakeTangents(Draft* draft) {
  Primitive& p = draft->primitive;
  std::vector<Frame> frames(p.vertices.size());
  for (size_t i = 0; i < p.indices.size(); i += 3) {
    const Frame frame = TriangleFrame(p, &p.indices[i]);
    for (size_t corner = i; corner < i + 3; ++corner) {
      frames[p.indices[corner]].u += frame.u;
      frames[p.indices[corner]].v += frame.v;
    }
  }
  for (size_t i = 0; i < frames.size(); ++i) {
    const glm::dvec3 n(p.vertices[i].normal);
    glm::dvec3 t = frames[i].u - n * glm::dot(n, frames[i].u);
    if (glm::length(t) <= 1e-9 * glm::length(frames[i].u) || !Normalize(&t)) t = AnyPerpendicular(n);
    // glTF's v grows downwards in the picture, its bitangent points up.
    const bool mirrored = glm::dot(glm::cross(n, t), frames[i].v) > 0;
    p.vertices[i].tangent = glm::vec4(glm::vec3(t), mirrored ? -1.0f : 1.0f);
  }
}

// Keeps the file's tangents but for length, and for those that no frame can be made of.
void RepairTangents(Document& doc, Draft* draft) {
  size_t bad = 0;
  for (Vertex& vertex : draft->primitive.vertices) {
    const glm::dvec3 n(vertex.normal);
    const glm::dvec3 given(vertex.tangent);
    glm::dvec3 t = given - n * glm::dot(n, given);
    if (glm::length(t) <= 1e-3 * glm::length(given) || !Normalize(&t)) {
      t = AnyPerpendicular(n);
      ++bad;
    }
    vertex.tangent = glm::vec4(glm::vec3(t), vertex.tangent.w);
  }
  if (bad != 0)
    doc.Warn(draft->primitive.name, ": ", bad, " of ", draft->primitive.vertices.size(),
             " tangents are zero, not finite or along the normal; they were replaced");
}

}  // namespace

void CompleteAttributes(Document& doc, double diameter, Draft* draft) {
  CompleteNormals(doc, draft);
  if (!draft->hasUvs) {
    MakeBoxUvs(diameter, draft);
    doc.Warn(draft->primitive.name, ": has no texture coordinates; they were made by box projection");
  }
  if (draft->hasTangents)
    RepairTangents(doc, draft);
  else
    MakeTangents(draft);
}

}  // namespace fur::gltf

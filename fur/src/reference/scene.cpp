#include "scene.h"

#include <algorithm>
#include <cmath>

namespace fur::reference {
namespace {

// In lengths of the fur, in the part's axes.
glm::dvec3 OffsetOf(const FurVertex& v, const FurSway& sway) {
  return sway.Varies() ? TipOffset(sway, glm::dvec3(v.position), glm::dvec3(v.direction)) : sway.comb;
}

template <class T>
T Mix(const glm::dvec3& b, const T& x, const T& y, const T& z) {
  return x * b.x + y * b.y + z * b.z;
}

template <class T>
T Mix(const glm::dvec3& b, const std::array<T, 3>& v) {
  return Mix(b, v[0], v[1], v[2]);
}

double Cross2(const glm::dvec3& a, const glm::dvec3& b) { return a.x * b.y - b.x * a.y; }

}  // namespace

// Edge functions in the ray's axes, as for the prisms: neighbours leave no gap.
void Intersect(const SkinTriangle& triangle, uint32_t index, const Ray& ray, SkinHit* nearest) {
  std::array<glm::dvec3, 3> q;
  for (size_t i = 0; i < 3; ++i) {
    const glm::dvec3 v = triangle.p[i] - ray.origin;
    q[i] = {glm::dot(ray.right, v), glm::dot(ray.up, v), glm::dot(ray.direction, v)};
  }
  const glm::dvec3 f(Cross2(q[1], q[2]), Cross2(q[2], q[0]), Cross2(q[0], q[1]));
  const double d = f.x + f.y + f.z;
  // right, up, direction: seen against the direction a front face turns clockwise in (right, up).
  const bool front = f.x <= 0 && f.y <= 0 && f.z <= 0, back = f.x >= 0 && f.y >= 0 && f.z >= 0;
  if (d == 0 || !(front || (back && triangle.doubleSided))) return;
  const glm::dvec3 b = f / d;
  const double t = b.x * q[0].z + b.y * q[1].z + b.z * q[2].z;
  // Ties go to the first, whatever order the triangles come in.
  if (!(t >= ray.tMin && t <= ray.tMax) || t > nearest->t || (t == nearest->t && index > nearest->triangle)) return;
  *nearest = {t, index, b};
}

FurScene::FurScene(const Model& model, std::span<const glm::dmat4> placements, const ReferenceSettings& s)
    : model_(model),
      semantics_(s.semantics),
      lighting_(s),
      furnace_(s.furnace),
      comb_(s.comb),
      bend_(s.bend),
      time_(s.time),
      windLength_(std::max(ComputeBounds(model).Diameter() / 2, 1e-6)),
      meshes_(MakeFurMeshes(model, s.look == Look::Correct ? FurTiling::Isometric : FurTiling::Model)) {
  for (const Material& m : model.materials) {
    const bool furred = m.fur && m.fur->params.enabled;
    coats_.push_back(furred ? std::make_unique<Coat>(model, m, s.look) : nullptr);
    skins_.push_back(std::make_unique<Skin>(model, m, s.look));
  }
  for (size_t i = 0; i < meshes_.size(); ++i)
    corners_.push_back(CornersOf(meshes_[i], coats_[model.primitives[i].material].get()));
  for (const glm::dmat4& placement : placements)
    for (const fur::Part& part : model.parts) AddPart(part, placement);
}

std::vector<FurScene::Corners> FurScene::CornersOf(const FurMesh& mesh, const Coat* coat) {
  std::vector<Corners> corners(mesh.indices.size() / 3);
  for (size_t i = 0; i < corners.size() * 3; ++i) {
    const FurVertex& v = mesh.vertices[mesh.indices[i]];
    Corners& c = corners[i / 3];
    c.uv[i % 3] = {v.direction.w, v.normal.w};
    c.tiles[i % 3] = glm::dvec2(v.furUv);
    c.length[i % 3] = double(v.position.w);
  }
  for (Corners& c : corners) {
    const auto [x, y, z] = c.uv;
    const double least = coat ? coat->LeastLength(glm::min(x, glm::min(y, z)), glm::max(x, glm::max(y, z))) : 0;
    c.uncut = least / std::max({c.length[0], c.length[1], c.length[2], 1e-9});
  }
  return corners;
}

void FurScene::AddPart(const fur::Part& source, const glm::dmat4& placement) {
  const glm::dmat4 toWorld = placement * source.transform;
  const Primitive& primitive = model_.primitives[source.primitive];
  Part part;
  part.linear = glm::dmat3(toWorld);
  part.normalToWorld = NormalMatrix(part.linear);
  part.primitive = source.primitive;
  part.material = primitive.material;
  part.mirrored = glm::determinant(part.linear) < 0;
  for (uint32_t i = 0; i + 2 < primitive.indices.size(); i += 3) {
    SkinTriangle t{{}, uint32_t(parts_.size()), i / 3, skins_[part.material]->DoubleSided()};
    for (uint32_t k = 0; k < 3; ++k)
      t.p[part.mirrored && k > 0 ? 3 - k : k] =
          toWorld * glm::dvec4(glm::dvec3(primitive.vertices[primitive.indices[i + k]].position), 1);
    skin_.push_back(t);
  }
  if (Furred(part)) part.sway = SwayOf(model_.materials[part.material], source, placement);
  parts_.push_back(part);
  if (Furred(part)) AddPrisms(part, toWorld);
}

FurSway FurScene::SwayOf(const Material& m, const fur::Part& part, const glm::dmat4& placement) const {
  FurParams p = m.fur->params;
  if (comb_) {
    p.comb = *comb_;
    p.combStrength = glm::length(*comb_);
  }
  if (bend_) p.bend = *bend_;
  if (p.windLength == 0) p.windLength = windLength_;
  return MakeFurSway(p, placement, part.transform, time_, glm::dvec3(0));
}

void FurScene::AddPrisms(const Part& part, const glm::dmat4& toWorld) {
  const FurMesh& mesh = meshes_[part.primitive];
  const bool leans = part.sway.Varies() || part.sway.comb != glm::dvec3(0);
  for (uint32_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
    Prism prism;
    prism.part = uint32_t(parts_.size() - 1);
    prism.triangle = i / 3;
    prism.bend = leans ? part.sway.bend : 1;
    for (uint32_t k = 0; k < 3; ++k) {
      const FurVertex& v = mesh.vertices[mesh.indices[i + k]];
      const double length = double(v.position.w) * coats_[part.material]->Length();
      prism.p[k] = toWorld * glm::dvec4(glm::dvec3(v.position), 1);
      prism.a[k] = part.linear * (glm::dvec3(v.direction) * length);
      prism.c[k] = part.linear * (OffsetOf(v, part.sway) * length);
    }
    prisms_.push_back(prism);
  }
}

uint32_t FurScene::Slices(const Prism& prism) const { return coats_[parts_[prism.part].material]->Slices(); }

FurPoint FurScene::Read(const Prism& prism, const PrismView& view, double h) const {
  const PrismView::Point at = view.At(h);
  FurPoint point;
  point.h = h;
  point.t = at.t;
  if (!at.valid) return point;
  point.b = at.b;
  const Part& part = parts_[prism.part];
  const Corners& c = corners_[part.primitive][prism.triangle];
  const Coat& coat = *coats_[part.material];
  point.uv = Mix(at.b, c.uv);
  point.place = coat.PlaceAt(Mix(at.b, c.tiles), h);
  // docs/accuracy.md: |dh| for sheets; |grad h| ds = |dh| / |m.w| for a volume.
  const bool cut = h > c.uncut && coat.IsCut(point.uv, h, Mix(at.b, c.length));
  if (!cut) point.density = point.place.density * (semantics_ == Semantics::Volume ? at.secant : 1);
  return point;
}

double FurScene::Texels(const Prism& prism, const FurPoint& from, const FurPoint& to) const {
  return coats_[parts_[prism.part].material]->Texels(from.place, to.place);
}

FurCorners FurScene::LightingOf(const Prism& prism) const {
  const Part& part = parts_[prism.part];
  const FurMesh& mesh = meshes_[part.primitive];
  FurCorners c;
  for (size_t i = 0; i < 3; ++i) {
    const FurVertex& v = mesh.vertices[mesh.indices[size_t(prism.triangle) * 3 + i]];
    c.direction[i] = part.linear * glm::dvec3(v.direction);
    c.lean[i] = part.linear * OffsetOf(v, part.sway);
    c.normal[i] = part.normalToWorld * glm::dvec3(v.normal);
    c.tangent[i] = part.linear * glm::dvec3(v.tangent);
    c.handedness[i] = double(v.tangent.w) * part.Handedness();
  }
  return c;
}

glm::dvec3 FurScene::Shade(const Prism& prism, const FurCorners& c, const FurPoint& point, const Ray& ray) const {
  if (furnace_) return *furnace_;
  const glm::dvec3& b = point.b;
  // The axis of the strand at this height: dX/dh.
  const double bend = prism.bend == 1 ? 1 : prism.bend * std::pow(point.h, prism.bend - 1);
  const FurFrame frame{Mix(b, c.direction) + Mix(b, c.lean) * bend, Mix(b, c.normal), Mix(b, c.tangent),
                       Mix(b, c.handedness)};
  return coats_[parts_[prism.part].material]->Shade(lighting_, ray.direction, frame, point.uv, point.place, point.h);
}

glm::dvec3 FurScene::Shade(const SkinHit& hit, const Ray& ray) const {
  if (furnace_) return *furnace_;
  const SkinTriangle& t = skin_[hit.triangle];
  const Part& part = parts_[t.part];
  const Primitive& primitive = model_.primitives[part.primitive];
  const uint32_t* i = &primitive.indices[size_t(t.triangle) * 3];
  const Vertex &x = primitive.vertices[i[0]], &y = primitive.vertices[i[part.mirrored ? 2 : 1]],
               &z = primitive.vertices[i[part.mirrored ? 1 : 2]];
  const glm::dvec3& b = hit.b;
  const SkinFrame frame{part.normalToWorld * Mix(b, glm::dvec3(x.normal), glm::dvec3(y.normal), glm::dvec3(z.normal)),
                        part.linear * Mix(b, glm::dvec3(x.tangent), glm::dvec3(y.tangent), glm::dvec3(z.tangent)),
                        (b.x * double(x.tangent.w) + b.y * double(y.tangent.w) + b.z * double(z.tangent.w)) *
                            part.Handedness()};
  const auto uv = Mix(b, glm::dvec2(x.uv), glm::dvec2(y.uv), glm::dvec2(z.uv));
  return skins_[part.material]->Shade(lighting_, ray.direction, frame, uv);
}

}  // namespace fur::reference

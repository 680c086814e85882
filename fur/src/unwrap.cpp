#include "unwrap.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>

#include "fur/fur_mesh.h"
#include "fur/fur_uv.h"
#include "fur_uv_charts.h"
#include "surface_painter.h"
#include "unwrap_pieces.h"

namespace fur {
namespace {

using glm::dvec2;

struct Box {
  dvec2 min{HUGE_VAL}, max{-HUGE_VAL};
  dvec2 at{0};  // where its min comes to lie
  dvec2 Size() const { return glm::max(max - min, 0.0); }
};

// A primitive whose vertices are split between pieces, and where they lie on the skin.
struct Unwrapped {
  uint32_t primitive = 0;
  std::vector<dvec2> uv;           // by new vertex
  std::vector<uint32_t> box;       // by new vertex: of its piece
  std::vector<uint32_t> vertexOf;  // by new vertex: the old one
  std::vector<uint32_t> indices;
};

double UnitScale(const Model& model, uint32_t primitive) {
  for (const Part& part : model.parts)
    if (part.primitive == primitive) return std::cbrt(std::abs(glm::determinant(glm::dmat3(part.transform))));
  return 1;
}

// Shelves of falling height. Whether all fit into a square.
bool Pack(std::vector<Box>* boxes, double side, double margin) {
  std::vector<size_t> order(boxes->size());
  std::iota(order.begin(), order.end(), size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](size_t a, size_t b) { return (*boxes)[a].Size().y > (*boxes)[b].Size().y; });
  dvec2 at(margin);
  double shelf = 0;
  for (const size_t i : order) {
    const dvec2 size = (*boxes)[i].Size();
    if (at.x + size.x + margin > side) at = {margin, at.y + shelf + margin}, shelf = 0;
    if (at.x + size.x + margin > side || at.y + size.y + margin > side) return false;
    (*boxes)[i].at = at;
    at.x += size.x + margin;
    shelf = std::max(shelf, size.y);
  }
  return true;
}

// The side of the square that they were packed into.
double PackAll(std::vector<Box>* boxes) {
  double area = 0, longest = 0;
  for (const Box& box : *boxes) {
    area += box.Size().x * box.Size().y;
    longest = std::max({longest, box.Size().x, box.Size().y});
  }
  double side = std::max(std::sqrt(area), longest);
  if (!(side > 0)) side = 1;
  while (!Pack(boxes, side, side * 0.008)) side *= 1.02;
  return side;
}

Unwrapped Split(const Model& model, uint32_t index, std::vector<Box>* boxes) {
  const Primitive& primitive = model.primitives[index];
  std::vector<dvec2> uv = MakeFurUv(primitive).uv;
  for (dvec2& p : uv) p *= UnitScale(model, index);
  const std::vector<uint32_t> pieces = FindPieces(primitive.indices, uv, furuv::FindCharts(primitive).chartOf);
  Unwrapped out{.primitive = index};
  const auto firstBox = uint32_t(boxes->size());
  std::map<std::pair<uint32_t, uint32_t>, uint32_t> known;  // by old vertex and piece
  for (size_t i = 0; i < pieces.size() * 3; ++i) {
    const uint32_t v = primitive.indices[i], box = firstBox + pieces[i / 3];
    const auto [it, isNew] = known.try_emplace({v, box}, uint32_t(out.uv.size()));
    out.indices.push_back(it->second);
    if (!isNew) continue;
    out.uv.push_back(uv[v]);
    out.box.push_back(box);
    out.vertexOf.push_back(v);
    boxes->resize(std::max(boxes->size(), size_t{box} + 1));
    (*boxes)[box].min = glm::min((*boxes)[box].min, uv[v]);
    (*boxes)[box].max = glm::max((*boxes)[box].max, uv[v]);
  }
  return out;
}

// The primitive with its new vertices, still with the old coordinates.
void Rebuild(const Unwrapped& u, Primitive* primitive) {
  std::vector<Vertex> vertices;
  for (const uint32_t v : u.vertexOf) vertices.push_back(primitive->vertices[v]);
  primitive->vertices = std::move(vertices);
  primitive->indices = u.indices;
}

// Of all triangles of the material.
double UvArea(const Model& model, uint32_t material) {
  double area = 0;
  for (const Primitive& p : model.primitives) {
    if (p.material != material) continue;
    for (size_t i = 0; i + 2 < p.indices.size(); i += 3) {
      const dvec2 a(p.vertices[p.indices[i]].uv), b(p.vertices[p.indices[i + 1]].uv), c(p.vertices[p.indices[i + 2]].uv);
      area += std::abs(furuv::Cross(b - a, c - a)) / 2;
    }
  }
  return area;
}

// A picture for the new coordinates, read at the old ones.
class Carrier {
 public:
  Carrier(const Model& before, Model* after, uint32_t material, uint32_t side)
      : before_(before), after_(*after), side_(side), raster_(*after, material, side) {}

  int32_t Carry(int32_t image, bool wrapU, bool wrapV) {
    if (image < 0) return image;
    const Image& old = before_.images[size_t(image)];
    const auto read = [&](const SurfaceRaster::Point& point) {
      const SurfaceRaster::Triangle& t = raster_.Triangles()[point.triangle];
      const Primitive& p = before_.primitives[before_.parts[t.part].primitive];
      dvec2 uv(0);
      for (size_t k = 0; k < 3; ++k) uv += dvec2(p.vertices[t.vertices[k]].uv) * point.weights[k];
      return SampleBilinear(old, uv, wrapU, wrapV);
    };
    after_.images.push_back(PaintPoints(raster_, side_, glm::dvec4(1), read));
    after_.images.back().name = old.name;
    return int32_t(after_.images.size() - 1);
  }
  TextureRef Carry(const TextureRef& t) {
    return t.image < 0 ? t : TextureRef{.image = Carry(t.image, t.wrapU, t.wrapV)};
  }

 private:
  const Model& before_;
  Model& after_;
  uint32_t side_;
  SurfaceRaster raster_;
};

}  // namespace

void UnwrapMaterial(Model* model, uint32_t material, uint32_t side) {
  std::vector<Box> boxes;
  std::vector<Unwrapped> all;
  for (uint32_t p = 0; p < model->primitives.size(); ++p)
    if (model->primitives[p].material == material) all.push_back(Split(*model, p, &boxes));
  const double square = PackAll(&boxes);
  for (const Unwrapped& u : all) Rebuild(u, &model->primitives[u.primitive]);
  const Model before = *model;
  for (const Unwrapped& u : all)
    for (size_t v = 0; v < u.uv.size(); ++v) {
      const Box& box = boxes[u.box[v]];
      model->primitives[u.primitive].vertices[v].uv = glm::vec2((u.uv[v] - box.min + box.at) / square);
    }
  Material& m = model->materials[material];
  Carrier carrier(before, model, material, side);
  m.baseColorTexture = carrier.Carry(m.baseColorTexture);
  m.normalTexture = carrier.Carry(m.normalTexture);
  m.specularTexture = carrier.Carry(m.specularTexture);
  // The maps of fur wrap as the base's sampler does.
  const TextureRef& base = before.materials[material].baseColorTexture;
  m.fur->lengthMap = carrier.Carry(m.fur->lengthMap, base.wrapU, base.wrapV);
  m.fur->directionMap = carrier.Carry(m.fur->directionMap, base.wrapU, base.wrapV);
  const double areaNow = UvArea(*model, material);
  if (areaNow > 0) m.fur->params.layerUvScale *= std::sqrt(UvArea(before, material) / areaNow);
}

}  // namespace fur

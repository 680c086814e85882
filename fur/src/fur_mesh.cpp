#include "fur/fur_mesh.h"

#include <algorithm>
#include <cmath>

#include "fur/fur_uv.h"
#include "fur/topology.h"

namespace fur {
namespace {

constexpr uint32_t kNone = ~0u;

// The primitives of one transform as one list of vertices and triangles.
struct Skin {
  struct Range {
    uint32_t primitive, firstVertex, firstIndex;
  };
  std::vector<Range> ranges;
  std::vector<Vertex> vertices;
  std::vector<uint32_t> indices;
  std::vector<uint32_t> owner;  // for each triangle: index into `ranges`
};

// What is welded: for each welded position.
struct Root {
  glm::dvec3 direction{0};
  double length = 0;
};

bool IsFurred(const Model& model, uint32_t primitive) {
  const auto& fur = model.materials[model.primitives[primitive].material].fur;
  return fur && fur->params.enabled;
}

Skin Gather(const Model& model, std::span<const uint32_t> primitives) {
  Skin skin;
  for (uint32_t p : primitives) {
    const Primitive& primitive = model.primitives[p];
    const auto base = uint32_t(skin.vertices.size());
    const auto range = uint32_t(skin.ranges.size());
    skin.ranges.push_back({p, base, uint32_t(skin.indices.size())});
    skin.vertices.insert(skin.vertices.end(), primitive.vertices.begin(), primitive.vertices.end());
    for (uint32_t index : primitive.indices) skin.indices.push_back(base + index);
    skin.owner.insert(skin.owner.end(), primitive.indices.size() / 3, range);
  }
  return skin;
}

// Each primitive once, with all those that its first part's transform places too.
std::vector<std::vector<uint32_t>> GroupByTransform(const Model& model) {
  std::vector<std::vector<uint32_t>> groups;
  std::vector<const glm::dmat4*> transforms;
  std::vector<bool> seen(model.primitives.size(), false);
  for (const Part& part : model.parts) {
    if (seen[part.primitive]) continue;
    seen[part.primitive] = true;
    size_t g = 0;
    while (g < groups.size() && *transforms[g] != part.transform) ++g;
    if (g == groups.size()) {
      groups.emplace_back();
      transforms.push_back(&part.transform);
    }
    groups[g].push_back(part.primitive);
  }
  for (uint32_t p = 0; p < seen.size(); ++p)
    if (!seen[p]) groups.push_back({p});
  return groups;
}

double CornerAngle(const glm::dvec3& at, const glm::dvec3& a, const glm::dvec3& b) {
  const glm::dvec3 x = a - at, y = b - at;
  const double lengths = glm::length(x) * glm::length(y);
  return lengths > 0 ? std::acos(std::clamp(glm::dot(x, y) / lengths, -1.0, 1.0)) : 0;
}

// Fur at one vertex before welding.
class Grower {
 public:
  Grower(const Model& model, const Primitive& primitive)
      : material_(model.materials[primitive.material]), fur_(*material_.fur) {
    lengthMap_ = fur_.lengthMap < 0 ? nullptr : &model.images[size_t(fur_.lengthMap)];
    directionMap_ = fur_.directionMap < 0 ? nullptr : &model.images[size_t(fur_.directionMap)];
  }
  double Length(const Vertex& v) const { return lengthMap_ ? Sample(*lengthMap_, v).r : 1; }
  glm::dvec3 Direction(const Vertex& v) const {
    const glm::dvec3 n(v.normal);
    if (!directionMap_) return n;
    const glm::dvec3 t = glm::dvec3(Sample(*directionMap_, v)) * 2.0 - 1.0;
    if (glm::dot(t, t) < 1.0 / 4096) return n;  // "no direction": docs/accuracy.md
    const glm::dvec3 tangent(v.tangent);
    return glm::normalize(tangent * t.x + glm::cross(n, tangent) * (double(v.tangent.w) * t.y) + n * t.z);
  }

 private:
  glm::dvec4 Sample(const Image& image, const Vertex& v) const {
    return SampleBilinear(image, v.uv, material_.baseColorTexture.wrapU, material_.baseColorTexture.wrapV);
  }
  const Material& material_;
  const MaterialFur& fur_;
  const Image *lengthMap_ = nullptr, *directionMap_ = nullptr;
};

class SkinBuilder {
 public:
  SkinBuilder(const Model& model, const Skin& skin)
      : model_(model), skin_(skin), weld_(WeldByPosition(skin.vertices)), roots_(weld_.representative.size()) {
    for (const Skin::Range& range : skin.ranges)
      if (IsFurred(model, range.primitive)) AddRoots(range, Grower(model, model.primitives[range.primitive]));
    FinishRoots();
    lines_ = LineAdjacency(skin.vertices, skin.indices, weld_);
  }

  FurMesh Build(uint32_t rangeIndex, FurTiling tiling) const {
    const Skin::Range& range = skin_.ranges[rangeIndex];
    const Primitive& primitive = model_.primitives[range.primitive];
    FurMesh mesh;
    for (uint32_t v = 0; v < primitive.vertices.size(); ++v)
      mesh.vertices.push_back(MakeVertex(range.firstVertex + v, primitive.vertices[v]));
    const double tiles = model_.materials[primitive.material].fur->params.layerUvScale;
    if (tiling == FurTiling::Model) {
      for (uint32_t v = 0; v < primitive.vertices.size(); ++v)
        mesh.vertices[v].furUv = glm::vec4(glm::vec2(glm::dvec2(primitive.vertices[v].uv) * tiles), 0, 0);
    } else {
      TileEvenly(primitive, tiles, &mesh);
    }
    KeepTriangles(primitive, &mesh);
    KeepEdges(rangeIndex, uint32_t(primitive.vertices.size()), &mesh);
    return mesh;
  }

 private:
  // Adds a primitive's corners to the means at their positions.
  void AddRoots(const Skin::Range& range, const Grower& grower) {
    const Primitive& p = model_.primitives[range.primitive];
    if (weights_.empty()) weights_.resize(roots_.size(), 0);
    for (size_t i = 0; i < p.indices.size(); ++i) {
      const size_t triangle = i - i % 3;
      const Vertex &at = p.vertices[p.indices[i]], &a = p.vertices[p.indices[triangle + (i + 1) % 3]],
                   &b = p.vertices[p.indices[triangle + (i + 2) % 3]];
      const double angle = CornerAngle(at.position, a.position, b.position);
      const uint32_t root = weld_.welded[range.firstVertex + p.indices[i]];
      roots_[root].direction += grower.Direction(at) * angle;
      roots_[root].length += grower.Length(at) * angle;
      weights_[root] += angle;
    }
  }

  void FinishRoots() {
    for (size_t i = 0; i < weights_.size(); ++i) {
      const double size = glm::length(roots_[i].direction);
      // A mean that has nearly vanished points anywhere.
      roots_[i].direction = size > 1e-3 * weights_[i] && size > 0 ? roots_[i].direction / size : glm::dvec3(0);
      roots_[i].length = weights_[i] > 0 ? roots_[i].length / weights_[i] : 0;
    }
  }

  // As many tiles on the whole skin as the model's map times `tiles` would put there, equally dense everywhere.
  static void TileEvenly(const Primitive& primitive, double tiles, FurMesh* mesh) {
    const FurUv even = MakeFurUv(WithoutDegenerate(primitive));
    const double perUnit = tiles * MeanUvScale(primitive);
    for (size_t v = 0; v < primitive.vertices.size(); ++v) {
      // A volume's y axis runs up its pictures, against v (fur/model.h); the even map's frame runs along v.
      mesh->vertices[v].furUv = glm::vec4(glm::vec2(even.uv[v] * glm::dvec2(perUnit, -perUnit)), 0, 0);
      mesh->vertices[v].tangent = glm::vec4(glm::vec3(even.tangent[v]), even.handedness[v]);
    }
  }

  // A triangle with two corners in one place ties together what does not touch.
  static Primitive WithoutDegenerate(Primitive p) {
    const auto at = [&](size_t i) { return p.vertices[p.indices[i]].position; };
    std::vector<uint32_t> kept;
    for (size_t i = 0; i + 2 < p.indices.size(); i += 3)
      if (at(i) != at(i + 1) && at(i + 1) != at(i + 2) && at(i + 2) != at(i))
        kept.insert(kept.end(), {p.indices[i], p.indices[i + 1], p.indices[i + 2]});
    p.indices = std::move(kept);
    return p;
  }

  // The model's texture coordinates for one unit of length, in the mean over the skin; 1 where it has no area.
  static double MeanUvScale(const Primitive& p) {
    double skin = 0, uv = 0;
    for (size_t i = 0; i + 2 < p.indices.size(); i += 3) {
      const Vertex &a = p.vertices[p.indices[i]], &b = p.vertices[p.indices[i + 1]], &c = p.vertices[p.indices[i + 2]];
      const glm::dvec3 ab = glm::dvec3(b.position) - glm::dvec3(a.position);
      const glm::dvec3 ac = glm::dvec3(c.position) - glm::dvec3(a.position);
      const glm::dvec2 u = glm::dvec2(b.uv) - glm::dvec2(a.uv), v = glm::dvec2(c.uv) - glm::dvec2(a.uv);
      skin += glm::length(glm::cross(ab, ac));
      uv += std::abs(u.x * v.y - u.y * v.x);
    }
    return skin > 0 && uv > 0 ? std::sqrt(uv / skin) : 1;
  }

  FurVertex MakeVertex(uint32_t skinVertex, const Vertex& v) const {
    const Root& root = roots_[weld_.welded[skinVertex]];
    const glm::vec3 direction = root.direction == glm::dvec3(0) ? v.normal : glm::vec3(root.direction);
    return {glm::vec4(v.position, float(root.length)), glm::vec4(direction, v.uv.x), v.tangent,
            glm::vec4(v.normal, v.uv.y), glm::vec4(0)};
  }

  bool Bald(uint32_t skinVertex) const { return roots_[weld_.welded[skinVertex]].length <= 0; }

  static void KeepTriangles(const Primitive& primitive, FurMesh* mesh) {
    for (size_t i = 0; i + 2 < primitive.indices.size(); i += 3) {
      const uint32_t* t = &primitive.indices[i];
      const auto hasFur = [&](uint32_t v) { return mesh->vertices[v].position.w > 0; };
      if (hasFur(t[0]) || hasFur(t[1]) || hasFur(t[2])) {
        mesh->indices.insert(mesh->indices.end(), t, t + 3);
      } else {
        ++mesh->baldTriangles;
      }
    }
  }

  // An edge belongs to the primitive whose vertices it names: those of its first triangle.
  void KeepEdges(uint32_t rangeIndex, uint32_t ownVertices, FurMesh* mesh) const {
    const Skin::Range& range = skin_.ranges[rangeIndex];
    const auto isOwn = [&](uint32_t v) { return v >= range.firstVertex && v - range.firstVertex < ownVertices; };
    std::vector<uint32_t> ghosts(skin_.vertices.size(), kNone);
    for (size_t i = 0; i + 3 < lines_.size(); i += 4) {
      if (!isOwn(lines_[i + 1])) continue;
      if (Bald(lines_[i + 1]) && Bald(lines_[i + 2])) {
        ++mesh->baldEdges;
        continue;
      }
      for (size_t k = 0; k < 4; ++k) {
        const uint32_t v = lines_[i + k];
        mesh->edges.push_back(isOwn(v) ? v - range.firstVertex : Ghost(v, &ghosts[v], mesh));
      }
    }
  }

  uint32_t Ghost(uint32_t skinVertex, uint32_t* known, FurMesh* mesh) const {
    if (*known != kNone) return *known;
    *known = uint32_t(mesh->vertices.size());
    mesh->vertices.push_back(MakeVertex(skinVertex, skin_.vertices[skinVertex]));
    return *known;
  }

  const Model& model_;
  const Skin& skin_;
  Weld weld_;
  std::vector<Root> roots_;
  std::vector<double> weights_;
  std::vector<uint32_t> lines_;
};

}  // namespace

glm::dvec4 SampleBilinear(const Image& image, const glm::dvec2& uv, bool wrapU, bool wrapV) {
  const auto texel = [](double x, uint32_t size, bool wrap) {
    const auto n = int64_t(size);
    const auto i = int64_t(x);
    return size_t(wrap ? ((i % n) + n) % n : std::clamp<int64_t>(i, 0, n - 1));
  };
  // Far outside the square a wrapped coordinate has no digits left for the texel: reduce it first.
  const auto reduce = [](double t, bool wrap) { return wrap ? t - std::floor(t) : std::clamp(t, -1.0, 2.0); };
  const double x = reduce(uv.x, wrapU) * image.width - 0.5, y = reduce(uv.y, wrapV) * image.height - 0.5;
  const double fx = x - std::floor(x), fy = y - std::floor(y);
  glm::dvec4 sum(0);
  for (int k = 0; k < 4; ++k) {
    const size_t tx = texel(std::floor(x) + (k & 1), image.width, wrapU);
    const size_t ty = texel(std::floor(y) + (k >> 1), image.height, wrapV);
    const uint8_t* p = &image.pixels[(ty * image.width + tx) * 4];
    sum += glm::dvec4(p[0], p[1], p[2], p[3]) * ((k & 1 ? fx : 1 - fx) * (k >> 1 ? fy : 1 - fy) / 255.0);
  }
  return sum;
}

std::vector<FurMesh> MakeFurMeshes(const Model& model, FurTiling tiling) {
  std::vector<FurMesh> meshes(model.primitives.size());
  for (std::vector<uint32_t>& group : GroupByTransform(model)) {
    // An edge belongs to the first of its triangles: with the furred ones in front none is lost to a bald neighbour.
    const auto bald =
        std::stable_partition(group.begin(), group.end(), [&](uint32_t p) { return IsFurred(model, p); });
    if (bald == group.begin()) continue;
    const Skin skin = Gather(model, group);
    const SkinBuilder builder(model, skin);
    for (uint32_t i = 0; i < group.size(); ++i)
      if (IsFurred(model, group[i])) meshes[group[i]] = builder.Build(i, tiling);
  }
  return meshes;
}

}  // namespace fur

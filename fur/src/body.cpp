#include "body.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <queue>

namespace fur {
namespace {

using glm::dvec3;

// As far as the wave that reached a at ta and b at tb has come at c: from the one point in the triangle's plane that is ta
// and tb away, if the straight line from there crosses the edge; else along an edge.
double Update(const dvec3& c, const dvec3& a, double ta, const dvec3& b, double tb) {
  const double edge = glm::length(b - a), along = std::min(ta + glm::length(a - c), tb + glm::length(b - c));
  if (!(edge > 0)) return along;
  const double x = (edge * edge + ta * ta - tb * tb) / (2 * edge), depth = ta * ta - x * x;
  const double cx = glm::dot(c - a, b - a) / edge, height = glm::dot(c - a, c - a) - cx * cx;
  if (!(depth > 0) || !(height > 0)) return along;
  const double y = std::sqrt(depth), cy = std::sqrt(height), crossing = x + (cx - x) * y / (y + cy);
  if (crossing < 0 || crossing > edge) return along;
  return std::min(along, std::sqrt((cx - x) * (cx - x) + (cy + y) * (cy + y)));
}

struct Neighbours {
  std::vector<std::vector<uint32_t>> triangles;  // by vertex
  explicit Neighbours(const Skin& skin) : triangles(skin.positions.size()) {
    for (uint32_t t = 0; t < skin.triangles.size(); ++t)
      for (const uint32_t v : skin.triangles[t]) triangles[v].push_back(t);
  }
};

// The best of a measure over the places.
template <class Value>
uint32_t Best(const std::vector<Place>& places, Value value) {
  uint32_t best = 0;
  for (uint32_t i = 1; i < places.size(); ++i)
    if (value(places[i]) > value(places[best])) best = i;
  return best;
}

// In [0, 1), without steps: base 2 and base 3 of Halton's sequence.
double Radical(uint32_t i, uint32_t base) {
  double value = 0, digit = 1.0 / base;
  for (; i > 0; i /= base, digit /= base) value += digit * (i % base);
  return value;
}

}  // namespace

Place Mix(const std::array<const Place*, 3>& t, double a, double b, double c) {
  const auto mix = [&](auto member) { return (*t[0]).*member * a + (*t[1]).*member * b + (*t[2]).*member * c; };
  return {mix(&Place::p), mix(&Place::n), mix(&Place::h), mix(&Place::nose), mix(&Place::tail), mix(&Place::feet)};
}

std::vector<double> SurfaceDistance(const Skin& skin, const std::vector<Source>& sources) {
  const Neighbours neighbours(skin);
  std::vector<double> distance(skin.positions.size(), HUGE_VAL);
  std::priority_queue<std::pair<double, uint32_t>, std::vector<std::pair<double, uint32_t>>, std::greater<>> queue;
  const auto reach = [&](uint32_t v, double d) {
    if (!(d < distance[v] * (1 - 1e-9))) return;
    distance[v] = d;
    queue.emplace(d, v);
  };
  for (const Source& s : sources) reach(s.vertex, s.distance);
  while (!queue.empty()) {
    const auto [d, v] = queue.top();
    queue.pop();
    if (d > distance[v]) continue;
    for (const uint32_t index : neighbours.triangles[v]) {
      const auto& t = skin.triangles[index];
      for (int k = 0; k < 3; ++k) {
        const uint32_t c = t[k], b = t[(k + 1) % 3] == v ? t[(k + 2) % 3] : t[(k + 1) % 3];
        if (c == v) continue;
        const dvec3 &at = skin.positions[v], &to = skin.positions[c];
        reach(c, distance[b] == HUGE_VAL ? d + glm::length(at - to)
                                         : Update(to, at, d, skin.positions[b], distance[b]));
      }
    }
  }
  for (size_t i = 0; i < distance.size(); ++i)
    for (size_t s = 0; distance[i] == HUGE_VAL && s < sources.size(); ++s)
      distance[i] = sources[s].distance + glm::length(skin.positions[i] - skin.positions[sources[s].vertex]);
  return distance;
}

Body::Body(const Model& model) {
  Weld(model);
  if (places_.empty()) return;
  Measure();
  Sample();
}

namespace {

// What the first furred material says, else the longer horizontal side; level and unit.
dvec3 FrontOf(const Model& model, const dvec3& size) {
  for (const Material& m : model.materials) {
    if (!m.fur) continue;
    const dvec3 level(m.fur->params.front.x, 0, m.fur->params.front.z);
    if (const double length = glm::length(level); length > 0) return level / length;
  }
  return size.x > size.z ? dvec3(1, 0, 0) : dvec3(0, 0, 1);
}

}  // namespace

void Body::Weld(const Model& model) {
  const Bounds bounds = ComputeBounds(model);
  const dvec3 size = bounds.max - bounds.min;
  const dvec3 front = FrontOf(model, size), side(front.z, 0, -front.x);
  const double scale = bounds.Diameter() > 0 ? 1 / bounds.Diameter() : 1, height = size.y > 0 ? size.y : 1;
  const auto turned = [&](const dvec3& v) { return dvec3(glm::dot(side, v), v.y, glm::dot(front, v)); };
  const auto less = [](const dvec3& a, const dvec3& b) {
    return std::array{a.x, a.y, a.z} < std::array{b.x, b.y, b.z};
  };
  std::map<dvec3, uint32_t, decltype(less)> known(less);
  const bool anyFur = std::any_of(model.materials.begin(), model.materials.end(), [](const Material& m) { return m.fur; });
  for (const Part& part : model.parts) {
    const Primitive& primitive = model.primitives[part.primitive];
    std::vector<uint32_t>& vertexOf = vertexOf_.emplace_back();
    for (const Vertex& v : primitive.vertices) {
      const dvec3 position(part.transform * glm::dvec4(glm::dvec3(v.position), 1));
      const dvec3 normal = turned(glm::dmat3(part.transform) * dvec3(v.normal));
      const auto [it, isNew] = known.try_emplace(position, uint32_t(places_.size()));
      if (isNew)
        places_.push_back({turned((position - bounds.Center()) * scale), dvec3(0), (position.y - bounds.min.y) / height});
      if (const double length = glm::length(normal); length > 0) places_[it->second].n += normal / length;
      vertexOf.push_back(it->second);
    }
    const bool furred = !anyFur || model.materials[primitive.material].fur.has_value();
    for (size_t i = 0; i + 2 < primitive.indices.size(); i += 3) {
      skin_.triangles.push_back({vertexOf[primitive.indices[i]], vertexOf[primitive.indices[i + 1]],
                                 vertexOf[primitive.indices[i + 2]]});
      furred_.push_back(furred);
    }
  }
  for (Place& place : places_) {
    const double length = glm::length(place.n);
    place.n = length > 0 ? place.n / length : dvec3(0, 1, 0);
    skin_.positions.push_back(place.p);
  }
}

void Body::Measure() {
  // The nose is what is foremost, near the middle.
  const uint32_t nose = Best(places_, [](const Place& at) { return at.p.z - 2 * std::abs(at.p.x); });
  const std::vector<double> fromNose = SurfaceDistance(skin_, {{nose, 0}});
  for (size_t i = 0; i < places_.size(); ++i) places_[i].nose = fromNose[i];
  std::vector<Source> ground;
  for (uint32_t i = 0; i < places_.size(); ++i)
    if (places_[i].h < 0.03) ground.push_back({i, 0});
  const std::vector<double> fromGround = SurfaceDistance(skin_, ground);
  for (size_t i = 0; i < places_.size(); ++i) places_[i].feet = fromGround[i];
  // The tip of the tail: farthest from the nose of all that is no hind leg.
  const uint32_t tail = Best(places_, [](const Place& at) {
    return at.h < 0.2 || at.p.z > 0 ? -1 : at.nose - std::abs(at.p.x);
  });
  const std::vector<double> fromTail = SurfaceDistance(skin_, {{tail, 0}});
  for (size_t i = 0; i < places_.size(); ++i) places_[i].tail = fromTail[i];
}

void Body::Sample() {
  constexpr uint32_t kSamples = 1 << 14;
  std::vector<double> sums;
  std::vector<uint32_t> triangles;
  double sum = 0;
  for (uint32_t i = 0; i < skin_.triangles.size(); ++i) {
    if (!furred_[i]) continue;
    const auto& t = skin_.triangles[i];
    const dvec3 &a = skin_.positions[t[0]], &b = skin_.positions[t[1]], &c = skin_.positions[t[2]];
    sum += glm::length(glm::cross(b - a, c - a));
    sums.push_back(sum);
    triangles.push_back(i);
  }
  if (!(sum > 0)) return;
  for (uint32_t i = 0; i < kSamples; ++i) {
    const double at = (i + 0.5) / kSamples * sum;
    const size_t index = size_t(std::upper_bound(sums.begin(), sums.end(), at) - sums.begin());
    const auto& t = skin_.triangles[triangles[std::min(index, triangles.size() - 1)]];
    // Even over the triangle: Osada et al., "Shape Distributions", TOG 21 (2002), section 3.2.
    const double root = std::sqrt(Radical(i + 1, 2)), other = Radical(i + 1, 3);
    samples_.push_back(Mix({&places_[t[0]], &places_[t[1]], &places_[t[2]]}, 1 - root, root * (1 - other), root * other));
  }
}

}  // namespace fur

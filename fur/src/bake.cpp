#include "fur/bake.h"

#include <algorithm>
#include <cmath>

#include "bake_math.h"
#include "for_all.h"
#include "strand_raster.h"

namespace fur {
namespace {

using glm::dvec2;
using glm::dvec3;

uint8_t ToByte(double x) { return static_cast<uint8_t>(std::clamp(x, 0.0, 1.0) * 255 + 0.5); }
int Modulo(int x, int n) { return ((x % n) + n) % n; }

// Sums of all strands in one picture, in the order of the list: nothing depends on threads.
class Picture {
 public:
  Picture(int width, int height) : width_(width), height_(height), texels_(size_t(width) * size_t(height)) {}

  void Add(int x, int row, const Footprint::Cell& cell, const dvec3& tint) {
    Texel& texel = texels_[size_t(row) * size_t(width_) + size_t(Modulo(x, width_))];
    const float share = float(cell.share);
    texel.open *= 1 - cell.share;
    const double length = std::sqrt(glm::dot(cell.direction, cell.direction));
    if (length > 0) texel.tangent += glm::vec3(cell.direction / length) * share;
    texel.tint += glm::vec3(tint) * share;
    texel.along += float(cell.along / cell.weight) * share;
    texel.weight += share;
  }

  // `tint` may be null.
  void Write(uint8_t* rgba, uint8_t* tint) {
    FillEmpty();
    for (const Texel& t : texels_) {
      const double length = std::sqrt(double(glm::dot(t.tangent, t.tangent)));
      const dvec3 unit = length > 1e-9 ? dvec3(t.tangent) / length : dvec3(0, 0, 1);
      for (int c = 0; c < 3; ++c) *rgba++ = ToByte(unit[c] * 0.5 + 0.5);
      *rgba++ = ToByte(1 - t.open);
      if (tint == nullptr) continue;
      const glm::vec3 color = t.weight > 0 ? t.tint / t.weight : glm::vec3(1);
      for (int c = 0; c < 3; ++c) *tint++ = ToByte(double(color[c]) * (128.0 / 255));
      *tint++ = ToByte(t.weight > 0 ? double(t.along / t.weight) : 0);
    }
  }

 private:
  struct Texel {
    double open = 1;
    glm::vec3 tangent{0}, tint{0};
    float along = 0, weight = 0;
    void Take(const Texel& t) {
      tangent += t.tangent, tint += t.tint;
      along += t.along, weight += t.weight;
    }
  };

  // Empty texels take the mean of their neighbours, ring by ring, so that filtering never mixes in a foreign direction;
  // what is still empty then takes the picture's mean, or straight up.
  void FillEmpty() {
    Texel mean;
    std::vector<size_t> empty;
    for (size_t i = 0; i < texels_.size(); ++i) {
      if (texels_[i].weight > 0)
        mean.Take(texels_[i]);
      else
        empty.push_back(i);
    }
    for (int ring = 0; ring < 4; ++ring) {
      std::vector<Texel> filled;
      for (size_t i : empty) filled.push_back(Neighbors(i));
      for (size_t k = 0; k < empty.size(); ++k) texels_[empty[k]] = filled[k];
      std::erase_if(empty, [&](size_t i) { return texels_[i].weight > 0; });
    }
    mean.open = 1;
    for (size_t i : empty) texels_[i] = mean;
  }

  Texel Neighbors(size_t i) const {
    const int x = static_cast<int>(i % size_t(width_)), y = static_cast<int>(i / size_t(width_));
    Texel sum;
    for (const auto& [dx, dy] : {std::pair{-1, 0}, {1, 0}, {0, -1}, {0, 1}})
      sum.Take(texels_[size_t(Modulo(y + dy, height_)) * size_t(width_) + size_t(Modulo(x + dx, width_))]);
    return sum;
  }

  int width_, height_;
  std::vector<Texel> texels_;
};

// Where a strand stands among the texels: whole ones and a rest, so that adding whole ones changes no bit.
struct Place {
  Place(dvec2 root, uint32_t size)
      : x(static_cast<int>(std::floor(root.x * size))),
        y(static_cast<int>(std::floor(root.y * size))),
        rest(root * double(size) - dvec2(x, y)) {}
  int x, y;
  dvec2 rest;
};

SweptDisc MakePiece(const StrandPoint& p, const StrandPoint& q, double t0, double t1, dvec2 a, dvec2 b, double scale) {
  const dvec3 d = q.position - p.position;
  const double length = std::sqrt(glm::dot(d, d));
  return {glm::mix(a, b, t0),
          glm::mix(a, b, t1),
          glm::mix(p.radius, q.radius, t0) * scale,
          glm::mix(p.radius, q.radius, t1) * scale,
          length > 0 ? d / length : dvec3(0),
          glm::mix(p.along, q.along, (t0 + t1) / 2)};
}

// The part of the strand between two heights, as discs that sweep over the texels.
void CutSlab(const Strand& strand, dvec2 rest, double scale, double low, double high, std::vector<SweptDisc>* pieces) {
  pieces->clear();
  for (size_t i = 0; i + 1 < strand.points.size(); ++i) {
    const StrandPoint &p = strand.points[i], &q = strand.points[i + 1];
    const double rise = q.position.z - p.position.z;
    double t0 = 0, t1 = 1;
    if (rise == 0) {
      if (p.position.z < low || p.position.z >= high) continue;
    } else {
      const double atLow = (low - p.position.z) / rise, atHigh = (high - p.position.z) / rise;
      t0 = std::max(0.0, std::min(atLow, atHigh)), t1 = std::min(1.0, std::max(atLow, atHigh));
      if (t0 >= t1) continue;
    }
    const dvec2 a = rest + dvec2(p.position) * scale, b = rest + dvec2(q.position) * scale;
    pieces->push_back(MakePiece(p, q, t0, t1, a, b, scale));
  }
}

void BakeSlice(const CoatParams& params, std::span<const Strand> strands, uint32_t slice, FurVolume* volume) {
  const int n = static_cast<int>(params.size);
  const size_t bytes = size_t{4} * params.size * params.size;
  Picture picture(n, n);
  Footprint footprint(1);
  std::vector<SweptDisc> pieces;
  const double low = double(slice) / params.layers, high = double(slice + 1) / params.layers;
  for (const Strand& strand : strands) {
    if (slice + 1 == params.layers) break;  // the top slice is empty by contract
    const Place place(strand.root, params.size);
    CutSlab(strand, place.rest, params.size / params.tile, low, high, &pieces);
    footprint.Cover(pieces);
    footprint.ForCovered([&](int x, int y, const Footprint::Cell& cell) {
      picture.Add(x + place.x, n - 1 - Modulo(y + place.y, n), cell, strand.tint);  // y is up, rows run down
    });
  }
  picture.Write(&volume->pixels[slice * bytes], &volume->tint[slice * bytes]);
}

}  // namespace

FurVolume BakeVolume(const CoatParams& params, std::span<const Strand> strands, uint32_t threads,
                     const BakeProgress& progress) {
  FurVolume volume{.name = "strands", .width = params.size, .height = params.size, .layers = params.layers};
  volume.pixels.resize(size_t{4} * params.size * params.size * params.layers);
  volume.tint.resize(volume.pixels.size());
  ForAll(params.layers, threads, progress, [&](uint32_t i) { BakeSlice(params, strands, i, &volume); });
  return volume;
}

Image BakeFinSlice(const CoatParams& params, std::span<const Strand> strands) {
  const uint32_t rows = std::max(1u, params.size / 2);
  Image image{.name = "fin", .width = params.size, .height = rows};
  image.pixels.resize(size_t{4} * image.width * image.height);
  const double scale = params.size / params.tile;
  Picture picture(static_cast<int>(params.size), static_cast<int>(rows));
  Footprint footprint(scale / rows);
  std::vector<SweptDisc> pieces;
  for (const Strand& strand : strands) {
    if (std::abs(Nearest(strand.root.y)) * params.tile > params.finDepth / 2) continue;
    const Place place(strand.root, params.size);
    pieces.clear();
    for (size_t i = 0; i + 1 < strand.points.size(); ++i) {
      const StrandPoint &p = strand.points[i], &q = strand.points[i + 1];
      const auto seen = [&](const dvec3& x) { return dvec2(place.rest.x + x.x * scale, x.z * scale); };
      pieces.push_back(MakePiece(p, q, 0, 1, seen(p.position), seen(q.position), scale));
    }
    footprint.Cover(pieces);
    footprint.ForCovered([&](int x, int row, const Footprint::Cell& cell) {
      if (row >= 0 && row + 1 < static_cast<int>(rows)) picture.Add(x + place.x, row, cell, strand.tint);
    });
  }
  picture.Write(image.pixels.data(), nullptr);
  return image;
}

FurVolume GrowCoat(uint32_t seed) {
  CoatParams params;
  params.seed = seed;
  return BakeVolume(params, GrowStrandList(params));
}

}  // namespace fur

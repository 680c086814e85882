#include "preset_textures.h"

#include <algorithm>
#include <cmath>

#include "fur/fur_mesh.h"

namespace fur {
namespace {

uint8_t ToByte(double value) { return uint8_t(std::lround(std::clamp(value, 0.0, 1.0) * 255)); }

struct LengthMap {
  LengthMap(const Model& model, const Material& m)
      : image(m.fur && m.fur->lengthMap >= 0 ? &model.images[size_t(m.fur->lengthMap)] : nullptr),
        wrapU(m.baseColorTexture.wrapU),
        wrapV(m.baseColorTexture.wrapV) {}
  double At(const glm::dvec2& uv) const { return SampleBilinear(*image, uv, wrapU, wrapV).r; }
  const Image* image;
  bool wrapU, wrapV;
};

// A picture as large as the larger of the colour and the length map; texel(colour, length).
template <class Texel>
Image Combine(const Image& color, const LengthMap& length, const char* name, Texel texel) {
  Image out{name, std::max(color.width, length.image->width), std::max(color.height, length.image->height), {}};
  for (uint32_t y = 0; y < out.height; ++y)
    for (uint32_t x = 0; x < out.width; ++x) {
      const glm::dvec2 uv((x + 0.5) / out.width, (y + 0.5) / out.height);
      const glm::dvec4 t = texel(SampleBilinear(color, uv, length.wrapU, length.wrapV), length.At(uv));
      for (int c = 0; c < 4; ++c) out.pixels.push_back(ToByte(t[c]));
    }
  return out;
}

void AddGrey(double value, Image* image) {
  const uint8_t grey = ToByte(value);
  image->pixels.insert(image->pixels.end(), {grey, grey, grey, 255});
}

double Coverage(const FurVolume& v, uint32_t x, uint32_t y, uint32_t slice) {
  return v.pixels[((size_t{slice} * v.height + y) * v.width + x) * 4 + 3] / 255.0;
}

}  // namespace

FurVolume WithoutTopSlice(FurVolume volume) {
  const size_t texels = size_t{volume.width} * volume.height;
  for (size_t i = texels * (volume.layers - 1); i < texels * volume.layers; ++i) volume.pixels[i * 4 + 3] = 0;
  if (!volume.tint.empty() && volume.layers > 1) {
    const auto end = volume.tint.end(), top = end - ptrdiff_t(4 * texels);
    std::copy(top - ptrdiff_t(4 * texels), top, top);
  }
  return volume;
}

Image LengthInAlpha(const Image& color, const Model& model, const Material& m) {
  const LengthMap length(model, m);
  if (!length.image) return color;
  if (length.image->width == color.width && length.image->height == color.height) {  // as Combine, at once
    Image out = color;
    for (size_t i = 0; i < out.pixels.size(); i += 4) out.pixels[i + 3] = length.image->pixels[i];
    return out;
  }
  return Combine(color, length, "colour and length",
                 [](const glm::dvec4& c, double l) { return glm::dvec4(glm::dvec3(c), l); });
}

Image FurlessSpots(const Image& color, const Model& model, const Material& m) {
  constexpr double kFadesOut = 0.1;
  const glm::dvec3 flesh(0.86, 0.62, 0.55);
  const LengthMap length(model, m);
  if (!length.image) return {"no spots", 1, 1, {0, 0, 0, 0}};
  return Combine(color, length, "furless spots", [&](const glm::dvec4& c, double l) {
    return glm::dvec4(glm::mix(glm::dvec3(c), flesh, 0.6), 1 - std::min(l / kFadesOut, 1.0));
  });
}

Image OpacityMap(const FurVolume& v) {
  std::vector<double> above;
  for (uint32_t y = 0; y < v.height; ++y)
    for (uint32_t x = 0; x < v.width; ++x) {
      double sum = 0;
      for (uint32_t slice = 0; slice < v.layers; ++slice) sum += Coverage(v, x, y, slice);
      above.push_back(sum);
    }
  // From the thinnest twentieth to the thickest: an even coat keeps its hairs.
  std::vector<double> sorted = above;
  std::sort(sorted.begin(), sorted.end());
  const double least = sorted[sorted.size() / 20] * 0.5, most = sorted[sorted.size() - 1 - sorted.size() / 50];
  Image out{"opacity map", v.width, v.height, {}};
  for (const double a : above) AddGrey(most > least ? (a - least) / (most - least) : a > 0 ? 1 : 0, &out);
  return out;
}

Image FinMap(const FurVolume& v) {
  constexpr uint32_t kRows = 64, kBand = 4;  // as many rows again stay empty: the picture wraps around
  // The densest texel of a band: a hair that leans out of one row is still seen.
  const auto at = [&](uint32_t x, uint32_t slice) {
    double most = 0;
    for (uint32_t k = 0; k < std::min(kBand, v.height); ++k)
      most = std::max(most, Coverage(v, x, v.height / 3 + k, slice));
    return most;
  };
  Image out{"fin map", v.width, 2 * kRows, {}};
  for (uint32_t row = 0; row < kRows; ++row)
    for (uint32_t x = 0; x < v.width; ++x) {
      const double slice = std::clamp((row + 0.5) / kRows * v.layers - 0.5, 0.0, v.layers - 1.0);
      const auto below = uint32_t(slice);
      AddGrey(glm::mix(at(x, below), at(x, std::min(below + 1, v.layers - 1)), slice - below), &out);
    }
  for (uint32_t i = 0; i < kRows * v.width; ++i) AddGrey(0, &out);
  return out;
}

}  // namespace fur

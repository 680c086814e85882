#include "fur/markings.h"

#include "fur/fur_mesh.h"
#include "mips.h"
#include "pattern_field.h"
#include "surface_painter.h"

namespace fur {
namespace {

using glm::dvec3;

// The model's own picture, sRGB, at the middle of texel i.
dvec3 OwnColor(const Model& model, const Material& m, uint32_t side, size_t i) {
  const TextureRef& texture = m.baseColorTexture;
  const glm::dvec2 uv((double(i % side) + 0.5) / side, (double(i / side) + 0.5) / side);
  const glm::dvec4 texel = texture.image < 0 ? glm::dvec4(1)
                                             : SampleBilinear(model.images[size_t(texture.image)], uv, texture.wrapU,
                                                              texture.wrapV);
  dvec3 color;
  for (int k = 0; k < 3; ++k) color[k] = LinearToSrgb(SrgbToLinear(texel[k]) * double(m.baseColor[k]));
  return color;
}

}  // namespace

Image PaintMarkings(const Model& model, const Body& body, uint32_t material, const Markings& markings) {
  std::vector<PatternField> fields;
  for (const MarkingLayer& layer : markings.layers) fields.emplace_back(layer, body);
  const auto color = [&](const Place& at) {
    dvec3 c = markings.base;
    for (size_t i = 0; i < fields.size(); ++i) c = glm::mix(c, markings.layers[i].color, fields[i].Weight(at));
    return c;
  };
  Image image = PaintSurface(model, body, material, markings.size, markings.base, color);
  if (markings.overBase == 1) return image;
  const Material& m = model.materials[material];
  for (size_t i = 0; i < image.pixels.size() / 4; ++i) {
    const dvec3 own = OwnColor(model, m, image.width, i);
    for (size_t k = 0; k < 3; ++k) {
      uint8_t& byte = image.pixels[i * 4 + k];
      byte = uint8_t(glm::mix(own[int(k)] * 255, double(byte), markings.overBase) + 0.5);
    }
  }
  return image;
}

}  // namespace fur

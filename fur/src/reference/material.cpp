#include "material.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "fur/groom.h"
#include "mips.h"

namespace fur::reference {
namespace {

constexpr double kMostCoverage = 0.999;
constexpr double kWrap = 0.5;           // of the wrapped cosine
constexpr double kScattered = 0.5;      // share of diffuse light that no longer knows the strand's direction
constexpr double kMeanSine = std::numbers::pi / 4;
constexpr double kSeedPower = 10;       // the demo's highlight on skin

glm::dvec3 UnitOr(const glm::dvec3& v, const glm::dvec3& fallback) {
  const double size = glm::dot(v, v);
  return size > 1e-20 ? v / std::sqrt(size) : fallback;
}

double Sine(double cosine) { return std::sqrt(std::max(0.0, 1 - cosine * cosine)); }

glm::dvec3 UnpackStrand(const glm::dvec3& packed) {
  const glm::dvec3 t = packed * 2.0 - 1.0;
  return glm::dot(t, t) < 1.0 / 4096 ? glm::dvec3(0, 0, 1) : glm::normalize(t);
}

// Look seed multiplies the colour factor into the texels, in raw values.
Texture ColorTexture(const Model& model, const Material& m, Look look) {
  const int32_t index = m.baseColorTexture.image;
  Image image = index < 0 ? Image{"white", 1, 1, {255, 255, 255, 255}} : model.images[size_t(index)];
  if (look == Look::Seed)
    for (size_t i = 0; i < image.pixels.size(); ++i)
      if (i % 4 != 3) {
        const double factor = std::clamp(LinearToSrgb(m.baseColor[int(i % 4)]), 0.0, 1.0);
        image.pixels[i] = uint8_t(std::lround(image.pixels[i] * factor));
      }
  Texture texture(std::move(image), look == Look::Correct);
  texture.SetWrap(m.baseColorTexture.wrapU, m.baseColorTexture.wrapV);
  return texture;
}

// All maps of a material are read through the colour's sampler.
Texture MapTexture(const Model& model, const Material& m, int32_t image, bool srgb) {
  Texture texture = image < 0 ? Texture() : Texture(model.images[size_t(image)], srgb);
  texture.SetWrap(m.baseColorTexture.wrapU, m.baseColorTexture.wrapV);
  return texture;
}

glm::dvec3 Factor(const Material& m, Look look) {
  return look == Look::Correct ? glm::dvec3(m.baseColor) : glm::dvec3(1);
}

}  // namespace

Lighting::Lighting(const ReferenceSettings& s)
    : look(s.look), light(s.light), travel(UnitOr(s.light.direction, {0, -1, 0})) {}

Coat::Coat(const Model& model, const Material& m, Look look)
    : volume_(m.fur->params.thickness == 1 ? model.volumes[size_t(m.fur->volume)]
                                           : Thickened(model.volumes[size_t(m.fur->volume)], m.fur->params.thickness)),
      params_(m.fur->params),
      falloff_(look == Look::Seed ? 1 : m.fur->params.heightFalloff),  // the demo's shells, whatever the volume holds
      color_(ColorTexture(model, m, look)),
      length_(MapTexture(model, m, m.fur->lengthMap, false)),
      factor_(Factor(m, look)),
      hasLengthMap_(m.fur->lengthMap >= 0) {
  const size_t texels = size_t(volume_.width) * volume_.height;
  const uint32_t filled = volume_.layers - (look == Look::Correct ? 1 : 0);  // the top slice is emptied
  coverage_.resize(texels * volume_.layers, 0);
  for (size_t layer = 0; layer < filled; ++layer)
    for (size_t i = 0; i < texels; ++i)
      coverage_[i * volume_.layers + layer] = volume_.pixels[(layer * texels + i) * 4 + 3];
  // The emptied slice has no colours of its own.
  const size_t top = 4 * texels * (volume_.layers - 1);
  for (size_t i = top; top > 0 && i < volume_.tint.size(); ++i)
    volume_.tint[i] = volume_.tint[i - 4 * texels];
}

double Coat::Texels(const glm::dvec2& tiles) const {
  return std::max(std::abs(tiles.x) * volume_.width, std::abs(tiles.y) * volume_.height);
}

double Coat::Density(const glm::dvec2& uv, const glm::dvec2& tiles, double h, double length) const {
  const uint32_t n = volume_.layers;
  const double z = std::clamp(h * n - 0.5, 0.0, double(n - 1));
  const auto below = uint32_t(z), above = std::min(below + 1, n - 1);
  const Cell u = CellAt(tiles.x, volume_.width, true), v = CellAt(tiles.y, volume_.height, true);
  const double part = z - below;
  const auto column = [&](uint32_t x, uint32_t y) {
    const uint8_t* p = &coverage_[(size_t(y) * volume_.width + x) * n];
    return p[below] * (1 - part) + p[above] * part;
  };
  const double low = column(u.x0, v.x0) * (1 - u.fraction) + column(u.x1, v.x0) * u.fraction;
  const double high = column(u.x0, v.x1) * (1 - u.fraction) + column(u.x1, v.x1) * u.fraction;
  const double filtered = (low * (1 - v.fraction) + high * v.fraction) / 255;
  const double a = std::min(filtered * (1 - falloff_ * z / n), kMostCoverage);
  if (!(a > 0) || (hasLengthMap_ && h * length > length_.Red(uv))) return 0;
  return -double(n) * params_.density * std::log(1 - a);
}

glm::dvec3 Coat::Filtered(const std::vector<uint8_t>& pixels, const glm::dvec2& tiles, double h) const {
  const uint32_t n = volume_.layers;
  const double z = std::clamp(h * n - 0.5, 0.0, double(n - 1));
  const auto below = uint32_t(z), above = std::min(below + 1, n - 1);
  const Cell u = CellAt(tiles.x, volume_.width, true), v = CellAt(tiles.y, volume_.height, true);
  const auto texel = [&](uint32_t x, uint32_t y, uint32_t layer) {
    const uint8_t* p = &pixels[((size_t(layer) * volume_.height + y) * volume_.width + x) * 4];
    return glm::dvec3(p[0], p[1], p[2]);
  };
  const auto slice = [&](uint32_t layer) {
    const glm::dvec3 low = texel(u.x0, v.x0, layer) * (1 - u.fraction) + texel(u.x1, v.x0, layer) * u.fraction;
    const glm::dvec3 high = texel(u.x0, v.x1, layer) * (1 - u.fraction) + texel(u.x1, v.x1, layer) * u.fraction;
    return low * (1 - v.fraction) + high * v.fraction;
  };
  return (slice(below) * (1 - (z - below)) + slice(above) * (z - below)) / 255.0;
}

glm::dvec3 Coat::Own(const glm::dvec2& tiles, double h) const {
  if (volume_.tint.empty()) return glm::dvec3(1);
  return 1.0 + (Filtered(volume_.tint, tiles, h) * (255.0 / 128) - 1.0) * params_.tint;
}

// docs/fur.md, "Colour".
glm::dvec3 Coat::Albedo(Look look, const glm::dvec2& uv, const glm::dvec2& tiles, double h) const {
  glm::dvec3 albedo = color_.Rgb(uv) * factor_;
  const bool groomed = IsGroomed(params_), own = look == Look::Correct && !volume_.tint.empty();
  if (groomed)
    albedo = glm::mix(glm::dvec3(1), albedo, params_.colorFromBase) * glm::mix(params_.rootColor, params_.tipColor, h);
  if (own) albedo *= Own(tiles, h);
  return groomed || own ? glm::min(albedo, glm::dvec3(1)) : albedo;
}

glm::dvec3 Coat::Shade(const Lighting& lit, const glm::dvec3& ray, const FurFrame& frame, const glm::dvec2& uv,
                       const glm::dvec2& tiles, double h) const {
  const glm::dvec3 albedo = Albedo(lit.look, uv, tiles, h);
  const glm::dvec3 normal = UnitOr(frame.normal, {0, 0, 1}), axis = UnitOr(frame.direction, normal);
  const glm::dvec3 tangent = UnitOr(frame.tangent - axis * glm::dot(frame.tangent, axis), {1, 0, 0});
  // The demo's frames are right-handed everywhere.
  const bool flipped = lit.look == Look::Correct && frame.handedness < 0;
  const glm::dvec3 bitangent = glm::cross(axis, tangent) * (flipped ? -1.0 : 1.0);
  const glm::dvec3 s = UnpackStrand(Filtered(volume_.pixels, tiles, h));
  const glm::dvec3 strand = UnitOr(tangent * s.x + bitangent * s.y + axis * s.z, axis);
  const Light& light = lit.light;
  const double r0 = params_.selfShadow;
  if (lit.look == Look::Seed) {
    const double tl = glm::dot(strand, lit.travel), te = glm::dot(strand, ray);
    const double lobe = std::pow(std::abs(tl * te + Sine(tl) * Sine(te)), params_.specularPower);
    const glm::dvec3 color = light.ambient * albedo + light.diffuse * albedo * (1 - Sine(tl)) +
                             light.specular * (lobe * params_.specularScale);
    const double height = std::max(h - 0.5 / volume_.layers, 0.0);
    return color * (height * (1 - r0) + r0);
  }
  const double tl = -glm::dot(strand, lit.travel), te = -glm::dot(strand, ray);
  const double facing = std::clamp((kWrap - glm::dot(normal, lit.travel)) / (1 + kWrap), 0.0, 1.0);
  const double cosine = std::max(0.0, Sine(tl) * Sine(te) - tl * te);
  const double lobe = facing > 0 ? std::pow(cosine, params_.specularPower) * facing : 0;
  const double diffuse = glm::mix(Sine(tl), kMeanSine, kScattered);
  const glm::dvec3 direct =
      light.diffuse * albedo * (diffuse * facing) + light.specular * (lobe * params_.specularScale);
  return (light.ambient * albedo + direct) * (r0 + (1 - r0) * h);
}

Skin::Skin(const Model& model, const Material& m, Look look)
    : color_(ColorTexture(model, m, look)),
      normal_(MapTexture(model, m, m.normalTexture.image, false)),
      specular_(MapTexture(model, m, m.specularTexture.image, look == Look::Correct)),
      factor_(Factor(m, look)),
      gloss_(glm::dvec3(m.specularColor) * (m.specularTexture.image >= 0 ? 1.0 : 0.5 * (1 - double(m.roughness)))),
      power_(look == Look::Seed ? kSeedPower
                                : std::clamp(2 / std::pow(std::max(double(m.roughness), 0.05), 4) - 2, 2.0, 256.0)),
      normalScale_(double(m.normalScale)),
      hasNormalMap_(m.normalTexture.image >= 0),
      doubleSided_(m.doubleSided) {}

glm::dvec3 Skin::ShadingNormal(Look look, const SkinFrame& frame, const glm::dvec2& uv) const {
  // A flat map is not quite flat: 128 / 255 is not a half. Look seed reads it, look correct leaves it out.
  const glm::dvec3 packed = hasNormalMap_ ? normal_.Rgb(uv) : glm::dvec3(128, 128, 255) / 255.0;
  const glm::dvec3 n = UnitOr(frame.normal, {0, 0, 1});
  glm::dvec3 t = packed * 2.0 - 1.0;
  if (look == Look::Seed) {  // the demo turns green around and does not normalise the frame
    t = UnitOr({t.x, -t.y, t.z}, {0, 0, 1});
    return UnitOr(frame.tangent * t.x + glm::cross(frame.normal, frame.tangent) * t.y + frame.normal * t.z, n);
  }
  if (!hasNormalMap_) return n;
  const glm::dvec3 tangent = UnitOr(frame.tangent, {1, 0, 0});
  t = {t.x * normalScale_, t.y * normalScale_, t.z};
  return UnitOr(tangent * t.x + glm::cross(n, tangent) * (frame.handedness * t.y) + n * t.z, n);
}

glm::dvec3 Skin::Shade(const Lighting& lit, const glm::dvec3& ray, const SkinFrame& frame, const glm::dvec2& uv) const {
  const glm::dvec3 albedo = color_.Rgb(uv) * factor_, gloss = specular_.Rgb(uv) * gloss_;
  const glm::dvec3 n = ShadingNormal(lit.look, frame, uv), halfway = UnitOr(-lit.travel - ray, n);
  const double diffuse = std::max(0.0, -glm::dot(n, lit.travel));
  const bool shines = lit.look == Look::Seed || diffuse > 0;
  const double highlight = shines ? std::pow(std::max(0.0, glm::dot(n, halfway)), power_) : 0;
  const glm::dvec3 color = lit.light.ambient * albedo + lit.light.diffuse * albedo * diffuse +
                           lit.light.specular * gloss * highlight;
  return glm::clamp(color, glm::dvec3(0), glm::dvec3(1));
}

}  // namespace fur::reference

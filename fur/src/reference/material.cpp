#include "material.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "clump.h"
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
  return size > 1e-20 ? v * (1 / std::sqrt(size)) : fallback;
}

double Sine(double cosine) { return std::sqrt(std::max(0.0, 1 - cosine * cosine)); }

// Highlights have whole exponents more often than not, and std::pow takes several times as long.
double Power(double base, double exponent) {
  if (exponent != std::floor(exponent) || !(exponent >= 0 && exponent < 256)) return std::pow(base, exponent);
  double power = 1;
  for (auto left = uint32_t(exponent); left > 0; left >>= 1, base *= base)
    if (left & 1) power *= base;
  return power;
}

// Not unit: what follows only asks for the direction.
glm::dvec3 UnpackStrand(const glm::dvec3& packed) {
  const glm::dvec3 t = packed * 2.0 - 1.0;
  return glm::dot(t, t) < 1.0 / 4096 ? glm::dvec3(0, 0, 1) : t;
}

// Wet fur and the skin under it.
glm::dvec3 Darkened(const glm::dvec3& albedo, double exponent) {
  return exponent == 1 ? albedo : glm::pow(glm::clamp(albedo, 0.0, 1.0), glm::dvec3(exponent));
}

FurVolume Thick(const FurVolume& volume, double thickness) {
  return thickness == 1 ? volume : Thickened(volume, thickness);
}

// What the light and the clumps see of wetness; docs/fur.md.
FurParams Wet(FurParams p) {
  p.clumping = WetClumping(p.clumping, p.wetness);
  p.specularScale = WetSpecularScale(p.specularScale, p.wetness);
  p.specularPower = WetSpecularPower(p.specularPower, p.wetness);
  return p;
}

double DarkeningOf(const Material& m) {
  return m.fur && m.fur->params.enabled ? WetDarkening(m.fur->params.wetness) : 1;
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
    : volume_(Thick(model.volumes[size_t(m.fur->volume)], m.fur->params.thickness), look == Look::Correct),
      params_(Wet(m.fur->params)),
      length_(WetLength(m.fur->params.length, m.fur->params.wetness)),
      falloff_(look == Look::Seed ? 1 : m.fur->params.heightFalloff),  // the demo's shells, whatever the volume holds
      darkening_(WetDarkening(m.fur->params.wetness)),
      groomed_(IsGroomed(m.fur->params)),
      color_(ColorTexture(model, m, look)),
      lengths_(MapTexture(model, m, m.fur->lengthMap, false)),
      factor_(Factor(m, look)),
      hasLengthMap_(m.fur->lengthMap >= 0) {}

FurPlace Coat::PlaceAt(const glm::dvec2& tiles, double h) const {
  FurPlace place;
  const bool clumps = params_.clumping > 0;
  const Clump clump = clumps ? ClumpAt(tiles, h, params_.clumping) : Clump{};
  place.root = clumps ? clump.root : tiles;
  const VolumeCell cell = volume_.CellOf(place.root, h);
  const glm::dvec4 read = volume_.Strands(cell);
  place.strand = UnpackStrand(glm::dvec3(read));
  if (clumps) place.strand += glm::dvec3(clump.lean * place.strand.z, 0);
  const double n = volume_.Slices(), slice = cell.below + cell.part;
  const double a = std::min(read.a * (1 - falloff_ * slice / n), kMostCoverage) * clump.inside;
  // Strands that stand closer together are more of them on the way of light.
  if (a > 0) place.density = -n * params_.density * (clump.spread * clump.spread) * std::log(1 - a);
  return place;
}

double Coat::LeastLength(const glm::dvec2& low, const glm::dvec2& high) const {
  return hasLengthMap_ ? lengths_.LeastRed(low, high) : std::numeric_limits<double>::infinity();
}

// docs/fur.md, "Colour".
glm::dvec3 Coat::Albedo(Look look, const glm::dvec2& uv, const FurPlace& place, double h) const {
  glm::dvec3 albedo = color_.Rgb(uv) * factor_;
  const bool own = look == Look::Correct && volume_.HasTint();
  if (groomed_)
    albedo = glm::mix(glm::dvec3(1), albedo, params_.colorFromBase) * glm::mix(params_.rootColor, params_.tipColor, h);
  if (own) albedo *= 1.0 + (volume_.Tint(volume_.CellOf(place.root, h)) * (255.0 / 128) - 1.0) * params_.tint;
  if (groomed_ || own) albedo = glm::min(albedo, glm::dvec3(1));
  return Darkened(albedo, darkening_);
}

glm::dvec3 Coat::Shade(const Lighting& lit, const glm::dvec3& ray, const FurFrame& frame, const glm::dvec2& uv,
                       const FurPlace& place, double h) const {
  const glm::dvec3 albedo = Albedo(lit.look, uv, place, h);
  const glm::dvec3 normal = UnitOr(frame.normal, {0, 0, 1}), axis = UnitOr(frame.direction, normal);
  const glm::dvec3 tangent = UnitOr(frame.tangent - axis * glm::dot(frame.tangent, axis), {1, 0, 0});
  // The demo's frames are right-handed everywhere.
  const bool flipped = lit.look == Look::Correct && frame.handedness < 0;
  const glm::dvec3 bitangent = glm::cross(axis, tangent) * (flipped ? -1.0 : 1.0);
  const glm::dvec3& s = place.strand;
  const glm::dvec3 strand = UnitOr(tangent * s.x + bitangent * s.y + axis * s.z, axis);
  const Light& light = lit.light;
  const double r0 = params_.selfShadow;
  if (lit.look == Look::Seed) {
    const double tl = glm::dot(strand, lit.travel), te = glm::dot(strand, ray);
    const double lobe = Power(std::abs(tl * te + Sine(tl) * Sine(te)), params_.specularPower);
    const glm::dvec3 color = light.ambient * albedo + light.diffuse * albedo * (1 - Sine(tl)) +
                             light.specular * (lobe * params_.specularScale);
    const double height = std::max(h - 0.5 / volume_.Slices(), 0.0);
    return color * (height * (1 - r0) + r0);
  }
  const double tl = -glm::dot(strand, lit.travel), te = -glm::dot(strand, ray);
  const double facing = std::clamp((kWrap - glm::dot(normal, lit.travel)) / (1 + kWrap), 0.0, 1.0);
  const double sine = Sine(tl), cosine = std::max(0.0, sine * Sine(te) - tl * te);
  const double lobe = facing > 0 ? Power(cosine, params_.specularPower) * facing : 0;
  const double diffuse = glm::mix(sine, kMeanSine, kScattered);
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
      darkening_(DarkeningOf(m)),
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
  const glm::dvec3 albedo = Darkened(color_.Rgb(uv) * factor_, darkening_), gloss = specular_.Rgb(uv) * gloss_;
  const glm::dvec3 n = ShadingNormal(lit.look, frame, uv), halfway = UnitOr(-lit.travel - ray, n);
  const double diffuse = std::max(0.0, -glm::dot(n, lit.travel));
  const bool shines = lit.look == Look::Seed || diffuse > 0;
  const double highlight = shines ? std::pow(std::max(0.0, glm::dot(n, halfway)), power_) : 0;
  const glm::dvec3 color = lit.light.ambient * albedo + lit.light.diffuse * albedo * diffuse +
                           lit.light.specular * gloss * highlight;
  return glm::clamp(color, glm::dvec3(0), glm::dvec3(1));
}

}  // namespace fur::reference

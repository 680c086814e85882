#include "fur/groom.h"

#include <algorithm>
#include <cmath>

#include "fur/fur_mesh.h"

namespace fur {
namespace {

// Offsets are relative to the fur's length: they follow the rotation alone. A part that is flattened to nothing has none.
glm::dvec3 ToAxesOf(const glm::dmat4& transform, const glm::dvec3& v) {
  const glm::dmat3 linear(transform);
  const double volume = std::abs(glm::determinant(linear));
  const glm::dvec3 turned = glm::inverse(linear) * v * std::cbrt(volume);
  return volume > 0 && std::isfinite(turned.x + turned.y + turned.z) ? turned : glm::dvec3(0);
}

glm::dvec3 UnitOrZero(const glm::dvec3& v) {
  const double length = glm::length(v);
  return length > 0 ? v / length : glm::dvec3(0);
}

double SineOfTurns(double turns) { return std::sin(2 * 3.14159265358979323846 * turns); }

void AddWind(const FurParams& p, const glm::dmat4& toWorld, double time, FurSway* sway) {
  const glm::dvec3 along = UnitOrZero(p.wind);
  if (p.windStrength == 0 || along == glm::dvec3(0)) return;
  const glm::dvec3 wave = along / p.windLength;
  sway->wind = ToAxesOf(toWorld, along * p.windStrength);
  sway->wave = glm::transpose(glm::dmat3(toWorld)) * wave;
  const double waves = p.windFrequency * time - glm::dot(wave, glm::dvec3(toWorld[3]));
  sway->phase = waves - kWavesOfAGust * std::floor(waves / kWavesOfAGust);
}

}  // namespace

FurSway MakeFurSway(const FurParams& p, const glm::dmat4& placement, const glm::dmat4& partToModel, double time,
                    const glm::dvec3& inertia) {
  const glm::dmat4 toWorld = placement * partToModel;
  FurSway sway;
  sway.comb = ToAxesOf(partToModel, UnitOrZero(p.comb) * p.combStrength);
  if (inertia != glm::dvec3(0)) sway.comb += ToAxesOf(toWorld, inertia);
  sway.bend = p.bend;
  if (p.gravity > 0) sway.gravity = ToAxesOf(toWorld, {0, -p.gravity, 0});
  AddWind(p, toWorld, time, &sway);
  return sway;
}

double WindAt(const FurSway& s, const glm::dvec3& position) {
  const double turns = glm::dot(s.wave, position) - s.phase;
  return (0.5 + 0.5 * SineOfTurns(turns)) * (0.625 + 0.375 * SineOfTurns(turns / kWavesOfAGust));
}

glm::dvec3 TipOffset(const FurSway& s, const glm::dvec3& position, const glm::dvec3& direction) {
  return s.comb + s.wind * WindAt(s, position) + s.gravity - direction * glm::dot(s.gravity, direction);
}

glm::dvec3 FurPoint(const FurSway& s, const glm::dvec3& position, const glm::dvec3& direction, double length,
                    double height) {
  return position + (direction * height + TipOffset(s, position, direction) * std::pow(height, s.bend)) * length;
}

double WetLength(double length, double w) { return length * (1 - 0.35 * w); }
double WetDarkening(double w) { return 1 + w; }
double WetSpecularScale(double scale, double w) { return scale * (1 + 3 * w); }
double WetSpecularPower(double power, double w) { return power * (1 + 2 * w); }
double WetClumping(double clumping, double w) { return std::max(clumping, w); }

FurVolume Thickened(FurVolume volume, double thickness) {
  for (size_t i = 3; i < volume.pixels.size(); i += 4)
    volume.pixels[i] = uint8_t(std::lround(255 * std::pow(volume.pixels[i] / 255.0, 1 / thickness)));
  return volume;
}

Image WithoutFurless(const Image* length, const Image& furless) {
  Image out{furless.name, furless.width, furless.height, {}};
  if (length) {
    out.name = length->name + " without " + furless.name;
    out.width = std::max(out.width, length->width);
    out.height = std::max(out.height, length->height);
  }
  for (uint32_t y = 0; y < out.height; ++y)
    for (uint32_t x = 0; x < out.width; ++x) {
      const size_t fx = size_t{x} * furless.width / out.width, fy = size_t{y} * furless.height / out.height;
      const bool bald = furless.pixels[(fy * furless.width + fx) * 4] <= 127;
      const glm::dvec2 uv((x + 0.5) / out.width, (y + 0.5) / out.height);
      const double relative = length ? SampleBilinear(*length, uv, false, false).r : 1;
      const auto red = uint8_t(bald ? 0 : std::lround(255 * relative));
      out.pixels.insert(out.pixels.end(), {red, red, red, 255});
    }
  return out;
}

bool IsGroomed(const FurParams& p) {
  return p.density != 1 || p.clumping > 0 || p.wetness > 0 || p.colorFromBase != 1 || p.rootColor != glm::dvec3(1) ||
         p.tipColor != glm::dvec3(1);
}

}  // namespace fur

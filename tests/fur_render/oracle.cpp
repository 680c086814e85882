#include "oracle.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "fur/fur_mesh.h"

namespace fur::test {
namespace {

constexpr double kSeedPower = 10;

// A texture's flat normal is not quite flat: 128 / 255 is not a half. The published shader reads it raw.
glm::dvec3 SeedFlatNormal() {
  const double off = 2 * 128 / 255.0 - 1;
  return glm::normalize(glm::dvec3(off, -off, 1));  // green-up asset, green-down shader
}

glm::dvec3 Albedo(const SquareScene& s) {
  glm::dvec3 raw(s.color[0] / 255.0, s.color[1] / 255.0, s.color[2] / 255.0);
  return s.look == Look::Seed ? raw : glm::dvec3(Decode(raw.x), Decode(raw.y), Decode(raw.z));
}

// Linear between two slices, at slice z; fewer shells than slices have slices of their own, of 8 bits.
double AsKept(const SquareScene& s, int below, int above, double z) {
  const double byte = below + (above - below) * (z - std::floor(z));
  return s.shells < s.coat.slices.size() ? std::nearbyint(byte) : byte;
}

// Between slices; the top one is emptied.
double CoverageAt(const SquareScene& s, double z) {
  const auto at = [&](size_t slice) {
    const bool emptied = s.look == Look::Correct && slice == s.coat.slices.size() - 1;
    return emptied ? 0 : s.coat.slices[slice][3] / 255.0;
  };
  const auto below = size_t(z);
  return at(below) + (at(std::min(below + 1, s.coat.slices.size() - 1)) - at(below)) * (z - double(below));
}

// Of fewer shells than slices: that of the slab, by docs/accuracy.md, in the same steps since the bytes are to be the same.
double KeptCoverage(const SquareScene& s, uint32_t shell, double falloff) {
  const auto slices = double(s.coat.slices.size());
  const double size = slices / s.shells, steps = 16 * std::ceil(size);
  const auto place = [&](double share) { return std::clamp((shell + share) * size - 0.5, 0.0, slices - 1); };
  double depth = 0;
  for (double k = 0; k < steps; ++k) {
    const double z = place((k + 0.5) / steps);
    depth -= std::log(1 - std::min(CoverageAt(s, z) * (1 - falloff * z / slices), 0.999)) / steps;
  }
  return std::nearbyint(std::min((1 - std::exp(-depth)) / (1 - falloff * place(0.5) / slices), 1.0) * 255) / 255.0;
}

// The strands' own factor, linear between slices; the emptied one is as the one below it.
glm::dvec3 OwnColor(const SquareScene& s, double height) {
  const std::vector<Texel>& t = s.coat.tints;
  if (t.empty() || s.look == Look::Seed) return glm::dvec3(1);
  const double z = std::clamp(height * double(t.size()) - 0.5, 0.0, double(t.size() - 1));
  const size_t last = t.size() - 2, below = std::min(size_t(z), last), above = std::min(size_t(z) + 1, last);
  glm::dvec3 own;
  for (int c = 0; c < 3; ++c)
    own[c] = AsKept(s, t[below][size_t(c)], t[above][size_t(c)], z) / 128.0;
  return glm::mix(glm::dvec3(1), own, s.groom.tint);
}

// docs/fur.md: white where the base does not count, the gradient, the strands' own colours, the
// darkening of wet fur.
glm::dvec3 FurAlbedo(const SquareScene& s, double height) {
  const FurParams& g = s.groom;
  const glm::dvec3 base = glm::mix(glm::dvec3(1), Albedo(s), g.colorFromBase);
  const glm::dvec3 rho = glm::clamp(base * glm::mix(g.rootColor, g.tipColor, height) * OwnColor(s, height), 0.0, 1.0);
  return glm::pow(rho, glm::dvec3(1 + g.wetness));
}

// docs/fur.md: a clump, written once more.
struct Clumped {
  double spread = 1, inside = 1;
  glm::dvec2 lean{0};
};

uint32_t Scramble(uint32_t h) {
  h = (h ^ (h >> 16)) * 0x7feb352du;
  h = (h ^ (h >> 15)) * 0x846ca68bu;
  return h ^ (h >> 16);
}

glm::dvec2 Site(int x, int y) {
  const uint32_t h = Scramble(uint32_t(x) + Scramble(uint32_t(y)));
  return glm::dvec2(x, y) + 0.25 + glm::dvec2(h & 0xffff, h >> 16) * (0.5 / 65536);
}

Clumped ClumpAt(const SquareScene& s, const glm::dvec3& ray, double h) {
  const double clumping = std::max(s.groom.clumping, s.groom.wetness);
  if (clumping == 0) return {};
  const double length = s.coat.length * (1 - 0.35 * s.groom.wetness);
  const glm::dvec3 at = s.eye + ray * ((h * length - s.eye.z) / ray.z);
  const glm::dvec2 p = 4.0 * (s.tilesAtOrigin + s.tilesForX * at.x + s.tilesForY * at.y);
  std::vector<glm::dvec2> sites;
  for (int y = -2; y <= 2; ++y)  // wider than the shader looks
    for (int x = -2; x <= 2; ++x) sites.push_back(Site(int(std::floor(p.x)) + x, int(std::floor(p.y)) + y));
  const glm::dvec2 own = *std::min_element(sites.begin(), sites.end(), [&](const glm::dvec2& a, const glm::dvec2& b) {
    return glm::length(a - p) < glm::length(b - p);
  });
  Clumped c;
  c.spread = 1 / (1 - 0.75 * clumping * h * h);
  const glm::dvec2 root = own + (p - own) * c.spread;
  for (const glm::dvec2& other : sites)
    if (other != own)
      c.inside = std::min(c.inside, 1 + 8 * glm::dot(root - (own + other) / 2.0, glm::normalize(own - other)));
  c.inside = std::max(c.inside, 0.0);
  c.lean = (own - root) * glm::dvec2(1, -1) * (2 * 0.75 * clumping * h * 4 / 4.0);
  return c;
}

// The strand's direction: the square's tangent frame is the world's.
glm::dvec3 Strand(const SquareScene& s, const Texel& texel) {
  const glm::dvec3 t = glm::dvec3(texel[0], texel[1], texel[2]) / 255.0 * 2.0 - 1.0;
  if (s.look == Look::Correct && glm::length(t) < 1.0 / 64) return {0, 0, 1};
  return glm::normalize(t);
}

// Habr's: 1 - sin(T,L) for the diffuse light, both vectors along their rays.
glm::dvec3 SeedShading(const SquareScene& s, const glm::dvec3& ray, const glm::dvec3& strand, double height) {
  const double toLight = std::acos(glm::dot(strand, glm::normalize(s.light.direction)));
  const double toEye = std::acos(glm::dot(strand, ray));
  // cos a cos b + sin a sin b = cos(a - b)
  const double lobe = std::pow(std::abs(std::cos(toLight - toEye)), s.coat.specularPower);
  const glm::dvec3 lit = Albedo(s) * (s.light.ambient + s.light.diffuse * (1 - std::sin(toLight))) +
                         s.light.specular * (lobe * s.coat.specularScale);
  return lit * glm::mix(s.coat.selfShadow, 1.0, height);
}

// Kajiya and Kay with a wrapped cosine; half of the diffuse light comes by way of other strands, with the mean of the
// sine over all directions, pi / 4.
glm::dvec3 CorrectShading(const SquareScene& s, const glm::dvec3& ray, const glm::dvec3& strand, double height) {
  constexpr double kWrap = 0.5;
  const glm::dvec3 l = -glm::normalize(s.light.direction);
  const double toLight = std::acos(glm::dot(strand, l)), toEye = std::acos(glm::dot(strand, -ray));
  const double wrapped = std::clamp((l.z + kWrap) / (1 + kWrap), 0.0, 1.0);
  // sin a sin b - cos a cos b = -cos(a + b)
  const double lobe = std::pow(std::max(0.0, -std::cos(toLight + toEye)), s.coat.specularPower * (1 + 2 * s.groom.wetness));
  const glm::dvec3 rho = FurAlbedo(s, height);
  const glm::dvec3 direct = rho * s.light.diffuse * (0.5 * std::sin(toLight) + std::numbers::pi / 8) +
                            s.light.specular * (lobe * s.coat.specularScale * (1 + 3 * s.groom.wetness));
  return (rho * s.light.ambient + direct * wrapped) * glm::mix(s.coat.selfShadow, 1.0, height);
}

double ShellOpacity(const SquareScene& s, const glm::dvec3& ray, uint32_t slice, double height) {
  const auto slices = uint32_t(s.coat.slices.size());
  double a = s.coat.slices[slice][3] / 255.0;
  if (s.look == Look::Correct && slice == slices - 1) return 0;  // the top slice is emptied
  if (a < 0.01) return 0;                                        // published: discarded
  if (s.look == Look::Seed) a *= 1 - height;
  if (s.semantics == Semantics::Sheet) return a;
  const double least = 0.25 / std::sqrt(double(s.shells));
  return 1 - std::pow(1 - std::min(a, 0.999), 1 / std::max(std::abs(ray.z), least));
}

glm::dvec3 Clamped(const glm::dvec3& c) { return glm::clamp(c, glm::dvec3(0), glm::dvec3(1)); }

}  // namespace

double Decode(double e) { return e <= 0.04045 ? e / 12.92 : std::pow((e + 0.055) / 1.055, 2.4); }
double Encode(double l) { return l <= 0.0031308 ? l * 12.92 : 1.055 * std::pow(l, 1 / 2.4) - 0.055; }

Model GroomedSquare(SquareScene* scene) {
  constexpr double kHalf = 40;
  Model model = FurredSquare(kHalf, scene->color, scene->coat);
  FurParams& params = model.materials[0].fur->params;
  const FurParams coat = params;
  params = scene->groom;
  params.length = coat.length;
  params.layerUvScale = 40;
  params.selfShadow = coat.selfShadow;
  params.specularPower = coat.specularPower;
  params.specularScale = coat.specularScale;
  const std::vector<FurVertex> v = MakeFurMeshes(model, FurTiling::Isometric)[0].vertices;
  const auto tiles = [&](size_t i) { return glm::dvec2(v[i].furUv.x, v[i].furUv.y); };
  scene->tangent = glm::dvec3(v[0].tangent);
  scene->tilesForX = (tiles(1) - tiles(0)) / (2 * kHalf);
  scene->tilesForY = (tiles(3) - tiles(0)) / (2 * kHalf);
  scene->tilesAtOrigin = (tiles(0) + tiles(2)) / 2.0;
  return model;
}

glm::dvec3 RayThrough(const Camera& camera, uint32_t width, uint32_t height, uint32_t x, uint32_t y) {
  const glm::dvec3 forward = glm::normalize(camera.target - camera.eye);
  const glm::dvec3 right = glm::normalize(glm::cross(forward, camera.up)), up = glm::cross(right, forward);
  const double pixel = 2 * std::tan(glm::radians(camera.fovY) / 2) / height;
  return glm::normalize(forward + right * ((x + 0.5 - width / 2.0) * pixel) + up * ((height / 2.0 - y - 0.5) * pixel));
}

glm::dvec3 GlossySkinColor(const SquareScene& s, const glm::dvec3& ray, const glm::dvec3& gloss, double power) {
  const glm::dvec3 n = s.look == Look::Seed ? SeedFlatNormal() : glm::dvec3(0, 0, 1);
  const glm::dvec3 l = -glm::normalize(s.light.direction), h = glm::normalize(l - ray);
  const double diffuse = std::max(0.0, glm::dot(n, l));
  const bool shines = s.look == Look::Seed || diffuse > 0;
  const double highlight = shines ? std::pow(std::max(0.0, glm::dot(n, h)), power) : 0;
  const glm::dvec3 rho = glm::pow(Albedo(s), glm::dvec3(1 + s.groom.wetness));
  return Clamped(rho * (s.light.ambient + s.light.diffuse * diffuse) + s.light.specular * gloss * highlight);
}

glm::dvec3 SkinColor(const SquareScene& s, const glm::dvec3& ray) {
  return GlossySkinColor(s, ray, glm::dvec3(0), kSeedPower);
}

glm::dvec4 ShellColor(const SquareScene& s, const glm::dvec3& ray, uint32_t shell) {
  const double slices = double(s.coat.slices.size());
  const double layer = shell * slices / s.shells, height = layer / slices;
  const auto slice = uint32_t(std::min(std::floor(layer + 0.5), slices - 1));
  const glm::dvec3 strand = Strand(s, s.coat.slices[slice]);
  const glm::dvec3 color =
      s.look == Look::Seed ? SeedShading(s, ray, strand, height) : CorrectShading(s, ray, strand, height);
  return glm::dvec4(Clamped(color), ShellOpacity(s, ray, slice, height));
}

// Slices as the technique reads them: linear between their middles (j + 1/2) / N0, clamped at the ends.
glm::dvec4 MidpointShell(const SquareScene& s, const glm::dvec3& ray, uint32_t shell) {
  const auto slices = double(s.coat.slices.size());
  const double h = (shell + 0.5) / s.shells, z = std::clamp(h * slices - 0.5, 0.0, slices - 1);
  const auto below = size_t(z), above = std::min(below + 1, s.coat.slices.size() - 1);
  glm::dvec4 texel(0);
  for (size_t c = 0; c < 4; ++c) texel[int(c)] = AsKept(s, s.coat.slices[below][c], s.coat.slices[above][c], z) / 255.0;
  const double falloff = s.look == Look::Seed ? 1 : 0;
  texel.a = s.shells < s.coat.slices.size() ? KeptCoverage(s, shell, falloff) : CoverageAt(s, z);
  const Clumped clump = ClumpAt(s, ray, h);
  const double coverage = std::min(texel.w * (1 - falloff * z / slices), 0.999) * clump.inside;
  double exponent = slices / s.shells * s.groom.density * clump.spread * clump.spread;
  if (s.semantics == Semantics::Volume) exponent /= std::max(std::abs(ray.z), 0.5 / std::sqrt(double(s.shells)));
  glm::dvec3 t = glm::dvec3(texel) * 2.0 - 1.0;
  t = t + glm::dvec3(clump.lean * t.z, 0);
  const glm::dmat3 frame(s.tangent, glm::cross(glm::dvec3(0, 0, 1), s.tangent), glm::dvec3(0, 0, 1));
  const glm::dvec3 strand = glm::length(t) < 1.0 / 64 ? glm::dvec3(0, 0, 1) : glm::normalize(frame * t);
  const glm::dvec3 color = s.look == Look::Seed ? SeedShading(s, ray, strand, std::max(h - 0.5 / slices, 0.0))
                                                : CorrectShading(s, ray, strand, h);
  return glm::dvec4(color, 1 - std::pow(1 - coverage, exponent));
}

glm::dvec3 CompositeMidpoints(const SquareScene& s, const glm::dvec3& ray, double end) {
  glm::dvec3 color = SkinColor(s, ray);
  for (uint32_t shell = 0; shell < s.shells; ++shell) {
    if ((shell + 0.5) / s.shells > end) break;
    const glm::dvec4 over = MidpointShell(s, ray, shell);
    color = glm::mix(color, glm::dvec3(over), over.w);
  }
  return color;
}

glm::dvec3 Stored(Look look, const glm::dvec3& c) {
  return look == Look::Seed ? c : glm::dvec3(Encode(c.x), Encode(c.y), Encode(c.z));
}

glm::dvec3 Composite(const SquareScene& s, const glm::dvec3& ray) {
  glm::dvec3 color = SkinColor(s, ray);
  for (uint32_t shell = 0; shell < s.shells; ++shell) {
    const glm::dvec4 over = ShellColor(s, ray, shell);
    color = glm::mix(color, glm::dvec3(over), over.w);
  }
  return Stored(s.look, color);
}

}  // namespace fur::test

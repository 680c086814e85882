#include "presets.h"

#include <algorithm>
#include <array>
#include <string>

#include "fur/topology.h"
#include "fur_shaders/fur_shaders.h"

namespace fur {
namespace {

constexpr uint32_t kMaxScalars =
    1024;  // that one run of a geometry shader may emit: Direct3D 10, and Vulkan's and GL's least
constexpr uint32_t kPublishedCoatShells = 30;  // the fourth description's 90 vertices

constexpr std::array<PresetTraits, 4> kTraits{{
    {.name = "demo-fur",
     .shells = ShellMode::Instanced,
     .fins = rhi::PrimitiveTopology::LineListAdj,
     .finCull = rhi::CullMode::Back},
    {.name = "nvidia-d3d10",
     .shells = ShellMode::Draws,
     .fins = rhi::PrimitiveTopology::LineListAdj,
     .finCull = rhi::CullMode::None,
     .defaultShells = 16,
     .lengthInAlpha = true,
     .spacingOfDiameter = true,
     .furLight = {0.8f, 20, 1}},
    {.name = "gs-shells",
     .shells = ShellMode::Amplified,
     .fins = rhi::PrimitiveTopology::LineList,
     .finCull = rhi::CullMode::None,
     .defaultShells = 28,
     .amplification = {.scalars = 12, .maxShells = 28},
     .opacityMap = true,
     .finMap = true,
     .spots = true,
     .lengthShare = 0.6,  // "works well for short haired fur"
     .furLight = {0.45f, 0.4f, 0}},
    {.name = "four-coats",
     .shells = ShellMode::Amplified,
     .fins = rhi::PrimitiveTopology::LineList,
     .finCull = rhi::CullMode::None,
     .defaultShells = kPublishedCoatShells,
     .amplification = {.scalars = 10, .maxShells = 34},
     .opacityMap = true,
     .finMap = true,
     .coatColors = true,
     .furLight = {0.5f, 0.5f, 0}},
}};

PresetShaders DemoShaders(Look look, Semantics semantics) {
  const bool seed = look == Look::Seed, volume = semantics == Semantics::Volume;
  PresetShaders s;
  s.finVS = seed ? &shaders::seed_fin_VSMain_seed : &shaders::seed_fin_VSMain;
  s.finGS = seed ? &shaders::seed_fin_GSMain_seed : &shaders::seed_fin_GSMain;
  s.finPS = seed ? &shaders::seed_fin_PSMain_seed : &shaders::seed_fin_PSMain;
  s.shellVS = &shaders::seed_shell_VSMain;
  s.shellPS = seed ? (volume ? &shaders::seed_shell_PSMain_seed_volume : &shaders::seed_shell_PSMain_seed)
                   : (volume ? &shaders::seed_shell_PSMain_volume : &shaders::seed_shell_PSMain);
  return s;
}

PresetShaders NvidiaShaders() {
  PresetShaders s;
  s.finVS = &shaders::nvidia_fin_VSMain;
  s.finGS = &shaders::nvidia_fin_GSMain;
  s.finPS = &shaders::nvidia_fin_PSMain;
  s.shellVS = &shaders::nvidia_shell_VSMain;
  s.shellPS = &shaders::nvidia_shell_PSMain;
  return s;
}

PresetShaders GsShellsShaders() {
  PresetShaders s;
  s.finVS = &shaders::gs_shells_fin_VSMain;
  s.finGS = &shaders::gs_shells_fin_GSMain;
  s.finPS = &shaders::gs_shells_fin_PSMain;
  s.shellVS = &shaders::gs_shells_shell_VSMain;
  s.shellGS = &shaders::gs_shells_shell_GSMain;
  s.shellPS = &shaders::gs_shells_shell_PSMain;
  s.furredBase = &shaders::gs_shells_base_PSMain;
  return s;
}

PresetShaders FourCoatsShaders(uint32_t shells) {
  PresetShaders s;
  s.finVS = &shaders::four_coats_fin_VSMain;
  s.finGS = &shaders::four_coats_fin_GSMain;
  s.finPS = &shaders::four_coats_fin_PSMain;
  s.shellVS = &shaders::four_coats_shell_VSMain;
  s.shellGS =
      shells > kPublishedCoatShells ? &shaders::four_coats_shell_GSMain_most : &shaders::four_coats_shell_GSMain;
  s.shellPS = &shaders::four_coats_shell_PSMain;
  s.furredBase = &shaders::four_coats_base_PSMain;
  return s;
}

Error TooMany(const std::string& why) { return {ErrorCode::Usage, why}; }

Result<Done> CheckAmplification(const rhi::Caps& caps, const PresetTraits& t, uint32_t shells) {
  const uint64_t vertices = uint64_t{shells} * 3, scalars = vertices * t.amplification.scalars;
  const std::string made = std::string(t.name) + ": " + std::to_string(shells) + " shells of a triangle are " +
                           std::to_string(vertices) + " vertices of " + std::to_string(t.amplification.scalars) +
                           " scalars, " + std::to_string(scalars) + " in all, ";
  const std::string most = "; at most " + std::to_string(t.amplification.maxShells) + " shells";
  if (scalars > kMaxScalars)
    return TooMany(made + "and a geometry shader of Direct3D 10 may emit " + std::to_string(kMaxScalars) + most);
  if (vertices > caps.maxGSOutputVertices || scalars > caps.maxGSOutputComponents)
    return TooMany(made + "and " + caps.adapter.data() + " allows " + std::to_string(caps.maxGSOutputVertices) +
                   " vertices and " + std::to_string(caps.maxGSOutputComponents) + " scalars");
  return Done{};
}

}  // namespace

const PresetTraits& TraitsOf(Preset preset) { return kTraits[size_t(preset)]; }

PresetShaders ShadersOf(const RenderSettings& settings, uint32_t shells) {
  switch (settings.preset) {
    case Preset::NvidiaD3d10: return NvidiaShaders();
    case Preset::GsShells: return GsShellsShaders();
    case Preset::FourCoats: return FourCoatsShaders(shells);
    case Preset::DemoFur: break;
  }
  return DemoShaders(settings.look, settings.semantics);
}

uint32_t ShellCount(const RenderSettings& settings, uint32_t coatShells, uint32_t volumeLayers) {
  const bool published = settings.technique == Technique::Seed;
  const uint32_t preset = published ? TraitsOf(settings.preset).defaultShells : 0;
  if (settings.shells) return settings.shells;
  if (preset) return preset;
  return coatShells ? coatShells : std::max(16u, volumeLayers);
}

Result<Done> CheckPreset(const rhi::Caps& caps, const RenderSettings& settings) {
  if (settings.preset == Preset::DemoFur) return Done{};
  const PresetTraits& traits = TraitsOf(settings.preset);
  if (settings.technique != Technique::Seed || settings.look != Look::Seed)
    return Error{ErrorCode::Usage, std::string("preset ") + traits.name +
                                       " is drawn by technique seed with look seed: it has its own look"};
  if (!settings.drawShells || traits.shells != ShellMode::Amplified) return Done{};
  if (!caps.geometryShader)
    return Error{ErrorCode::NoDevice, std::string("preset ") + traits.name +
                                          " makes its shells in a geometry shader, which " + caps.adapter.data() +
                                          " does not have; try --preset nvidia-d3d10 or --no-shells"};
  return CheckAmplification(caps, traits, ShellCount(settings, 0, 0));
}

std::vector<uint32_t> FinIndices(const Primitive& primitive, Preset preset) {
  if (preset == Preset::DemoFur) return SeedLineAdjacency(primitive.indices);
  const std::vector<uint32_t> adjacency =
      LineAdjacency(primitive.vertices, primitive.indices, WeldByPosition(primitive.vertices));
  if (TraitsOf(preset).fins == rhi::PrimitiveTopology::LineListAdj) return adjacency;
  std::vector<uint32_t> lines;
  for (size_t i = 0; i + 3 < adjacency.size(); i += 4) lines.insert(lines.end(), {adjacency[i + 1], adjacency[i + 2]});
  return lines;
}

Light PresetLight(Preset preset) {
  switch (preset) {
    // ka .3, kd .7, ks .2: the first description's Kajiya-Kay constants are the light's colours.
    case Preset::NvidiaD3d10: return {kDemoLight.direction, glm::dvec3(0.7), glm::dvec3(0.3), glm::dvec3(0.2)};
    // Lambert without a highlight on the fur.
    case Preset::GsShells:
    case Preset::FourCoats: return {kDemoLight.direction, glm::dvec3(0.8), glm::dvec3(0.35), glm::dvec3(0.3)};
    case Preset::DemoFur: break;
  }
  return kDemoLight;
}

}  // namespace fur

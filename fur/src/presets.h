// The published systems as a table: what one technique (published_technique.cpp) needs to draw each as its description
// says. docs/presets.md cites the descriptions.
#pragma once

#include <array>
#include <vector>

#include "fur/renderer.h"
#include "gpu_constants.h"

namespace fur {

struct PresetShaders {
  const rhi::ShaderBlob *finVS = nullptr, *finGS = nullptr, *finPS = nullptr;
  const rhi::ShaderBlob *shellVS = nullptr, *shellGS = nullptr, *shellPS = nullptr;  // shellGS: null unless amplified
  const rhi::ShaderBlob* furredBase = nullptr;  // the skin under the fur; null: the solid pass's own
};

// What a geometry shader that makes every shell of a triangle emits.
struct Amplification {
  uint32_t scalars = 0;    // of one vertex
  uint32_t maxShells = 0;  // its description's, or what the 1,024 scalars hold
};

struct PresetTraits {
  const char* name;
  ShellMode shells;                                                            // how they are drawn
  rhi::PrimitiveTopology fins;                                                 // LineListAdj or LineList
  rhi::CullMode finCull;                                                       // a strip on an edge has no outside
  uint32_t defaultShells = 0;                                                  // 0: as the coat says
  Amplification amplification;                                                 // shells == Amplified
  bool lengthInAlpha = false;                                                  // of the colour texture
  bool opacityMap = false, finMap = false, spots = false, coatColors = false;  // textures made by the program
  bool spacingOfDiameter = false;  // shells a thousandth of the model's diameter apart; else the coat's length
  double lengthShare = 1;          // of the coat's length
  // furLight.xyz instead of the coat's, where x > 0. nvidia-d3d10: light left at the root, power and scale of the
  // highlight. gs-shells, four-coats: light left on the skin, and between the hairs.
  std::array<float, 3> furLight{};
};
const PresetTraits& TraitsOf(Preset);

// The shaders for `shells` of them.
PresetShaders ShadersOf(const RenderSettings&, uint32_t shells);

// Shells of a coat of `volumeLayers` slices: the setting, else the preset's, else the coat's, else 16 or the slices.
uint32_t ShellCount(const RenderSettings&, uint32_t coatShells, uint32_t volumeLayers);

// Usage when the settings do not go together, or when a geometry shader cannot make that many shells: by Direct3D 10's
// 1,024 scalars, by the description's own number, or by what the device allows.
Result<Done> CheckPreset(const rhi::Caps&, const RenderSettings&);

// Indices of the edges that may grow a fin, in the preset's topology. Preset demo-fur: as its demo makes them, by
// index. Others: each edge once, welded by position.
std::vector<uint32_t> FinIndices(const Primitive&, Preset);

}  // namespace fur

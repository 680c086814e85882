// The reference picture: the fur model of docs/accuracy.md integrated along rays in double precision on the CPU. It has
// no shells and shares no shader code with the GPU's path; what both read is the model and its FurMesh.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "fur/renderer.h"

namespace fur {

struct ReferenceSettings {
  uint32_t width = 1280, height = 720;  // of the whole picture
  uint32_t cropX = 0, cropY = 0, cropWidth = 0, cropHeight = 0;  // the part that is rendered; width or height 0: to the edge
  Look look = Look::Correct;  // Seed: the demo's, as preset demo-fur draws it with technique shells
  Semantics semantics = Semantics::Volume;
  glm::dvec3 background{0};
  Light light;
  std::optional<glm::dvec3> comb;  // RenderSettings, these three
  std::optional<double> bend;
  double time = 0;
  uint32_t samplesPerPixel = 64;  // spread evenly, best for powers of two
  uint64_t seed = 0;              // of their scrambling
  uint32_t threads = 0;           // 0: one for each core. The picture does not depend on it
  // Of one step of the integration, for its effect on the pixel; the estimate is one order too pessimistic.
  double tolerance = 5e-3;
  // Furnace: fur and skin shine with this colour whatever the light.
  std::optional<glm::dvec3> furnace;
  std::function<void(double)> progress;  // 0..1, called from one thread at a time
};

// Of the crop. Row 0 on top, tightly packed.
struct ReferenceImage {
  FloatImage color;               // as Renderer::ReadPixels: over the background; a: opacity, 1 on skin
  std::vector<float> furOpacity;  // 1 - exp(-tau), the skin apart: the mask
  std::vector<uint8_t> skin;      // 1 where the ray through the pixel's centre meets skin: its complement in the mask is the band
};

// What fur/compare.h takes as mask and band: the fur's opacity, and the same where it has no skin behind it, else 0.
Plane MaskOf(const ReferenceImage&);
Plane BandOf(const ReferenceImage&);

// Skin is seen as the renderer draws it: back faces are culled unless the material is double-sided, between the camera's
// near and far plane. Fur has no back: each crossing counts. The groom is that of technique shells (docs/fur.md), clumps
// as if pixels were small against them. Usage for a crop outside the picture or no samples.
Result<ReferenceImage> RenderReference(const Model&, const Camera&, std::span<const glm::dmat4> placements,
                                       const ReferenceSettings&);

// A name for all that the picture depends on: 32 hexadecimal digits, a hash of the model's content, the scene and the
// settings, and of this program's version of the reference.
std::string ReferenceKey(const Model&, const Camera&, std::span<const glm::dmat4> placements, const ReferenceSettings&);

// Pictures kept by their key. Load: InputMissing when there is none, InputMalformed when the file is damaged.
Result<ReferenceImage> LoadReference(const std::string& folder, const std::string& key);
Result<Done> StoreReference(const std::string& folder, const std::string& key, const ReferenceImage&);

}  // namespace fur

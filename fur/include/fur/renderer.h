// Draws animals with fur through the RHI.
#pragma once

#include <memory>
#include <span>

#include "fur/model.h"
#include "fur/scene.h"
#include "rhi/rhi.h"

namespace fur {

// How look and semantics are sampled.
enum class Technique {
  Seed  // the published shells and fins, the baseline: docs/seed.md
};
// Lighting, colour space and handling of assets.
enum class Look {
  Seed,    // as published: raw texture values, no transfer function
  Correct  // docs/accuracy.md: sRGB decoded, blended in linear light
};
// What a shell's coverage means.
enum class Semantics {
  Sheet,  // a sheet of that opacity, whatever the angle
  Volume  // a slab of strands: opacity grows with the length of the way through it
};

struct RenderSettings {
  uint32_t width = 1280, height = 720, samples = 1;  // samples: 1 or 4
  Technique technique = Technique::Seed;
  Look look = Look::Correct;
  Semantics semantics = Semantics::Sheet;
  uint32_t shells = 0;  // 0: as the material says
  bool drawFins = true, drawShells = true;
  glm::dvec3 background{0};  // linear for Correct, raw for Seed
  Light light;
};

// What one frame submits. Fragments are counted exactly, one sample for each pixel, by an untimed pass.
struct FrameCounts {
  uint64_t draws = 0, triangles = 0, edges = 0;  // submitted; edges: inputs of the fins' geometry shader
  uint64_t baseFragments = 0, finFragments = 0, shellFragments = 0;
  uint64_t skippedAnimals = 0, skippedEdges = 0, skippedShells = 0;
};

class Renderer {
 public:
  virtual ~Renderer() = default;

  // Records and submits one frame into the renderer's own target; does not wait.
  virtual void Draw(const Camera&, std::span<const glm::dmat4> placements) = 0;
  // Waits for the GPU. RenderFailed when the driver failed.
  virtual Result<Done> Finish() = 0;
  // The last frame, alpha 1: as stored, so sRGB-encoded for look correct.
  virtual Result<Image> ReadImage() = 0;
  // Draws the frame once more, counting.
  virtual Result<FrameCounts> Count(const Camera&, std::span<const glm::dmat4> placements) = 0;
};

// Uploads the model. The device must outlive the renderer; the model need not. NoDevice where the device lacks what the
// technique needs (geometry shaders, samples), saying what.
Result<std::unique_ptr<Renderer>> MakeRenderer(rhi::IDevice& device, const Model& model, const RenderSettings& settings);

}  // namespace fur

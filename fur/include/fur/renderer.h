// Draws animals with fur through the RHI.
#pragma once

#include <memory>
#include <optional>
#include <span>

#include "fur/float_image.h"
#include "fur/model.h"
#include "fur/scene.h"
#include "rhi/rhi.h"

namespace fur {

// How look and semantics are sampled.
enum class Technique {
  Seed,   // the published shells and fins, the baseline: docs/seed.md
  Shells  // the same idea without its defects: docs/shells.md
};
// Lighting, colour space and handling of assets.
enum class Look {
  Seed,    // as published: raw texture values, no transfer function
  Correct  // docs/accuracy.md: sRGB decoded, blended in linear light
};
// Whose published shells and fins technique seed draws: docs/presets.md. All but DemoFur want look seed; their shells
// are sheets whatever the semantics.
enum class Preset {
  DemoFur,      // the second description's demo: docs/seed.md
  NvidiaD3d10,  // the first: a draw for each shell, length in alpha, comb, fins with a threshold
  GsShells,     // the third: shells made by a geometry shader, furless spots
  FourCoats     // the fourth: the same in the colours of four animals
};
enum class FourCoat { Bear, Panther, Snow, Tiger };
// What a shell's coverage means.
enum class Semantics {
  Sheet,  // a sheet of that opacity, whatever the angle
  Volume  // a slab of strands: opacity grows with the length of the way through it
};

// Sorted: every limb's fur over that of the limb behind it. The others go shell by shell, whatever lies in front: three
// ways to one picture.
enum class ShellMode {
  Sorted,     // one draw, all shells of a triangle before those of the next nearer one
  Instanced,  // one draw, an instance for each shell
  Draws,      // one draw for each shell
  Amplified   // a geometry shader makes the shells of a triangle, as many at a time as shellsAtOnce says
};
enum class FinMode {
  Auto,       // compacted where the device has compute and indirect draws, else geometry, else pulled
  Geometry,   // a geometry shader over line adjacency
  Pulled,     // six vertices for each edge, made by the vertex shader
  Compacted   // the same for the edges that a compute shader kept, by an indirect draw
};
// What the frame is blended in.
enum class TargetFormat {
  Auto,     // seed: Unorm8; shells: Float16, above 32 shells Float32
  Unorm8,   // 8 bits, sRGB-encoded for look correct
  Float16,  // brought to 8 bits at the end
  Float32
};

struct RenderSettings {
  uint32_t width = 1280, height = 720, samples = 1;  // samples: 1 or 4
  Technique technique = Technique::Shells;
  Look look = Look::Correct;
  Semantics semantics = Semantics::Volume;
  TargetFormat target = TargetFormat::Auto;
  Preset preset = Preset::DemoFur;      // technique seed only
  FourCoat fourCoat = FourCoat::Bear;   // preset FourCoats only
  double finDeadZone = 0.25;            // presets GsShells, FourCoats: |edge normal . view| below it grows a fin, 0..1
  uint32_t shells = 0;                  // 0: as the preset or the material says
  bool drawFins = true, drawShells = true;
  // Textures decoded to 32-bit floats: drivers then filter with float weights where for bytes some take 8-bit ones.
  bool floatTextures = false;
  glm::dvec3 background{0};  // linear for Correct, raw for Seed
  Light light;

  // Of bare skin, parts of materials without fur, 1 or 4, 0: as samples. Smooth whiskers and eyes without the cost of four
  // samples for all of the fur; with samples 1, technique shells.
  uint32_t skinSamples = 0;

  // Technique shells only; but fins' threshold and opacity, the comb and the spacing also where a preset has them.
  ShellMode shellMode = ShellMode::Sorted;
  // Amplified: 1..14. Above 1 the triangles are sorted back to front and the picture is that of one at a time only
  // where the fur of no two limbs overlaps: docs/measured.md.
  uint32_t shellsAtOnce = 1;
  FinMode finMode = FinMode::Auto;
  double finThreshold = 0.25;  // edges with |e.N| below it grow a fading fin, 0..1; 0: silhouettes only
  // Of a fin on the silhouette, 0..1; none: 0.9, as published. In a volume, factor of the opacity that the fin has by the
  // fur it stands for; none: 1.
  std::optional<double> finOpacity;
  bool backFaces = true;       // fur behind the outline, where the skin can be missed
  bool sortAnimals = true;     // back to front
  std::optional<glm::dvec3> comb;  // instead of the coats' own: offset of the tips relative to the fur's length, in the
                                   // model's axes
  std::optional<double> bend;      // instead of the coats' own: exponent of the height in that offset, >= 1
  double time = 0;                 // seconds; where the wind is
  double spacing = 0;          // distance of two shells in the primitive's units: the length is N times it; 0: the
                               // preset's, or the coat's
};

// The light of a preset as its description has it. Directions are the demo's.
Light PresetLight(Preset);

// What one frame submits. Fragments are counted exactly, one sample for each pixel, by an untimed pass.
struct FrameCounts {
  uint64_t draws = 0, triangles = 0, edges = 0, dispatches = 0;  // submitted; edges: candidates for fins
  uint64_t baseFragments = 0, finFragments = 0, shellFragments = 0;
  uint64_t skippedAnimals = 0, skippedEdges = 0, skippedShells = 0;
};

// What moves between two frames.
struct Motion {
  double time = 0;                        // seconds, added to the settings'
  std::span<const glm::dvec3> offsets;    // of each animal's tips by inertia (fur/inertia.h): world axes, in fur lengths;
                                          // animals beyond its end have none. Technique shells, and presets with a comb
};

class Renderer {
 public:
  virtual ~Renderer() = default;

  // Records and submits one frame into the renderer's own target; does not wait. Animals whose placement or offset is not
  // finite are not drawn; a camera that is not shows the background.
  virtual void Draw(const Camera&, std::span<const glm::dmat4> placements, const Motion&) = 0;
  void Draw(const Camera& camera, std::span<const glm::dmat4> placements) { Draw(camera, placements, Motion{}); }
  // Waits for the GPU. RenderFailed when the driver failed.
  virtual Result<Done> Finish() = 0;
  // The last frame, alpha 1: as stored, so sRGB-encoded for look correct.
  virtual Result<Image> ReadImage() = 0;
  // The last frame before it is brought to 8 bits: linear for look correct. rgb: the frame over the background; a: the
  // opacity of what was drawn over it, 1 on skin (technique shells). Usage with a Unorm8 target.
  virtual Result<FloatImage> ReadPixels() = 0;
  // Draws the frame once more, counting.
  virtual Result<FrameCounts> Count(const Camera&, std::span<const glm::dmat4> placements) = 0;
};

// Uploads the model. The device must outlive the renderer; the model need not. NoDevice where the device lacks what the
// technique needs (geometry shaders, samples), saying what.
Result<std::unique_ptr<Renderer>> MakeRenderer(rhi::IDevice& device, const Model& model, const RenderSettings& settings);

}  // namespace fur

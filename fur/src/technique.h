// What a technique is to the renderer: it records the draws of a frame whose targets are bound and cleared.
#pragma once

#include <memory>
#include <span>

#include "fur/renderer.h"
#include "gpu_model.h"
#include "gpu_constants.h"
#include "targets.h"

namespace fur {

// The passes of a frame, for counting them apart.
enum class Pass { Base, Fins, Shells };
inline constexpr size_t kPassCount = 3;

struct FrameInputs {
  glm::dvec3 eye{0};
  glm::dmat4 worldToClip{1};
  Light light;
  std::span<const glm::dmat4> placements;
  FrameCounts* counts = nullptr;                          // never null
  rhi::IShader* countingShader = nullptr;                 // set: replaces every pixel shader
  std::span<const rhi::Ref<rhi::IQuery>> passQueries;     // empty, or one occlusion query for each pass
  const Targets* targets = nullptr;                       // never null while a technique draws
  Motion motion{};                                        // time: the settings' added

  glm::dvec3 OffsetOf(size_t animal) const {
    return animal < motion.offsets.size() ? motion.offsets[animal] : glm::dvec3(0);
  }
};

class ITechnique {
 public:
  virtual ~ITechnique() = default;
  virtual void Draw(rhi::IContext&, const GpuModel&, const FrameInputs&) = 0;
};

Result<std::unique_ptr<ITechnique>> MakeSeedTechnique(rhi::IDevice&, const RenderSettings&);
Result<std::unique_ptr<ITechnique>> MakeShellsTechnique(rhi::IDevice&, const RenderSettings&);

// Constants of one part of one animal, computed in double.
ObjectConstants MakeObjectConstants(const glm::dmat4& objectToWorld, const FrameInputs&);

}  // namespace fur

// The fins of technique `shells`, three ways to the same picture.
#pragma once

#include <array>

#include "fur/fur_mesh.h"
#include "pass.h"

namespace fur {

// NoDevice where the device cannot make fins this way, saying what it lacks.
Result<Done> CheckFinMode(const rhi::Caps&, const RenderSettings&);

class FinPass {
 public:
  FinPass(Creation&, const RenderSettings&);
  // Compacts the edges of all animals, before any target is drawn to: a dispatch would break the pass.
  void Prepare(rhi::IContext&, const PassBinding&, const GpuModel&, const FrameInputs&);
  // Blend and depth states are the caller's.
  void Draw(rhi::IContext&, const PassBinding&, const GpuModel&, const FrameInputs&, size_t animal) const;

 private:
  struct Slot {  // of one part of one animal
    uint32_t firstEdge = 0, arguments = 0;
  };
  bool Reserve(const GpuModel&, size_t animals);
  void Compact(rhi::IContext&, const PassBinding&, const GpuModel&, const FrameInputs&);
  void DrawPart(rhi::IContext&, const PassBinding&, const GpuFurMesh&, const Slot&) const;
  const Slot& SlotOf(const GpuModel& model, size_t animal, size_t part) const {
    return slots_[animal * model.parts.size() + part];
  }

  rhi::IDevice& device_;
  FinMode mode_;
  bool compacted_ = false;  // this frame's edges are
  using Pair = std::array<rhi::Ref<rhi::IShader>, 2>;  // by + 1: swaying
  Pair vs_, gs_, compactedVS_;
  std::array<rhi::Ref<rhi::IShader>, 4> ps_;  // by + 1: groomed, + 2: tinted
  rhi::Ref<rhi::IShader> compactCS_;
  rhi::Ref<rhi::IInputLayout> layout_;
  std::vector<Slot> slots_;
  uint64_t keptCapacity_ = 0;
  rhi::Ref<rhi::IBuffer> kept_, arguments_;
  rhi::Ref<rhi::IShaderResourceView> keptView_;
  rhi::Ref<rhi::IUnorderedAccessView> keptUav_, argumentsUav_;
};

}  // namespace fur

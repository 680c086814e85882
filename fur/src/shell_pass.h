// The shells of technique `shells`. Sorted: triangle by triangle, from the back to the front (triangle_order.h). Else those
// seen from behind come outside in, then those seen from the front inside out: shell by shell, or, amplified, some shells
// of each triangle at a time (docs/measured.md).
#pragma once

#include <array>
#include <vector>

#include "fur/fur_mesh.h"
#include "pass.h"

namespace fur {

// NoDevice or Usage where the device cannot draw shells this way, saying which limit is exceeded and what to do.
Result<Done> CheckShellMode(const rhi::Caps&, const RenderSettings&);

class ShellPass {
 public:
  ShellPass(Creation&, const RenderSettings&);
  // Blend and depth states are the caller's.
  void Draw(rhi::IContext&, const PassBinding&, const GpuModel&, const FrameInputs&, size_t animal) const;

 private:
  struct Side {
    size_t animal;
    const std::vector<rhi::IBuffer*>& indices;  // of each part
    bool back;
  };
  std::vector<rhi::IBuffer*> Indices(rhi::IContext&, const GpuModel&, const FrameInputs&, size_t animal) const;
  // Draws all shells of a part, triangle by triangle.
  void DrawSorted(rhi::IContext&, const PassBinding&, const GpuModel&, const FrameInputs&, size_t animal) const;
  // What a part's shells are drawn with, but for vertices and indices.
  void BindPart(rhi::IContext&, const PassBinding&, const GpuModel&, const FrameInputs&, size_t animal, const GpuPart&,
                rhi::CullMode) const;
  struct Shaders {
    rhi::Ref<rhi::IShader> still, swaying;
    rhi::IShader* For(const GpuMaterial& m) const { return (m.sways ? swaying : still).get(); }
  };
  void DrawSide(rhi::IContext&, const PassBinding&, const GpuModel&, const FrameInputs&, const Side&) const;
  void DrawShells(rhi::IContext&, const PassBinding&, const GpuFurMesh&, uint32_t shells, bool back,
                  FrameCounts*) const;

  ShellMode mode_;
  bool backFaces_;
  uint32_t shellsAtOnce_;  // in the geometry shader
  Shaders vs_, gs_;
  std::array<rhi::Ref<rhi::IShader>, 8> ps_;  // + 1: between slices, + 2: groomed, + 4: tinted
  rhi::Ref<rhi::IInputLayout> layout_;
};

// The vertex layout of FurVertex.
rhi::Ref<rhi::IInputLayout> FurLayout(Creation&, rhi::IShader* vs);

}  // namespace fur

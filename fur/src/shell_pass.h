// The shells of technique `shells`, three ways to the same picture.
#pragma once

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
  void DrawSide(rhi::IContext&, const PassBinding&, const GpuModel&, const FrameInputs&, size_t animal,
                bool back) const;
  void DrawShells(rhi::IContext&, const PassBinding&, const GpuFurMesh&, uint32_t shells, bool back,
                  FrameCounts*) const;

  ShellMode mode_;
  bool backFaces_;
  rhi::Ref<rhi::IShader> vs_, gs_, onSlicesPS_, betweenPS_;
  rhi::Ref<rhi::IInputLayout> layout_;
};

// The vertex layout of FurVertex.
rhi::Ref<rhi::IInputLayout> FurLayout(Creation&, rhi::IShader* vs);

}  // namespace fur

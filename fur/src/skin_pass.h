// The skin of a frame of technique shells: where the settings ask for it, with more samples a pixel than the fur.
#pragma once

#include "pass.h"
#include "targets.h"

namespace fur {

// Usage where skinSamples does not go with the other settings.
Result<Done> CheckSkinSamples(const RenderSettings&);

// Skin has edges where fur has none: whiskers, eyes, bald parts. Fur is transparent and lies over the skin, so it needs no
// more than the skin's resolved colour and, at one sample, its depth: the skin is drawn twice, the second time for the
// depth alone, which costs less than four samples of every shell. Resolved by a shader, and only where there can be skin:
// ResolveSubresource is for whole textures.
class SkinPass {
 public:
  SkinPass(Creation&, const RenderSettings&);
  // Into in.targets.
  void Draw(rhi::IContext&, const PassBinding&, const GpuModel&, const FrameInputs&) const;

 private:
  void Resolve(rhi::IContext&, const PassBinding&, const GpuModel&, const FrameInputs&) const;

  BasePass base_;
  Targets apart_;  // none: the skin is drawn like all else; from here on
  rhi::Ref<rhi::IShaderResourceView> apartView_;
  rhi::Ref<rhi::IShader> vs_, ps_;
  rhi::Ref<rhi::IRasterizerState> raster_;
  rhi::Ref<rhi::IDepthStencilState> noDepth_;
};

}  // namespace fur

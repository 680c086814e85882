// The skin of technique shells; bare pieces, where the settings ask for it, with more samples a pixel than the fur.
#pragma once

#include <vector>

#include "pass.h"
#include "targets.h"

namespace fur {

// Usage where skinSamples does not go with the other settings.
Result<Done> CheckSkinSamples(const RenderSettings&);

// Pixels of the frame from its top left; empty: no pixel.
struct PixelBox {
  int32_t left = 0, top = 0, right = 0, bottom = 0;
  bool Empty() const { return left >= right || top >= bottom; }
  double Area() const { return double(right - left) * (bottom - top); }
  bool Overlaps(const PixelBox& o) const {
    return left < o.right && o.left < right && top < o.bottom && o.top < bottom;
  }
};
// What the bare pieces of all animals can cover, no pixel twice; few boxes, since all skin is drawn again for each. The whole
// frame where a piece is beside or behind the eye.
std::vector<PixelBox> BoxesOfBarePieces(const GpuModel&, const FrameInputs&, uint32_t width, uint32_t height);

// Bare pieces (of materials without fur: whiskers, eyes, claws) have edges where fur has none. They are drawn again with four
// samples, behind what hides them, into a target as large as the largest box that holds some of them, and blended over the
// skin by the share of their samples: few pixels, where four samples for all of the frame would cost more than all the fur.
// To the fur their pixels have one depth: where a piece misses a pixel's centre, fur behind it covers it.
class SkinPass {
 public:
  SkinPass(Creation&, const RenderSettings&);
  // Into in.targets, which are bound and stay so.
  void Draw(rhi::IContext&, const PassBinding&, const GpuModel&, const FrameInputs&);

 private:
  bool MakeApart(const std::vector<PixelBox>&);
  void DrawApart(rhi::IContext&, const PassBinding&, const GpuModel&, const FrameInputs&, const PixelBox&) const;
  void Blend(rhi::IContext&, const PassBinding&, const FrameInputs&, const PixelBox&) const;
  void SetFrameViewport(rhi::IContext&, int32_t left, int32_t top) const;

  rhi::IDevice& device_;
  RenderSettings settings_;
  BasePass base_;
  Targets apart_;  // grows with the largest box
  uint32_t apartWidth_ = 0, apartHeight_ = 0;
  rhi::Ref<rhi::IShaderResourceView> apartView_;
  rhi::Ref<rhi::IShader> vs_, ps_;  // null where bare skin has no more samples than the rest
  rhi::Ref<rhi::IRasterizerState> raster_;
  rhi::Ref<rhi::IDepthStencilState> noDepth_;
  rhi::Ref<rhi::IBlendState> over_;
};

}  // namespace fur

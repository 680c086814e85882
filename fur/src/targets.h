// Colour and depth that a frame, or its skin alone, is drawn to.
#pragma once

#include <glm/glm.hpp>

#include "fur/renderer.h"
#include "rhi/rhi.h"

namespace fur {

struct Targets {
  rhi::Ref<rhi::ITexture> color, depth;
  rhi::Ref<rhi::IRenderTargetView> colorView;
  rhi::Ref<rhi::IDepthStencilView> depthView;
  rhi::Format format = rhi::Format::Unknown;  // of the colour
};

// What frames are blended in; settings.target must not be Auto.
rhi::Format FrameFormat(const RenderSettings&);
// Of the settings' size and FrameFormat; depth D32_Float.
rhi::Status MakeTargets(rhi::IDevice&, const RenderSettings&, uint32_t samples, Targets*);
void BindTargets(rhi::IContext&, const Targets&);
// Depth to 0, the far end: depth is reversed.
void ClearTargets(rhi::IContext&, const Targets&, const glm::vec4& background);

}  // namespace fur

// Objects of every kind on one device, and work that uses each of them.
#pragma once

#include "lost_layer.h"
#include "rig.h"

namespace rhi_stress {

struct LostScene {
  explicit LostScene(Rig&);

  void Record(Rig&);      // one frame's work, without its end
  void ExpectLost(Rig&);  // every call says DeviceLost, or does nothing
  // Gives all objects away in an order that `seed` decides; the device among them if it is given.
  void Release(uint32_t seed, rhi::Ref<rhi::IDevice>* device = nullptr);

  Target target, samples;
  rhi::Ref<rhi::ITexture> picture, depth, stagingTexture;
  rhi::Ref<rhi::IBuffer> constants, vertices, indices, args, words, staging, mapped;
  rhi::Ref<rhi::IShaderResourceView> view;
  rhi::Ref<rhi::IDepthStencilView> depthView;
  rhi::Ref<rhi::IUnorderedAccessView> writable;
  rhi::Ref<rhi::IShader> vs, mesh, ps, pictured, cs;
  rhi::Ref<rhi::IInputLayout> layout;
  rhi::Ref<rhi::IBlendState> blend;
  rhi::Ref<rhi::IDepthStencilState> depthState;
  rhi::Ref<rhi::IRasterizerState> raster;
  rhi::Ref<rhi::ISamplerState> sampler;
  rhi::Ref<rhi::IQuery> event, occlusion, timestamp;
};

}  // namespace rhi_stress

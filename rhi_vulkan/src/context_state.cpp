// Dynamic state: what the pipelines leave open.
#include "context.h"

namespace rhi_vulkan {
namespace {

// No scissor: as large as any target.
constexpr uint32_t kNoScissor = 65535;

VkStencilOp ToVk(StencilOp op) {
  switch (op) {
    case StencilOp::Keep: return VK_STENCIL_OP_KEEP;
    case StencilOp::Zero: return VK_STENCIL_OP_ZERO;
    case StencilOp::Replace: return VK_STENCIL_OP_REPLACE;
    case StencilOp::IncrSat: return VK_STENCIL_OP_INCREMENT_AND_CLAMP;
    case StencilOp::DecrSat: return VK_STENCIL_OP_DECREMENT_AND_CLAMP;
    case StencilOp::Invert: return VK_STENCIL_OP_INVERT;
    case StencilOp::Incr: return VK_STENCIL_OP_INCREMENT_AND_WRAP;
    case StencilOp::Decr: return VK_STENCIL_OP_DECREMENT_AND_WRAP;
  }
  return VK_STENCIL_OP_KEEP;
}

VkCullModeFlags ToVk(CullMode cull) {
  switch (cull) {
    case CullMode::None: return VK_CULL_MODE_NONE;
    case CullMode::Front: return VK_CULL_MODE_FRONT_BIT;
    case CullMode::Back: return VK_CULL_MODE_BACK_BIT;
  }
  return VK_CULL_MODE_NONE;
}

VkRect2D ToVk(const Rect& r) {
  const int32_t left = std::max(r.left, 0), top = std::max(r.top, 0);
  return {{left, top}, {uint32_t(std::max(r.right - left, 0)), uint32_t(std::max(r.bottom - top, 0))}};
}

// The default of a descriptor stands for a null state.
template <class Object, class Ptr>
auto DescOf(const Ptr& state) {
  using Desc = std::remove_cvref_t<decltype(std::declval<Object>().Desc())>;
  return state ? static_cast<const Object&>(*state).Desc() : Desc{};
}

}  // namespace

void Context::ApplyDynamicState() {
  using namespace backend;
  if (dirty_ & DirtyViewports) ApplyViewports();
  if (dirty_ & (DirtyViewports | DirtyScissors | DirtyRaster)) ApplyScissors();
  if (dirty_ & DirtyRaster) ApplyRaster();
  if (dirty_ & DirtyDepthStencil) ApplyDepthStencil();
  if (dirty_ & DirtyStencilRef) vk_.vkCmdSetStencilReference(cmd_, VK_STENCIL_FACE_FRONT_AND_BACK, state_.stencilRef);
  if (dirty_ & DirtyBlendFactor) vk_.vkCmdSetBlendConstants(cmd_, state_.blendFactor.data());
  if (dirty_ & DirtyTopology) {
    vk_.vkCmdSetPrimitiveTopology(cmd_, rhi_vulkan::ToVk(state_.topology));
    vk_.vkCmdSetPrimitiveRestartEnable(cmd_, IsStrip(state_.topology));
  }
}

void Context::ApplyViewports() {
  // The negative height turns Vulkan's y-down clip space into Direct3D's y-up.
  std::array<VkViewport, kMaxViewports> list;
  for (uint32_t i = 0; i < state_.viewportCount; ++i) {
    const Viewport& v = state_.viewports[i];
    const float width = std::max(v.width, 1.0f);  // Vulkan wants more than 0; ApplyScissors lets nothing through
    list[i] = {
        v.x, v.y + v.height, width, -v.height, std::clamp(v.minDepth, 0.0f, 1.0f), std::clamp(v.maxDepth, 0.0f, 1.0f)};
  }
  vk_.vkCmdSetViewportWithCount(cmd_, state_.viewportCount, list.data());
}

void Context::ApplyScissors() {
  const bool enabled = state_.raster && static_cast<const RasterState&>(*state_.raster).Desc().scissor;
  std::array<VkRect2D, kMaxViewports> list;
  for (uint32_t i = 0; i < state_.viewportCount; ++i) {
    // A rectangle that was never set is empty, as in Direct3D 10.
    const Rect rect = i < state_.scissorCount ? state_.scissors[i] : Rect{0, 0, 0, 0};
    const bool empty = !(state_.viewports[i].width > 0 && state_.viewports[i].height > 0);
    list[i] = enabled ? ToVk(rect) : VkRect2D{{0, 0}, {kNoScissor, kNoScissor}};
    if (empty) list[i].extent = {0, 0};
  }
  vk_.vkCmdSetScissorWithCount(cmd_, state_.viewportCount, list.data());
}

void Context::ApplyRaster() {
  const RasterizerDesc d = DescOf<RasterState>(state_.raster);
  const bool bias = d.depthBias != 0 || d.slopeScaledBias != 0;
  vk_.vkCmdSetCullMode(cmd_, ToVk(d.cull));
  vk_.vkCmdSetFrontFace(cmd_, d.frontCCW ? VK_FRONT_FACE_COUNTER_CLOCKWISE : VK_FRONT_FACE_CLOCKWISE);
  vk_.vkCmdSetDepthBiasEnable(cmd_, bias);
  vk_.vkCmdSetDepthBias(cmd_, float(d.depthBias), d.depthBiasClamp, d.slopeScaledBias);
}

void Context::ApplyDepthStencil() {
  const DepthStencilDesc d = DescOf<DepthState>(state_.depthStencil);
  vk_.vkCmdSetDepthTestEnable(cmd_, d.depthEnable);
  vk_.vkCmdSetDepthWriteEnable(cmd_, d.depthEnable && d.depthWrite);
  vk_.vkCmdSetDepthCompareOp(cmd_, rhi_vulkan::ToVk(d.depthFunc));
  vk_.vkCmdSetStencilTestEnable(cmd_, d.stencilEnable);
  const auto setFace = [&](VkStencilFaceFlags face, const StencilFace& f) {
    vk_.vkCmdSetStencilOp(cmd_, face, ToVk(f.fail), ToVk(f.pass), ToVk(f.depthFail), rhi_vulkan::ToVk(f.func));
  };
  setFace(VK_STENCIL_FACE_FRONT_BIT, d.front);
  setFace(VK_STENCIL_FACE_BACK_BIT, d.back);
  vk_.vkCmdSetStencilCompareMask(cmd_, VK_STENCIL_FACE_FRONT_AND_BACK, d.readMask);
  vk_.vkCmdSetStencilWriteMask(cmd_, VK_STENCIL_FACE_FRONT_AND_BACK, d.writeMask);
}

}  // namespace rhi_vulkan

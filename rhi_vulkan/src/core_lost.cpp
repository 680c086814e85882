// What becomes of a device that is lost.
#include "core.h"

namespace rhi_vulkan {
namespace {

template <class Result, class... Args>
void Silence(Result(VKAPI_PTR*& function)(Args...)) {
  function = [](Args...) -> Result { return Result(); };  // a VkResult is then VK_SUCCESS
}
template <class... Functions>
void SilenceAll(Functions&... functions) {
  (Silence(functions), ...);
}

// Nothing is recorded on a lost device, so that a program that draws on neither fills the memory nor writes to command
// buffers that could not be begun. Nobody else has to ask whether the device is lost.
void SilenceRecording(VolkDeviceTable& vk, InstanceTable& instance) {
  SilenceAll(vk.vkBeginCommandBuffer, vk.vkEndCommandBuffer, vk.vkResetCommandPool);
  SilenceAll(vk.vkCmdBeginRendering, vk.vkCmdEndRendering, vk.vkCmdPipelineBarrier2, vk.vkCmdPushConstants,
             vk.vkCmdBindDescriptorSets, vk.vkCmdBindIndexBuffer, vk.vkCmdBindPipeline, vk.vkCmdBindVertexBuffers2);
  SilenceAll(vk.vkCmdDraw, vk.vkCmdDrawIndexed, vk.vkCmdDrawIndirect, vk.vkCmdDrawIndexedIndirect, vk.vkCmdDispatch,
             vk.vkCmdDispatchIndirect);
  SilenceAll(vk.vkCmdCopyBuffer, vk.vkCmdCopyBufferToImage, vk.vkCmdCopyImage, vk.vkCmdCopyImageToBuffer,
             vk.vkCmdBlitImage, vk.vkCmdResolveImage, vk.vkCmdClearAttachments, vk.vkCmdClearColorImage);
  SilenceAll(vk.vkCmdBeginQuery, vk.vkCmdEndQuery, vk.vkCmdWriteTimestamp2);
  SilenceAll(vk.vkCmdSetBlendConstants, vk.vkCmdSetCullMode, vk.vkCmdSetDepthBias, vk.vkCmdSetDepthBiasEnable,
             vk.vkCmdSetDepthCompareOp, vk.vkCmdSetDepthTestEnable, vk.vkCmdSetDepthWriteEnable, vk.vkCmdSetFrontFace,
             vk.vkCmdSetPrimitiveRestartEnable, vk.vkCmdSetPrimitiveTopology, vk.vkCmdSetScissorWithCount,
             vk.vkCmdSetStencilCompareMask, vk.vkCmdSetStencilOp, vk.vkCmdSetStencilReference,
             vk.vkCmdSetStencilTestEnable, vk.vkCmdSetStencilWriteMask, vk.vkCmdSetViewportWithCount);
  instance.vkCmdBeginDebugUtilsLabelEXT = nullptr;
  instance.vkCmdEndDebugUtilsLabelEXT = nullptr;
}

}  // namespace

Status Core::Lose(VkResult result, const char* what) {
  if (lost) return Status::DeviceLost;  // said once
  lost = true;
  // What runs still must be over before objects are deleted. On a lost device this returns, whatever has become of it.
  if (vk.vkDeviceWaitIdle) vk.vkDeviceWaitIdle(device);
  SilenceRecording(vk, instance.vk);
  log.Report(Severity::Error, MsgCode::DeviceLost, "",
             "%s: %s; the device is lost: release it and its objects, and make a new one", what, ToString(result));
  return Status::DeviceLost;
}

}  // namespace rhi_vulkan

#include "core.h"

#include "descriptors.h"
#include "pipeline.h"
#include "queries.h"
#include "states.h"

namespace rhi_vulkan {

Core::Core(IMessageSink* sink) : log(sink) {}

Core::~Core() {
  if (!device) return;
  vk.vkDeviceWaitIdle(device);
  closed_ = true;
  queries.reset();
  pipelines.reset();
  layouts.reset();
  ring.reset();
  memory.reset();
  if (timeline) vk.vkDestroySemaphore(device, timeline, nullptr);
  vk.vkDestroyDevice(device, nullptr);
}

void Core::Retire(Retirable* object) noexcept {
  if (closed_) {
    delete object;
  } else {
    retired_.emplace_back(recording, object);
  }
}

void Core::Collect() {
  const uint64_t done = Completed();
  // Deleting a view may retire its resource, which then goes to the back with the current serial.
  while (!retired_.empty() && retired_.front().first <= done) {
    Retirable* object = retired_.front().second;
    retired_.pop_front();
    delete object;
  }
  ring->Collect(done);
}

void Core::Close() {
  closed_ = true;
  while (!retired_.empty()) {
    Retirable* object = retired_.front().second;
    retired_.pop_front();
    delete object;
  }
}

uint64_t Core::Completed() {
  if (lost) return recording - 1;  // nothing runs any more
  uint64_t value = 0;
  if (Check(vk.vkGetSemaphoreCounterValue(device, timeline, &value), "", "vkGetSemaphoreCounterValue") == Status::Ok)
    completed_ = value;
  return completed_;
}

VkResult Core::TrySubmit(uint32_t count, const VkCommandBuffer* commands, const PresentSync& present) {
  std::array<VkCommandBufferSubmitInfo, 2> infos{};
  for (uint32_t i = 0; i < count; ++i) {
    infos[i].sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_SUBMIT_INFO;
    infos[i].commandBuffer = commands[i];
  }
  const auto semaphore = [](VkSemaphore handle, uint64_t value, VkPipelineStageFlags2 stages) {
    VkSemaphoreSubmitInfo info{VK_STRUCTURE_TYPE_SEMAPHORE_SUBMIT_INFO};
    info.semaphore = handle;
    info.value = value;
    info.stageMask = stages;
    return info;
  };
  const VkSemaphoreSubmitInfo wait = semaphore(present.acquired, 0, VK_PIPELINE_STAGE_2_ALL_TRANSFER_BIT);
  const VkSemaphoreSubmitInfo signals[] = {semaphore(timeline, recording, VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT),
                                           semaphore(present.written, 0, VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT)};
  VkSubmitInfo2 submit{VK_STRUCTURE_TYPE_SUBMIT_INFO_2};
  submit.commandBufferInfoCount = count;
  submit.pCommandBufferInfos = infos.data();
  submit.waitSemaphoreInfoCount = present.acquired ? 1 : 0;
  submit.pWaitSemaphoreInfos = &wait;
  submit.signalSemaphoreInfoCount = present.written ? 2 : 1;
  submit.pSignalSemaphoreInfos = signals;
  return vk.vkQueueSubmit2(queue, 1, &submit, VK_NULL_HANDLE);
}

Status Core::Submit(uint32_t count, const VkCommandBuffer* commands, const PresentSync& present) {
  if (!lost) {
    VkResult result = TrySubmit(count, commands, present);
    // Out of memory changes nothing, so there is a second try, when the GPU has given back what it holds.
    const bool again = result != VK_SUCCESS && result != VK_ERROR_DEVICE_LOST && Wait(recording - 1) == Status::Ok;
    if (again) result = TrySubmit(count, commands, present);
    if (result != VK_SUCCESS) Lose(result, "vkQueueSubmit2");  // the serial will never be signalled
  }
  ring->OnSubmit(recording);
  ++recording;
  return lost ? Status::DeviceLost : Status::Ok;
}

Status Core::Wait(uint64_t serial) {
  if (lost) return Status::DeviceLost;
  if (serial <= completed_) return Status::Ok;
  VkSemaphoreWaitInfo info{VK_STRUCTURE_TYPE_SEMAPHORE_WAIT_INFO};
  info.semaphoreCount = 1;
  info.pSemaphores = &timeline;
  info.pValues = &serial;
  const VkResult result = vk.vkWaitSemaphores(device, &info, UINT64_MAX);
  return result == VK_SUCCESS ? Status::Ok : Lose(result, "vkWaitSemaphores");
}

Status Core::Check(VkResult result, const char* object, const char* what) {
  if (result == VK_SUCCESS) return Status::Ok;
  return result == VK_ERROR_DEVICE_LOST ? Lose(result, what) : CheckResult(log, result, object, what);
}

Status Core::CheckOnce(VkResult result, const char* object, const char* what) {
  if (ToStatus(result) == Status::OutOfMemory && std::exchange(saidNoMemory_, true)) return Status::OutOfMemory;
  return Check(result, object, what);
}

void Core::SetName(VkObjectType type, uint64_t handle, const char* name) {
  if (!instance.vk.vkSetDebugUtilsObjectNameEXT || !handle || !*name) return;
  VkDebugUtilsObjectNameInfoEXT info{VK_STRUCTURE_TYPE_DEBUG_UTILS_OBJECT_NAME_INFO_EXT};
  info.objectType = type;
  info.objectHandle = handle;
  info.pObjectName = name;
  instance.vk.vkSetDebugUtilsObjectNameEXT(device, &info);
}

}  // namespace rhi_vulkan

// What every object of a device shares and keeps alive: the VkDevice, its tables, memory, caches, and the serials of
// its submissions. The Device (with its context) holds bound objects; the objects hold the Core; so there is no cycle,
// and objects may outlive the user's device.
#pragma once

#include <deque>
#include <memory>

#include "instance.h"
#include "memory.h"
#include "ring.h"

namespace rhi_vulkan {

class LayoutCache;
class PipelineCache;
class QueryHeap;
class StateTables;
class Context;
class Core;

// An object that the GPU may still use when its last reference is gone.
class Retirable {
 public:
  virtual ~Retirable() = default;
};

// Binary semaphores of a submission that writes an image of a window.
struct PresentSync {
  VkSemaphore acquired = VK_NULL_HANDLE;  // waited for before transfers
  VkSemaphore written = VK_NULL_HANDLE;   // signalled at the end
};

class Core {
 public:
  explicit Core(IMessageSink* sink);
  ~Core();
  Core(const Core&) = delete;
  Core& operator=(const Core&) = delete;

  // Deletes `object` when all that is recorded now has run.
  void Retire(Retirable* object) noexcept;
  // Deletes what the GPU has finished with.
  void Collect();
  // After the device is gone (and idle) objects are deleted at once.
  void Close();

  // Signals `recording` and moves it on; on a lost device only the latter.
  Status Submit(uint32_t count, const VkCommandBuffer* commands, const PresentSync& = {});
  Status Wait(uint64_t serial);  // of a submitted serial
  uint64_t Completed();
  Status Check(VkResult, const char* object, const char* what);  // also notes a lost device
  // For what gives the caller no status: that there is no memory is said once, until SpeakAgain.
  Status CheckOnce(VkResult, const char* object, const char* what);
  void SpeakAgain() { saidNoMemory_ = false; }  // a new frame, or a call whose status needs its message
  // Of a failure after which nobody knows what the GPU does or holds. Waits for it, and says so, once.
  Status Lose(VkResult, const char* what);
  // Why a call failed that has given its message already.
  Status Failure() const { return lost ? Status::DeviceLost : Status::OutOfMemory; }
  void SetName(VkObjectType, uint64_t handle, const char* name);

  MessageLog log;
  Instance instance;
  Adapter adapter;
  VkDevice device = VK_NULL_HANDLE;
  VkQueue queue = VK_NULL_HANDLE;
  VolkDeviceTable vk{};
  VkSemaphore timeline = VK_NULL_HANDLE;
  std::unique_ptr<Allocator> memory;
  std::unique_ptr<Ring> ring;
  std::unique_ptr<LayoutCache> layouts;
  std::unique_ptr<PipelineCache> pipelines;
  std::unique_ptr<StateTables> states;
  std::unique_ptr<QueryHeap> queries;
  Context* context = nullptr;  // of the device; null before and after it
  uint64_t recording = 1;      // serial of the submission being recorded; smaller ones are submitted
  uint64_t nextId = 1;         // ids of views and the like: never reused, unlike handles
  bool lost = false;

 private:
  VkResult TrySubmit(uint32_t count, const VkCommandBuffer* commands, const PresentSync&);
  uint64_t completed_ = 0;
  bool closed_ = false, saidNoMemory_ = false;
  std::deque<std::pair<uint64_t, Retirable*>> retired_;
};

// A final class of `Interface` whose deletion waits for the GPU.
template <class Interface>
class VkObject : public backend::Object<Interface>, public Retirable {
 public:
  explicit VkObject(std::shared_ptr<Core> core) : core_(std::move(core)) {}

 protected:
  void Destroy() noexcept override {
    const std::shared_ptr<Core> keep = core_;
    keep->Retire(this);
  }
  std::shared_ptr<Core> core_;
};

}  // namespace rhi_vulkan

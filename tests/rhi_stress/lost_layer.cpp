// A Vulkan layer that passes everything through, but for the calls that a test wants to fail (lost_layer.h). Written
// against the loader's layer interface, version 2.
#include "lost_layer.h"

#include <vulkan/vk_layer.h>
#include <vulkan/vulkan_core.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <cstring>
#include <map>
#include <mutex>
#include <string>
#include <string_view>

namespace {

template <size_t N>
struct Name {
  char text[N];
  constexpr Name(const char (&literal)[N]) { std::copy(literal, literal + N, text); }
};

struct NextInstance {
  VkInstance handle;
  PFN_vkGetInstanceProcAddr find;
  // Found once, at the beginning: later the loader gives this layer's own, the first of the chain.
  PFN_vkDestroyInstance destroy;
  PFN_vkGetPhysicalDeviceFeatures2 features;
  PFN_vkGetPhysicalDeviceProperties2 properties;
};
struct NextDevice {
  VkDevice handle;
  PFN_vkGetDeviceProcAddr find;
  bool lost = false;
};

struct Layer {
  std::mutex mutex;
  std::map<void*, NextInstance> instances;  // by the loader's dispatch pointer, which children share
  std::map<void*, NextDevice> devices;
  std::string failing;
  VkResult result = VK_SUCCESS;
  uint32_t skip = 0, times = 0, failures = 0;
  bool hideDrawParameters = false;
  bool saveCaches = false;
  uint32_t warmCaches = 0;
};
Layer& TheLayer() {
  static Layer layer;
  return layer;
}

template <class Handle>
void* KeyOf(Handle handle) {
  void* key = nullptr;
  std::memcpy(&key, reinterpret_cast<void*>(handle), sizeof key);
  return key;
}

// What a call of `name` shall give; success: ask the driver. Under the mutex.
VkResult Verdict(Layer& layer, std::string_view name) {
  if (name != layer.failing || layer.times == 0) return VK_SUCCESS;
  if (layer.skip != 0) return --layer.skip, VK_SUCCESS;
  if (layer.times != rhi_stress::kForever) --layer.times;
  ++layer.failures;
  return layer.result;
}

bool TellsLoss(std::string_view name) {
  constexpr std::string_view kNames[] = {"vkQueueSubmit2",        "vkQueueWaitIdle",  "vkDeviceWaitIdle",
                                         "vkGetQueryPoolResults", "vkWaitSemaphores", "vkGetSemaphoreCounterValue"};
  return std::find(std::begin(kNames), std::end(kNames), name) != std::end(kNames);
}

template <Name name, class Function>
struct Hook;
template <Name name, class First, class... Rest>
struct Hook<name, VkResult(VKAPI_PTR*)(First, Rest...)> {
  static VKAPI_ATTR VkResult VKAPI_CALL Call(First first, Rest... rest) {
    Layer& layer = TheLayer();
    std::unique_lock lock(layer.mutex);
    NextDevice& device = layer.devices.at(KeyOf(first));
    const auto next = reinterpret_cast<VkResult(VKAPI_PTR*)(First, Rest...)>(device.find(device.handle, name.text));
    const VkResult verdict = Verdict(layer, name.text);
    if (verdict == VK_ERROR_DEVICE_LOST) device.lost = true;
    const bool lost = device.lost && TellsLoss(name.text);
    lock.unlock();
    // A lost device stands still when this has returned; so must the driver, which does not know.
    if (lost && std::strcmp(name.text, "vkDeviceWaitIdle") == 0) next(first, rest...);
    if (verdict != VK_SUCCESS) return verdict;
    return lost ? VK_ERROR_DEVICE_LOST : next(first, rest...);
  }
};

struct Entry {
  const char* name;
  PFN_vkVoidFunction function;
};
template <Name name, class Function>
Entry Failing() {
  return {name.text, reinterpret_cast<PFN_vkVoidFunction>(&Hook<name, Function>::Call)};
}
#define FAILING(name) Failing<#name, PFN_##name>()

const Entry kFailing[] = {FAILING(vkQueueSubmit2),
                          FAILING(vkQueueWaitIdle),
                          FAILING(vkDeviceWaitIdle),
                          FAILING(vkGetQueryPoolResults),
                          FAILING(vkWaitSemaphores),
                          FAILING(vkGetSemaphoreCounterValue),
                          FAILING(vkAllocateMemory),
                          FAILING(vkMapMemory),
                          FAILING(vkBindBufferMemory),
                          FAILING(vkBindImageMemory),
                          FAILING(vkCreateBuffer),
                          FAILING(vkCreateImage),
                          FAILING(vkCreateImageView),
                          FAILING(vkCreateSampler),
                          FAILING(vkCreateShaderModule),
                          FAILING(vkCreatePipelineCache),
                          FAILING(vkGetPipelineCacheData),
                          FAILING(vkCreatePipelineLayout),
                          FAILING(vkCreateGraphicsPipelines),
                          FAILING(vkCreateComputePipelines),
                          FAILING(vkCreateDescriptorSetLayout),
                          FAILING(vkCreateDescriptorPool),
                          FAILING(vkAllocateDescriptorSets),
                          FAILING(vkCreateCommandPool),
                          FAILING(vkAllocateCommandBuffers),
                          FAILING(vkBeginCommandBuffer),
                          FAILING(vkEndCommandBuffer),
                          FAILING(vkResetCommandPool),
                          FAILING(vkCreateSemaphore),
                          FAILING(vkCreateQueryPool)};

// The loader's link in a chain of creation structs.
template <class Info>
Info* FindLink(const void* chain, VkStructureType type) {
  for (auto* s = static_cast<const VkBaseInStructure*>(chain); s; s = s->pNext) {
    auto* info = reinterpret_cast<Info*>(const_cast<VkBaseInStructure*>(s));
    if (s->sType == type && info->function == VK_LAYER_LINK_INFO) return info;
  }
  return nullptr;
}

VKAPI_ATTR VkResult VKAPI_CALL CreateInstance(const VkInstanceCreateInfo* info, const VkAllocationCallbacks* allocator,
                                              VkInstance* instance) {
  auto* link = FindLink<VkLayerInstanceCreateInfo>(info->pNext, VK_STRUCTURE_TYPE_LOADER_INSTANCE_CREATE_INFO);
  if (!link) return VK_ERROR_INITIALIZATION_FAILED;
  const PFN_vkGetInstanceProcAddr find = link->u.pLayerInfo->pfnNextGetInstanceProcAddr;
  link->u.pLayerInfo = link->u.pLayerInfo->pNext;  // for the next layer
  const auto create = reinterpret_cast<PFN_vkCreateInstance>(find(VK_NULL_HANDLE, "vkCreateInstance"));
  const VkResult result = create(info, allocator, instance);
  if (result != VK_SUCCESS) return result;
  const std::lock_guard lock(TheLayer().mutex);
  TheLayer().instances[KeyOf(*instance)] = {
      *instance, find, reinterpret_cast<PFN_vkDestroyInstance>(find(*instance, "vkDestroyInstance")),
      reinterpret_cast<PFN_vkGetPhysicalDeviceFeatures2>(find(*instance, "vkGetPhysicalDeviceFeatures2")),
      reinterpret_cast<PFN_vkGetPhysicalDeviceProperties2>(find(*instance, "vkGetPhysicalDeviceProperties2"))};
  return result;
}

VKAPI_ATTR void VKAPI_CALL DestroyInstance(VkInstance instance, const VkAllocationCallbacks* allocator) {
  if (!instance) return;
  std::unique_lock lock(TheLayer().mutex);
  const NextInstance next = TheLayer().instances.extract(KeyOf(instance)).mapped();
  lock.unlock();
  next.destroy(instance, allocator);
}

VKAPI_ATTR VkResult VKAPI_CALL CreateDevice(VkPhysicalDevice physical, const VkDeviceCreateInfo* info,
                                            const VkAllocationCallbacks* allocator, VkDevice* device) {
  auto* link = FindLink<VkLayerDeviceCreateInfo>(info->pNext, VK_STRUCTURE_TYPE_LOADER_DEVICE_CREATE_INFO);
  if (!link) return VK_ERROR_INITIALIZATION_FAILED;
  Layer& layer = TheLayer();
  std::unique_lock lock(layer.mutex);
  const NextInstance instance = layer.instances.at(KeyOf(physical));
  if (const VkResult verdict = Verdict(layer, "vkCreateDevice"); verdict != VK_SUCCESS) return verdict;
  lock.unlock();
  const VkLayerDeviceLink next = *link->u.pLayerInfo;
  link->u.pLayerInfo = next.pNext;
  const auto create =
      reinterpret_cast<PFN_vkCreateDevice>(next.pfnNextGetInstanceProcAddr(instance.handle, "vkCreateDevice"));
  const VkResult result = create(physical, info, allocator, device);
  if (result != VK_SUCCESS) return result;
  lock.lock();
  layer.devices[KeyOf(*device)] = {*device, next.pfnNextGetDeviceProcAddr};
  return result;
}

VKAPI_ATTR void VKAPI_CALL DestroyDevice(VkDevice device, const VkAllocationCallbacks* allocator) {
  if (!device) return;
  std::unique_lock lock(TheLayer().mutex);
  const NextDevice next = TheLayer().devices.extract(KeyOf(device)).mapped();
  lock.unlock();
  reinterpret_cast<PFN_vkDestroyDevice>(next.find(device, "vkDestroyDevice"))(device, allocator);
}

VKAPI_ATTR void VKAPI_CALL GetPhysicalDeviceFeatures2(VkPhysicalDevice physical, VkPhysicalDeviceFeatures2* features) {
  std::unique_lock lock(TheLayer().mutex);
  const NextInstance next = TheLayer().instances.at(KeyOf(physical));
  const bool hide = TheLayer().hideDrawParameters;
  lock.unlock();
  next.features(physical, features);
  for (auto* s = static_cast<VkBaseOutStructure*>(features->pNext); hide && s; s = s->pNext)
    if (s->sType == VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_1_FEATURES)
      reinterpret_cast<VkPhysicalDeviceVulkan11Features*>(s)->shaderDrawParameters = VK_FALSE;
}

VKAPI_ATTR void VKAPI_CALL GetPhysicalDeviceProperties2(VkPhysicalDevice physical,
                                                        VkPhysicalDeviceProperties2* properties) {
  std::unique_lock lock(TheLayer().mutex);
  const NextInstance next = TheLayer().instances.at(KeyOf(physical));
  const bool another = TheLayer().saveCaches;
  lock.unlock();
  next.properties(physical, properties);
  for (auto* s = static_cast<VkBaseOutStructure*>(properties->pNext); another && s; s = s->pNext)
    if (s->sType == VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_DRIVER_PROPERTIES)
      reinterpret_cast<VkPhysicalDeviceDriverProperties*>(s)->driverID = VK_DRIVER_ID_MAX_ENUM;
}

// What the pretended driver saves: its header, then this.
constexpr size_t kCacheHeaderBytes = 32;
constexpr std::string_view kSaved = "pipelines, made once and for all";

VKAPI_ATTR VkResult VKAPI_CALL GetPipelineCacheData(VkDevice device, VkPipelineCache cache, size_t* bytes, void* data) {
  const auto next = &Hook<"vkGetPipelineCacheData", PFN_vkGetPipelineCacheData>::Call;
  if (!TheLayer().saveCaches) return next(device, cache, bytes, data);
  const size_t all = kCacheHeaderBytes + kSaved.size();
  size_t header = kCacheHeaderBytes;
  if (data && *bytes < all) return VK_INCOMPLETE;
  *bytes = all;
  if (!data) return VK_SUCCESS;
  const VkResult result = next(device, cache, &header, data);
  std::memcpy(static_cast<char*>(data) + kCacheHeaderBytes, kSaved.data(), kSaved.size());
  return result == VK_INCOMPLETE ? VK_SUCCESS : result;
}

VKAPI_ATTR VkResult VKAPI_CALL CreatePipelineCache(VkDevice device, const VkPipelineCacheCreateInfo* info,
                                                   const VkAllocationCallbacks* allocator, VkPipelineCache* cache) {
  VkPipelineCacheCreateInfo passed = *info;
  if (TheLayer().saveCaches && info->initialDataSize != 0) {
    const auto* data = static_cast<const char*>(info->pInitialData);
    const bool intact = info->initialDataSize == kCacheHeaderBytes + kSaved.size() &&
                        std::memcmp(data + kCacheHeaderBytes, kSaved.data(), kSaved.size()) == 0;
    if (!intact) std::abort();  // as a driver may that trusts what it is given
    ++TheLayer().warmCaches;
    passed.initialDataSize = kCacheHeaderBytes;
  }
  return Hook<"vkCreatePipelineCache", PFN_vkCreatePipelineCache>::Call(device, &passed, allocator, cache);
}

PFN_vkVoidFunction FindOwn(const Entry* begin, const Entry* end, const char* name) {
  const Entry* found = std::find_if(begin, end, [&](const Entry& e) { return std::strcmp(e.name, name) == 0; });
  return found == end ? nullptr : found->function;
}

VKAPI_ATTR PFN_vkVoidFunction VKAPI_CALL GetDeviceProcAddr(VkDevice device, const char* name) {
  static const Entry own[] = {{"vkGetDeviceProcAddr", reinterpret_cast<PFN_vkVoidFunction>(GetDeviceProcAddr)},
                              {"vkDestroyDevice", reinterpret_cast<PFN_vkVoidFunction>(DestroyDevice)},
                              {"vkGetPipelineCacheData", reinterpret_cast<PFN_vkVoidFunction>(GetPipelineCacheData)},
                              {"vkCreatePipelineCache", reinterpret_cast<PFN_vkVoidFunction>(CreatePipelineCache)}};
  if (const auto f = FindOwn(std::begin(own), std::end(own), name)) return f;
  if (const auto f = FindOwn(std::begin(kFailing), std::end(kFailing), name)) return f;
  const std::lock_guard lock(TheLayer().mutex);
  return TheLayer().devices.at(KeyOf(device)).find(device, name);
}

VKAPI_ATTR PFN_vkVoidFunction VKAPI_CALL GetInstanceProcAddr(VkInstance instance, const char* name) {
  static const Entry own[] = {
      {"vkGetInstanceProcAddr", reinterpret_cast<PFN_vkVoidFunction>(GetInstanceProcAddr)},
      {"vkGetDeviceProcAddr", reinterpret_cast<PFN_vkVoidFunction>(GetDeviceProcAddr)},
      {"vkCreateInstance", reinterpret_cast<PFN_vkVoidFunction>(CreateInstance)},
      {"vkDestroyInstance", reinterpret_cast<PFN_vkVoidFunction>(DestroyInstance)},
      {"vkCreateDevice", reinterpret_cast<PFN_vkVoidFunction>(CreateDevice)},
      {"vkDestroyDevice", reinterpret_cast<PFN_vkVoidFunction>(DestroyDevice)},
      {"vkGetPhysicalDeviceProperties2", reinterpret_cast<PFN_vkVoidFunction>(GetPhysicalDeviceProperties2)},
      {"vkGetPhysicalDeviceFeatures2", reinterpret_cast<PFN_vkVoidFunction>(GetPhysicalDeviceFeatures2)}};
  if (const auto f = FindOwn(std::begin(own), std::end(own), name)) return f;
  if (const auto f = FindOwn(std::begin(kFailing), std::end(kFailing), name)) return f;
  if (!instance) return nullptr;
  const std::lock_guard lock(TheLayer().mutex);
  return TheLayer().instances.at(KeyOf(instance)).find(instance, name);
}

void Fail(const char* function, int32_t result, uint32_t skip, uint32_t times) {
  Layer& layer = TheLayer();
  const std::lock_guard lock(layer.mutex);
  layer.failing = function;
  layer.result = VkResult(result);
  layer.skip = skip;
  layer.times = times;
  layer.failures = 0;
}
void Pass() {
  const std::lock_guard lock(TheLayer().mutex);
  TheLayer().times = 0;
}
uint32_t Failures() {
  const std::lock_guard lock(TheLayer().mutex);
  return TheLayer().failures;
}
void HideDrawParameters(bool hide) {
  const std::lock_guard lock(TheLayer().mutex);
  TheLayer().hideDrawParameters = hide;
}
void SaveCaches(bool save) {
  const std::lock_guard lock(TheLayer().mutex);
  TheLayer().saveCaches = save;
  TheLayer().warmCaches = 0;
}
uint32_t WarmCaches() {
  const std::lock_guard lock(TheLayer().mutex);
  return TheLayer().warmCaches;
}
const char* const* Functions() {
  static const auto names = [] {
    std::array<const char*, std::size(kFailing) + 2> all{};
    std::transform(std::begin(kFailing), std::end(kFailing), all.begin(), [](const Entry& e) { return e.name; });
    all[std::size(kFailing)] = "vkCreateDevice";
    return all;
  }();
  return names.data();
}

}  // namespace

extern "C" {

VK_LAYER_EXPORT VKAPI_ATTR VkResult VKAPI_CALL
vkNegotiateLoaderLayerInterfaceVersion(VkNegotiateLayerInterface* versions) {
  if (versions->loaderLayerInterfaceVersion < 2) return VK_ERROR_INITIALIZATION_FAILED;
  versions->loaderLayerInterfaceVersion = 2;
  versions->pfnGetInstanceProcAddr = GetInstanceProcAddr;
  versions->pfnGetDeviceProcAddr = GetDeviceProcAddr;
  versions->pfnGetPhysicalDeviceProcAddr = nullptr;
  return VK_SUCCESS;
}

VK_LAYER_EXPORT const rhi_stress::LostLayer* FurLostLayer() {
  static const rhi_stress::LostLayer layer{Fail, Pass, Failures, HideDrawParameters, SaveCaches, WarmCaches, Functions};
  return &layer;
}
}

// CreateDevice: the instance, the choice of an adapter, the VkDevice.
#include <strings.h>

#include <cstring>

#include "device.h"
#include "rhi_vulkan/rhi_vulkan.h"

namespace rhi_vulkan {
namespace {

const Adapter* FirstOf(const std::vector<Adapter>& adapters, bool software) {
  const auto it = std::find_if(adapters.begin(), adapters.end(),
                               [&](const Adapter& a) { return a.Usable() && a.caps.software == software; });
  return it == adapters.end() ? nullptr : &*it;
}

const Adapter* Choose(const std::vector<Adapter>& adapters, const DeviceDesc& desc) {
  if (desc.adapter && *desc.adapter) {
    const auto it = std::find_if(adapters.begin(), adapters.end(), [&](const Adapter& a) {
      return a.Usable() && strcasestr(a.caps.adapter.data(), desc.adapter) != nullptr;
    });
    return it == adapters.end() ? nullptr : &*it;
  }
  const Adapter* preferred = FirstOf(adapters, desc.preferSoftware);
  return preferred ? preferred : FirstOf(adapters, !desc.preferSoftware);
}

Status ChooseAdapter(Core& core, const DeviceDesc& desc) {
  std::vector<Adapter> adapters;
  std::string seen;
  for (VkPhysicalDevice physical : core.instance.PhysicalDevices()) {
    adapters.push_back(DescribeAdapter(core.instance, physical));
    const Caps& c = adapters.back().caps;
    seen += (seen.empty() ? "" : ", ") + std::string(c.adapter.data()) + " (Vulkan " + std::to_string(c.apiMajor) +
            "." + std::to_string(c.apiMinor) + ")";
  }
  if (const Adapter* chosen = Choose(adapters, desc)) {
    core.adapter = *chosen;
    return Status::Ok;
  }
  core.log.Report(Severity::Error, MsgCode::DeviceUnavailable, "", "no Vulkan 1.3 adapter%s%s; the loader lists: %s",
                  desc.adapter && *desc.adapter ? " named like " : "", desc.adapter ? desc.adapter : "",
                  seen.empty() ? "none" : seen.c_str());
  return Status::Unsupported;
}

std::vector<const char*> DeviceExtensions(const Adapter& adapter) {
  std::vector<const char*> list;
  for (const char* name : {VK_EXT_LINE_RASTERIZATION_EXTENSION_NAME, VK_EXT_DEPTH_CLIP_ENABLE_EXTENSION_NAME,
                           VK_EXT_VERTEX_ATTRIBUTE_DIVISOR_EXTENSION_NAME, VK_EXT_ROBUSTNESS_2_EXTENSION_NAME,
                           VK_EXT_CUSTOM_BORDER_COLOR_EXTENSION_NAME})
    if (adapter.Has(name)) list.push_back(name);
  if (adapter.caps.swapChain) list.push_back(VK_KHR_SWAPCHAIN_EXTENSION_NAME);
  return list;
}

Status CreateVkDevice(Core& core) {
  const InstanceTable& vki = core.instance.vk;
  FeatureChain features(core.adapter);
  vki.vkGetPhysicalDeviceFeatures2(core.adapter.handle, &features.core);
  features.KeepWanted();
  const float priority = 1;
  VkDeviceQueueCreateInfo queue{VK_STRUCTURE_TYPE_DEVICE_QUEUE_CREATE_INFO};
  queue.queueFamilyIndex = core.adapter.queueFamily;
  queue.queueCount = 1;
  queue.pQueuePriorities = &priority;
  const std::vector<const char*> extensions = DeviceExtensions(core.adapter);
  VkDeviceCreateInfo info{VK_STRUCTURE_TYPE_DEVICE_CREATE_INFO, &features.core};
  info.queueCreateInfoCount = 1;
  info.pQueueCreateInfos = &queue;
  info.enabledExtensionCount = uint32_t(extensions.size());
  info.ppEnabledExtensionNames = extensions.data();
  return core.Check(vki.vkCreateDevice(core.adapter.handle, &info, nullptr, &core.device),
                    core.adapter.caps.adapter.data(), "vkCreateDevice");
}

void LoadDeviceTable(Core& core) {
  // volk's table loader reads vkGetDeviceProcAddr from a global, which is the loader's own function for every instance.
  static const bool once = [&] {
    volkLoadInstanceOnly(core.instance.handle);
    return true;
  }();
  (void)once;
  volkLoadDeviceTable(&core.vk, core.device);
  core.vk.vkGetDeviceQueue(core.device, core.adapter.queueFamily, 0, &core.queue);
}

Status CreateTimeline(Core& core) {
  VkSemaphoreTypeCreateInfo type{VK_STRUCTURE_TYPE_SEMAPHORE_TYPE_CREATE_INFO};
  type.semaphoreType = VK_SEMAPHORE_TYPE_TIMELINE;
  VkSemaphoreCreateInfo info{VK_STRUCTURE_TYPE_SEMAPHORE_CREATE_INFO, &type};
  return core.Check(core.vk.vkCreateSemaphore(core.device, &info, nullptr, &core.timeline), "", "vkCreateSemaphore");
}

Status CreateParts(Core& core, const DeviceDesc& desc) {
  VkPhysicalDeviceMemoryProperties memory{};
  core.instance.vk.vkGetPhysicalDeviceMemoryProperties(core.adapter.handle, &memory);
  core.memory = std::make_unique<Allocator>(core.vk, core.device, memory);
  const VkPhysicalDeviceLimits& limits = core.adapter.properties.limits;
  const VkDeviceSize alignment =
      std::max<VkDeviceSize>({16, limits.minUniformBufferOffsetAlignment, limits.minStorageBufferOffsetAlignment});
  core.ring = std::make_unique<Ring>(core, std::max(desc.ringPageBytes, 65536u), uint32_t(alignment));
  core.states = std::make_unique<StateTables>();
  core.queries = std::make_unique<QueryHeap>(core);
  core.layouts = std::make_unique<LayoutCache>(core);
  core.pipelines = std::make_unique<PipelineCache>(core);
  if (Status s = CreateTimeline(core); s != Status::Ok) return s;
  if (Status s = core.layouts->Init(); s != Status::Ok) return s;
  return core.pipelines->Init(desc.pipelineCache, desc.pipelineCacheSize);
}

}  // namespace

Status CreateDevice(const DeviceDesc& desc, Ref<IDevice>* out) {
  *out = nullptr;
  auto core = std::make_shared<Core>(desc.sink);
  if (Status s = core->instance.Create(desc, core->log); s != Status::Ok) return s;
  if (Status s = ChooseAdapter(*core, desc); s != Status::Ok) return s;
  if (Status s = CreateVkDevice(*core); s != Status::Ok) return s;
  LoadDeviceTable(*core);
  if (Status s = CreateParts(*core, desc); s != Status::Ok) return s;
  auto device = Ref<VulkanDevice>::Adopt(new VulkanDevice(core, desc));
  if (Status s = device->Init(desc); s != Status::Ok) return s;
  *out = device;
  return Status::Ok;
}

std::vector<Caps> EnumerateAdapters() {
  const MessageLog log;
  Instance instance;
  std::vector<Caps> list;
  if (instance.Create({}, log) != Status::Ok) return list;
  for (VkPhysicalDevice physical : instance.PhysicalDevices()) list.push_back(DescribeAdapter(instance, physical).caps);
  return list;
}

}  // namespace rhi_vulkan

// The Vulkan instance, its debug messenger, and the adapters it lists.
#pragma once

#include <string>
#include <vector>

#include "vulkan_api.h"

namespace rhi_vulkan {

struct Instance {
  VkInstance handle = VK_NULL_HANDLE;
  VkDebugUtilsMessengerEXT messenger = VK_NULL_HANDLE;
  InstanceTable vk;
  bool debugUtils = false;
  bool validation = false;
  bool surfaces = false;    // made with VK_KHR_xlib_surface
  void* display = nullptr;  // DeviceDesc::nativeDisplay

  Instance() = default;
  Instance(const Instance&) = delete;
  Instance& operator=(const Instance&) = delete;
  ~Instance();

  // `log` must outlive the instance: the messenger reports to it.
  Status Create(const DeviceDesc& desc, const MessageLog& log);
  std::vector<VkPhysicalDevice> PhysicalDevices() const;
};

// What can be turned on in a device. All false: not there.
struct Features {
  bool bresenhamLines = false, depthClipEnable = false, instanceDivisor = false, robustness2 = false,
       nullDescriptor = false, customBorderColor = false, hostQueryReset = false, drawParameters = false;
};

struct Adapter {
  VkPhysicalDevice handle = VK_NULL_HANDLE;
  VkPhysicalDeviceProperties properties{};
  Caps caps;
  Features features;
  uint32_t queueFamily = ~0u;  // of the first family with graphics and compute; ~0: none
  std::vector<std::string> extensions;

  bool Has(const char* extension) const;
  bool Usable() const { return queueFamily != ~0u && properties.apiVersion >= VK_API_VERSION_1_3; }
};

Adapter DescribeAdapter(const Instance&, VkPhysicalDevice);

// The feature structs of everything that this backend may use, chained for the extensions that are there.
struct FeatureChain {
  VkPhysicalDeviceFeatures2 core{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_FEATURES_2};
  VkPhysicalDeviceVulkan11Features v11{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_1_FEATURES};
  VkPhysicalDeviceVulkan12Features v12{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_2_FEATURES};
  VkPhysicalDeviceVulkan13Features v13{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_3_FEATURES};
  VkPhysicalDeviceLineRasterizationFeaturesEXT lines{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_LINE_RASTERIZATION_FEATURES_EXT};
  VkPhysicalDeviceDepthClipEnableFeaturesEXT clip{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_DEPTH_CLIP_ENABLE_FEATURES_EXT};
  VkPhysicalDeviceVertexAttributeDivisorFeaturesEXT divisor{
      VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VERTEX_ATTRIBUTE_DIVISOR_FEATURES_EXT};
  VkPhysicalDeviceRobustness2FeaturesEXT robustness{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_ROBUSTNESS_2_FEATURES_EXT};
  VkPhysicalDeviceCustomBorderColorFeaturesEXT border{
      VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_CUSTOM_BORDER_COLOR_FEATURES_EXT};

  explicit FeatureChain(const Adapter&);
  FeatureChain(const FeatureChain&) = delete;  // the chain points into itself
  FeatureChain& operator=(const FeatureChain&) = delete;

  // Keeps of what the adapter offers only what this backend uses.
  void KeepWanted();
};

}  // namespace rhi_vulkan

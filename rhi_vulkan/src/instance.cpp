#include "instance.h"

#include <cstring>
#include <mutex>

namespace rhi_vulkan {
namespace {

constexpr const char* kValidationLayer = "VK_LAYER_KHRONOS_validation";

// volk keeps its loader pointers in globals; they are the same for every instance, so they are loaded once.
bool LoadLoader() {
  static const bool loaded = volkInitialize() == VK_SUCCESS;
  return loaded;
}

template <class Function>
void Load(VkInstance instance, const char* name, Function& function) {
  function = reinterpret_cast<Function>(vkGetInstanceProcAddr(instance, name));
}

void LoadTable(VkInstance instance, InstanceTable& t) {
  Load(instance, "vkDestroyInstance", t.vkDestroyInstance);
  Load(instance, "vkEnumeratePhysicalDevices", t.vkEnumeratePhysicalDevices);
  Load(instance, "vkGetPhysicalDeviceProperties", t.vkGetPhysicalDeviceProperties);
  Load(instance, "vkGetPhysicalDeviceProperties2", t.vkGetPhysicalDeviceProperties2);
  Load(instance, "vkGetPhysicalDeviceFeatures2", t.vkGetPhysicalDeviceFeatures2);
  Load(instance, "vkGetPhysicalDeviceMemoryProperties", t.vkGetPhysicalDeviceMemoryProperties);
  Load(instance, "vkGetPhysicalDeviceQueueFamilyProperties", t.vkGetPhysicalDeviceQueueFamilyProperties);
  Load(instance, "vkGetPhysicalDeviceFormatProperties", t.vkGetPhysicalDeviceFormatProperties);
  Load(instance, "vkGetPhysicalDeviceImageFormatProperties", t.vkGetPhysicalDeviceImageFormatProperties);
  Load(instance, "vkEnumerateDeviceExtensionProperties", t.vkEnumerateDeviceExtensionProperties);
  Load(instance, "vkCreateDevice", t.vkCreateDevice);
  Load(instance, "vkDestroySurfaceKHR", t.vkDestroySurfaceKHR);
  Load(instance, "vkGetPhysicalDeviceSurfaceSupportKHR", t.vkGetPhysicalDeviceSurfaceSupportKHR);
  Load(instance, "vkGetPhysicalDeviceSurfaceCapabilitiesKHR", t.vkGetPhysicalDeviceSurfaceCapabilitiesKHR);
  Load(instance, "vkGetPhysicalDeviceSurfaceFormatsKHR", t.vkGetPhysicalDeviceSurfaceFormatsKHR);
  Load(instance, "vkGetPhysicalDeviceSurfacePresentModesKHR", t.vkGetPhysicalDeviceSurfacePresentModesKHR);
  Load(instance, "vkCreateDebugUtilsMessengerEXT", t.vkCreateDebugUtilsMessengerEXT);
  Load(instance, "vkDestroyDebugUtilsMessengerEXT", t.vkDestroyDebugUtilsMessengerEXT);
  Load(instance, "vkSetDebugUtilsObjectNameEXT", t.vkSetDebugUtilsObjectNameEXT);
  Load(instance, "vkCmdBeginDebugUtilsLabelEXT", t.vkCmdBeginDebugUtilsLabelEXT);
  Load(instance, "vkCmdEndDebugUtilsLabelEXT", t.vkCmdEndDebugUtilsLabelEXT);
}

bool HasLayer(const char* name) {
  uint32_t count = 0;
  vkEnumerateInstanceLayerProperties(&count, nullptr);
  std::vector<VkLayerProperties> layers(count);
  vkEnumerateInstanceLayerProperties(&count, layers.data());
  return std::any_of(layers.begin(), layers.end(), [&](const auto& l) { return std::strcmp(l.layerName, name) == 0; });
}

bool HasInstanceExtension(const char* layer, const char* name) {
  uint32_t count = 0;
  vkEnumerateInstanceExtensionProperties(layer, &count, nullptr);
  std::vector<VkExtensionProperties> list(count);
  vkEnumerateInstanceExtensionProperties(layer, &count, list.data());
  return std::any_of(list.begin(), list.end(), [&](const auto& e) { return std::strcmp(e.extensionName, name) == 0; });
}

VKAPI_ATTR VkBool32 VKAPI_CALL OnDebugMessage(VkDebugUtilsMessageSeverityFlagBitsEXT severity,
                                              VkDebugUtilsMessageTypeFlagsEXT,
                                              const VkDebugUtilsMessengerCallbackDataEXT* data, void* user) {
  const char* object = "";
  for (uint32_t i = 0; i < data->objectCount && !*object; ++i)
    if (data->pObjects[i].pObjectName) object = data->pObjects[i].pObjectName;
  const bool error = severity & VK_DEBUG_UTILS_MESSAGE_SEVERITY_ERROR_BIT_EXT;
  static_cast<const MessageLog*>(user)->Forward({error ? Severity::Error : Severity::Warning, MsgCode::ApiValidation,
                                                 object, data->pMessage ? data->pMessage : "", data->messageIdNumber});
  return VK_FALSE;
}

VkDebugUtilsMessengerCreateInfoEXT MessengerInfo(const MessageLog& log) {
  VkDebugUtilsMessengerCreateInfoEXT info{VK_STRUCTURE_TYPE_DEBUG_UTILS_MESSENGER_CREATE_INFO_EXT};
  info.messageSeverity =
      VK_DEBUG_UTILS_MESSAGE_SEVERITY_WARNING_BIT_EXT | VK_DEBUG_UTILS_MESSAGE_SEVERITY_ERROR_BIT_EXT;
  // Not GENERAL: the loader uses it to tell about drivers that are not installed.
  info.messageType = VK_DEBUG_UTILS_MESSAGE_TYPE_VALIDATION_BIT_EXT;
  info.pfnUserCallback = OnDebugMessage;
  info.pUserData = const_cast<MessageLog*>(&log);
  return info;
}

std::vector<const char*> InstanceExtensions(bool surfaces, bool validation, bool debugUtils) {
  std::vector<const char*> list;
  if (debugUtils) list.push_back(VK_EXT_DEBUG_UTILS_EXTENSION_NAME);
  if (validation) list.push_back(VK_EXT_VALIDATION_FEATURES_EXTENSION_NAME);
  if (surfaces) list.push_back(VK_KHR_SURFACE_EXTENSION_NAME);
  if (surfaces) list.push_back("VK_KHR_xlib_surface");
  return list;
}

}  // namespace

Instance::~Instance() {
  if (messenger) vk.vkDestroyDebugUtilsMessengerEXT(handle, messenger, nullptr);
  if (handle) vk.vkDestroyInstance(handle, nullptr);
}

Status Instance::Create(const DeviceDesc& desc, const MessageLog& log) {
  if (!LoadLoader() || volkGetInstanceVersion() < VK_API_VERSION_1_3) {
    log.Report(Severity::Error, MsgCode::DeviceUnavailable, "",
               "no Vulkan 1.3 loader; install libvulkan.so.1 of at least 1.3 and a driver");
    return Status::Unsupported;
  }
  debugUtils = HasInstanceExtension(nullptr, VK_EXT_DEBUG_UTILS_EXTENSION_NAME);
  validation = desc.apiValidation && debugUtils && HasLayer(kValidationLayer);
  if (desc.apiValidation && !validation)
    log.Report(Severity::Warning, MsgCode::CapMissing, "",
               "apiValidation was asked for, but %s is not installed; the device is made without it", kValidationLayer);

  // Only a device for a native display touches the window system.
  display = desc.nativeDisplay;
  surfaces = display && HasInstanceExtension(nullptr, VK_KHR_SURFACE_EXTENSION_NAME) &&
             HasInstanceExtension(nullptr, "VK_KHR_xlib_surface");
  VkApplicationInfo app{VK_STRUCTURE_TYPE_APPLICATION_INFO};
  app.pEngineName = "fur rhi";
  app.apiVersion = VK_API_VERSION_1_3;
  const VkValidationFeatureEnableEXT sync = VK_VALIDATION_FEATURE_ENABLE_SYNCHRONIZATION_VALIDATION_EXT;
  VkValidationFeaturesEXT layerFeatures{VK_STRUCTURE_TYPE_VALIDATION_FEATURES_EXT};
  layerFeatures.enabledValidationFeatureCount = desc.syncValidation ? 1 : 0;
  layerFeatures.pEnabledValidationFeatures = &sync;
  VkDebugUtilsMessengerCreateInfoEXT messengerInfo = MessengerInfo(log);
  messengerInfo.pNext = &layerFeatures;  // so that messages of vkCreateInstance itself arrive too
  const std::vector<const char*> extensions = InstanceExtensions(surfaces, validation, debugUtils);
  VkInstanceCreateInfo info{VK_STRUCTURE_TYPE_INSTANCE_CREATE_INFO};
  info.pNext = validation ? &messengerInfo : nullptr;
  info.pApplicationInfo = &app;
  info.enabledLayerCount = validation ? 1 : 0;
  info.ppEnabledLayerNames = &kValidationLayer;
  info.enabledExtensionCount = uint32_t(extensions.size());
  info.ppEnabledExtensionNames = extensions.data();
  if (Status s = CheckResult(log, vkCreateInstance(&info, nullptr, &handle), "", "vkCreateInstance"); s != Status::Ok)
    return s;
  LoadTable(handle, vk);
  if (!validation) return Status::Ok;
  messengerInfo.pNext = nullptr;
  return CheckResult(log, vk.vkCreateDebugUtilsMessengerEXT(handle, &messengerInfo, nullptr, &messenger), "",
                     "vkCreateDebugUtilsMessengerEXT");
}

std::vector<VkPhysicalDevice> Instance::PhysicalDevices() const {
  uint32_t count = 0;
  vk.vkEnumeratePhysicalDevices(handle, &count, nullptr);
  std::vector<VkPhysicalDevice> devices(count);
  if (count) vk.vkEnumeratePhysicalDevices(handle, &count, devices.data());
  devices.resize(count);
  return devices;
}

}  // namespace rhi_vulkan

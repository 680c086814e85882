// What an adapter can do: Caps for the user, Features for this backend.
#include <cstring>

#include "instance.h"

namespace rhi_vulkan {
namespace {

template <size_t N>
void CopyText(std::array<char, N>& out, const char* text) {
  std::snprintf(out.data(), N, "%.*s", int(N - 1), text);
}

std::vector<std::string> DeviceExtensions(const InstanceTable& vki, VkPhysicalDevice physical) {
  uint32_t count = 0;
  vki.vkEnumerateDeviceExtensionProperties(physical, nullptr, &count, nullptr);
  std::vector<VkExtensionProperties> list(count);
  vki.vkEnumerateDeviceExtensionProperties(physical, nullptr, &count, list.data());
  std::vector<std::string> names;
  names.reserve(list.size());
  for (const VkExtensionProperties& e : list) names.emplace_back(e.extensionName);
  return names;
}

uint32_t FindQueueFamily(const InstanceTable& vki, VkPhysicalDevice physical, bool* timestamps) {
  uint32_t count = 0;
  vki.vkGetPhysicalDeviceQueueFamilyProperties(physical, &count, nullptr);
  std::vector<VkQueueFamilyProperties> families(count);
  vki.vkGetPhysicalDeviceQueueFamilyProperties(physical, &count, families.data());
  constexpr VkQueueFlags kNeed = VK_QUEUE_GRAPHICS_BIT | VK_QUEUE_COMPUTE_BIT;
  for (uint32_t i = 0; i < count; ++i) {
    if ((families[i].queueFlags & kNeed) != kNeed) continue;
    *timestamps = families[i].timestampValidBits > 0;
    return i;
  }
  return ~0u;
}

uint32_t HighestCount(VkSampleCountFlags counts) {
  uint32_t highest = 1;
  for (uint32_t samples = 2; samples <= 64; samples *= 2)
    if (counts & samples) highest = samples;
  return highest;
}

void FillIdentity(Caps& c, const VkPhysicalDeviceProperties& p, const VkPhysicalDeviceDriverProperties& driver) {
  c.backend = Backend::Vulkan;
  CopyText(c.adapter, p.deviceName);
  std::snprintf(c.driver.data(), c.driver.size(), "%.60s %.60s", driver.driverName, driver.driverInfo);
  c.apiMajor = VK_API_VERSION_MAJOR(p.apiVersion);
  c.apiMinor = VK_API_VERSION_MINOR(p.apiVersion);
  c.software = p.deviceType == VK_PHYSICAL_DEVICE_TYPE_CPU;
  // Theirs are bare headers, whatever pipelines there are (lavapipe of Mesa 22.3, SwiftShader of Chromium 156).
  c.pipelineCacheBlob =
      driver.driverID != VK_DRIVER_ID_MESA_LLVMPIPE && driver.driverID != VK_DRIVER_ID_GOOGLE_SWIFTSHADER;
}

void FillLimits(Caps& c, const VkPhysicalDeviceLimits& l) {
  c.maxTexture2D = l.maxImageDimension2D;
  c.maxTexture3D = l.maxImageDimension3D;
  c.maxArrayLayers = l.maxImageArrayLayers;
  c.maxColorSamples = std::min(HighestCount(l.framebufferColorSampleCounts & l.framebufferDepthSampleCounts), kMaxSamples);
  c.constantBufferAlignment = uint32_t(l.minUniformBufferOffsetAlignment);
  c.timestampPeriodNs = double(l.timestampPeriod);
  if (!c.geometryShader) return;
  c.maxGSOutputVertices = l.maxGeometryOutputVertices;
  c.maxGSOutputComponents = l.maxGeometryTotalOutputComponents;
}

void FillFeatures(Caps& c, const FeatureChain& f) {
  const VkPhysicalDeviceFeatures& core = f.core.features;
  c.geometryShader = core.geometryShader;
  c.layeredRendering = core.geometryShader || f.v12.shaderOutputLayer;
  c.alphaToCoverage = c.drawIndirect = c.compute = true;  // every Vulkan driver
  c.independentBlend = core.independentBlend;
  c.dualSourceBlend = core.dualSrcBlend;
  c.wireframe = core.fillModeNonSolid;
  c.depthClipDisable = core.depthClamp;
  c.depthBiasClamp = core.depthBiasClamp;
  c.instanceStepRate = f.divisor.vertexAttributeInstanceRateDivisor;
  c.customBorderColor = f.border.customBorderColors && f.border.customBorderColorWithoutFormat;
  c.pipelineStatistics = core.pipelineStatisticsQuery && f.v12.hostQueryReset;
  c.occlusionPrecise = core.occlusionQueryPrecise && f.v12.hostQueryReset;
  c.samplerAnisotropy = core.samplerAnisotropy;
  c.textureCompressionBC = core.textureCompressionBC;
  c.bresenhamLines = f.lines.bresenhamLines;
}

Features BackendFeatures(const FeatureChain& f) {
  Features out;
  out.bresenhamLines = f.lines.bresenhamLines;
  out.depthClipEnable = f.clip.depthClipEnable;
  out.instanceDivisor = f.divisor.vertexAttributeInstanceRateDivisor;
  out.robustness2 = f.robustness.robustBufferAccess2;
  out.nullDescriptor = f.robustness.nullDescriptor;
  out.customBorderColor = f.border.customBorderColors && f.border.customBorderColorWithoutFormat;
  out.hostQueryReset = f.v12.hostQueryReset;
  out.drawParameters = f.v11.shaderDrawParameters;
  return out;
}

template <class T>
void Append(VkPhysicalDeviceFeatures2& head, T& next) {
  next.pNext = head.pNext;
  head.pNext = &next;
}

}  // namespace

bool Adapter::Has(const char* extension) const {
  return std::find(extensions.begin(), extensions.end(), extension) != extensions.end();
}

FeatureChain::FeatureChain(const Adapter& adapter) {
  Append(core, v11);
  Append(core, v12);
  Append(core, v13);
  if (adapter.Has(VK_EXT_LINE_RASTERIZATION_EXTENSION_NAME)) Append(core, lines);
  if (adapter.Has(VK_EXT_DEPTH_CLIP_ENABLE_EXTENSION_NAME)) Append(core, clip);
  if (adapter.Has(VK_EXT_VERTEX_ATTRIBUTE_DIVISOR_EXTENSION_NAME)) Append(core, divisor);
  if (adapter.Has(VK_EXT_ROBUSTNESS_2_EXTENSION_NAME)) Append(core, robustness);
  if (adapter.Has(VK_EXT_CUSTOM_BORDER_COLOR_EXTENSION_NAME)) Append(core, border);
}

void FeatureChain::KeepWanted() {
  const VkPhysicalDeviceFeatures have = core.features;
  VkPhysicalDeviceFeatures& want = core.features;
  want = {};
  want.robustBufferAccess = have.robustBufferAccess;  // out-of-bounds reads give 0, as in Direct3D 10
  want.fullDrawIndexUint32 = have.fullDrawIndexUint32;
  want.imageCubeArray = have.imageCubeArray;
  want.independentBlend = have.independentBlend;
  want.geometryShader = have.geometryShader;
  want.sampleRateShading = have.sampleRateShading;
  want.dualSrcBlend = have.dualSrcBlend;
  want.drawIndirectFirstInstance = have.drawIndirectFirstInstance;
  want.depthClamp = have.depthClamp;
  want.depthBiasClamp = have.depthBiasClamp;
  want.fillModeNonSolid = have.fillModeNonSolid;
  want.multiViewport = have.multiViewport;
  want.samplerAnisotropy = have.samplerAnisotropy;
  want.textureCompressionBC = have.textureCompressionBC;
  want.occlusionQueryPrecise = have.occlusionQueryPrecise;
  want.pipelineStatisticsQuery = have.pipelineStatisticsQuery;
  want.vertexPipelineStoresAndAtomics = have.vertexPipelineStoresAndAtomics;
  want.fragmentStoresAndAtomics = have.fragmentStoresAndAtomics;
  want.shaderImageGatherExtended = have.shaderImageGatherExtended;
  want.shaderStorageImageExtendedFormats = have.shaderStorageImageExtendedFormats;
  want.shaderStorageImageReadWithoutFormat = have.shaderStorageImageReadWithoutFormat;
  want.shaderStorageImageWriteWithoutFormat = have.shaderStorageImageWriteWithoutFormat;
  want.shaderClipDistance = have.shaderClipDistance;
  want.shaderCullDistance = have.shaderCullDistance;

  const auto drawParameters = v11.shaderDrawParameters;
  const auto outputLayer = v12.shaderOutputLayer, outputViewport = v12.shaderOutputViewportIndex;
  const auto hostReset = v12.hostQueryReset;
  void *next11 = v11.pNext, *next12 = v12.pNext, *next13 = v13.pNext;
  v11 = {VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_1_FEATURES, next11};
  v12 = {VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_2_FEATURES, next12};
  v13 = {VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_3_FEATURES, next13};
  v11.shaderDrawParameters = drawParameters;
  v12.shaderOutputLayer = outputLayer;
  v12.shaderOutputViewportIndex = outputViewport;
  v12.hostQueryReset = hostReset;
  v12.timelineSemaphore = v13.dynamicRendering = v13.synchronization2 = VK_TRUE;  // a 1.3 driver has them
  v13.shaderDemoteToHelperInvocation = VK_TRUE;

  lines.rectangularLines = lines.smoothLines = VK_FALSE;
  lines.stippledRectangularLines = lines.stippledBresenhamLines = lines.stippledSmoothLines = VK_FALSE;
  divisor.vertexAttributeInstanceRateZeroDivisor = VK_FALSE;
  robustness.robustImageAccess2 = VK_FALSE;
}

Adapter DescribeAdapter(const Instance& instance, VkPhysicalDevice physical) {
  const InstanceTable& vki = instance.vk;
  Adapter a;
  a.handle = physical;
  a.extensions = DeviceExtensions(vki, physical);
  vki.vkGetPhysicalDeviceProperties(physical, &a.properties);
  bool timestamps = false;
  a.queueFamily = FindQueueFamily(vki, physical, &timestamps);
  VkPhysicalDeviceDriverProperties driver{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_DRIVER_PROPERTIES};
  if (a.properties.apiVersion >= VK_API_VERSION_1_3) {
    VkPhysicalDeviceProperties2 properties{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_PROPERTIES_2, &driver};
    vki.vkGetPhysicalDeviceProperties2(physical, &properties);
    FeatureChain chain(a);
    vki.vkGetPhysicalDeviceFeatures2(physical, &chain.core);
    FillFeatures(a.caps, chain);
    a.features = BackendFeatures(chain);
    a.caps.timestamp = timestamps && a.features.hostQueryReset;
  }
  FillIdentity(a.caps, a.properties, driver);
  FillLimits(a.caps, a.properties.limits);
  a.caps.debugMarkers = instance.debugUtils;
  a.caps.swapChain = instance.surfaces && a.Has(VK_KHR_SWAPCHAIN_EXTENSION_NAME);
  return a;
}

}  // namespace rhi_vulkan

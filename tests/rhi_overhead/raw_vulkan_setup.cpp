#include <algorithm>
#include <stdexcept>

#include "raw_vulkan.h"
#include "rhi_overhead_shaders/shaders.h"

namespace rhi_overhead {

void Require(VkResult result, const char* what) {
  if (result != VK_SUCCESS) throw std::runtime_error(std::string(what) + " gave " + std::to_string(int(result)));
}

RawVulkanObjects::RawVulkanObjects() {
  MakeInstance();
  MakeDevice();
  MakeTarget();
  VkPhysicalDeviceProperties properties{};
  vkGetPhysicalDeviceProperties(physical, &properties);
  const uint32_t unit = uint32_t(properties.limits.minUniformBufferOffsetAlignment);
  stride = (uint32_t(sizeof(DrawConstants)) + unit - 1) / unit * unit;
  MakeBuffer(VkDeviceSize(stride) * kDraws, VK_BUFFER_USAGE_UNIFORM_BUFFER_BIT, &ring, &ringMemory, &ringData);
  MakeBuffer(kSize * kSize * 4, VK_BUFFER_USAGE_TRANSFER_DST_BIT, &read, &readMemory, &readData);
  MakeDescriptors();
  const auto module = [&](const rhi::ShaderBlob& blob) {
    VkShaderModuleCreateInfo info{VK_STRUCTURE_TYPE_SHADER_MODULE_CREATE_INFO};
    info.codeSize = blob.spirv.size * sizeof(uint32_t);
    info.pCode = blob.spirv.data;
    VkShaderModule out = VK_NULL_HANDLE;
    Require(vk.vkCreateShaderModule(device, &info, nullptr, &out), "vkCreateShaderModule");
    return out;
  };
  const VkShaderModule vs = module(overhead_shaders::pixel_VSPixel);
  const std::array<VkShaderModule, 2> ps{module(overhead_shaders::pixel_PSColor),
                                         module(overhead_shaders::pixel_PSSwapped)};
  for (size_t i = 0; i < 2; ++i) pipelines[i] = MakePipeline(vs, ps[i], i == 1);
  for (VkShaderModule m : {vs, ps[0], ps[1]}) vk.vkDestroyShaderModule(device, m, nullptr);
  MakeCommands();
}

RawVulkanObjects::~RawVulkanObjects() {
  vk.vkDeviceWaitIdle(device);
  vk.vkDestroyFence(device, fence, nullptr);
  vk.vkDestroyCommandPool(device, commandPool, nullptr);
  for (VkPipeline p : pipelines) vk.vkDestroyPipeline(device, p, nullptr);
  vk.vkDestroyDescriptorPool(device, descriptorPool, nullptr);
  vk.vkDestroyPipelineLayout(device, layout, nullptr);
  vk.vkDestroyDescriptorSetLayout(device, setLayout, nullptr);
  vk.vkDestroyBuffer(device, ring, nullptr);
  vk.vkDestroyBuffer(device, read, nullptr);
  vk.vkDestroyImageView(device, view, nullptr);
  vk.vkDestroyImage(device, image, nullptr);
  for (VkDeviceMemory m : {imageMemory, ringMemory, readMemory}) vk.vkFreeMemory(device, m, nullptr);
  vk.vkDestroyDevice(device, nullptr);
  vkDestroyInstance(instance, nullptr);
}

void RawVulkanObjects::MakeInstance() {
  Require(volkInitialize(), "volkInitialize");
  VkApplicationInfo app{VK_STRUCTURE_TYPE_APPLICATION_INFO};
  app.apiVersion = VK_API_VERSION_1_3;
  VkInstanceCreateInfo info{VK_STRUCTURE_TYPE_INSTANCE_CREATE_INFO};
  info.pApplicationInfo = &app;
  Require(vkCreateInstance(&info, nullptr, &instance), "vkCreateInstance");
  volkLoadInstanceOnly(instance);
}

// A CPU rasteriser first, as the RHI is asked to.
void RawVulkanObjects::MakeDevice() {
  uint32_t count = 0;
  vkEnumeratePhysicalDevices(instance, &count, nullptr);
  std::vector<VkPhysicalDevice> list(count);
  vkEnumeratePhysicalDevices(instance, &count, list.data());
  if (list.empty()) throw std::runtime_error("no Vulkan driver; install mesa-vulkan-drivers");
  const auto isCpu = [](VkPhysicalDevice p) {
    VkPhysicalDeviceProperties properties{};
    vkGetPhysicalDeviceProperties(p, &properties);
    return properties.deviceType == VK_PHYSICAL_DEVICE_TYPE_CPU;
  };
  std::stable_partition(list.begin(), list.end(), isCpu);
  physical = list[0];
  const float priority = 1;
  VkDeviceQueueCreateInfo queueInfo{VK_STRUCTURE_TYPE_DEVICE_QUEUE_CREATE_INFO};
  queueInfo.queueCount = 1;  // of family 0: software drivers have but one
  queueInfo.pQueuePriorities = &priority;
  VkPhysicalDeviceVulkan13Features v13{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_3_FEATURES};
  v13.dynamicRendering = v13.synchronization2 = VK_TRUE;
  VkPhysicalDeviceVulkan11Features v11{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_1_FEATURES, &v13};
  v11.shaderDrawParameters = VK_TRUE;  // SV_VertexID is VertexIndex less BaseVertex
  VkDeviceCreateInfo info{VK_STRUCTURE_TYPE_DEVICE_CREATE_INFO, &v11};
  info.queueCreateInfoCount = 1;
  info.pQueueCreateInfos = &queueInfo;
  Require(vkCreateDevice(physical, &info, nullptr, &device), "vkCreateDevice");
  volkLoadDeviceTable(&vk, device);
  vk.vkGetDeviceQueue(device, 0, 0, &queue);
}

uint32_t RawVulkanObjects::MemoryType(uint32_t allowed, VkMemoryPropertyFlags need) {
  VkPhysicalDeviceMemoryProperties p{};
  vkGetPhysicalDeviceMemoryProperties(physical, &p);
  for (uint32_t i = 0; i < p.memoryTypeCount; ++i)
    if ((allowed >> i & 1u) && (p.memoryTypes[i].propertyFlags & need) == need) return i;
  throw std::runtime_error("no memory type fits");
}

VkDeviceMemory RawVulkanObjects::Allocate(const VkMemoryRequirements& need, VkMemoryPropertyFlags flags) {
  VkMemoryAllocateInfo info{VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO};
  info.allocationSize = need.size;
  info.memoryTypeIndex = MemoryType(need.memoryTypeBits, flags);
  VkDeviceMemory memory = VK_NULL_HANDLE;
  Require(vk.vkAllocateMemory(device, &info, nullptr, &memory), "vkAllocateMemory");
  return memory;
}

void RawVulkanObjects::MakeTarget() {
  VkImageCreateInfo info{VK_STRUCTURE_TYPE_IMAGE_CREATE_INFO};
  info.imageType = VK_IMAGE_TYPE_2D;
  info.format = VK_FORMAT_R8G8B8A8_UNORM;
  info.extent = {kSize, kSize, 1};
  info.mipLevels = info.arrayLayers = 1;
  info.samples = VK_SAMPLE_COUNT_1_BIT;
  info.usage = VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT | VK_IMAGE_USAGE_TRANSFER_SRC_BIT;
  Require(vk.vkCreateImage(device, &info, nullptr, &image), "vkCreateImage");
  VkMemoryRequirements need{};
  vk.vkGetImageMemoryRequirements(device, image, &need);
  imageMemory = Allocate(need, VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT);
  Require(vk.vkBindImageMemory(device, image, imageMemory, 0), "vkBindImageMemory");
  VkImageViewCreateInfo viewInfo{VK_STRUCTURE_TYPE_IMAGE_VIEW_CREATE_INFO};
  viewInfo.image = image;
  viewInfo.viewType = VK_IMAGE_VIEW_TYPE_2D;
  viewInfo.format = info.format;
  viewInfo.subresourceRange = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 1, 0, 1};
  Require(vk.vkCreateImageView(device, &viewInfo, nullptr, &view), "vkCreateImageView");
}

void RawVulkanObjects::MakeBuffer(VkDeviceSize size, VkBufferUsageFlags usage, VkBuffer* buffer, VkDeviceMemory* memory,
                                  uint8_t** data) {
  VkBufferCreateInfo info{VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO};
  info.size = size;
  info.usage = usage;
  Require(vk.vkCreateBuffer(device, &info, nullptr, buffer), "vkCreateBuffer");
  VkMemoryRequirements need{};
  vk.vkGetBufferMemoryRequirements(device, *buffer, &need);
  *memory = Allocate(need, VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT | VK_MEMORY_PROPERTY_HOST_COHERENT_BIT);
  Require(vk.vkBindBufferMemory(device, *buffer, *memory, 0), "vkBindBufferMemory");
  void* mapped = nullptr;
  Require(vk.vkMapMemory(device, *memory, 0, VK_WHOLE_SIZE, 0, &mapped), "vkMapMemory");
  *data = static_cast<uint8_t*>(mapped);
}

void RawVulkanObjects::MakeDescriptors() {
  const VkDescriptorSetLayoutBinding binding{kConstantSlot, VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER_DYNAMIC, 1,
                                             VK_SHADER_STAGE_VERTEX_BIT | VK_SHADER_STAGE_FRAGMENT_BIT, nullptr};
  VkDescriptorSetLayoutCreateInfo setInfo{VK_STRUCTURE_TYPE_DESCRIPTOR_SET_LAYOUT_CREATE_INFO};
  setInfo.bindingCount = 1;
  setInfo.pBindings = &binding;
  Require(vk.vkCreateDescriptorSetLayout(device, &setInfo, nullptr, &setLayout), "vkCreateDescriptorSetLayout");
  VkPipelineLayoutCreateInfo layoutInfo{VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO};
  layoutInfo.setLayoutCount = 1;
  layoutInfo.pSetLayouts = &setLayout;
  Require(vk.vkCreatePipelineLayout(device, &layoutInfo, nullptr, &layout), "vkCreatePipelineLayout");
  const VkDescriptorPoolSize size{VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER_DYNAMIC, 1};
  VkDescriptorPoolCreateInfo poolInfo{VK_STRUCTURE_TYPE_DESCRIPTOR_POOL_CREATE_INFO};
  poolInfo.maxSets = poolInfo.poolSizeCount = 1;
  poolInfo.pPoolSizes = &size;
  Require(vk.vkCreateDescriptorPool(device, &poolInfo, nullptr, &descriptorPool), "vkCreateDescriptorPool");
  VkDescriptorSetAllocateInfo allocate{VK_STRUCTURE_TYPE_DESCRIPTOR_SET_ALLOCATE_INFO};
  allocate.descriptorPool = descriptorPool;
  allocate.descriptorSetCount = 1;
  allocate.pSetLayouts = &setLayout;
  Require(vk.vkAllocateDescriptorSets(device, &allocate, &set), "vkAllocateDescriptorSets");
  const VkDescriptorBufferInfo range{ring, 0, sizeof(DrawConstants)};
  VkWriteDescriptorSet write{VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET};
  write.dstSet = set;
  write.dstBinding = kConstantSlot;
  write.descriptorCount = 1;
  write.descriptorType = VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER_DYNAMIC;
  write.pBufferInfo = &range;
  vk.vkUpdateDescriptorSets(device, 1, &write, 0, nullptr);
}

void RawVulkanObjects::MakeCommands() {
  VkCommandPoolCreateInfo poolInfo{VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO};
  poolInfo.flags = VK_COMMAND_POOL_CREATE_TRANSIENT_BIT;
  Require(vk.vkCreateCommandPool(device, &poolInfo, nullptr, &commandPool), "vkCreateCommandPool");
  VkCommandBufferAllocateInfo info{VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO};
  info.commandPool = commandPool;
  info.commandBufferCount = 1;
  Require(vk.vkAllocateCommandBuffers(device, &info, &commands), "vkAllocateCommandBuffers");
  const VkFenceCreateInfo fenceInfo{VK_STRUCTURE_TYPE_FENCE_CREATE_INFO};
  Require(vk.vkCreateFence(device, &fenceInfo, nullptr, &fence), "vkCreateFence");
}

VkPipeline RawVulkanObjects::MakePipeline(VkShaderModule vs, VkShaderModule ps, bool blend) {
  std::array<VkPipelineShaderStageCreateInfo, 2> stages{};
  for (VkPipelineShaderStageCreateInfo& s : stages) s = {VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO};
  stages[0].stage = VK_SHADER_STAGE_VERTEX_BIT;
  stages[0].module = vs;
  stages[1].stage = VK_SHADER_STAGE_FRAGMENT_BIT;
  stages[1].module = ps;
  stages[0].pName = stages[1].pName = "main";
  const VkPipelineVertexInputStateCreateInfo input{VK_STRUCTURE_TYPE_PIPELINE_VERTEX_INPUT_STATE_CREATE_INFO};
  VkPipelineInputAssemblyStateCreateInfo assembly{VK_STRUCTURE_TYPE_PIPELINE_INPUT_ASSEMBLY_STATE_CREATE_INFO};
  assembly.topology = VK_PRIMITIVE_TOPOLOGY_TRIANGLE_LIST;
  const VkViewport viewport{0, float(kSize), float(kSize), -float(kSize), 0, 1};
  const VkRect2D scissor{{0, 0}, {kSize, kSize}};
  VkPipelineViewportStateCreateInfo viewports{VK_STRUCTURE_TYPE_PIPELINE_VIEWPORT_STATE_CREATE_INFO};
  viewports.viewportCount = viewports.scissorCount = 1;
  viewports.pViewports = &viewport;
  viewports.pScissors = &scissor;
  VkPipelineRasterizationStateCreateInfo raster{VK_STRUCTURE_TYPE_PIPELINE_RASTERIZATION_STATE_CREATE_INFO};
  raster.cullMode = VK_CULL_MODE_BACK_BIT;
  raster.frontFace = VK_FRONT_FACE_CLOCKWISE;
  raster.lineWidth = 1;
  VkPipelineMultisampleStateCreateInfo samples{VK_STRUCTURE_TYPE_PIPELINE_MULTISAMPLE_STATE_CREATE_INFO};
  samples.rasterizationSamples = VK_SAMPLE_COUNT_1_BIT;
  VkPipelineColorBlendAttachmentState attachment{};
  attachment.blendEnable = blend;
  attachment.srcColorBlendFactor = VK_BLEND_FACTOR_SRC_ALPHA;
  attachment.dstColorBlendFactor = VK_BLEND_FACTOR_ONE_MINUS_SRC_ALPHA;
  attachment.srcAlphaBlendFactor = VK_BLEND_FACTOR_ONE;
  attachment.colorWriteMask = 0xF;
  VkPipelineColorBlendStateCreateInfo blending{VK_STRUCTURE_TYPE_PIPELINE_COLOR_BLEND_STATE_CREATE_INFO};
  blending.attachmentCount = 1;
  blending.pAttachments = &attachment;
  const VkFormat format = VK_FORMAT_R8G8B8A8_UNORM;
  VkPipelineRenderingCreateInfo rendering{VK_STRUCTURE_TYPE_PIPELINE_RENDERING_CREATE_INFO};
  rendering.colorAttachmentCount = 1;
  rendering.pColorAttachmentFormats = &format;
  VkGraphicsPipelineCreateInfo info{VK_STRUCTURE_TYPE_GRAPHICS_PIPELINE_CREATE_INFO, &rendering};
  info.stageCount = uint32_t(stages.size());
  info.pStages = stages.data();
  info.pVertexInputState = &input;
  info.pInputAssemblyState = &assembly;
  info.pViewportState = &viewports;
  info.pRasterizationState = &raster;
  info.pMultisampleState = &samples;
  info.pColorBlendState = &blending;
  info.layout = layout;
  VkPipeline pipeline = VK_NULL_HANDLE;
  Require(vk.vkCreateGraphicsPipelines(device, VK_NULL_HANDLE, 1, &info, nullptr, &pipeline),
          "vkCreateGraphicsPipelines");
  return pipeline;
}

}  // namespace rhi_overhead

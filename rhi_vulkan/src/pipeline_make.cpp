// Makes one VkPipeline from a key.
#include "descriptors.h"
#include "formats.h"
#include "pipeline.h"

namespace rhi_vulkan {
namespace {

VkPrimitiveTopology TopologyOf(TopologyClass c) {
  switch (c) {
    case TopologyClass::Point: return VK_PRIMITIVE_TOPOLOGY_POINT_LIST;
    case TopologyClass::Line: return VK_PRIMITIVE_TOPOLOGY_LINE_LIST;
    case TopologyClass::Triangle: return VK_PRIMITIVE_TOPOLOGY_TRIANGLE_LIST;
    case TopologyClass::LineAdj: return VK_PRIMITIVE_TOPOLOGY_LINE_LIST_WITH_ADJACENCY;
    case TopologyClass::TriangleAdj: return VK_PRIMITIVE_TOPOLOGY_TRIANGLE_LIST_WITH_ADJACENCY;
  }
  return VK_PRIMITIVE_TOPOLOGY_TRIANGLE_LIST;
}

VkBlendFactor ToVk(Blend blend) {
  switch (blend) {
    case Blend::Zero: return VK_BLEND_FACTOR_ZERO;
    case Blend::One: return VK_BLEND_FACTOR_ONE;
    case Blend::SrcColor: return VK_BLEND_FACTOR_SRC_COLOR;
    case Blend::InvSrcColor: return VK_BLEND_FACTOR_ONE_MINUS_SRC_COLOR;
    case Blend::SrcAlpha: return VK_BLEND_FACTOR_SRC_ALPHA;
    case Blend::InvSrcAlpha: return VK_BLEND_FACTOR_ONE_MINUS_SRC_ALPHA;
    case Blend::DestAlpha: return VK_BLEND_FACTOR_DST_ALPHA;
    case Blend::InvDestAlpha: return VK_BLEND_FACTOR_ONE_MINUS_DST_ALPHA;
    case Blend::DestColor: return VK_BLEND_FACTOR_DST_COLOR;
    case Blend::InvDestColor: return VK_BLEND_FACTOR_ONE_MINUS_DST_COLOR;
    case Blend::SrcAlphaSat: return VK_BLEND_FACTOR_SRC_ALPHA_SATURATE;
    case Blend::BlendFactor: return VK_BLEND_FACTOR_CONSTANT_COLOR;
    case Blend::InvBlendFactor: return VK_BLEND_FACTOR_ONE_MINUS_CONSTANT_COLOR;
    case Blend::Src1Color: return VK_BLEND_FACTOR_SRC1_COLOR;
    case Blend::InvSrc1Color: return VK_BLEND_FACTOR_ONE_MINUS_SRC1_COLOR;
    case Blend::Src1Alpha: return VK_BLEND_FACTOR_SRC1_ALPHA;
    case Blend::InvSrc1Alpha: return VK_BLEND_FACTOR_ONE_MINUS_SRC1_ALPHA;
  }
  return VK_BLEND_FACTOR_ONE;
}

VkBlendOp ToVk(BlendOp op) {
  switch (op) {
    case BlendOp::Add: return VK_BLEND_OP_ADD;
    case BlendOp::Subtract: return VK_BLEND_OP_SUBTRACT;
    case BlendOp::RevSubtract: return VK_BLEND_OP_REVERSE_SUBTRACT;
    case BlendOp::Min: return VK_BLEND_OP_MIN;
    case BlendOp::Max: return VK_BLEND_OP_MAX;
  }
  return VK_BLEND_OP_ADD;
}

VkPipelineColorBlendAttachmentState ToVk(const RenderTargetBlend& t, bool blendable, bool written) {
  VkPipelineColorBlendAttachmentState out{};
  out.blendEnable = t.enable && blendable;
  out.srcColorBlendFactor = ToVk(t.src);
  out.dstColorBlendFactor = ToVk(t.dest);
  out.colorBlendOp = ToVk(t.op);
  out.srcAlphaBlendFactor = ToVk(t.srcAlpha);
  out.dstAlphaBlendFactor = ToVk(t.destAlpha);
  out.alphaBlendOp = ToVk(t.opAlpha);
  out.colorWriteMask = written ? t.writeMask & 0xFu : 0u;
  return out;
}

struct Stages {
  std::array<VkPipelineShaderStageCreateInfo, 3> infos{};
  uint32_t count = 0;
  void Add(const Shader* shader, VkShaderStageFlagBits stage, VkShaderModule module) {
    if (!shader) return;
    infos[count] = {VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO};
    infos[count].stage = stage;
    infos[count].module = module;
    infos[count++].pName = "main";
  }
};

struct VertexInput {
  std::array<VkVertexInputAttributeDescription, kMaxVertexElements> attributes{};
  std::array<VkVertexInputBindingDescription, kMaxVertexBuffers> bindings{};
  std::array<VkVertexInputBindingDivisorDescriptionEXT, kMaxVertexBuffers> divisors{};
  VkPipelineVertexInputStateCreateInfo info{VK_STRUCTURE_TYPE_PIPELINE_VERTEX_INPUT_STATE_CREATE_INFO};
  VkPipelineVertexInputDivisorStateCreateInfoEXT divisorInfo{
      VK_STRUCTURE_TYPE_PIPELINE_VERTEX_INPUT_DIVISOR_STATE_CREATE_INFO_EXT};

  explicit VertexInput(const InputLayout* layout) {
    uint32_t slots = 0;
    if (layout)
      for (const LayoutElement& e : layout->elements) Add(e, &slots);
    info.pVertexBindingDescriptions = bindings.data();
    info.pVertexAttributeDescriptions = attributes.data();
    divisorInfo.pVertexBindingDivisors = divisors.data();
    if (divisorInfo.vertexBindingDivisorCount) info.pNext = &divisorInfo;
  }
  VertexInput(const VertexInput&) = delete;
  VertexInput& operator=(const VertexInput&) = delete;

 private:
  void Add(const LayoutElement& e, uint32_t* slots) {
    attributes[info.vertexAttributeDescriptionCount++] = {e.location, e.slot, rhi_vulkan::ToVk(e.format), e.offset};
    if (*slots & (1u << e.slot)) return;
    *slots |= 1u << e.slot;
    const VkVertexInputRate rate = e.perInstance ? VK_VERTEX_INPUT_RATE_INSTANCE : VK_VERTEX_INPUT_RATE_VERTEX;
    bindings[info.vertexBindingDescriptionCount++] = {e.slot, 0, rate};  // the stride is dynamic
    if (e.stepRate > 1) divisors[divisorInfo.vertexBindingDivisorCount++] = {e.slot, e.stepRate};
  }
};

struct RasterInfo {
  VkPipelineRasterizationStateCreateInfo info{VK_STRUCTURE_TYPE_PIPELINE_RASTERIZATION_STATE_CREATE_INFO};
  VkPipelineRasterizationDepthClipStateCreateInfoEXT clip{
      VK_STRUCTURE_TYPE_PIPELINE_RASTERIZATION_DEPTH_CLIP_STATE_CREATE_INFO_EXT};
  VkPipelineRasterizationLineStateCreateInfoEXT line{
      VK_STRUCTURE_TYPE_PIPELINE_RASTERIZATION_LINE_STATE_CREATE_INFO_EXT};

  RasterInfo(const PipelineKey& key, const Features& features, bool alphaToCoverage) {
    info.polygonMode = key.wireframe ? VK_POLYGON_MODE_LINE : VK_POLYGON_MODE_FILL;
    info.depthClampEnable = !key.depthClip;
    info.lineWidth = 1;
    if (features.depthClipEnable) {
      clip.depthClipEnable = key.depthClip;
      Append(&clip);
    }
    // Bresenham's rule is GL's for aliased lines; it goes with neither samples nor alpha-to-coverage.
    if (features.bresenhamLines && key.samples == 1 && !alphaToCoverage) {
      line.lineRasterizationMode = VK_LINE_RASTERIZATION_MODE_BRESENHAM_EXT;
      Append(&line);
    }
  }
  RasterInfo(const RasterInfo&) = delete;
  RasterInfo& operator=(const RasterInfo&) = delete;

 private:
  template <class T>
  void Append(T* next) {
    next->pNext = info.pNext;
    info.pNext = next;
  }
};

struct ColorBlend {
  std::array<VkPipelineColorBlendAttachmentState, kMaxRenderTargets> attachments{};
  VkPipelineColorBlendStateCreateInfo info{VK_STRUCTURE_TYPE_PIPELINE_COLOR_BLEND_STATE_CREATE_INFO};

  ColorBlend(const PipelineKey& key, const BlendDesc& desc, const Shader* ps) {
    for (uint32_t i = 0; i < key.rtvCount; ++i) {
      const bool blendable = !GetFormatInfo(key.rtv[i]).isInteger;
      const bool written = ps && (ps->colorOutputs >> i & 1u);
      attachments[i] = ToVk(desc.rt[desc.independent ? i : 0], blendable, written);
    }
    info.attachmentCount = key.rtvCount;
    info.pAttachments = attachments.data();
  }
  ColorBlend(const ColorBlend&) = delete;
  ColorBlend& operator=(const ColorBlend&) = delete;
};

struct TargetFormats {
  std::array<VkFormat, kMaxRenderTargets> colors{};
  VkPipelineRenderingCreateInfo info{VK_STRUCTURE_TYPE_PIPELINE_RENDERING_CREATE_INFO};

  explicit TargetFormats(const PipelineKey& key) {
    for (uint32_t i = 0; i < key.rtvCount; ++i) colors[i] = rhi_vulkan::ToVk(key.rtv[i]);
    info.colorAttachmentCount = key.rtvCount;
    info.pColorAttachmentFormats = colors.data();
    if (GetFormatInfo(key.dsv).depth) info.depthAttachmentFormat = rhi_vulkan::ToVk(key.dsv);
    if (GetFormatInfo(key.dsv).stencil) info.stencilAttachmentFormat = rhi_vulkan::ToVk(key.dsv);
  }
  TargetFormats(const TargetFormats&) = delete;
  TargetFormats& operator=(const TargetFormats&) = delete;
};

constexpr auto kDynamic = std::to_array<VkDynamicState>(
    {VK_DYNAMIC_STATE_VIEWPORT_WITH_COUNT, VK_DYNAMIC_STATE_SCISSOR_WITH_COUNT, VK_DYNAMIC_STATE_BLEND_CONSTANTS,
     VK_DYNAMIC_STATE_STENCIL_REFERENCE, VK_DYNAMIC_STATE_STENCIL_COMPARE_MASK, VK_DYNAMIC_STATE_STENCIL_WRITE_MASK,
     VK_DYNAMIC_STATE_DEPTH_BIAS, VK_DYNAMIC_STATE_CULL_MODE, VK_DYNAMIC_STATE_FRONT_FACE,
     VK_DYNAMIC_STATE_PRIMITIVE_TOPOLOGY, VK_DYNAMIC_STATE_DEPTH_TEST_ENABLE, VK_DYNAMIC_STATE_DEPTH_WRITE_ENABLE,
     VK_DYNAMIC_STATE_DEPTH_COMPARE_OP, VK_DYNAMIC_STATE_STENCIL_TEST_ENABLE, VK_DYNAMIC_STATE_STENCIL_OP,
     VK_DYNAMIC_STATE_DEPTH_BIAS_ENABLE, VK_DYNAMIC_STATE_PRIMITIVE_RESTART_ENABLE,
     // Last: a pipeline without vertex buffers leaves it out, because nobody would set it.
     VK_DYNAMIC_STATE_VERTEX_INPUT_BINDING_STRIDE});

}  // namespace

Pipeline PipelineCache::Make(const PipelineKey& key, const PipelineParts& parts) {
  Pipeline out;
  out.sets = {parts.vs->layout, parts.gs ? parts.gs->layout : nullptr, parts.ps ? parts.ps->layout : nullptr};
  out.layout = core_.layouts->GetPipelineLayout(out.sets);
  out.status = core_.Failure();
  if (!out.layout) return out;

  Stages stages;
  const auto moduleOf = [](const Shader* shader) { return shader ? shader->module : VkShaderModule(VK_NULL_HANDLE); };
  const bool points = key.topology == TopologyClass::Point && !parts.gs;
  stages.Add(parts.vs, VK_SHADER_STAGE_VERTEX_BIT, points ? parts.vs->PointModule() : parts.vs->module);
  stages.Add(parts.gs, VK_SHADER_STAGE_GEOMETRY_BIT, moduleOf(parts.gs));
  stages.Add(parts.ps, VK_SHADER_STAGE_FRAGMENT_BIT, moduleOf(parts.ps));
  if (!stages.infos[0].module) return out;
  const BlendDesc blendDesc = parts.blend ? *parts.blend : BlendDesc{};
  const VertexInput vertexInput(parts.layout);
  const RasterInfo raster(key, core_.adapter.features, blendDesc.alphaToCoverage);
  const ColorBlend blend(key, blendDesc, parts.ps);
  const TargetFormats targets(key);

  VkPipelineInputAssemblyStateCreateInfo assembly{VK_STRUCTURE_TYPE_PIPELINE_INPUT_ASSEMBLY_STATE_CREATE_INFO};
  assembly.topology = TopologyOf(key.topology);
  VkPipelineViewportStateCreateInfo viewport{VK_STRUCTURE_TYPE_PIPELINE_VIEWPORT_STATE_CREATE_INFO};
  VkPipelineMultisampleStateCreateInfo multisample{VK_STRUCTURE_TYPE_PIPELINE_MULTISAMPLE_STATE_CREATE_INFO};
  // Bits beyond the last sample are no samples: lavapipe would take any bit for the only one.
  const std::array<VkSampleMask, 2> mask{key.samples < 32 ? key.sampleMask & ((1u << key.samples) - 1) : key.sampleMask,
                                         ~0u};
  multisample.rasterizationSamples = VkSampleCountFlagBits(key.samples);
  multisample.pSampleMask = mask.data();
  multisample.alphaToCoverageEnable = blendDesc.alphaToCoverage;
  VkPipelineDepthStencilStateCreateInfo depth{VK_STRUCTURE_TYPE_PIPELINE_DEPTH_STENCIL_STATE_CREATE_INFO};
  VkPipelineDynamicStateCreateInfo dynamic{VK_STRUCTURE_TYPE_PIPELINE_DYNAMIC_STATE_CREATE_INFO};
  dynamic.dynamicStateCount = uint32_t(kDynamic.size()) - (vertexInput.info.vertexBindingDescriptionCount ? 0 : 1);
  dynamic.pDynamicStates = kDynamic.data();

  VkGraphicsPipelineCreateInfo info{VK_STRUCTURE_TYPE_GRAPHICS_PIPELINE_CREATE_INFO, &targets.info};
  info.stageCount = stages.count;
  info.pStages = stages.infos.data();
  info.pVertexInputState = &vertexInput.info;
  info.pInputAssemblyState = &assembly;
  info.pViewportState = &viewport;
  info.pRasterizationState = &raster.info;
  info.pMultisampleState = &multisample;
  info.pDepthStencilState = &depth;
  info.pColorBlendState = &blend.info;
  info.pDynamicState = &dynamic;
  info.layout = out.layout;
  ++made;
  const VkResult result = core_.vk.vkCreateGraphicsPipelines(core_.device, cache_, 1, &info, nullptr, &out.handle);
  out.status = core_.CheckOnce(result, parts.vs->Name().c_str(), "vkCreateGraphicsPipelines");
  if (out.status != Status::Ok) out.handle = VK_NULL_HANDLE;
  return out;
}

}  // namespace rhi_vulkan

#include "states.h"

#include <strings.h>

#include <cstring>

#include "formats.h"

namespace rhi_vulkan {
namespace {

VkFilter ToVk(Filter filter) { return filter == Filter::Point ? VK_FILTER_NEAREST : VK_FILTER_LINEAR; }

VkSamplerAddressMode ToVk(AddressMode mode) {
  switch (mode) {
    case AddressMode::Wrap: return VK_SAMPLER_ADDRESS_MODE_REPEAT;
    case AddressMode::Mirror: return VK_SAMPLER_ADDRESS_MODE_MIRRORED_REPEAT;
    case AddressMode::Clamp: return VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_EDGE;
    case AddressMode::Border: return VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_BORDER;
  }
  return VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_EDGE;
}

// One of the three colours that every driver has, or VK_BORDER_COLOR_MAX_ENUM.
VkBorderColor StandardBorder(const std::array<float, 4>& c) {
  if (c == std::array{0.0f, 0.0f, 0.0f, 0.0f}) return VK_BORDER_COLOR_FLOAT_TRANSPARENT_BLACK;
  if (c == std::array{0.0f, 0.0f, 0.0f, 1.0f}) return VK_BORDER_COLOR_FLOAT_OPAQUE_BLACK;
  if (c == std::array{1.0f, 1.0f, 1.0f, 1.0f}) return VK_BORDER_COLOR_FLOAT_OPAQUE_WHITE;
  return VK_BORDER_COLOR_MAX_ENUM;
}

VkSamplerCreateInfo SamplerInfo(const SamplerDesc& d, const Core& core) {
  VkSamplerCreateInfo info{VK_STRUCTURE_TYPE_SAMPLER_CREATE_INFO};
  info.minFilter = ToVk(d.min);
  info.magFilter = ToVk(d.mag);
  info.mipmapMode = d.mip == Filter::Point ? VK_SAMPLER_MIPMAP_MODE_NEAREST : VK_SAMPLER_MIPMAP_MODE_LINEAR;
  info.addressModeU = ToVk(d.u);
  info.addressModeV = ToVk(d.v);
  info.addressModeW = ToVk(d.w);
  const VkPhysicalDeviceLimits& limits = core.adapter.properties.limits;
  info.mipLodBias = std::clamp(d.mipBias, -limits.maxSamplerLodBias, limits.maxSamplerLodBias);
  const bool anisotropic = d.min == Filter::Anisotropic || d.mag == Filter::Anisotropic || d.mip == Filter::Anisotropic;
  info.anisotropyEnable = anisotropic && core.adapter.caps.samplerAnisotropy;
  info.maxAnisotropy = std::clamp(float(d.maxAniso), 1.0f, limits.maxSamplerAnisotropy);
  info.compareEnable = d.comparison;
  info.compareOp = rhi_vulkan::ToVk(d.func);
  info.minLod = d.minLod;
  info.maxLod = std::max(d.minLod, d.maxLod);
  info.borderColor = VK_BORDER_COLOR_FLOAT_TRANSPARENT_BLACK;
  return info;
}

bool UsesBorder(const SamplerDesc& d) {
  return d.u == AddressMode::Border || d.v == AddressMode::Border || d.w == AddressMode::Border;
}

const InputElement* FindElement(const InputElement* elements, uint32_t count, const ShaderInput& input) {
  const auto matches = [&](const InputElement& e) {
    return strcasecmp(e.semantic, input.semantic) == 0 && e.semanticIndex == input.semanticIndex;
  };
  const InputElement* found = std::find_if(elements, elements + count, matches);
  return found == elements + count ? nullptr : found;
}

Status CheckElement(const InputElement& e, const Core& core) {
  const bool instanced = e.inputClass == InputClass::PerInstance;
  if (e.slot >= kMaxVertexBuffers || (instanced && e.stepRate == 0)) {
    core.log.Report(Severity::Error, MsgCode::InvalidDesc, "",
                    "element %s%u: slot %u of %u, step rate %u; a PerInstance element needs a stepRate of at least 1",
                    e.semantic, e.semanticIndex, e.slot, kMaxVertexBuffers, e.stepRate);
    return Status::InvalidArg;
  }
  if (instanced && e.stepRate > 1 && !core.adapter.features.instanceDivisor) {
    core.log.Report(Severity::Error, MsgCode::CapMissing, "", "step rates above 1 need Caps::instanceStepRate");
    return Status::Unsupported;
  }
  const VkPhysicalDevice physical = core.adapter.handle;
  if (QueryFormatSupport(core.instance.vk, physical, e.format) & FormatSupport::VertexBuffer) return Status::Ok;
  core.log.Report(Severity::Error, MsgCode::CapMissing, "", "element %s%u: %s is not offered for vertex buffers",
                  e.semantic, e.semanticIndex, rhi::ToString(e.format));
  return Status::Unsupported;
}

}  // namespace

VkCompareOp ToVk(Comparison func) { return VkCompareOp(uint32_t(func) - uint32_t(Comparison::Never)); }

Sampler::~Sampler() {
  if (handle) core_->vk.vkDestroySampler(core_->device, handle, nullptr);
}

void Sampler::Destroy() noexcept {
  core_->states->samplers.Forget(this);
  VkObject::Destroy();
}

Status Sampler::Create() {
  VkSamplerCreateInfo info = SamplerInfo(desc_, *core_);
  VkSamplerCustomBorderColorCreateInfoEXT custom{VK_STRUCTURE_TYPE_SAMPLER_CUSTOM_BORDER_COLOR_CREATE_INFO_EXT};
  const VkBorderColor standard = StandardBorder(desc_.border);
  if (standard != VK_BORDER_COLOR_MAX_ENUM) {
    info.borderColor = standard;
  } else if (UsesBorder(desc_)) {  // CheckSamplerDesc has seen the cap
    std::copy(desc_.border.begin(), desc_.border.end(), custom.customBorderColor.float32);
    info.pNext = &custom;
    info.borderColor = VK_BORDER_COLOR_FLOAT_CUSTOM_EXT;
  }
  return core_->Check(core_->vk.vkCreateSampler(core_->device, &info, nullptr, &handle), "", "vkCreateSampler");
}

InputLayout::InputLayout(std::shared_ptr<Core> core, std::vector<LayoutElement> list, uint32_t layoutId)
    : VkObject(std::move(core)), elements(std::move(list)), id(layoutId) {
  for (const LayoutElement& e : elements) {
    slotMask |= 1u << e.slot;
    locationMask |= 1u << e.location;
  }
}

Status ResolveElements(const InputElement* elements, uint32_t count, const Shader& vs, const Core& core,
                       std::vector<LayoutElement>* out) {
  for (const ShaderInput& input : vs.reflection.inputs) {
    const InputElement* e = FindElement(elements, count, input);
    if (!e) {
      core.log.Report(Severity::Error, MsgCode::LayoutMismatch, vs.Name().c_str(),
                      "the vertex shader reads %s%u, which no element gives; add one", input.semantic,
                      input.semanticIndex);
      return Status::InvalidArg;
    }
    if (Status s = CheckElement(*e, core); s != Status::Ok) return s;
    const bool instanced = e->inputClass == InputClass::PerInstance;
    const LayoutElement resolved{input.location, e->format, e->slot, e->offset, instanced, instanced ? e->stepRate : 0};
    for (const LayoutElement& other : *out) {
      if (other.slot != e->slot || (other.perInstance == instanced && other.stepRate == resolved.stepRate)) continue;
      core.log.Report(Severity::Error, MsgCode::InvalidDesc, vs.Name().c_str(),
                      "the elements of slot %u differ in input class or step rate; use one slot for each", e->slot);
      return Status::InvalidArg;
    }
    out->push_back(resolved);
  }
  return Status::Ok;
}

}  // namespace rhi_vulkan

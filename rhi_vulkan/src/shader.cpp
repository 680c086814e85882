#include "descriptors.h"
#include "pipeline.h"
#include "states.h"

namespace rhi_vulkan {
namespace {

constexpr uint32_t kSpirvMagic = 0x07230203, kHeaderWords = 5;
constexpr uint32_t kOpVariable = 59, kOpDecorate = 71, kStorageOutput = 3, kDecorationLocation = 30;

VkShaderStageFlags StageFlag(Stage stage) {
  switch (stage) {
    case Stage::Vertex: return VK_SHADER_STAGE_VERTEX_BIT;
    case Stage::Geometry: return VK_SHADER_STAGE_GEOMETRY_BIT;
    case Stage::Pixel: return VK_SHADER_STAGE_FRAGMENT_BIT;
    case Stage::Compute: return VK_SHADER_STAGE_COMPUTE_BIT;
  }
  return 0;
}

// Calls f(opcode, words, count) for each instruction of a SPIR-V module.
template <class F>
void ForEachInstruction(const Array<uint32_t>& spirv, F f) {
  for (uint32_t i = kHeaderWords; i < spirv.size;) {
    const uint32_t count = spirv[i] >> 16;
    if (count == 0 || count > spirv.size - i) return;
    f(spirv[i] & 0xFFFF, spirv.data + i, count);
    i += count;
  }
}

// The locations of a pixel shader's outputs: a target that it does not write must be masked, or holds garbage.
uint32_t ColorOutputs(const Array<uint32_t>& spirv) {
  std::vector<uint32_t> outputs;
  ForEachInstruction(spirv, [&](uint32_t op, const uint32_t* w, uint32_t count) {
    if (op == kOpVariable && count >= 4 && w[3] == kStorageOutput) outputs.push_back(w[2]);
  });
  uint32_t mask = 0;
  ForEachInstruction(spirv, [&](uint32_t op, const uint32_t* w, uint32_t count) {
    if (op != kOpDecorate || count < 4 || w[2] != kDecorationLocation || w[3] >= kMaxRenderTargets) return;
    if (std::find(outputs.begin(), outputs.end(), w[1]) != outputs.end()) mask |= 1u << w[3];
  });
  return mask;
}

void SplitRegisters(const ShaderReflection& r, std::vector<SetBinding>* inputs, std::vector<SetBinding>* uavs) {
  for (const ShaderResource& t : r.resources) switch (t.kind) {
      case ShaderResourceKind::Texture:
        inputs->push_back({kVkTextureBinding + t.slot, VK_DESCRIPTOR_TYPE_SAMPLED_IMAGE});
        break;
      case ShaderResourceKind::StructuredBuffer:
        inputs->push_back({kVkTextureBinding + t.slot, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER});
        break;
      case ShaderResourceKind::RWTexture:
        uavs->push_back({kVkUavBinding + t.slot, VK_DESCRIPTOR_TYPE_STORAGE_IMAGE});
        break;
      case ShaderResourceKind::RWStructuredBuffer:
        uavs->push_back({kVkUavBinding + t.slot, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER});
        break;
    }
  for (const ShaderSampler& s : r.samplers) inputs->push_back({kVkSamplerBinding + s.slot, VK_DESCRIPTOR_TYPE_SAMPLER});
  const auto byBinding = [](const SetBinding& a, const SetBinding& b) { return a.binding < b.binding; };
  std::sort(inputs->begin(), inputs->end(), byBinding);
  std::sort(uavs->begin(), uavs->end(), byBinding);
}

bool RegistersInRange(const ShaderReflection& r) {
  const auto resourceOk = [](const ShaderResource& t) {
    const bool writable = t.kind == ShaderResourceKind::RWTexture || t.kind == ShaderResourceKind::RWStructuredBuffer;
    return t.slot < (writable ? kMaxUnorderedAccess : kMaxShaderResources);
  };
  return std::all_of(r.resources.begin(), r.resources.end(), resourceOk) &&
         std::all_of(r.samplers.begin(), r.samplers.end(), [](auto& s) { return s.slot < kMaxSamplers; }) &&
         std::all_of(r.constantBuffers.begin(), r.constantBuffers.end(),
                     [](auto& b) { return b.slot < kMaxConstantBuffers; });
}

}  // namespace

Shader::Shader(std::shared_ptr<Core> core, const ShaderBlob& blob)
    : VkObject(std::move(core)), reflection(blob.reflection), id(core_->states->nextShader++), stage_(blob.stage) {
  backend::Object<IShader>::SetName(blob.name);
}

Shader::~Shader() {
  core_->pipelines->Forget(id);
  if (compute) core_->vk.vkDestroyPipeline(core_->device, compute, nullptr);
  if (module) core_->vk.vkDestroyShaderModule(core_->device, module, nullptr);
}

void Shader::SetName(const char* name) {
  backend::Object<IShader>::SetName(name);
  core_->SetName(VK_OBJECT_TYPE_SHADER_MODULE, uint64_t(module), Name().c_str());
}

Status Shader::CheckCaps(const ShaderBlob& blob) const {
  const Caps& caps = core_->adapter.caps;
  const ShaderReflection& r = blob.reflection;
  const char* missing = nullptr;
  if (stage_ == Stage::Geometry && !caps.geometryShader)
    missing = "this adapter has no geometry shaders (Caps::geometryShader); use the vertex-pulling variant";
  if (stage_ == Stage::Geometry && caps.geometryShader &&
      (r.gsMaxVertices > caps.maxGSOutputVertices ||
       r.gsMaxVertices * r.gsOutputComponents > caps.maxGSOutputComponents))
    missing = "the geometry shader's maxvertexcount exceeds Caps::maxGSOutputVertices or maxGSOutputComponents";
  if (stage_ != Stage::Geometry && r.writesLayer && !caps.layeredRendering)
    missing = "SV_RenderTargetArrayIndex needs Caps::layeredRendering";
  if (!missing) return Status::Ok;
  core_->log.Report(Severity::Error, MsgCode::CapMissing, blob.name, "%s", missing);
  return Status::Unsupported;
}

Status Shader::Create(const ShaderBlob& blob) {
  if (Status s = CheckCaps(blob); s != Status::Ok) return s;
  if (blob.spirv.size <= kHeaderWords || blob.spirv[0] != kSpirvMagic || !RegistersInRange(reflection)) {
    core_->log.Report(Severity::Error, MsgCode::ShaderRejected, blob.name,
                      "no SPIR-V (%u words), or registers out of range; make the blob with fur_add_shaders",
                      blob.spirv.size);
    return Status::InvalidArg;
  }
  VkShaderModuleCreateInfo info{VK_STRUCTURE_TYPE_SHADER_MODULE_CREATE_INFO};
  info.codeSize = blob.spirv.size * sizeof(uint32_t);
  info.pCode = blob.spirv.data;
  if (Status s = core_->Check(core_->vk.vkCreateShaderModule(core_->device, &info, nullptr, &module), blob.name,
                              "vkCreateShaderModule");
      s != Status::Ok)
    return s;
  core_->SetName(VK_OBJECT_TYPE_SHADER_MODULE, uint64_t(module), blob.name);
  if (stage_ == Stage::Pixel) colorOutputs = ColorOutputs(blob.spirv);

  std::vector<SetBinding> inputs, uavs;
  SplitRegisters(reflection, &inputs, &uavs);
  layout = core_->layouts->Get(StageFlag(stage_), std::move(inputs));
  uavLayout = core_->layouts->Get(StageFlag(stage_), std::move(uavs));
  if (!layout || !uavLayout) return Status::OutOfMemory;
  return stage_ == Stage::Compute ? CreateComputePipeline(blob.name) : Status::Ok;
}

Status Shader::CreateComputePipeline(const char* name) {
  computeLayout = core_->layouts->GetPipelineLayout({layout, uavLayout, nullptr});
  if (!computeLayout) return Status::OutOfMemory;
  VkComputePipelineCreateInfo info{VK_STRUCTURE_TYPE_COMPUTE_PIPELINE_CREATE_INFO};
  info.stage = {VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO};
  info.stage.stage = VK_SHADER_STAGE_COMPUTE_BIT;
  info.stage.module = module;
  info.stage.pName = "main";
  info.layout = computeLayout;
  ++core_->pipelines->made;
  const VkResult result =
      core_->vk.vkCreateComputePipelines(core_->device, core_->pipelines->Handle(), 1, &info, nullptr, &compute);
  return core_->Check(result, name, "vkCreateComputePipelines");
}

}  // namespace rhi_vulkan

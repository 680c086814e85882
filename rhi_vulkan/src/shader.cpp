#include "descriptors.h"
#include "pipeline.h"
#include "spirv.h"
#include "states.h"

namespace rhi_vulkan {
namespace {

VkShaderStageFlags StageFlag(Stage stage) {
  switch (stage) {
    case Stage::Vertex: return VK_SHADER_STAGE_VERTEX_BIT;
    case Stage::Geometry: return VK_SHADER_STAGE_GEOMETRY_BIT;
    case Stage::Pixel: return VK_SHADER_STAGE_FRAGMENT_BIT;
    case Stage::Compute: return VK_SHADER_STAGE_COMPUTE_BIT;
  }
  return 0;
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
  for (const ShaderInput& input : reflection.inputs) inputMask |= 1u << input.location;
}

Shader::~Shader() {
  core_->pipelines->Forget(id);
  if (compute) core_->vk.vkDestroyPipeline(core_->device, compute, nullptr);
  for (VkShaderModule m : {module, pointModule_})
    if (m) core_->vk.vkDestroyShaderModule(core_->device, m, nullptr);
}

Status Shader::CreateModule(const uint32_t* words, size_t count, VkShaderModule* out) {
  VkShaderModuleCreateInfo info{VK_STRUCTURE_TYPE_SHADER_MODULE_CREATE_INFO};
  info.codeSize = count * sizeof(uint32_t);
  info.pCode = words;
  const Status s = core_->Check(core_->vk.vkCreateShaderModule(core_->device, &info, nullptr, out), Name().c_str(),
                                "vkCreateShaderModule");
  if (s == Status::Ok) core_->SetName(VK_OBJECT_TYPE_SHADER_MODULE, uint64_t(*out), Name().c_str());
  return s;
}

VkShaderModule Shader::PointModule() {
  if (pointModule_) return pointModule_;
  const std::vector<uint32_t> words = WithPointSize(spirv_);
  CreateModule(words.data(), words.size(), &pointModule_);
  return pointModule_;
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
  if (blob.spirv.size == 0 || !RegistersInRange(reflection)) {
    core_->log.Report(Severity::Error, MsgCode::ShaderRejected, blob.name,
                      "no SPIR-V (%u words), or registers out of range; make the blob with fur_add_shaders",
                      blob.spirv.size);
    return Status::InvalidArg;
  }
  if (!IsSpirv(blob.spirv)) {
    core_->log.Report(Severity::Error, MsgCode::ShaderRejected, blob.name,
                      "its %u words are no SPIR-V, or SPIR-V that breaks off; make the blob with fur_add_shaders",
                      blob.spirv.size);
    return Status::CompileFailed;
  }
  spirv_ = blob.spirv;
  if ((reflection.usesVertexId || reflection.usesInstanceId) && !core_->adapter.features.drawParameters) {
    patched_ = WithoutDrawParameters(blob.spirv);
    spirv_ = {patched_.data(), uint32_t(patched_.size())};
  }
  if (Status s = CreateModule(spirv_.data, spirv_.size, &module); s != Status::Ok) return s;
  if (stage_ == Stage::Pixel) colorOutputs = ColorOutputs(blob.spirv);

  std::vector<SetBinding> inputs, uavs;
  SplitRegisters(reflection, &inputs, &uavs);
  layout = core_->layouts->Get(StageFlag(stage_), std::move(inputs));
  uavLayout = core_->layouts->Get(StageFlag(stage_), std::move(uavs));
  if (!layout || !uavLayout) return core_->Failure();
  return stage_ == Stage::Compute ? CreateComputePipeline(blob.name) : Status::Ok;
}

Status Shader::CreateComputePipeline(const char* name) {
  computeLayout = core_->layouts->GetPipelineLayout({layout, uavLayout, nullptr});
  if (!computeLayout) return core_->Failure();
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

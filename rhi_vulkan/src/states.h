// State objects, samplers, shaders and input layouts.
#pragma once

#include "core.h"

namespace rhi_vulkan {

class StateTables;
struct SetLayout;

// Interned: the tables know every living object, and give equal descriptors the same `id` for as long as the device
// lives, so that a state made again finds its old pipelines.
template <class Interface, class DescType>
class State final : public backend::Object<Interface> {
 public:
  State(std::shared_ptr<Core> core, const DescType& desc, uint32_t stateId)
      : id(stateId), core_(std::move(core)), desc_(desc) {}
  const DescType& Desc() const override { return desc_; }
  const uint32_t id;

 protected:
  void Destroy() noexcept override;

 private:
  std::shared_ptr<Core> core_;
  DescType desc_;
};

using BlendState = State<IBlendState, BlendDesc>;
using DepthState = State<IDepthStencilState, DepthStencilDesc>;
using RasterState = State<IRasterizerState, RasterizerDesc>;

class Sampler final : public VkObject<ISamplerState> {
 public:
  Sampler(std::shared_ptr<Core> core, const SamplerDesc& desc)
      : VkObject(std::move(core)), id(core_->nextId++), desc_(desc) {}
  ~Sampler() override;
  Status Create();
  const SamplerDesc& Desc() const override { return desc_; }

  VkSampler handle = VK_NULL_HANDLE;
  const uint64_t id;

 protected:
  void Destroy() noexcept override;

 private:
  SamplerDesc desc_;
};

class Shader final : public VkObject<IShader> {
 public:
  Shader(std::shared_ptr<Core> core, const ShaderBlob& blob);
  ~Shader() override;
  Status Create(const ShaderBlob& blob);
  Stage GetStage() const override { return stage_; }
  void SetName(const char*) override;
  VkShaderModule PointModule();  // of a vertex shader, for points without a geometry shader; null: refused

  ShaderReflection reflection;
  VkShaderModule module = VK_NULL_HANDLE;
  const SetLayout* layout = nullptr;     // t and s registers
  const SetLayout* uavLayout = nullptr;  // u registers (compute)
  VkPipeline compute = VK_NULL_HANDLE;
  VkPipelineLayout computeLayout = VK_NULL_HANDLE;
  uint32_t inputMask = 0;     // vertex: locations that are read
  uint32_t colorOutputs = 0;  // pixel: bit n is set if SV_Target n is written
  uint32_t id = 0;

 private:
  Status CheckCaps(const ShaderBlob&) const;
  Status CreateModule(const uint32_t* words, size_t count, VkShaderModule* out);
  Status CreateComputePipeline(const char* name);
  Stage stage_;
  Array<uint32_t> spirv_;
  std::vector<uint32_t> patched_;  // spirv_, where it is not the blob's own
  VkShaderModule pointModule_ = VK_NULL_HANDLE;
};

struct LayoutElement {  // an InputElement whose semantic is resolved
  uint32_t location;
  Format format;
  uint32_t slot, offset;
  bool perInstance;
  uint32_t stepRate;
  bool operator==(const LayoutElement&) const = default;
};

class InputLayout final : public VkObject<IInputLayout> {
 public:
  InputLayout(std::shared_ptr<Core> core, std::vector<LayoutElement> list, uint32_t layoutId);
  std::vector<LayoutElement> elements;
  uint32_t slotMask = 0;      // vertex buffer slots that are read
  uint32_t locationMask = 0;  // that are fed
  const uint32_t id;
};

// Small numbers for equal values, kept for the life of the device.
template <class Value>
class IdTable {
 public:
  uint32_t IdOf(const Value& value) {  // from 1; 0 means none
    const auto it = std::find(values_.begin(), values_.end(), value);
    if (it != values_.end()) return uint32_t(it - values_.begin()) + 1;
    values_.push_back(value);
    return uint32_t(values_.size());
  }

 private:
  std::vector<Value> values_;
};

template <class Object, class DescType>
struct StateTable {
  backend::Interner<DescType, Object> living;
  IdTable<DescType> ids;
};

class StateTables {
 public:
  StateTable<BlendState, BlendDesc> blend;
  StateTable<DepthState, DepthStencilDesc> depth;
  StateTable<RasterState, RasterizerDesc> raster;
  backend::Interner<SamplerDesc, Sampler> samplers;
  IdTable<std::vector<LayoutElement>> layouts;
  uint32_t nextShader = 1;

  // The table of one kind of state object.
  auto& TableOf(const BlendDesc&) { return blend; }
  auto& TableOf(const DepthStencilDesc&) { return depth; }
  auto& TableOf(const RasterizerDesc&) { return raster; }
};

template <class Interface, class DescType>
void State<Interface, DescType>::Destroy() noexcept {
  core_->states->TableOf(desc_).living.Forget(this);
  delete this;
}

// Matches elements to the inputs of `vs` by semantic.
Status ResolveElements(const InputElement*, uint32_t count, const Shader& vs, const Core&, std::vector<LayoutElement>*);

VkCompareOp ToVk(Comparison);

}  // namespace rhi_vulkan

// Descriptor sets: constants (set 0) by dynamic offsets, the stages' t and s registers, and compute's u registers.
#include "context.h"
#include "device.h"

namespace rhi_vulkan {
namespace {

constexpr uint32_t kMaxWrites = 32;  // 16 t and 16 s registers; u registers are 8

}  // namespace

bool Context::BindConstants() {
  if ((dirty_ & backend::DirtyConstants) || !constantSet_) constantSet_ = ConstantSet();
  if (!constantSet_) return false;
  BindConstantOffsets();
  return true;
}

// Makes `buffer` keep the slot's offset up to date. One that is in two slots keeps the later; DirtyConstants sees to
// the other, because then every discard looks for the set again.
void Context::OwnOffset(uint32_t slot, Buffer* buffer) {
  uint32_t* entry = &constantOffsets_[slot];
  Buffer* old = offsetOwners_[slot];
  if (old && old != buffer && old->offsetEntry == entry) old->offsetEntry = &old->unboundOffset;
  *entry = buffer ? buffer->slice.offset : 0;
  if (buffer && buffer->IsDynamic()) {
    const bool elsewhere = buffer->offsetEntry != &buffer->unboundOffset && buffer->offsetEntry != entry;
    buffer->dirtyOnDiscard = kDirtyOffsets | (elsewhere ? uint32_t(backend::DirtyConstants) : 0u);
    buffer->offsetEntry = entry;
  }
  offsetOwners_[slot] = buffer;
}

void Context::Disown(const Buffer& buffer) {
  for (Buffer*& owner : offsetOwners_)
    if (owner == &buffer) owner = nullptr;
}

// The set for the buffers (or ring pages) in b0..b3; also notes their offsets.
VkDescriptorSet Context::ConstantSet() {
  writes_.clear();
  setKey_.Clear();
  setKey_.Add(~0ull);  // no stage's set begins so
  for (uint32_t i = 0; i < kMaxConstantBuffers; ++i) {
    auto* buffer = static_cast<Buffer*>(state_.constants[i].get());
    OwnOffset(i, buffer);
    const VkBuffer handle = buffer ? buffer->Handle() : null_.zeros.handle;
    const uint32_t range = buffer ? AlignUp(buffer->Desc().byteWidth, 16u) : kMaxConstantBufferBytes;
    AddBuffer(i, handle, 0, range, !buffer ? 0 : buffer->IsDynamic() ? buffer->slice.page->id : buffer->id);
    writes_.back().descriptorType = VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER_DYNAMIC;
  }
  if (emulateStarts_) {
    AddBuffer(kStartsBinding, starts_.handle, 0, sizeof(DrawStarts), 0);
    writes_.back().descriptorType = VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER;
  }
  bool isNew = false;
  const VkDescriptorSet set = batch_->sets.Find(*core_->layouts->Constants(), setKey_, &isNew);
  if (set && isNew) WriteSet(set);
  return set;
}

void Context::WriteSet(VkDescriptorSet set) {
  for (VkWriteDescriptorSet& write : writes_) write.dstSet = set;
  if (!writes_.empty()) vk_.vkUpdateDescriptorSets(core_->device, uint32_t(writes_.size()), writes_.data(), 0, nullptr);
  ++stats_.descriptorMisses;
}

void Context::AddBuffer(uint32_t binding, VkBuffer buffer, VkDeviceSize offset, VkDeviceSize range, uint64_t id) {
  VkDescriptorBufferInfo& info = bufferInfos_[writes_.size()];
  info = {buffer, offset, buffer ? range : VK_WHOLE_SIZE};
  VkWriteDescriptorSet write{VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET};
  write.dstBinding = binding;
  write.descriptorCount = 1;
  write.descriptorType = VK_DESCRIPTOR_TYPE_STORAGE_BUFFER;
  write.pBufferInfo = &info;
  writes_.push_back(write);
  setKey_.Add(id << 8 | binding);
  setKey_.Add(offset << 32 | (range & 0xFFFFFFFFu));
}

void Context::AddImage(uint32_t binding, VkDescriptorType type, VkImageView view, VkImageLayout layout, uint64_t id) {
  VkDescriptorImageInfo& info = imageInfos_[writes_.size()];
  info = {VK_NULL_HANDLE, view, layout};
  VkWriteDescriptorSet write{VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET};
  write.dstBinding = binding;
  write.descriptorCount = 1;
  write.descriptorType = type;
  write.pImageInfo = &info;
  writes_.push_back(write);
  setKey_.Add(id << 8 | binding);
}

void Context::AddResource(Stage stage, const ShaderResource& r) {
  const uint32_t binding = kVkTextureBinding + r.slot;
  auto* view = static_cast<ShaderView*>(state_.resources[size_t(stage)][r.slot].get());
  const bool wantsTexture = r.kind == ShaderResourceKind::Texture;
  if (view && !Fits(*view, r)) {
    Report(Severity::Error, MsgCode::ViewMismatch, r.name,
           "the view in a t register is of another kind, dimension or type of texels than the shader's; it reads 0");
    view = nullptr;
  } else if (!view) {
    Report(Severity::Warning, MsgCode::NothingBound, r.name,
           "the shader reads a t register with nothing bound; it reads 0");
  }
  if (wantsTexture) {
    const bool depth = view && GetFormatInfo(view->Desc().format).depth;
    const VkImageView handle = view ? view->view : NullView(r.dim, r.integer);
    setIncomplete_ = setIncomplete_ || (!handle && !core_->adapter.features.nullDescriptor);
    AddImage(binding, VK_DESCRIPTOR_TYPE_SAMPLED_IMAGE, handle, SampledRead(stage, depth).layout, view ? view->id : 0);
    return;
  }
  if (!view) return AddBuffer(binding, null_.zeros.handle, 0, kMaxConstantBufferBytes, 0);
  const Buffer& buffer = *view->buffer;
  const VkDeviceSize stride = buffer.Desc().structureStride;
  AddBuffer(binding, buffer.Handle(), buffer.Offset() + view->Desc().firstElement * stride,
            view->Desc().elementCount * stride, view->id);
  if (buffer.IsDynamic()) setKey_.Add(buffer.slice.page->id);
}

void Context::AddSampler(Stage stage, const ShaderSampler& s) {
  const auto* sampler = static_cast<const Sampler*>(state_.samplers[size_t(stage)][s.slot].get());
  if (!sampler) sampler = static_cast<const Sampler*>(null_.sampler.get());
  AddImage(kVkSamplerBinding + s.slot, VK_DESCRIPTOR_TYPE_SAMPLER, VK_NULL_HANDLE, VK_IMAGE_LAYOUT_UNDEFINED,
           sampler->id);
  imageInfos_[writes_.size() - 1].sampler = sampler->handle;
}

VkDescriptorSet Context::StageSet(Stage stage, const Shader& shader) {
  static_assert(kMaxShaderResources + kMaxSamplers <= kMaxWrites);
  writes_.clear();
  setKey_.Clear();
  setKey_.Add(uint64_t(reinterpret_cast<uintptr_t>(shader.layout)));  // layouts live as long as the device
  setIncomplete_ = false;
  for (const ShaderResource& r : shader.reflection.resources)
    if (r.kind == ShaderResourceKind::Texture || r.kind == ShaderResourceKind::StructuredBuffer) AddResource(stage, r);
  if (setIncomplete_) return VK_NULL_HANDLE;
  for (const ShaderSampler& s : shader.reflection.samplers) AddSampler(stage, s);
  bool isNew = false;
  const VkDescriptorSet set = batch_->sets.Find(*shader.layout, setKey_, &isNew);
  if (set && isNew) WriteSet(set);
  return set;
}

bool Context::BindStageSets() {
  bool disturbed = false;  // a set of another layout disturbs those behind it
  for (uint32_t i = 0; i < 3; ++i) {
    const Stage stage = Stage(i);
    const SetLayout* layout = pipeline_->sets[i] ? pipeline_->sets[i] : core_->layouts->Empty();
    const uint32_t own = (backend::DirtyResources | backend::DirtySamplers) << i;
    const bool sameLayout = boundLayouts_[i] == layout;
    if (sameLayout && !disturbed && !(dirty_ & own)) continue;
    if (!sameLayout) disturbed = true;
    if (!layout->bindings.empty()) {
      // A disturbed set whose contents are the same is only bound again.
      if (!sameLayout || (dirty_ & own) || !boundSets_[i])
        boundSets_[i] = StageSet(stage, static_cast<const Shader&>(*state_.shaders[i]));
      if (!boundSets_[i]) return false;
      vk_.vkCmdBindDescriptorSets(cmd_, VK_PIPELINE_BIND_POINT_GRAPHICS, pipeline_->layout, kVkStageSet + i, 1,
                                  &boundSets_[i], 0, nullptr);
    }
    boundLayouts_[i] = layout;
  }
  return true;
}

void Context::AddUav(const ShaderResource& r) {
  const uint32_t binding = kVkUavBinding + r.slot;
  auto* view = static_cast<UavView*>(state_.uavs[r.slot].get());
  const bool wantsTexture = r.kind == ShaderResourceKind::RWTexture;
  if (view && !Fits(*view, r)) {
    Report(Severity::Error, MsgCode::ViewMismatch, r.name,
           "the view in a u register is of another kind, dimension or type of texels than the shader's; it reads 0 and "
           "writes are dropped");
    view = nullptr;
  } else if (!view) {
    Report(Severity::Warning, MsgCode::NothingBound, r.name,
           "the shader uses a u register with nothing bound; it reads 0 and writes are dropped");
  }
  if (wantsTexture)
    return AddImage(binding, VK_DESCRIPTOR_TYPE_STORAGE_IMAGE, view ? view->view : VK_NULL_HANDLE, kStorageWrite.layout,
                    view ? view->id : 0);
  if (!view) {
    const VkBuffer sink = core_->adapter.features.nullDescriptor ? VK_NULL_HANDLE : null_.sink.handle;
    return AddBuffer(binding, sink, 0, kMaxConstantBufferBytes, 0);
  }
  const VkDeviceSize stride = view->buffer->Desc().structureStride;
  AddBuffer(binding, view->buffer->Handle(), view->Desc().firstElement * stride, view->Desc().elementCount * stride,
            view->id);
}

VkDescriptorSet Context::UavSet(const Shader& shader) {
  writes_.clear();
  setKey_.Clear();
  setKey_.Add(uint64_t(reinterpret_cast<uintptr_t>(shader.uavLayout)));
  for (const ShaderResource& r : shader.reflection.resources)
    if (r.kind == ShaderResourceKind::RWTexture || r.kind == ShaderResourceKind::RWStructuredBuffer) AddUav(r);
  bool isNew = false;
  const VkDescriptorSet set = batch_->sets.Find(*shader.uavLayout, setKey_, &isNew);
  if (set && isNew) WriteSet(set);
  return set;
}

// A texture of zeros (alpha too) of the dimension that the shader declares; made in the setup commands, so that no pass
// is broken. VK_NULL_HANDLE where the driver has null descriptors.
VkImageView Context::NullView(TextureDim dim, bool integer) {
  if (core_->adapter.features.nullDescriptor) return VK_NULL_HANDLE;
  VkImageView& view = null_.views[size_t(dim)][integer];
  if (view) return view;
  TextureDesc desc;
  desc.dim = dim;
  desc.depthOrArray = dim == TextureDim::TexCube ? 6 : 1;
  desc.sampleCount = dim == TextureDim::Tex2DMS ? std::min(4u, core_->adapter.caps.maxColorSamples) : 1;
  desc.format = integer ? Format::RGBA8_UInt : Format::RGBA8_UNorm;
  desc.bind = Bind::ShaderResource | (dim == TextureDim::Tex2DMS ? Bind::RenderTarget : Bind::None);
  desc.name = "rhi unbound";
  Ref<ITexture>& texture = null_.textures[size_t(dim)][integer];
  if (device_.CreateTexture(desc, nullptr, &texture) != Status::Ok) return VK_NULL_HANDLE;
  auto& made = static_cast<Texture&>(*texture);
  BarrierBatch barriers;
  made.Advance(made.All(), kCopyDest, barriers);
  barriers.Record(vk_, Setup());
  const VkClearColorValue zero{};
  const VkImageSubresourceRange all{VK_IMAGE_ASPECT_COLOR_BIT, 0, 1, 0, VK_REMAINING_ARRAY_LAYERS};
  vk_.vkCmdClearColorImage(Setup(), made.image, kCopyDest.layout, &zero, 1, &all);
  Access read = SampledRead(Stage::Pixel, false);
  read.stages |= constantStages_ | StageBits(Stage::Compute);
  made.Advance(made.All(), read, barriers);
  barriers.Record(vk_, Setup());
  ViewDesc viewDesc;
  backend::ResolveTextureView(desc, nullptr, Bind::ShaderResource, &viewDesc, log_);
  const VkResult result = CreateImageView(*core_, made, viewDesc, Bind::ShaderResource, &view);
  core_->CheckOnce(result, desc.name, "vkCreateImageView");
  return view;
}

}  // namespace rhi_vulkan

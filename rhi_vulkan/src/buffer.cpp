#include <cstring>

#include "context.h"

namespace rhi_vulkan {
namespace {

VkBufferUsageFlags UsageOf(const BufferDesc& desc) {
  VkBufferUsageFlags usage = VK_BUFFER_USAGE_TRANSFER_SRC_BIT | VK_BUFFER_USAGE_TRANSFER_DST_BIT;
  if (desc.bind & Bind::VertexBuffer) usage |= VK_BUFFER_USAGE_VERTEX_BUFFER_BIT;
  if (desc.bind & Bind::IndexBuffer) usage |= VK_BUFFER_USAGE_INDEX_BUFFER_BIT;
  if (desc.bind & Bind::ConstantBuffer) usage |= VK_BUFFER_USAGE_UNIFORM_BUFFER_BIT;
  if ((desc.bind & Bind::ShaderResource) || (desc.bind & Bind::UnorderedAccess))
    usage |= VK_BUFFER_USAGE_STORAGE_BUFFER_BIT;
  if (desc.bind & Bind::IndirectArgs) usage |= VK_BUFFER_USAGE_INDIRECT_BUFFER_BIT;
  return usage;
}

// What the context must look at again when the buffer's contents move.
uint32_t DirtyBitsOf(Bind bind) {
  uint32_t bits = 0;
  if (bind & Bind::ConstantBuffer) bits |= kDirtyOffsets;
  if (bind & Bind::VertexBuffer) bits |= backend::DirtyVertexBuffers;
  if (bind & Bind::IndexBuffer) bits |= backend::DirtyIndexBuffer;
  if (bind & Bind::ShaderResource) bits |= backend::DirtyResources * 15u;  // all four stages
  return bits;
}

}  // namespace

Status GpuBuffer::Create(Core& core, const char* name, VkDeviceSize size, VkBufferUsageFlags usage, MemoryKind kind) {
  VkBufferCreateInfo info{VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO};
  info.size = size;
  info.usage = usage;
  Status s = core.Check(core.vk.vkCreateBuffer(core.device, &info, nullptr, &handle), name, "vkCreateBuffer");
  if (s == Status::Ok) s = core.Check(core.memory->AllocateFor(handle, kind, &memory), name, "memory of a buffer");
  if (s == Status::Ok) core.SetName(VK_OBJECT_TYPE_BUFFER, uint64_t(handle), name);
  return s;
}

void GpuBuffer::Destroy(Core& core) {
  if (handle) core.vk.vkDestroyBuffer(core.device, handle, nullptr);
  core.memory->Free(memory);
}

Buffer::Buffer(std::shared_ptr<Core> core, const BufferDesc& desc)
    : VkObject(std::move(core)), id(core_->nextId++), descName_(desc.name ? desc.name : ""), desc_(desc) {
  desc_.name = descName_.c_str();
  backend::Object<IBuffer>::SetName(desc_.name);
}

Buffer::~Buffer() {
  core_->ring->Repin(slice.page, nullptr);
  gpu.Destroy(*core_);
}

void Buffer::Destroy() noexcept {
  if (core_->context && (desc_.bind & Bind::ConstantBuffer)) core_->context->Disown(*this);
  VkObject::Destroy();
}

void Buffer::SetName(const char* name) {
  backend::Object<IBuffer>::SetName(name);
  core_->SetName(VK_OBJECT_TYPE_BUFFER, uint64_t(gpu.handle), Name().c_str());
}

Status Buffer::Create() {
  if (desc_.usage == Usage::Dynamic) {
    alignedWidth = AlignUp(desc_.byteWidth, core_->ring->Alignment());
    dirtyOnDiscard = DirtyBitsOf(desc_.bind);
    core_->SpeakAgain();
    if (!core_->ring->Take(alignedWidth, &slice)) return core_->Failure();
    core_->ring->Repin(nullptr, slice.page);
    std::memset(slice.Data(), 0, desc_.byteWidth);
    return Status::Ok;
  }
  const bool staging = desc_.usage == Usage::Staging;
  // Constant buffers are read in rows of 16 bytes. Others end where they end: drivers find vertices beyond by the
  // buffer's size.
  const uint32_t size = desc_.bind & Bind::ConstantBuffer ? AlignUp(desc_.byteWidth, 16u) : desc_.byteWidth;
  return gpu.Create(*core_, desc_.name, size, UsageOf(desc_), staging ? MemoryKind::Readback : MemoryKind::Gpu);
}

}  // namespace rhi_vulkan

#include "ring.h"

#include "core.h"

namespace rhi_vulkan {

Ring::~Ring() {
  for (const auto& page : pages_) DestroyPage(*page);
}

void Ring::DestroyPage(RingPage& page) {
  if (page.buffer) core_.vk.vkDestroyBuffer(core_.device, page.buffer, nullptr);
  core_.memory->Free(page.memory);
}

RingPage* Ring::NewPage(uint32_t bytes) {
  auto page = std::make_unique<RingPage>();
  VkBufferCreateInfo info{VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO};
  info.size = bytes;
  info.usage = VK_BUFFER_USAGE_UNIFORM_BUFFER_BIT | VK_BUFFER_USAGE_STORAGE_BUFFER_BIT |
               VK_BUFFER_USAGE_VERTEX_BUFFER_BIT | VK_BUFFER_USAGE_INDEX_BUFFER_BIT |
               VK_BUFFER_USAGE_INDIRECT_BUFFER_BIT | VK_BUFFER_USAGE_TRANSFER_SRC_BIT;
  VkResult result = core_.vk.vkCreateBuffer(core_.device, &info, nullptr, &page->buffer);
  if (result == VK_SUCCESS) result = core_.memory->AllocateFor(page->buffer, MemoryKind::Upload, &page->memory);
  if (result != VK_SUCCESS) {
    core_.CheckOnce(result, "", "a new page of the constant ring");
    DestroyPage(*page);
    return nullptr;
  }
  page->data = page->memory.mapped;
  page->size = bytes;
  page->id = core_.nextId++;
  core_.SetName(VK_OBJECT_TYPE_BUFFER, uint64_t(page->buffer), "rhi ring page");
  pages_.push_back(std::move(page));
  return pages_.back().get();
}

bool Ring::TakeFromNewPage(uint32_t alignedSize, Slice* out) {
  if (alignedSize > pageBytes_) {  // a page of its own
    RingPage* page = NewPage(alignedSize);
    if (!page) return false;
    page->lastUse = core_.recording;
    busy_.push_back(page);
    *out = {page, 0};
    return true;
  }
  RingPage* page = nullptr;
  if (!free_.empty()) {
    page = free_.back();
    free_.pop_back();
  } else {
    page = NewPage(pageBytes_);
  }
  if (!page) return false;
  if (current_) {
    current_->lastUse = core_.recording;
    busy_.push_back(current_);
  }
  current_ = page;
  currentSize_ = page->size;
  head_ = alignedSize;
  *out = {page, 0};
  return true;
}

void Ring::Repin(RingPage* from, RingPage* to) {
  if (to) ++to->live;
  if (!from) return;
  --from->live;
  from->lastUse = core_.recording;  // draws recorded until now may read it
}

void Ring::OnSubmit(uint64_t serial) {
  if (current_) current_->lastUse = serial;
}

void Ring::Collect(uint64_t completed) {
  std::erase_if(busy_, [&](RingPage* page) {
    if (page->live != 0 || page->lastUse > completed) return false;
    if (page->size == pageBytes_) {
      free_.push_back(page);
      return true;
    }
    DestroyPage(*page);
    std::erase_if(pages_, [&](const auto& p) { return p.get() == page; });
    return true;
  });
}

}  // namespace rhi_vulkan

// Memory that the CPU writes for the GPU to read once: constants, dynamic buffers, uploads. Pages are filled from front
// to back and used again when the GPU has passed them and no dynamic buffer's current contents lie in them.
#pragma once

#include <memory>
#include <vector>

#include "memory.h"

namespace rhi_vulkan {

class Core;

struct RingPage {
  VkBuffer buffer = VK_NULL_HANDLE;
  Allocation memory;
  uint8_t* data = nullptr;
  uint32_t size = 0;
  uint32_t live = 0;     // dynamic buffers whose contents are here
  uint64_t lastUse = 0;  // serial of the last submission that may read it
  uint64_t id = 0;       // from Core::nextId
};

struct Slice {
  RingPage* page = nullptr;
  uint32_t offset = 0;
  uint8_t* Data() const { return page->data + offset; }
};

class Ring {
 public:
  Ring(Core& core, uint32_t pageBytes, uint32_t alignment)
      : core_(core), pageBytes_(AlignUp(pageBytes, alignment)), alignment_(alignment) {}
  ~Ring();
  Ring(const Ring&) = delete;
  Ring& operator=(const Ring&) = delete;

  // `alignedSize` is a multiple of Alignment(). False: out of memory.
  bool Take(uint32_t alignedSize, Slice* out) {
    if (alignedSize <= currentSize_ - head_) [[likely]] {
      *out = {current_, head_};
      head_ += alignedSize;
      return true;
    }
    return TakeFromNewPage(alignedSize, out);
  }
  // The same for contents that lie in `page` now: succeeds if that is the current page and has room.
  bool TakeInPage(const RingPage* page, uint32_t alignedSize, uint32_t* offset) {
    const uint32_t end = head_ + alignedSize;
    if (page != current_ || end > currentSize_) [[unlikely]]
      return false;
    *offset = head_;
    head_ = end;
    return true;
  }
  uint32_t Alignment() const { return alignment_; }

  // Moves a dynamic buffer's contents from one page to another; either may be null.
  void Repin(RingPage* from, RingPage* to);

  void OnSubmit(uint64_t serial);    // `serial` is what was just submitted
  void Collect(uint64_t completed);  // pages may be used again

 private:
  bool TakeFromNewPage(uint32_t alignedSize, Slice* out);
  RingPage* NewPage(uint32_t bytes);
  void DestroyPage(RingPage&);

  Core& core_;
  uint32_t pageBytes_, alignment_, head_ = 0, currentSize_ = 0;
  RingPage* current_ = nullptr;
  std::vector<std::unique_ptr<RingPage>> pages_;  // all of them
  std::vector<RingPage*> free_;                   // of pageBytes_ each
  std::vector<RingPage*> busy_;
};

}  // namespace rhi_vulkan

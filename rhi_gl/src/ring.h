// The ring of the constants: pages of persistently mapped memory, handed out from front to back and used again when the
// GPU has passed the frame that filled them. It grows by a page whenever all are in flight.
#pragma once

#include "resources.h"

namespace rhi_gl {

struct RingPage {
  GLuint name = 0;
  uint32_t uid = 0;
  std::byte* memory = nullptr;
  uint64_t lastFrame = 0;
  Buffer* inhabitants = nullptr;  // buffers whose current contents lie here

  void Enter(Buffer&);
  static void Leave(Buffer&);  // from whichever page it is in
};

class Ring {
 public:
  Ring(Core& core, uint32_t pageBytes);
  ~Ring();
  Ring(const Ring&) = delete;
  Ring& operator=(const Ring&) = delete;

  // Moves a dynamic constant buffer to a fresh slice and gives its memory; null (and a message): out of memory.
  std::byte* Rename(Buffer& buffer) {
    if (buffer.ringBytes > size_ - used_) [[unlikely]]
      if (!NextPage()) return nullptr;
    std::byte* slice = memory_ + used_;
    buffer.offset = used_;
    buffer.data = slice;
    used_ += buffer.ringBytes;
    if (buffer.page != page_) [[unlikely]]
      MoveIn(buffer);
    return slice;
  }

  // Bytes that no buffer owns, valid for this frame.
  struct Slice {
    GLuint name;
    uint32_t uid, offset;
    std::byte* data;  // null: out of memory
  };
  Slice Take(uint32_t bytes);

  // Gives back the pages that the GPU has finished with. True: contents of a bound buffer moved.
  bool Recycle();

 private:
  bool NextPage();
  std::unique_ptr<RingPage> MakePage();
  void MoveIn(Buffer&);
  bool Evacuate(RingPage&);
  void Abandon(RingPage&);

  Core& core_;
  const uint32_t pageBytes_;
  // The page being filled. No page: size_ is 0, so the first slice asks for one.
  std::byte* memory_ = nullptr;
  uint32_t used_ = 0, size_ = 0;
  RingPage* page_ = nullptr;
  std::unique_ptr<RingPage> filling_;
  std::vector<std::unique_ptr<RingPage>> busy_, free_;
};

}  // namespace rhi_gl

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

  // The hot path: a fresh slice of the page that the buffer lives in already. Null: ask Rename.
  std::byte* RenameInPage(Buffer& buffer) {
    const uint32_t at = used_, end = at + buffer.ringBytes;
    if (end > open_ || buffer.page != page_) [[unlikely]]
      return nullptr;
    used_ = end;
    buffer.offset = at;
    return memory_ + at;
  }
  // Moves a dynamic constant buffer to a fresh slice and gives its memory; null (and a message): out of memory.
  std::byte* Rename(Buffer&);

  // Closed, the ring sends the hot path to Rename, whose caller first makes the context current.
  void Close() { open_ = 0; }
  void Open() { open_ = page_ ? pageBytes_ : 0; }

  // Bytes that no buffer owns, valid for this frame.
  struct Slice {
    GLuint name;
    uint32_t uid, offset;
    std::byte* data;  // null: out of memory
  };
  Slice Take(uint32_t bytes);

  // All that was ever taken, in bytes.
  uint64_t Taken() const { return takenBefore_ + used_; }

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
  // The page being filled, open as far as open_.
  std::byte* memory_ = nullptr;
  uint32_t used_ = 0, open_ = 0;
  uint64_t takenBefore_ = 0;
  RingPage* page_ = nullptr;
  std::unique_ptr<RingPage> filling_;
  std::vector<std::unique_ptr<RingPage>> busy_, free_;
};

}  // namespace rhi_gl

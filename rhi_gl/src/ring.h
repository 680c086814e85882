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

  // The hot path: whether Advance may serve the buffer. One comparison tells that the buffer lives in the page being
  // filled, that a slice fits there, and that the ring is open: any other page, or none, is out of reach.
  bool IsAtHand(const Buffer& buffer) const {
    return uintptr_t(cursor_) - uintptr_t(buffer.pageMemory) <= buffer.lastSlice;
  }
  // Moves the buffer to the next slice of the page that it lives in already.
  std::byte* Advance(Buffer& buffer) {
    std::byte* slice = cursor_;
    buffer.offset = uint32_t(uintptr_t(slice) - uintptr_t(buffer.pageMemory));
    cursor_ = slice + buffer.ringBytes;
    return slice;
  }
  // Moves a dynamic constant buffer to a fresh slice and gives its memory; null (and a message): out of memory.
  std::byte* Rename(Buffer&);

  // Closed, nothing is at hand, and who asks for Rename first makes the context current and opens the ring.
  void Close() {
    if (cursor_) closedAt_ = std::exchange(cursor_, nullptr);
  }
  void Open() {
    if (!cursor_) cursor_ = closedAt_;
  }

  // Bytes that no buffer owns, valid for this frame.
  struct Slice {
    GLuint name;
    uint32_t uid, offset;
    std::byte* data;  // null: out of memory
  };
  Slice Take(uint32_t bytes);

  // All that was ever taken, in bytes.
  uint64_t Taken() const;

  // Gives back the pages that the GPU has finished with. True: contents of a bound buffer moved.
  bool Recycle();

 private:
  bool MakeRoom(uint32_t bytes);
  bool NextPage();
  std::unique_ptr<RingPage> MakePage();
  void MoveIn(Buffer&);
  bool Evacuate(RingPage&);
  void Abandon(RingPage&);

  Core& core_;
  const uint32_t pageBytes_;
  std::byte* cursor_ = nullptr;    // where the next slice begins; null: no page yet, or closed
  std::byte* closedAt_ = nullptr;  // where to go on
  uint64_t takenBefore_ = 0;       // from the pages before
  std::unique_ptr<RingPage> filling_;
  std::vector<std::unique_ptr<RingPage>> busy_, free_;
};

}  // namespace rhi_gl

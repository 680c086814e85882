#include "ring.h"

namespace rhi_gl {

void RingPage::Enter(Buffer& buffer) {
  buffer.page = this;
  buffer.previousInPage = nullptr;
  buffer.nextInPage = inhabitants;
  if (inhabitants) inhabitants->previousInPage = &buffer;
  inhabitants = &buffer;
}

void RingPage::Leave(Buffer& buffer) {
  if (buffer.previousInPage) {
    buffer.previousInPage->nextInPage = buffer.nextInPage;
  } else {
    buffer.page->inhabitants = buffer.nextInPage;
  }
  if (buffer.nextInPage) buffer.nextInPage->previousInPage = buffer.previousInPage;
  buffer.page = nullptr;
  buffer.pageMemory = nullptr;
}

Ring::Ring(Core& core, uint32_t pageBytes)
    : core_(core), pageBytes_(std::max(AlignUp(pageBytes, 256), 2 * kMaxConstantBufferBytes)) {}

Ring::~Ring() {
  if (filling_) Abandon(*filling_);
  for (auto& page : busy_) Abandon(*page);
  for (auto& page : free_) Abandon(*page);
}

// The device ends: buffers that outlive it can no longer be used, only released.
void Ring::Abandon(RingPage& page) {
  while (page.inhabitants) RingPage::Leave(*page.inhabitants);
  core_.Discard(NameKind::Buffer, page.name);
}

std::unique_ptr<RingPage> Ring::MakePage() {
  auto page = std::make_unique<RingPage>();
  constexpr GLbitfield kFlags = GL_MAP_WRITE_BIT | GL_MAP_PERSISTENT_BIT | GL_MAP_COHERENT_BIT;
  const bool fits = core_.Allocates([&] {
    glCreateBuffers(1, &page->name);
    glNamedBufferStorage(page->name, pageBytes_, nullptr, kFlags);
    page->memory = static_cast<std::byte*>(glMapNamedBufferRange(page->name, 0, pageBytes_, kFlags));
  });
  if (!fits || !page->memory) {
    core_.Discard(NameKind::Buffer, page->name);
    return nullptr;
  }
  page->uid = core_.NewUid();
  return page;
}

bool Ring::NextPage() {
  std::unique_ptr<RingPage> next;
  if (free_.empty()) {
    next = MakePage();
  } else {
    next = std::move(free_.back());
    free_.pop_back();
  }
  if (!next) {
    core_.OutOfMemory("", "page of the ring of constants");
    return false;
  }
  takenBefore_ = Taken();  // while the page is still the one that is filled
  if (filling_) {
    filling_->lastFrame = core_.frames.Current();
    busy_.push_back(std::move(filling_));
  }
  filling_ = std::move(next);
  cursor_ = filling_->memory;
  return true;
}

uint64_t Ring::Taken() const {
  const std::byte* end = cursor_ ? cursor_ : closedAt_;
  return takenBefore_ + (filling_ ? uint64_t(end - filling_->memory) : 0);
}

bool Ring::MakeRoom(uint32_t bytes) {
  if (cursor_ && uint64_t(cursor_ - filling_->memory) + bytes <= pageBytes_) return true;
  return NextPage();
}

void Ring::MoveIn(Buffer& buffer) {
  if (buffer.page) RingPage::Leave(buffer);
  filling_->Enter(buffer);
  buffer.name = filling_->name;
  buffer.uid = filling_->uid;
  buffer.pageMemory = filling_->memory;
  buffer.lastSlice = pageBytes_ - buffer.ringBytes;
}

std::byte* Ring::Rename(Buffer& buffer) {
  if (!MakeRoom(buffer.ringBytes)) return nullptr;
  if (buffer.page != filling_.get()) MoveIn(buffer);
  return Advance(buffer);
}

Ring::Slice Ring::Take(uint32_t bytes) {
  const uint32_t size = AlignUp(bytes, core_.limits.uniformAlignment);
  if (!MakeRoom(size)) return {};
  const Slice slice{filling_->name, filling_->uid, uint32_t(cursor_ - filling_->memory), cursor_};
  cursor_ += size;
  return slice;
}

bool Ring::Evacuate(RingPage& page) {
  bool bound = false;
  while (Buffer* buffer = page.inhabitants) {
    RingPage::Leave(*buffer);
    buffer->MoveHome();
    bound = bound || buffer->boundSlots != 0;
  }
  return bound;
}

bool Ring::Recycle() {
  bool bound = false;
  std::vector<std::unique_ptr<RingPage>> still;
  for (std::unique_ptr<RingPage>& page : busy_) {
    if (page->lastFrame > core_.frames.Completed()) {
      still.push_back(std::move(page));
    } else if (page->inhabitants) {
      // Constants that are older than the frames in flight keep their contents; the copies read the page once more.
      bound |= Evacuate(*page);
      page->lastFrame = core_.frames.Current();
      still.push_back(std::move(page));
    } else {
      free_.push_back(std::move(page));
    }
  }
  busy_ = std::move(still);
  return bound;
}

}  // namespace rhi_gl

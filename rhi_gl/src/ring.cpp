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
  if (filling_) {
    filling_->lastFrame = core_.frames.Current();
    busy_.push_back(std::move(filling_));
  }
  filling_ = std::move(next);
  page_ = filling_.get();
  memory_ = page_->memory;
  takenBefore_ += used_;
  used_ = 0;
  open_ = pageBytes_;
  return true;
}

void Ring::MoveIn(Buffer& buffer) {
  if (buffer.page) RingPage::Leave(buffer);
  page_->Enter(buffer);
  buffer.name = page_->name;
  buffer.uid = page_->uid;
}

std::byte* Ring::Rename(Buffer& buffer) {
  if (used_ + buffer.ringBytes > open_ && !NextPage()) return nullptr;
  if (buffer.page != page_) MoveIn(buffer);
  return RenameInPage(buffer);
}

Ring::Slice Ring::Take(uint32_t bytes) {
  const uint32_t size = AlignUp(bytes, core_.limits.uniformAlignment);
  if (used_ + size > open_ && !NextPage()) return {};
  Slice slice{page_->name, page_->uid, used_, memory_ + used_};
  used_ += size;
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

#include <cstring>
#include <typeinfo>

#include "resources.h"
#include "ring.h"

namespace rhi_gl {
namespace {

constexpr GLbitfield kMapWrite = GL_MAP_WRITE_BIT | GL_MAP_PERSISTENT_BIT | GL_MAP_COHERENT_BIT;
constexpr GLbitfield kMapReadWrite = kMapWrite | GL_MAP_READ_BIT;
constexpr uint32_t kMaxVersionChunk = 1u << 20;  // small buffers share GL buffers of up to this size

// Storage with all of it mapped for ever.
std::byte* MakeMapped(GLuint name, uint64_t size, GLbitfield map, GLbitfield storage, const void* init) {
  glNamedBufferStorage(name, GLsizeiptr(size), init, map | storage);
  return static_cast<std::byte*>(glMapNamedBufferRange(name, 0, GLsizeiptr(size), map));
}

}  // namespace

Buffer* AsBuffer(IResource* r) { return r && typeid(*r) == typeid(Buffer) ? static_cast<Buffer*>(r) : nullptr; }
Texture* AsTexture(IResource* r) { return r && typeid(*r) == typeid(Texture) ? static_cast<Texture*>(r) : nullptr; }

Buffer::Buffer(const CorePtr& core, const BufferDesc& desc) : core_(core), desc_(desc) {
  const bool constant = desc.bind & Bind::ConstantBuffer;
  ringConstant_ = constant && desc.usage == Usage::Dynamic;
  range = constant ? AlignUp(desc.byteWidth, 16) : desc.byteWidth;
  ringBytes = AlignUp(range, core->limits.uniformAlignment);
}

Status Buffer::Create(const CorePtr& core, const BufferDesc& desc, const void* init, Ref<IBuffer>* out) {
  if (Status s = CheckBufferDesc(desc, init, core->caps, core->log); s != Status::Ok) return s;
  auto buffer = Ref<Buffer>::Adopt(new Buffer(core, desc));
  if (!core->Allocates([&] { buffer->AllocateStorage(init); }) || buffer->name == 0)
    return core->OutOfMemory(desc.name, "buffer");
  buffer->SetName(desc.name);
  *out = buffer;
  return Status::Ok;
}

Buffer::~Buffer() {
  if (page) RingPage::Leave(*this);
  core_->Discard(NameKind::Buffer, own_);
  for (GLuint chunk : chunks_) core_->Discard(NameKind::Buffer, chunk);
}

void Buffer::SetName(const char* text) {
  Object::SetName(text);
  desc_.name = Name().c_str();
  core_->Label(GL_BUFFER, own_, text);
}

bool Buffer::AllocateStorage(const void* init) {
  switch (desc_.usage) {
    case Usage::Default: return AllocateFixed(init, GL_DYNAMIC_STORAGE_BIT);
    case Usage::Immutable: return AllocateFixed(init, 0);
    case Usage::Staging: return AllocateFixed(init, kMapReadWrite | GL_CLIENT_STORAGE_BIT);
    case Usage::Dynamic: break;
  }
  if (!ringConstant_) return AllocateVersions(init);
  if (init) return AllocateFixed(init, 0);
  name = core_->zeroBuffer;  // until the first update
  return true;
}

bool Buffer::AllocateFixed(const void* init, GLbitfield flags) {
  glCreateBuffers(1, &own_);
  // The caller's memory may end before the rounded size of a constant buffer does.
  std::vector<std::byte> padded;
  if (init && range != desc_.byteWidth) {
    padded.resize(range);
    std::memcpy(padded.data(), init, desc_.byteWidth);
    init = padded.data();
  }
  if (flags & GL_MAP_PERSISTENT_BIT) {
    data = MakeMapped(own_, range, kMapReadWrite, GL_CLIENT_STORAGE_BIT, init);
    if (!data) return false;
  } else {
    glNamedBufferStorage(own_, range, init, flags);
  }
  name = own_;
  uid = ownUid_ = core_->NewUid();
  return true;
}

bool Buffer::AllocateVersions(const void* init) {
  if (!AddVersions()) return false;
  current_ = idle_.front();
  idle_.pop_front();
  if (init) std::memcpy(current_.data, init, desc_.byteWidth);
  name = current_.name;
  uid = current_.uid;
  offset = current_.offset;
  data = current_.data;
  return true;
}

// One GL buffer with as many versions as there are already (so that the number doubles), within kMaxVersionChunk.
bool Buffer::AddVersions() {
  const uint64_t size = (uint64_t(desc_.byteWidth) + 255) & ~uint64_t(255);  // every alignment GL asks for
  const uint64_t room = std::max<uint64_t>(1, kMaxVersionChunk / size);
  const uint64_t count = std::min<uint64_t>(room, idle_.size() + 1);
  GLuint chunk = 0;
  glCreateBuffers(1, &chunk);
  std::byte* memory = MakeMapped(chunk, size * count, kMapWrite, 0, nullptr);
  chunks_.push_back(chunk);
  if (!memory) return false;
  const uint32_t chunkUid = core_->NewUid();
  for (uint64_t i = 0; i < count; ++i) idle_.push_front({chunk, chunkUid, uint32_t(size * i), memory + size * i, 0});
  return true;
}

std::byte* Buffer::Rename() {
  if (idle_.empty() || idle_.front().freeAfter > core_->frames.Completed()) {
    bool added = false;
    if (!core_->Allocates([&] { added = AddVersions(); }) || !added) {
      core_->OutOfMemory(desc_.name, "buffer's next version");
      return nullptr;
    }
  }
  current_.freeAfter = core_->frames.Current();
  idle_.push_back(current_);
  current_ = idle_.front();
  idle_.pop_front();
  name = current_.name;
  uid = current_.uid;
  offset = current_.offset;
  return data = current_.data;
}

bool Buffer::MakeHome() {
  if (own_ != 0) return true;
  const bool fits = core_->Allocates([&] {
    glCreateBuffers(1, &own_);
    glNamedBufferStorage(own_, range, nullptr, 0);
  });
  ownUid_ = core_->NewUid();
  if (fits) core_->Label(GL_BUFFER, own_, desc_.name);
  if (!fits) core_->Discard(NameKind::Buffer, std::exchange(own_, 0));
  return fits;
}

void Buffer::MoveHome() {
  const bool kept = MakeHome();
  if (kept) glCopyNamedBufferSubData(name, own_, offset, 0, range);
  if (!kept) core_->OutOfMemory(desc_.name, "constant buffer's contents, which read 0 from now on");
  name = kept ? own_ : core_->zeroBuffer;
  uid = ownUid_;
  offset = 0;
  data = nullptr;
}

}  // namespace rhi_gl

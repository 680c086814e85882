#include "transfer.h"

#include <cstring>

namespace rhi_gl {
namespace {

// Row length and image height of the caller's memory, for one transfer.
class PixelStore {
 public:
  PixelStore(bool pack, Format format, uint32_t rowPitch, uint32_t slicePitch) : pack_(pack) {
    const FormatInfo& info = GetFormatInfo(format);
    Set(GL_UNPACK_ROW_LENGTH, GL_PACK_ROW_LENGTH, GLint(rowPitch / info.blockBytes * info.blockSize));
    Set(GL_UNPACK_IMAGE_HEIGHT, GL_PACK_IMAGE_HEIGHT, GLint(slicePitch / rowPitch * info.blockSize));
    if (info.blockSize > 1) SetBlock(info.blockSize, info.blockSize, 1, info.blockBytes);
  }
  ~PixelStore() {
    Set(GL_UNPACK_ROW_LENGTH, GL_PACK_ROW_LENGTH, 0);
    Set(GL_UNPACK_IMAGE_HEIGHT, GL_PACK_IMAGE_HEIGHT, 0);
    SetBlock(0, 0, 0, 0);
  }
  PixelStore(const PixelStore&) = delete;
  PixelStore& operator=(const PixelStore&) = delete;

 private:
  void Set(GLenum unpack, GLenum pack, GLint value) const { glPixelStorei(pack_ ? pack : unpack, value); }
  void SetBlock(GLint width, GLint height, GLint depth, GLint bytes) const {
    Set(GL_UNPACK_COMPRESSED_BLOCK_WIDTH, GL_PACK_COMPRESSED_BLOCK_WIDTH, width);
    Set(GL_UNPACK_COMPRESSED_BLOCK_HEIGHT, GL_PACK_COMPRESSED_BLOCK_HEIGHT, height);
    Set(GL_UNPACK_COMPRESSED_BLOCK_DEPTH, GL_PACK_COMPRESSED_BLOCK_DEPTH, depth);
    Set(GL_UNPACK_COMPRESSED_BLOCK_SIZE, GL_PACK_COMPRESSED_BLOCK_SIZE, bytes);
  }
  bool pack_;
};

bool Is3DCall(const Texture& t) { return t.target != GL_TEXTURE_2D; }

uint64_t TightBytes(Format format, const TexelBlock& b) {
  return uint64_t(BlockRowBytes(format, b.width)) * BlockRows(format, b.height) * b.depth;
}

// Both take GL's row settings from the pixel store; `data` may be an offset into a bound buffer.
void CallUpload(const Texture& t, const TexelBlock& b, const void* data) {
  const GlFormat& f = GetGlFormat(t.Desc().format);
  const GLint level = GLint(b.mip), x = GLint(b.x), y = GLint(b.y), z = GLint(b.z);
  const GLsizei w = GLsizei(b.width), h = GLsizei(b.height), d = GLsizei(b.depth);
  if (IsCompressed(t.Desc().format)) {
    const auto bytes = GLsizei(TightBytes(t.Desc().format, b));
    if (Is3DCall(t)) {
      glCompressedTextureSubImage3D(t.name, level, x, y, z, w, h, d, f.internal, bytes, data);
    } else {
      glCompressedTextureSubImage2D(t.name, level, x, y, w, h, f.internal, bytes, data);
    }
  } else if (Is3DCall(t)) {
    glTextureSubImage3D(t.name, level, x, y, z, w, h, d, f.layout, f.type, data);
  } else {
    glTextureSubImage2D(t.name, level, x, y, w, h, f.layout, f.type, data);
  }
}

void CallDownload(const Texture& t, const TexelBlock& b, void* out, uint64_t capacity) {
  const GlFormat& f = GetGlFormat(t.Desc().format);
  const GLint level = GLint(b.mip), x = GLint(b.x), y = GLint(b.y), z = GLint(b.z);
  const GLsizei w = GLsizei(b.width), h = GLsizei(b.height), d = GLsizei(b.depth), size = GLsizei(capacity);
  if (IsCompressed(t.Desc().format)) {
    glGetCompressedTextureSubImage(t.name, level, x, y, z, w, h, d, size, out);
  } else {
    glGetTextureSubImage(t.name, level, x, y, z, w, h, d, f.layout, f.type, size, out);
  }
}

// Copies rows between two layouts in memory.
void CopyRows(std::byte* to, uint64_t toRow, uint64_t toSlice, const std::byte* from, uint64_t fromRow,
              uint64_t fromSlice, uint64_t rowBytes, uint32_t rows, uint32_t slices) {
  for (uint32_t z = 0; z < slices; ++z)
    for (uint32_t y = 0; y < rows; ++y)
      std::memcpy(to + z * toSlice + y * toRow, from + z * fromSlice + y * fromRow, rowBytes);
}

// Whether GL can express the pitches.
bool GlUnderstands(Format format, uint32_t rowPitch, uint32_t slicePitch) {
  return rowPitch % GetFormatInfo(format).blockBytes == 0 && slicePitch % rowPitch == 0;
}

void DefaultPitches(Format format, const TexelBlock& b, uint32_t* rowPitch, uint32_t* slicePitch) {
  if (*rowPitch == 0) *rowPitch = BlockRowBytes(format, b.width);
  if (*slicePitch == 0 || b.depth == 1) *slicePitch = *rowPitch * BlockRows(format, b.height);
}

}  // namespace

uint32_t BlockRowBytes(Format format, uint32_t width) {
  const FormatInfo& f = GetFormatInfo(format);
  return (width + f.blockSize - 1) / f.blockSize * f.blockBytes;
}

uint32_t BlockRows(Format format, uint32_t height) {
  const FormatInfo& f = GetFormatInfo(format);
  return (height + f.blockSize - 1) / f.blockSize;
}

bool MakeBlock(const TextureDesc& desc, uint32_t mip, uint32_t slice, const Box* box, TexelBlock* out) {
  const backend::MipLayout m = backend::GetMipLayout(desc, mip);
  const Box all{0, 0, 0, m.width, m.height, m.depth};
  const Box& b = box ? *box : all;
  if (b.left >= b.right || b.top >= b.bottom || b.front >= b.back) return false;
  if (b.right > m.width || b.bottom > m.height || b.back > m.depth) return false;
  *out = {mip, b.left, b.top, slice + b.front, b.right - b.left, b.bottom - b.top, b.back - b.front};
  return true;
}

void Upload(const Texture& texture, const TexelBlock& b, const void* data, uint32_t rowPitch, uint32_t slicePitch) {
  const Format format = texture.Desc().format;
  DefaultPitches(format, b, &rowPitch, &slicePitch);
  std::vector<std::byte> tight;
  if (!GlUnderstands(format, rowPitch, slicePitch)) {
    const uint32_t rowBytes = BlockRowBytes(format, b.width), rows = BlockRows(format, b.height);
    tight.resize(TightBytes(format, b));
    CopyRows(tight.data(), rowBytes, uint64_t(rowBytes) * rows, static_cast<const std::byte*>(data), rowPitch,
             slicePitch, rowBytes, rows, b.depth);
    data = tight.data();
    rowPitch = rowBytes;
    slicePitch = rowBytes * rows;
  }
  const PixelStore store(false, format, rowPitch, slicePitch);
  CallUpload(texture, b, data);
}

void Download(const Texture& texture, const TexelBlock& b, void* out, uint32_t rowPitch, uint32_t slicePitch) {
  const Format format = texture.Desc().format;
  DefaultPitches(format, b, &rowPitch, &slicePitch);
  const uint32_t rowBytes = BlockRowBytes(format, b.width), rows = BlockRows(format, b.height);
  std::vector<std::byte> tight(TightBytes(format, b));
  {
    const PixelStore store(true, format, rowBytes, rowBytes * rows);
    CallDownload(texture, b, tight.data(), tight.size());
  }
  if (format == Format::D24_UNorm_S8_UInt) DepthStencilFromGl(tight.data(), tight.size() / 4);
  CopyRows(static_cast<std::byte*>(out), rowPitch, slicePitch, tight.data(), rowBytes, uint64_t(rowBytes) * rows,
           rowBytes, rows, b.depth);
}

void UploadFromBuffer(const Texture& texture, const TexelBlock& b, const BufferPlace& place) {
  const PixelStore store(false, texture.Desc().format, place.rowPitch, place.slicePitch);
  glBindBuffer(GL_PIXEL_UNPACK_BUFFER, place.buffer);
  CallUpload(texture, b, reinterpret_cast<const void*>(place.offset));
  glBindBuffer(GL_PIXEL_UNPACK_BUFFER, 0);
}

void DownloadToBuffer(const Texture& texture, const TexelBlock& b, const BufferPlace& place) {
  const PixelStore store(true, texture.Desc().format, place.rowPitch, place.slicePitch);
  glBindBuffer(GL_PIXEL_PACK_BUFFER, place.buffer);
  // The capacity is what a robust read may write beyond `offset`; the buffer's end is checked by GL itself.
  CallDownload(texture, b, reinterpret_cast<void*>(place.offset), 0x7FFFFFFF);
  glBindBuffer(GL_PIXEL_PACK_BUFFER, 0);
}

}  // namespace rhi_gl

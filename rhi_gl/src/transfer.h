// Texels between memory and textures, row 0 on top.
#pragma once

#include "resources.h"

namespace rhi_gl {

// A block of texels of one mip; z counts the slices of arrays and cubes, and the depth of a Tex3D.
struct TexelBlock {
  uint32_t mip = 0;
  uint32_t x = 0, y = 0, z = 0, width = 0, height = 0, depth = 1;
};

// The block that `box` names within a subresource, or all of it. False: it reaches beyond.
bool MakeBlock(const TextureDesc&, uint32_t mip, uint32_t slice, const Box* box, TexelBlock* out);

// Pitches of 0 mean tightly packed.
void Upload(const Texture&, const TexelBlock&, const void* data, uint32_t rowPitch, uint32_t slicePitch);
void Download(const Texture&, const TexelBlock&, void* out, uint32_t rowPitch, uint32_t slicePitch);

// The same from and to a buffer on the GPU's time line. The pitches must be whole numbers of texels or blocks.
struct BufferPlace {
  GLuint buffer;
  uint64_t offset;
  uint32_t rowPitch, slicePitch;
};
void UploadFromBuffer(const Texture&, const TexelBlock&, const BufferPlace&);
void DownloadToBuffer(const Texture&, const TexelBlock&, const BufferPlace&);

// Bytes of a tightly packed row, and the number of rows (of blocks), of a block.
uint32_t BlockRowBytes(Format, uint32_t width);
uint32_t BlockRows(Format, uint32_t height);

}  // namespace rhi_gl

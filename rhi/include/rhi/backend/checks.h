// For backends: the checks of descriptors that do not depend on the API. Each reports what is wrong, the actual value
// and what to do, and gives InvalidArg or Unsupported.
#pragma once

#include "rhi/backend/object.h"

namespace rhi::backend {

Status CheckBufferDesc(const BufferDesc&, const void* init, const Caps&, const MessageLog&);

// Also resolves mipLevels 0 to the full chain, in place.
Status CheckTextureDesc(TextureDesc*, const SubresourceData* init, const Caps&, const MessageLog&);

// Resolves defaults of a view of a texture, or of a structured buffer, and checks ranges and bind flags. `need` is the
// flag that the kind of view asks for.
Status ResolveTextureView(const TextureDesc&, const ViewDesc*, Bind need, ViewDesc* out, const MessageLog&);
Status ResolveBufferView(const BufferDesc&, const ViewDesc*, Bind need, ViewDesc* out, const MessageLog&);

// Enums in range, and the caps that the state asks for.
Status CheckBlendDesc(const BlendDesc&, const Caps&, const MessageLog&);
Status CheckDepthStencilDesc(const DepthStencilDesc&, const MessageLog&);
Status CheckRasterizerDesc(const RasterizerDesc&, const Caps&, const MessageLog&);
Status CheckSamplerDesc(const SamplerDesc&, const Caps&, const MessageLog&);

// Also that the device has swap chains at all.
Status CheckSwapChainDesc(const SwapChainDesc&, const Caps&, const MessageLog&);
TextureDesc BackBufferDesc(uint32_t width, uint32_t height, Format);

// What a shader's view of a texture shows: what is not a whole cube to be read is an array of faces.
TextureDim ShownDim(const TextureDesc&, const ViewDesc&, bool written);

// Whether a view of a texture (null: of a structured buffer) is of the kind, dimension and type of texels that a shader
// declares.
bool ShowsAs(const TextureDesc*, const ViewDesc&, const ShaderResource& declared, bool written);

uint32_t SliceCount(const TextureDesc&);  // array slices: 1 for a Tex3D
uint32_t MipSize(uint32_t size, uint32_t mip);

// Bytes of a row, and of a depth slice, of one mip when tightly packed; rows counts blocks for BC formats.
struct MipLayout {
  uint32_t width, height, depth;  // texels
  uint32_t rowBytes, rows;
  uint64_t sliceBytes;  // rowBytes * rows
};
MipLayout GetMipLayout(const TextureDesc&, uint32_t mip);

}  // namespace rhi::backend

#include "rhi/backend/checks.h"

namespace rhi::backend {
namespace {

Status Refuse(const MessageLog& log, Status status, MsgCode code, const char* object, const char* text) {
  log.Report(Severity::Error, code, object, "%s", text);
  return status;
}

Status Invalid(const MessageLog& log, const char* object, const char* text) {
  return Refuse(log, Status::InvalidArg, MsgCode::InvalidDesc, object, text);
}

bool SampleCountOk(uint32_t samples, const Caps& caps) {
  return samples >= 1 && samples <= caps.maxColorSamples && (samples & (samples - 1)) == 0;
}

Status CheckTextureExtent(const TextureDesc& d, const Caps& caps, const MessageLog& log) {
  const bool is3D = d.dim == TextureDim::Tex3D;
  const uint32_t limit = is3D ? caps.maxTexture3D : caps.maxTexture2D;
  if (d.width == 0 || d.height == 0 || d.depthOrArray == 0)
    return Invalid(log, d.name, "a texture needs width, height and depthOrArray of at least 1");
  if (d.width > limit || d.height > limit || d.depthOrArray > (is3D ? limit : caps.maxArrayLayers)) {
    log.Report(Severity::Error, MsgCode::CapMissing, d.name, "texture of %u x %u x %u exceeds this adapter's limits (%u, %u layers)",
               d.width, d.height, d.depthOrArray, limit, caps.maxArrayLayers);
    return Status::Unsupported;
  }
  if ((d.dim == TextureDim::Tex2D || d.dim == TextureDim::Tex2DMS) && d.depthOrArray != 1)
    return Invalid(log, d.name, "depthOrArray must be 1 for Tex2D and Tex2DMS; use Tex2DArray for slices");
  if (d.dim == TextureDim::TexCube && (d.depthOrArray != 6 || d.width != d.height))
    return Invalid(log, d.name, "a TexCube needs six square slices: depthOrArray 6, width equal to height");
  return Status::Ok;
}

Status CheckTextureSamples(const TextureDesc& d, const Caps& caps, const MessageLog& log) {
  if (d.dim != TextureDim::Tex2DMS)
    return d.sampleCount == 1 ? Status::Ok : Invalid(log, d.name, "sampleCount above 1 needs dim Tex2DMS");
  if (d.mipLevels != 1) return Invalid(log, d.name, "a Tex2DMS has exactly one mip level");
  if (d.sampleCount < 2) return Invalid(log, d.name, "a Tex2DMS has at least 2 samples; use Tex2D for one");
  if (SampleCountOk(d.sampleCount, caps)) return Status::Ok;
  log.Report(Severity::Error, MsgCode::CapMissing, d.name, "%u samples are not available; this adapter has up to %u, powers of two",
             d.sampleCount, caps.maxColorSamples);
  return Status::Unsupported;
}

Status CheckTextureUse(const TextureDesc& d, const SubresourceData* init, const MessageLog& log) {
  const FormatInfo& format = GetFormatInfo(d.format);
  const bool depth = format.depth;
  if (d.format == Format::Unknown || size_t(d.format) >= size_t(Format::Count) || d.format == Format::RGB32_Float)
    return Invalid(log, d.name, "a texture needs a texture format; Unknown and RGB32_Float are none");
  if ((d.bind & Bind::DepthStencil) && !depth) return Invalid(log, d.name, "Bind::DepthStencil needs a depth format");
  if ((d.bind & Bind::RenderTarget) && (depth || format.blockSize > 1))
    return Invalid(log, d.name, "Bind::RenderTarget needs a colour format that is not block-compressed");
  if (depth && d.dim == TextureDim::Tex3D) return Invalid(log, d.name, "a Tex3D cannot have a depth format");
  if ((d.bind & Bind::UnorderedAccess) && d.dim == TextureDim::Tex2DMS)
    return Invalid(log, d.name, "a Tex2DMS cannot have Bind::UnorderedAccess");
  if (d.bind & (Bind::VertexBuffer | Bind::IndexBuffer | Bind::ConstantBuffer | Bind::IndirectArgs))
    return Invalid(log, d.name, "a texture cannot have Bind flags of buffers");
  if ((d.bind & Bind::UnorderedAccess) && depth)
    return Refuse(log, Status::Unsupported, MsgCode::CapMissing, d.name, "a depth format has no unordered access");
  if ((d.bind & Bind::UnorderedAccess) && format.sRGB)
    return Refuse(log, Status::Unsupported, MsgCode::CapMissing, d.name,
                  "an _sRGB format has no unordered access; make the texture as its UNorm twin and view it as _sRGB");
  if (d.usage == Usage::Immutable && !init)
    return Invalid(log, d.name, "an Immutable texture needs its data at creation");
  if (d.usage == Usage::Immutable && d.bind != Bind::ShaderResource)
    return Invalid(log, d.name, "an Immutable texture is only read: its Bind flag is ShaderResource");
  if (d.usage == Usage::Staging && d.bind != Bind::None)
    return Invalid(log, d.name, "a Staging texture cannot be bound; set bind to None");
  if (d.usage == Usage::Dynamic)
    return Invalid(log, d.name, "Dynamic textures are not offered; use Default and UpdateSubresource, or a Staging copy");
  if (init && d.dim == TextureDim::Tex2DMS) return Invalid(log, d.name, "a multisampled texture cannot be given data");
  if (init && format.stencil)
    return Invalid(log, d.name, "a texture with stencil cannot be given data; render or clear it");
  if (d.usage == Usage::Staging && (format.stencil || d.dim == TextureDim::Tex2DMS))
    return Refuse(log, Status::Unsupported, MsgCode::CapMissing, d.name,
                  "staging textures hold neither stencil nor samples; read depth-stencil back with ReadBack");
  return Status::Ok;
}

Status CheckTextureData(const TextureDesc& d, const SubresourceData* init, const MessageLog& log) {
  for (uint32_t i = 0; init && i < d.mipLevels * SliceCount(d); ++i) {
    if (!init[i].data) return Invalid(log, d.name, "initial data must be given for every subresource");
  }
  return Status::Ok;
}

}  // namespace

TextureDim ShownDim(const TextureDesc& d, const ViewDesc& v, bool written) {
  return d.dim == TextureDim::TexCube && (written || v.sliceCount != 6) ? TextureDim::Tex2DArray : d.dim;
}

bool ShowsAs(const TextureDesc* texture, const ViewDesc& v, const ShaderResource& declared, bool written) {
  const bool wantsTexture =
      declared.kind == ShaderResourceKind::Texture || declared.kind == ShaderResourceKind::RWTexture;
  if (!texture || !wantsTexture) return !texture && !wantsTexture;
  return ShownDim(*texture, v, written) == declared.dim && GetFormatInfo(v.format).isInteger == declared.integer;
}

uint32_t SliceCount(const TextureDesc& d) { return d.dim == TextureDim::Tex3D ? 1 : d.depthOrArray; }
uint32_t MipSize(uint32_t size, uint32_t mip) { return std::max(1u, mip < 32 ? size >> mip : 0u); }

MipLayout GetMipLayout(const TextureDesc& d, uint32_t mip) {
  const FormatInfo& format = GetFormatInfo(d.format);
  MipLayout m{};
  m.width = MipSize(d.width, mip);
  m.height = MipSize(d.height, mip);
  m.depth = d.dim == TextureDim::Tex3D ? MipSize(d.depthOrArray, mip) : 1;
  m.rowBytes = (m.width + format.blockSize - 1) / format.blockSize * format.blockBytes;
  m.rows = (m.height + format.blockSize - 1) / format.blockSize;
  m.sliceBytes = uint64_t(m.rowBytes) * m.rows;
  return m;
}

Status CheckBufferDesc(const BufferDesc& d, const void* init, const Caps& caps, const MessageLog& log) {
  if (d.byteWidth == 0) return Invalid(log, d.name, "a buffer needs a byteWidth of at least 1");
  if (d.usage == Usage::Immutable && !init)
    return Invalid(log, d.name, "an Immutable buffer needs its data at creation");
  if (d.usage == Usage::Staging && d.bind != Bind::None)
    return Invalid(log, d.name, "a Staging buffer cannot be bound; set bind to None");
  if ((d.bind & Bind::ConstantBuffer) && d.bind != Bind::ConstantBuffer)
    return Invalid(log, d.name, "Bind::ConstantBuffer cannot be combined with other flags");
  if ((d.bind & Bind::ConstantBuffer) && d.byteWidth > kMaxConstantBufferBytes)
    return Invalid(log, d.name, "a constant buffer holds at most 16384 bytes");
  if (d.bind & (Bind::RenderTarget | Bind::DepthStencil))
    return Invalid(log, d.name, "a buffer cannot be a target; RenderTarget and DepthStencil are flags of textures");
  if (d.usage != Usage::Default && (d.bind & Bind::UnorderedAccess))
    return Invalid(log, d.name, "only a Default buffer can have Bind::UnorderedAccess: the others are not the GPU's to write");
  if (d.structureStride != 0 && (d.structureStride % 4 != 0 || d.byteWidth % d.structureStride != 0))
    return Invalid(log, d.name, "structureStride must be a multiple of 4 that divides byteWidth");
  const bool structured = (d.bind & Bind::ShaderResource) || (d.bind & Bind::UnorderedAccess);
  if (structured && d.structureStride == 0)
    return Invalid(log, d.name, "a buffer read or written by shaders is structured: set structureStride");
  if ((d.bind & Bind::UnorderedAccess) && !caps.compute)
    return Refuse(log, Status::Unsupported, MsgCode::CapMissing, d.name, "Bind::UnorderedAccess needs Caps::compute");
  return Status::Ok;
}

Status CheckTextureDesc(TextureDesc* d, const SubresourceData* init, const Caps& caps, const MessageLog& log) {
  if (Status s = CheckTextureUse(*d, init, log); s != Status::Ok) return s;
  if (Status s = CheckTextureExtent(*d, caps, log); s != Status::Ok) return s;
  const uint32_t full = FullMipCount(d->width, d->height, d->dim == TextureDim::Tex3D ? d->depthOrArray : 1);
  if (d->mipLevels == 0) d->mipLevels = full;
  if (d->mipLevels > full) return Invalid(log, d->name, "mipLevels exceeds the full chain");
  if (Status s = CheckTextureSamples(*d, caps, log); s != Status::Ok) return s;
  return CheckTextureData(*d, init, log);
}

Status CheckSwapChainDesc(const SwapChainDesc& d, const Caps& caps, const MessageLog& log) {
  if (!caps.swapChain)
    return Refuse(log, Status::Unsupported, MsgCode::CapMissing, "",
                  "this device has no swap chains (Caps::swapChain); make it with DeviceDesc::nativeDisplay set to the "
                  "X11 Display*, on a driver that can present");
  if (!d.nativeWindow) return Invalid(log, "", "a swap chain needs SwapChainDesc::nativeWindow, the X11 Window");
  if (d.width == 0 || d.height == 0)
    return Invalid(log, "", "a swap chain needs width and height of at least 1; Resize(0, 0) says that it is minimised");
  switch (d.format) {
    case Format::RGBA8_UNorm:
    case Format::RGBA8_UNorm_sRGB:
    case Format::BGRA8_UNorm:
    case Format::BGRA8_UNorm_sRGB:
    case Format::R10G10B10A2_UNorm:
    case Format::RGBA16_Float: return Status::Ok;
    default:
      log.Report(Severity::Error, MsgCode::CapMissing, "",
                 "%s cannot be shown; take RGBA8 or BGRA8 (also _sRGB), R10G10B10A2_UNorm or RGBA16_Float",
                 ToString(d.format));
      return Status::Unsupported;
  }
}

TextureDesc BackBufferDesc(uint32_t width, uint32_t height, Format format) {
  return {.width = width,
          .height = height,
          .format = format,
          .bind = Bind::RenderTarget | Bind::ShaderResource,
          .name = "back buffer"};
}

Status ResolveTextureView(const TextureDesc& d, const ViewDesc* in, Bind need, ViewDesc* out, const MessageLog& log) {
  ViewDesc v = in ? *in : ViewDesc{};
  const uint32_t slices = SliceCount(d);
  // A view that is written shows one mip.
  const bool oneMip = need != Bind::ShaderResource;
  if (!(d.bind & need))
    return Refuse(log, Status::InvalidArg, MsgCode::WrongBindFlag, d.name, "the texture was made without the Bind flag of this view");
  if (v.format == Format::Unknown) v.format = d.format;
  const bool twins = ToLinear(v.format) == ToLinear(d.format);
  if (!twins) return Refuse(log, Status::InvalidArg, MsgCode::FormatMismatch, d.name, "a view's format must be the texture's own or its sRGB twin");
  if (v.firstMip >= d.mipLevels || v.firstSlice >= slices)
    return Refuse(log, Status::InvalidArg, MsgCode::SubresourceOutOfRange, d.name, "the view starts beyond the last mip or slice");
  if (v.mipCount == kAllMips) v.mipCount = oneMip ? 1 : d.mipLevels - v.firstMip;
  if (v.sliceCount == kAllSlices) v.sliceCount = slices - v.firstSlice;
  if (v.mipCount == 0 || v.sliceCount == 0 || v.mipCount > d.mipLevels - v.firstMip || v.sliceCount > slices - v.firstSlice)
    return Refuse(log, Status::InvalidArg, MsgCode::SubresourceOutOfRange, d.name, "the view reaches beyond the last mip or slice, or is empty");
  if (oneMip && v.mipCount != 1) return Invalid(log, d.name, "a view of a target or a u register shows exactly one mip");
  if (need == Bind::UnorderedAccess && GetFormatInfo(v.format).sRGB)
    return Refuse(log, Status::Unsupported, MsgCode::CapMissing, d.name, "an _sRGB format has no unordered access; view it as its UNorm twin");
  *out = v;
  return Status::Ok;
}

Status ResolveBufferView(const BufferDesc& d, const ViewDesc* in, Bind need, ViewDesc* out, const MessageLog& log) {
  ViewDesc v = in ? *in : ViewDesc{};
  if (!(d.bind & need) || d.structureStride == 0)
    return Refuse(log, Status::InvalidArg, MsgCode::WrongBindFlag, d.name, "the buffer was made without the Bind flag of this view");
  const uint32_t elements = d.byteWidth / d.structureStride;
  if (v.firstElement >= elements) return Refuse(log, Status::InvalidArg, MsgCode::OutOfBounds, d.name, "the view starts beyond the last element");
  if (v.elementCount == ~0u) v.elementCount = elements - v.firstElement;
  if (v.elementCount == 0 || v.elementCount > elements - v.firstElement)
    return Refuse(log, Status::InvalidArg, MsgCode::OutOfBounds, d.name, "the view reaches beyond the last element, or is empty");
  v.mipCount = v.sliceCount = 1;
  *out = v;
  return Status::Ok;
}

}  // namespace rhi::backend

#include "rhi/backend/data_checks.h"

#include "rhi/backend/checks.h"

namespace rhi::backend {
namespace {

[[gnu::format(printf, 2, 3)]] Misuse Wrong(MsgCode code, const char* format, ...) {
  char text[512];
  va_list args;
  va_start(args, format);
  std::vsnprintf(text, sizeof text, format, args);
  va_end(args);
  return {code, text};
}

const char* NameOf(Usage usage) {
  switch (usage) {
    case Usage::Default: return "Default";
    case Usage::Immutable: return "Immutable";
    case Usage::Dynamic: return "Dynamic";
    case Usage::Staging: return "Staging";
  }
  return "of no usage";
}

bool SameFormat(Format a, Format b) { return ToLinear(a) == ToLinear(b); }

Box Whole(const MipLayout& m) { return {0, 0, 0, m.width, m.height, m.depth}; }

bool IsOrdered(const Box& b) { return b.left <= b.right && b.top <= b.bottom && b.front <= b.back; }

bool IsWithin(const Box& b, const MipLayout& m) {
  return IsOrdered(b) && b.right <= m.width && b.bottom <= m.height && b.back <= m.depth;
}

bool IsOnBlocks(const Box& b, const MipLayout& m, uint32_t block) {
  const auto edge = [block](uint32_t end, uint32_t whole) { return end % block == 0 || end == whole; };
  return b.left % block == 0 && b.top % block == 0 && edge(b.right, m.width) && edge(b.bottom, m.height);
}

Misuse CheckSubresource(const char* call, const TextureDesc& d, uint32_t subresource) {
  const uint32_t count = d.mipLevels * SliceCount(d);
  if (subresource < count) return {};
  return Wrong(MsgCode::SubresourceOutOfRange,
               "%s: subresource %u of a texture that has %u; use Subresource(mip, slice, mipLevels)", call, subresource,
               count);
}

Misuse CheckMapMode(Usage usage, MapMode mode, bool constants) {
  if (usage == Usage::Immutable)
    return Wrong(MsgCode::ImmutableWrite,
                 "Map of an Immutable resource; make it Dynamic to write it, or copy it to a Staging one to read it");
  const bool discard = mode == MapMode::WriteDiscard, append = mode == MapMode::WriteNoOverwrite;
  const bool staging = mode == MapMode::Read || mode == MapMode::Write;
  if (!(usage == Usage::Dynamic && (discard || append)) && !(usage == Usage::Staging && staging))
    return Wrong(MsgCode::MapMode,
                 "Map of a %s resource: Dynamic ones take WriteDiscard and WriteNoOverwrite, Staging ones Read and "
                 "Write, Default ones none (use UpdateSubresource or a Staging copy)",
                 NameOf(usage));
  if (append && constants)
    return Wrong(MsgCode::MapMode,
                 "Map: constant buffers take WriteDiscard only, as in Direct3D 10; use it, or UpdateConstants");
  return {};
}

Misuse CheckUpdateUsage(Usage usage) {
  if (usage == Usage::Default) return {};
  return Wrong(usage == Usage::Immutable ? MsgCode::ImmutableWrite : MsgCode::MapMode,
               "UpdateSubresource of a %s resource needs Usage::Default; Dynamic and Staging resources are mapped, "
               "Immutable ones never written",
               NameOf(usage));
}

Misuse CheckDestination(const char* call, Usage usage) {
  if (usage == Usage::Default || usage == Usage::Staging) return {};
  return Wrong(usage == Usage::Immutable ? MsgCode::ImmutableWrite : MsgCode::MapMode,
               "%s: the destination is %s; it must be of Usage::Default or Staging", call, NameOf(usage));
}

Misuse CheckTexels(const char* call, const TextureDesc& dst, const TextureDesc& src) {
  if (!SameFormat(dst.format, src.format))
    return Wrong(MsgCode::FormatMismatch,
                 "%s from %s to %s; copies convert nothing, so take one format or its sRGB twin", call,
                 ToString(src.format), ToString(dst.format));
  if (dst.sampleCount != src.sampleCount)
    return Wrong(MsgCode::FormatMismatch, "%s from %u samples to %u; use ResolveSubresource", call, src.sampleCount,
                 dst.sampleCount);
  return {};
}

MipLayout LayoutOf(const TexturePlace& p) { return GetMipLayout(p.desc, p.subresource % p.desc.mipLevels); }

}  // namespace

Misuse CheckMap(const BufferDesc& d, MapMode mode) {
  return CheckMapMode(d.usage, mode, d.bind & Bind::ConstantBuffer);
}

Misuse CheckMap(const TextureDesc& d, uint32_t subresource, MapMode mode) {
  if (Misuse m = CheckMapMode(d.usage, mode, false)) return m;
  return CheckSubresource("Map", d, subresource);
}

Misuse CheckUpdateConstants(const BufferDesc& d, uint32_t size) {
  if (d.usage != Usage::Dynamic || !(d.bind & Bind::ConstantBuffer))
    return Wrong(MsgCode::MapMode,
                 "UpdateConstants: the buffer is no Dynamic constant buffer; make it with Usage::Dynamic and "
                 "Bind::ConstantBuffer, or call UpdateSubresource");
  if (size <= d.byteWidth) return {};
  return Wrong(MsgCode::OutOfBounds, "UpdateConstants: %u bytes for a buffer of %u", size, d.byteWidth);
}

Misuse CheckUpdate(const BufferDesc& d, const Box* box) {
  if (Misuse m = CheckUpdateUsage(d.usage)) return m;
  if (!box || (box->left <= box->right && box->right <= d.byteWidth)) return {};
  return Wrong(MsgCode::OutOfBounds, "UpdateSubresource: bytes %u..%u of a buffer of %u", box->left, box->right,
               d.byteWidth);
}

Misuse CheckUpdate(const TextureDesc& d, uint32_t subresource, const Box* box, uint32_t rowPitch, uint32_t slicePitch) {
  if (Misuse m = CheckUpdateUsage(d.usage)) return m;
  if (Misuse m = CheckSubresource("UpdateSubresource", d, subresource)) return m;
  const FormatInfo& format = GetFormatInfo(d.format);
  if (format.depth || d.sampleCount > 1)
    return Wrong(MsgCode::FormatMismatch,
                 "UpdateSubresource: a depth or multisampled texture (%s, %u samples) takes no data; clear, render or "
                 "copy it",
                 ToString(d.format), d.sampleCount);
  const MipLayout m = GetMipLayout(d, subresource % d.mipLevels);
  const Box b = box ? *box : Whole(m);
  if (!IsWithin(b, m) || !IsOnBlocks(b, m, format.blockSize))
    return Wrong(
        MsgCode::OutOfBounds,
        "UpdateSubresource: the box (%u, %u, %u)..(%u, %u, %u) is not within the subresource's %u x %u x %u, or "
        "not on whole blocks of %u texels",
        b.left, b.top, b.front, b.right, b.bottom, b.back, m.width, m.height, m.depth, format.blockSize);
  TextureDesc part = d;
  part.width = b.right - b.left;
  part.height = b.bottom - b.top;
  const MipLayout rows = GetMipLayout(part, 0);
  const bool narrow = rowPitch != 0 && rowPitch < rows.rowBytes && rows.rows > 1;
  const bool shallow = slicePitch != 0 && b.back - b.front > 1 && slicePitch < rows.sliceBytes;
  if (!narrow && !shallow) return {};
  return Wrong(
      MsgCode::PitchTooSmall,
      "UpdateSubresource: rowPitch %u, slicePitch %u; a row has %u bytes and a slice %llu; give these or more, "
      "or 0 for tightly packed data",
      rowPitch, slicePitch, rows.rowBytes, static_cast<unsigned long long>(rows.sliceBytes));
}

// ------------------------------------------------------------------------------------------------------------- copies

Misuse CheckCopyKinds(Usage dst) {
  if (Misuse m = CheckDestination("a copy", dst)) return m;
  return Wrong(MsgCode::FormatMismatch, "a copy between a buffer and a texture; both must be of one kind");
}

Misuse CheckCopyAll(const BufferDesc& dst, const BufferDesc& src, bool same) {
  if (Misuse m = CheckDestination("CopyResource", dst.usage)) return m;
  if (same) return Wrong(MsgCode::OutOfBounds, "CopyResource of a resource to itself");
  if (dst.byteWidth == src.byteWidth) return {};
  return Wrong(MsgCode::FormatMismatch,
               "CopyResource from a buffer of %u bytes to one of %u; take equal sizes or CopySubresourceRegion",
               src.byteWidth, dst.byteWidth);
}

Misuse CheckCopyAll(const TextureDesc& dst, const TextureDesc& src, bool same) {
  if (Misuse m = CheckDestination("CopyResource", dst.usage)) return m;
  if (same) return Wrong(MsgCode::OutOfBounds, "CopyResource of a resource to itself");
  const bool equal = dst.width == src.width && dst.height == src.height && dst.depthOrArray == src.depthOrArray &&
                     dst.mipLevels == src.mipLevels && (dst.dim == TextureDim::Tex3D) == (src.dim == TextureDim::Tex3D);
  if (equal) return CheckTexels("CopyResource", dst, src);
  return Wrong(MsgCode::FormatMismatch,
               "CopyResource from %u x %u x %u with %u mips to %u x %u x %u with %u; take equal sizes or "
               "CopySubresourceRegion",
               src.width, src.height, src.depthOrArray, src.mipLevels, dst.width, dst.height, dst.depthOrArray,
               dst.mipLevels);
}

Misuse CheckCopy(const BufferDesc& dst, uint32_t x, const BufferDesc& src, const Box* box, bool same) {
  if (Misuse m = CheckDestination("CopySubresourceRegion", dst.usage)) return m;
  const uint32_t left = box ? box->left : 0, right = box ? box->right : src.byteWidth;
  if (left > right || right > src.byteWidth || uint64_t(x) + (right - left) > dst.byteWidth)
    return Wrong(MsgCode::OutOfBounds, "CopySubresourceRegion of bytes %u..%u of %u to byte %u of %u", left, right,
                 src.byteWidth, x, dst.byteWidth);
  if (!same || left >= uint64_t(x) + (right - left) || x >= right) return {};
  return Wrong(
      MsgCode::OutOfBounds,
      "CopySubresourceRegion of bytes %u..%u to byte %u of the same buffer: the ranges overlap; copy by way of "
      "another buffer",
      left, right, x);
}

Misuse CheckCopy(const TexturePlace& dst, const TexturePlace& src, const Box* box, bool same) {
  constexpr const char* kCall = "CopySubresourceRegion";
  if (Misuse m = CheckDestination(kCall, dst.desc.usage)) return m;
  if (Misuse m = CheckTexels(kCall, dst.desc, src.desc)) return m;
  if (Misuse m = CheckSubresource(kCall, dst.desc, dst.subresource)) return m;
  if (Misuse m = CheckSubresource(kCall, src.desc, src.subresource)) return m;
  if (same && dst.subresource == src.subresource)
    return Wrong(MsgCode::OutOfBounds, "%s within subresource %u; copy by way of another texture", kCall,
                 dst.subresource);
  const MipLayout s = LayoutOf(src), d = LayoutOf(dst);
  const Box b = box ? *box : Whole(s);
  const uint32_t block = GetFormatInfo(src.desc.format).blockSize;
  const bool inSource = IsWithin(b, s) && IsOnBlocks(b, s, block);
  const bool inDest = inSource && uint64_t(dst.x) + b.right - b.left <= d.width &&
                      uint64_t(dst.y) + b.bottom - b.top <= d.height && uint64_t(dst.z) + b.back - b.front <= d.depth;
  if (inDest) {
    const Box to{dst.x, dst.y, dst.z, dst.x + b.right - b.left, dst.y + b.bottom - b.top, dst.z + b.back - b.front};
    if (IsOnBlocks(to, d, block)) return {};
  }
  return Wrong(
      MsgCode::OutOfBounds,
      "%s of (%u, %u, %u)..(%u, %u, %u) of %u x %u x %u to (%u, %u, %u) of %u x %u x %u; keep within both, and "
      "on whole blocks of %u texels",
      kCall, b.left, b.top, b.front, b.right, b.bottom, b.back, s.width, s.height, s.depth, dst.x, dst.y, dst.z,
      d.width, d.height, d.depth, block);
}

Misuse CheckResolve(const TexturePlace& dst, const TexturePlace& src, Format format) {
  constexpr const char* kCall = "ResolveSubresource";
  const TextureDesc &a = dst.desc, &b = src.desc;
  if (Misuse m = CheckDestination(kCall, a.usage)) return m;
  if (Misuse m = CheckSubresource(kCall, a, dst.subresource)) return m;
  if (Misuse m = CheckSubresource(kCall, b, src.subresource)) return m;
  if (b.sampleCount < 2 || a.sampleCount != 1 || a.usage != Usage::Default)
    return Wrong(MsgCode::FormatMismatch,
                 "%s from %u samples to %u; take a multisampled source and a Default destination of one sample "
                 "(CopyResource copies equal counts)",
                 kCall, b.sampleCount, a.sampleCount);
  if (format == Format::Unknown) format = b.format;
  if (a.format != format || b.format != format || GetFormatInfo(format).depth)
    return Wrong(MsgCode::FormatMismatch, "%s from %s to %s as %s; take one colour format for all three", kCall,
                 ToString(b.format), ToString(a.format), ToString(format));
  const MipLayout to = LayoutOf(dst);
  if (to.width == b.width && to.height == b.height) return {};
  return Wrong(MsgCode::FormatMismatch, "%s from %u x %u to %u x %u; take equal sizes", kCall, b.width, b.height,
               to.width, to.height);
}

Misuse CheckGenerateMips(const TextureDesc& d, Format view, FormatSupport support) {
  if (!(d.bind & Bind::RenderTarget) || !(d.bind & Bind::ShaderResource))
    return Wrong(MsgCode::WrongBindFlag,
                 "GenerateMips: the texture was made with flags 0x%X; it needs Bind::RenderTarget and ShaderResource",
                 uint32_t(d.bind));
  if (view != d.format)
    return Wrong(MsgCode::FormatMismatch,
                 "GenerateMips of a view as %s of a texture of %s; take a view of the texture's own format",
                 ToString(view), ToString(d.format));
  if (d.sampleCount > 1)
    return Wrong(MsgCode::FormatMismatch, "GenerateMips of %u samples, which have one mip", d.sampleCount);
  if (support & FormatSupport::MipAutogen) return {};
  return Wrong(MsgCode::CapMissing, "GenerateMips: %s has no FormatSupport::MipAutogen on this adapter",
               ToString(d.format));
}

// ----------------------------------------------------------------------------------------------------------- read-back

Misuse CheckReadBack(const BufferDesc* d, uint32_t offset, uint32_t size, const void* out) {
  if (!d || !out) return Wrong(MsgCode::InvalidDesc, "ReadBack: the buffer, or the memory for the result, is null");
  if (uint64_t(offset) + size <= d->byteWidth) return {};
  return Wrong(MsgCode::OutOfBounds, "ReadBack of %u bytes at %u of a buffer of %u", size, offset, d->byteWidth);
}

Misuse CheckReadBack(const TextureDesc* d, uint32_t subresource, const void* out, size_t capacity, uint32_t rowPitch) {
  if (!d || !out) return Wrong(MsgCode::InvalidDesc, "ReadBack: the texture, or the memory for the result, is null");
  if (Misuse m = CheckSubresource("ReadBack", *d, subresource)) return m;
  if (d->sampleCount > 1)
    return Wrong(MsgCode::FormatMismatch, "ReadBack of a texture of %u samples; resolve it first", d->sampleCount);
  const MipLayout m = GetMipLayout(*d, subresource % d->mipLevels);
  const uint64_t pitch = rowPitch ? rowPitch : m.rowBytes, rows = uint64_t(m.rows) * m.depth;
  if (pitch >= m.rowBytes && (rows - 1) * pitch + m.rowBytes <= capacity) return {};
  return Wrong(MsgCode::OutOfBounds, "ReadBack of %llu rows of %u bytes into %zu bytes with a rowPitch of %llu",
               static_cast<unsigned long long>(rows), m.rowBytes, capacity, static_cast<unsigned long long>(pitch));
}

// ---------------------------------------------------------------------------------------------------------- dispatches

Misuse CheckGroups(uint32_t x, uint32_t y, uint32_t z) {
  constexpr uint32_t kMax = 65535;  // D3D11_CS_DISPATCH_MAX_THREAD_GROUPS_PER_DIMENSION
  if (x <= kMax && y <= kMax && z <= kMax) return {};
  return Wrong(MsgCode::OutOfBounds, "Dispatch of %u x %u x %u groups; each number is at most %u", x, y, z, kMax);
}

uint32_t ResultSize(QueryType type) {
  switch (type) {
    case QueryType::Event:
    case QueryType::OcclusionPredicate: return sizeof(bool);
    case QueryType::Occlusion:
    case QueryType::Timestamp: return sizeof(uint64_t);
    case QueryType::TimestampDisjoint: return sizeof(TimestampDisjoint);
    case QueryType::PipelineStatistics: return sizeof(PipelineStatistics);
  }
  return 0;
}

}  // namespace rhi::backend

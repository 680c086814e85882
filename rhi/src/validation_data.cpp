// Map and Unmap, UpdateConstants, UpdateSubresource.
#include "validation_context.h"

namespace rhi::validation {

using backend::GetMipLayout;
using backend::MipLayout;

bool Context::Subresources(const char* call, const IResource& resource, uint32_t subresource) {
  const ObjectRecord* record = v_.objects.Find(&resource);
  uint32_t count = 1;
  if (record && record->kind == ObjectKind::Texture) {
    const TextureDesc& d = static_cast<const ITexture&>(resource).Desc();
    count = d.mipLevels * backend::SliceCount(d);
  }
  if (subresource < count) return true;
  return v_.Error(MsgCode::SubresourceOutOfRange, &resource,
                  "%s: subresource %u of a resource that has %u; use Subresource(mip, slice, mipLevels); the call is "
                  "ignored",
                  call, subresource, count);
}

bool Context::NotMapped(const char* call, const IResource* resource) {
  if (v_.objects.mappedCount == 0 || !resource) return true;
  const ObjectRecord* record = v_.objects.Find(resource);
  if (!record || !record->AnyMapped()) return true;
  return v_.Error(MsgCode::MappedInUse, resource, "%s uses a %s that is mapped; call Unmap first; the call is ignored",
                  call, ToString(record->kind));
}

// ------------------------------------------------------------------------------------------------------- Map and Unmap

bool Context::CheckMapMode(const IResource& resource, MapMode mode) {
  const Usage usage = resource.GetUsage();
  if (usage == Usage::Immutable)
    return v_.Error(
        MsgCode::ImmutableWrite, &resource,
        "Map of an Immutable resource; make it Dynamic to write it, or copy it to a Staging one to read it");
  const bool discard = mode == MapMode::WriteDiscard, append = mode == MapMode::WriteNoOverwrite;
  const bool staging = mode == MapMode::Read || mode == MapMode::Write;
  if (!(usage == Usage::Dynamic && (discard || append)) && !(usage == Usage::Staging && staging))
    return v_.Error(
        MsgCode::MapMode, &resource,
        "Map: Dynamic resources take WriteDiscard and WriteNoOverwrite, Staging ones Read and Write, Default "
        "ones none (use UpdateSubresource or a Staging copy)");
  const bool constants =
      IsBuffer(&resource) && (static_cast<const IBuffer&>(resource).Desc().bind & Bind::ConstantBuffer);
  if (append && constants)
    return v_.Error(MsgCode::MapMode, &resource,
                    "Map: constant buffers take WriteDiscard only, as in Direct3D 10; use it, or UpdateConstants");
  return true;
}

bool Context::CheckMap(IResource* resource, uint32_t subresource, MapMode mode, const Mapped* out) {
  if (!NotNull("Map", resource, "the resource") || !NotNull("Map", out, "the out parameter")) return false;
  if (!v_.Owns("Map", resource) || !CheckMapMode(*resource, mode)) return false;
  if (!Subresources("Map", *resource, subresource)) return false;
  const ObjectRecord* record = v_.objects.Find(resource);
  if (subresource >= record->mapped.size() || !record->mapped[subresource]) return true;
  return v_.Error(MsgCode::MapTwice, resource, "Map: subresource %u is mapped already; call Unmap first", subresource);
}

Status Context::Map(IResource* resource, uint32_t subresource, MapMode mode, Mapped* out) {
  if (out) *out = {};
  if (!CheckMap(resource, subresource, mode, out)) return Status::InvalidArg;
  const Status s = inner_.Map(resource, subresource, mode, out);
  if (s != Status::Ok) return s;
  ObjectRecord* record = v_.objects.Find(resource);
  if (subresource >= record->mapped.size()) record->mapped.resize(subresource + 1);
  record->mapped[subresource] = true;
  ++v_.objects.mappedCount;
  return s;
}

void Context::Unmap(IResource* resource, uint32_t subresource) {
  if (!NotNull("Unmap", resource, "the resource") || !v_.Owns("Unmap", resource)) return;
  ObjectRecord* record = v_.objects.Find(resource);
  if (subresource >= record->mapped.size() || !record->mapped[subresource]) {
    v_.Error(MsgCode::MapMode, resource, "Unmap: subresource %u is not mapped; call it once for each Map that gave Ok",
             subresource);
    return;
  }
  record->mapped[subresource] = false;
  --v_.objects.mappedCount;
  inner_.Unmap(resource, subresource);
}

// ------------------------------------------------------------------------------------------------------------- updates

bool Context::CheckUpdateConstants(IBuffer* buffer, const void* data, uint32_t size) {
  constexpr const char* kCall = "UpdateConstants";
  if (!buffer)
    return v_.Error(MsgCode::NothingBound, {nullptr, kCall}, "%s: the buffer is null; the call is ignored", kCall);
  if (!v_.Owns(kCall, buffer) || (size > 0 && !NotNull(kCall, data, "data"))) return false;
  const BufferDesc& d = buffer->Desc();
  if (d.usage != Usage::Dynamic || !(d.bind & Bind::ConstantBuffer))
    return v_.Error(
        MsgCode::MapMode, buffer,
        "%s: the buffer is no Dynamic constant buffer; make it with Usage::Dynamic and Bind::ConstantBuffer, "
        "or call UpdateSubresource; the call is ignored",
        kCall);
  if (size > d.byteWidth)
    return v_.Error(MsgCode::OutOfBounds, buffer, "%s: %u bytes for a buffer of %u; the call is ignored", kCall, size,
                    d.byteWidth);
  return NotMapped(kCall, buffer);
}

void Context::UpdateConstants(IBuffer* buffer, const void* data, uint32_t size) {
  if (CheckUpdateConstants(buffer, data, size)) inner_.UpdateConstants(buffer, data, size);
}

bool Context::CheckTextureUpdate(const ITexture& texture, uint32_t subresource, const Box* box, uint32_t rowPitch,
                                 uint32_t slicePitch) {
  constexpr const char* kCall = "UpdateSubresource";
  const TextureDesc& d = texture.Desc();
  if (!Subresources(kCall, texture, subresource)) return false;
  if (GetFormatInfo(d.format).depth || d.sampleCount > 1)
    return v_.Error(MsgCode::FormatMismatch, &texture,
                    "%s: a depth or multisampled texture (%s, %u samples) takes no data; clear, render or copy it",
                    kCall, rhi::ToString(d.format), d.sampleCount);
  const MipLayout m = GetMipLayout(d, subresource % d.mipLevels);
  const Box b = box ? *box : Box{0, 0, 0, m.width, m.height, m.depth};
  if (b.left > b.right || b.top > b.bottom || b.front > b.back || b.right > m.width || b.bottom > m.height ||
      b.back > m.depth)
    return v_.Error(MsgCode::OutOfBounds, &texture,
                    "%s: the box (%u, %u, %u)..(%u, %u, %u) is not within the subresource's %u x %u x %u; the call is "
                    "ignored",
                    kCall, b.left, b.top, b.front, b.right, b.bottom, b.back, m.width, m.height, m.depth);
  TextureDesc part = d;
  part.width = b.right - b.left;
  part.height = b.bottom - b.top;
  const MipLayout rows = GetMipLayout(part, 0);
  const bool narrow = rowPitch != 0 && rowPitch < rows.rowBytes && rows.rows > 1;
  const bool shallow = slicePitch != 0 && b.back - b.front > 1 && slicePitch < rows.sliceBytes;
  if (!narrow && !shallow) return true;
  return v_.Error(MsgCode::PitchTooSmall, &texture,
                  "%s: rowPitch %u, slicePitch %u; a row has %u bytes and a slice %llu; give these or more, or 0 for "
                  "tightly packed data; the call is ignored",
                  kCall, rowPitch, slicePitch, rows.rowBytes, static_cast<unsigned long long>(rows.sliceBytes));
}

void Context::UpdateSubresource(IResource* dst, uint32_t subresource, const Box* box, const void* data,
                                uint32_t rowPitch, uint32_t slicePitch) {
  constexpr const char* kCall = "UpdateSubresource";
  if (!NotNull(kCall, dst, "the resource") || !NotNull(kCall, data, "data") || !v_.Owns(kCall, dst)) return;
  if (const Usage usage = dst->GetUsage(); usage != Usage::Default) {
    v_.Error(
        usage == Usage::Immutable ? MsgCode::ImmutableWrite : MsgCode::MapMode, dst,
        "%s needs Usage::Default; Dynamic and Staging resources are mapped, Immutable ones never written; the call "
        "is ignored",
        kCall);
    return;
  }
  if (!IsBuffer(dst)) {
    if (!CheckTextureUpdate(static_cast<const ITexture&>(*dst), subresource, box, rowPitch, slicePitch)) return;
  } else if (const uint32_t size = static_cast<const IBuffer*>(dst)->Desc().byteWidth;
             box && (box->left > box->right || box->right > size)) {
    v_.Error(MsgCode::OutOfBounds, dst, "%s: bytes %u..%u of a buffer of %u; the call is ignored", kCall, box->left,
             box->right, size);
    return;
  }
  inner_.UpdateSubresource(dst, subresource, box, data, rowPitch, slicePitch);
}

}  // namespace rhi::validation

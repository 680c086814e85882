// Map and Unmap, UpdateConstants, UpdateSubresource.
#include "validation_context.h"

namespace rhi::validation {

bool Context::NotMapped(const char* call, const IResource* resource) {
  if (v_.objects.mappedCount == 0 || !resource) return true;
  const ObjectRecord* record = v_.objects.Find(resource);
  if (!record || !record->AnyMapped()) return true;
  return v_.Error(MsgCode::MappedInUse, resource, "%s uses a %s that is mapped; call Unmap first; the call is ignored",
                  call, ToString(record->kind));
}

// ------------------------------------------------------------------------------------------------------- Map and Unmap

bool Context::CheckMap(IResource* resource, uint32_t subresource, MapMode mode, const Mapped* out) {
  if (!NotNull("Map", resource, "the resource") || !NotNull("Map", out, "the out parameter")) return false;
  if (!v_.Owns("Map", resource)) return false;
  const Misuse misuse = IsBuffer(resource)
                            ? backend::CheckMap(static_cast<IBuffer*>(resource)->Desc(), mode)
                            : backend::CheckMap(static_cast<ITexture*>(resource)->Desc(), subresource, mode);
  if (Is(misuse, resource)) return false;
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
  if (Is(backend::CheckUpdateConstants(buffer->Desc(), size), buffer)) return false;
  return NotMapped(kCall, buffer);
}

void Context::UpdateConstants(IBuffer* buffer, const void* data, uint32_t size) {
  if (CheckUpdateConstants(buffer, data, size)) inner_.UpdateConstants(buffer, data, size);
}

void Context::UpdateSubresource(IResource* dst, uint32_t subresource, const Box* box, const void* data,
                                uint32_t rowPitch, uint32_t slicePitch) {
  constexpr const char* kCall = "UpdateSubresource";
  if (!NotNull(kCall, dst, "the resource") || !NotNull(kCall, data, "data") || !v_.Owns(kCall, dst)) return;
  const Misuse misuse =
      IsBuffer(dst) ? backend::CheckUpdate(static_cast<IBuffer*>(dst)->Desc(), box)
                    : backend::CheckUpdate(static_cast<ITexture*>(dst)->Desc(), subresource, box, rowPitch, slicePitch);
  if (!Is(misuse, dst)) inner_.UpdateSubresource(dst, subresource, box, data, rowPitch, slicePitch);
}

}  // namespace rhi::validation

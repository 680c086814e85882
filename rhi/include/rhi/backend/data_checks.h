// For backends and the validation: what is wrong with a call on data. Every backend asks here before it does anything,
// so that one misuse has one code everywhere. Nothing here looks at what is mapped; that is the caller's.
#pragma once

#include <string>

#include "rhi/backend/object.h"

namespace rhi::backend {

// Converts to true where something is wrong; the text says what, the actual values, and what to do.
struct Misuse {
  MsgCode code = MsgCode::None;
  std::string text;
  explicit operator bool() const { return code != MsgCode::None; }
  // True, and said: the call is to be ignored.
  bool Refuses(const MessageLog& log, const char* object) const {
    if (code != MsgCode::None) log.Report(Severity::Error, code, object, "%s; the call is ignored", text.c_str());
    return code != MsgCode::None;
  }
};

// Dynamic: WriteDiscard, and NoOverwrite but for constants. Staging: Read and Write.
Misuse CheckMap(const BufferDesc&, MapMode);
Misuse CheckMap(const TextureDesc&, uint32_t subresource, MapMode);

Misuse CheckUpdateConstants(const BufferDesc&, uint32_t size);
// UpdateSubresource. Empty boxes are allowed: there is nothing to do.
Misuse CheckUpdate(const BufferDesc&, const Box*);
Misuse CheckUpdate(const TextureDesc&, uint32_t subresource, const Box*, uint32_t rowPitch, uint32_t slicePitch);

// CopyResource. `same`: source and destination are one.
Misuse CheckCopyAll(const BufferDesc& dst, const BufferDesc& src, bool same);
Misuse CheckCopyAll(const TextureDesc& dst, const TextureDesc& src, bool same);
Misuse CheckCopyKinds(Usage dst);  // between a buffer and a texture, which is always wrong

// CopySubresourceRegion. Empty boxes are allowed.
Misuse CheckCopy(const BufferDesc& dst, uint32_t x, const BufferDesc& src, const Box*, bool same);
struct TexturePlace {
  const TextureDesc& desc;
  uint32_t subresource, x = 0, y = 0, z = 0;
};
Misuse CheckCopy(const TexturePlace& dst, const TexturePlace& src, const Box*, bool same);

// Bytes of what GetData gives for a query of this type; 0 for none.
uint32_t ResultSize(QueryType);

// `format` Unknown: the source's.
Misuse CheckResolve(const TexturePlace& dst, const TexturePlace& src, Format);

// `view` is the view's format, `support` that of the texture's.
Misuse CheckGenerateMips(const TextureDesc&, Format view, FormatSupport support);

// ReadBack; a null resource is a misuse, too. rowPitch 0: tightly packed.
Misuse CheckReadBack(const BufferDesc*, uint32_t offset, uint32_t size, const void* out);
Misuse CheckReadBack(const TextureDesc*, uint32_t subresource, const void* out, size_t capacity, uint32_t rowPitch);

Misuse CheckGroups(uint32_t x, uint32_t y, uint32_t z);  // of a dispatch

}  // namespace rhi::backend

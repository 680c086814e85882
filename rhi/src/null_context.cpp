// Clears and queries of the null device.
#include "null_context.h"

#include "rhi/backend/data_checks.h"
#include <bit>
#include <cmath>
#include <cstring>

namespace rhi::null_backend {
namespace {

uint32_t UNorm(float v, uint32_t bits) {
  const double most = (1u << bits) - 1;                                // a float has no room for 24 bits and a half
  return v > 0 ? uint32_t(std::min(double(v), 1.0) * most + 0.5) : 0;  // NaN is 0
}

float EncodeSRGB(float v) { return v <= 0.0031308f ? v * 12.92f : 1.055f * std::pow(v, 1 / 2.4f) - 0.055f; }

// To the nearest half; numbers too small for a normal half become 0.
uint16_t Half(float v) {
  const uint32_t bits = std::bit_cast<uint32_t>(v), sign = bits >> 16 & 0x8000u, magnitude = bits & 0x7FFFFFFFu;
  if (magnitude > 0x7F800000u) return uint16_t(sign | 0x7E00u);   // NaN
  if (magnitude >= 0x47800000u) return uint16_t(sign | 0x7C00u);  // 65536 and more
  if (magnitude < 0x38800000u) return uint16_t(sign);
  const uint32_t even = (magnitude >> 13 & 1u) + 0xFFFu;
  return uint16_t(sign | (magnitude - 0x38000000u + even) >> 13);
}

template <class T>
uint32_t Put(std::byte* out, const T& value) {
  std::memcpy(out, &value, sizeof value);
  return sizeof value;
}

template <class T, class F>
uint32_t PutAll(std::byte* out, uint32_t count, const F& component) {
  uint32_t size = 0;
  for (uint32_t i = 0; i < count; ++i) size += Put(out + size, T(component(i)));
  return size;
}

uint32_t EncodeUNorm8(const FormatInfo& f, bool bgra, const float rgba[4], std::byte* out) {
  return PutAll<uint8_t>(out, f.components, [&](uint32_t i) {
    const uint32_t source = bgra && i < 3 ? 2 - i : i;
    return UNorm(f.sRGB && i < 3 ? EncodeSRGB(rgba[source]) : rgba[source], 8);
  });
}

struct DepthStencilBytes {
  std::byte texel[16];
  uint32_t size, stencilAt, depthSize;
};

DepthStencilBytes EncodeDepthStencil(Format format, float depth, uint8_t stencil) {
  DepthStencilBytes d{};
  const float values[4] = {depth, float(stencil), 0, 0};
  d.size = EncodeTexel(format, values, d.texel);
  d.stencilAt = format == Format::D24_UNorm_S8_UInt ? 3 : 4;
  d.depthSize = GetFormatInfo(format).stencil ? d.stencilAt : d.size;
  return d;
}

// Calls write(texel) for each texel that the view shows.
template <class F>
void ForEachTexel(const IView& view, const F& write) {
  Texture* t = AsTexture(view.Resource());
  const ViewDesc& v = view.Desc();
  const uint32_t texelBytes = GetFormatInfo(v.format).blockBytes;
  for (uint32_t slice = v.firstSlice; slice < v.firstSlice + v.sliceCount; ++slice) {
    std::vector<std::byte>& texels = t->texels[Subresource(v.firstMip, slice, t->Desc().mipLevels)];
    for (size_t at = 0; at + texelBytes <= texels.size(); at += texelBytes) write(texels.data() + at);
  }
}

}  // namespace

uint32_t EncodeTexel(Format format, const float rgba[4], std::byte out[16]) {
  const FormatInfo& f = GetFormatInfo(format);
  switch (format) {
    case Format::R8_UNorm:
    case Format::RG8_UNorm:
    case Format::RGBA8_UNorm:
    case Format::RGBA8_UNorm_sRGB: return EncodeUNorm8(f, false, rgba, out);
    case Format::BGRA8_UNorm:
    case Format::BGRA8_UNorm_sRGB: return EncodeUNorm8(f, true, rgba, out);
    case Format::R16_Float:
    case Format::RG16_Float:
    case Format::RGBA16_Float: return PutAll<uint16_t>(out, f.components, [&](uint32_t i) { return Half(rgba[i]); });
    case Format::R32_Float:
    case Format::RG32_Float:
    case Format::RGBA32_Float: return PutAll<float>(out, f.components, [&](uint32_t i) { return rgba[i]; });
    case Format::R16_UInt: return Put(out, uint16_t(std::max(0.0f, rgba[0])));
    case Format::R32_UInt: return Put(out, uint32_t(std::max(0.0f, rgba[0])));
    case Format::RGBA8_UInt: return PutAll<uint8_t>(out, 4, [&](uint32_t i) { return std::max(0.0f, rgba[i]); });
    case Format::R10G10B10A2_UNorm:
      return Put(out,
                 UNorm(rgba[0], 10) | UNorm(rgba[1], 10) << 10 | UNorm(rgba[2], 10) << 20 | UNorm(rgba[3], 2) << 30);
    case Format::D16_UNorm: return Put(out, uint16_t(UNorm(rgba[0], 16)));
    case Format::D24_UNorm_S8_UInt: return Put(out, UNorm(rgba[0], 24) | uint32_t(rgba[1]) << 24);
    case Format::D32_Float: return Put(out, rgba[0]);
    case Format::D32_Float_S8_UInt: return Put(out, rgba[0]) + Put(out + 4, uint32_t(rgba[1]));
    default: return 0;
  }
}

void Context::ClearRenderTargetView(IRenderTargetView* view, const float rgba[4]) {
  if (!view) {
    Refuse(MsgCode::InvalidDesc, "", "ClearRenderTargetView: the view is null; the call is ignored");
    return;
  }
  std::byte texel[16];
  const uint32_t size = EncodeTexel(view->Desc().format, rgba, texel);
  ForEachTexel(*view, [&](std::byte* at) { std::memcpy(at, texel, size); });
}

void Context::ClearDepthStencilView(IDepthStencilView* view, bool clearDepth, float depth, bool clearStencil,
                                    uint8_t stencil) {
  if (!view) {
    Refuse(MsgCode::InvalidDesc, "", "ClearDepthStencilView: the view is null; the call is ignored");
    return;
  }
  const DepthStencilBytes d = EncodeDepthStencil(view->Desc().format, depth, stencil);
  ForEachTexel(*view, [&](std::byte* at) {
    if (clearDepth) std::memcpy(at, d.texel, d.depthSize);
    if (clearStencil && d.size > d.stencilAt)
      std::memcpy(at + d.stencilAt, d.texel + d.stencilAt, d.size - d.stencilAt);
  });
}

// ------------------------------------------------------------------------------------------------------------- queries

void Context::Begin(IQuery* query) {
  auto* q = static_cast<Query*>(query);
  const bool range = q && q->Type() != QueryType::Event && q->Type() != QueryType::Timestamp;
  if (range && !q->active)
    q->active = true;
  else
    Refuse(MsgCode::QueryOrder, "", "Begin of no query, of an Event or Timestamp, or of one that is begun already");
}

void Context::End(IQuery* query) {
  auto* q = static_cast<Query*>(query);
  const bool range = q && q->Type() != QueryType::Event && q->Type() != QueryType::Timestamp;
  if (!q || (range && !q->active)) {
    Refuse(MsgCode::QueryOrder, "", "End of a query without Begin; it is ignored");
    return;
  }
  q->active = false;
  q->ended = true;
}

Status Context::GetData(IQuery* query, void* data, uint32_t size, bool) {
  const auto* q = static_cast<const Query*>(query);
  if (!q || !q->ended || q->active) return Refuse(MsgCode::QueryOrder, "", "GetData needs a query that was ended");
  if (!data) return Status::Ok;
  if (size != backend::ResultSize(q->Type())) return Refuse(MsgCode::OutOfBounds, "", "GetData: the result has another size");
  std::memset(data, 0, size);
  if (q->Type() == QueryType::Event) *static_cast<bool*>(data) = true;
  if (q->Type() == QueryType::TimestampDisjoint) static_cast<TimestampDisjoint*>(data)->frequency = 1'000'000'000;
  return Status::Ok;
}

}  // namespace rhi::null_backend

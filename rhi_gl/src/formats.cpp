#include "formats.h"

#include <algorithm>
#include <bit>
#include <cstring>
#include <vector>

namespace rhi_gl {
namespace {

using rhi::Format;
using rhi::FormatSupport;

constexpr GLboolean kNorm = GL_TRUE, kRaw = GL_FALSE;

constexpr auto kGlFormats = std::to_array<GlFormat>({
    {},
    {GL_R8, GL_RED, GL_UNSIGNED_BYTE, 1, GL_UNSIGNED_BYTE, kNorm},
    {GL_RG8, GL_RG, GL_UNSIGNED_BYTE, 2, GL_UNSIGNED_BYTE, kNorm},
    {GL_RGBA8, GL_RGBA, GL_UNSIGNED_BYTE, 4, GL_UNSIGNED_BYTE, kNorm},
    {GL_SRGB8_ALPHA8, GL_RGBA, GL_UNSIGNED_BYTE, 0, 0, kRaw},
    {GL_RGBA8, GL_BGRA, GL_UNSIGNED_BYTE, GL_BGRA, GL_UNSIGNED_BYTE, kNorm},
    {GL_SRGB8_ALPHA8, GL_BGRA, GL_UNSIGNED_BYTE, 0, 0, kRaw},
    {GL_R16F, GL_RED, GL_HALF_FLOAT, 1, GL_HALF_FLOAT, kRaw},
    {GL_RG16F, GL_RG, GL_HALF_FLOAT, 2, GL_HALF_FLOAT, kRaw},
    {GL_RGBA16F, GL_RGBA, GL_HALF_FLOAT, 4, GL_HALF_FLOAT, kRaw},
    {GL_R32F, GL_RED, GL_FLOAT, 1, GL_FLOAT, kRaw},
    {GL_RG32F, GL_RG, GL_FLOAT, 2, GL_FLOAT, kRaw},
    {0, 0, 0, 3, GL_FLOAT, kRaw},
    {GL_RGBA32F, GL_RGBA, GL_FLOAT, 4, GL_FLOAT, kRaw},
    {GL_R16UI, GL_RED_INTEGER, GL_UNSIGNED_SHORT, 1, GL_UNSIGNED_SHORT, kRaw},
    {GL_R32UI, GL_RED_INTEGER, GL_UNSIGNED_INT, 1, GL_UNSIGNED_INT, kRaw},
    {GL_RGBA8UI, GL_RGBA_INTEGER, GL_UNSIGNED_BYTE, 4, GL_UNSIGNED_BYTE, kRaw},
    {GL_RGB10_A2, GL_RGBA, GL_UNSIGNED_INT_2_10_10_10_REV, 4, GL_UNSIGNED_INT_2_10_10_10_REV, kNorm},
    {GL_R11F_G11F_B10F, GL_RGB, GL_UNSIGNED_INT_10F_11F_11F_REV, 0, 0, kRaw},
    {GL_DEPTH_COMPONENT16, GL_DEPTH_COMPONENT, GL_UNSIGNED_SHORT, 0, 0, kRaw},
    {GL_DEPTH24_STENCIL8, GL_DEPTH_STENCIL, GL_UNSIGNED_INT_24_8, 0, 0, kRaw},
    {GL_DEPTH_COMPONENT32F, GL_DEPTH_COMPONENT, GL_FLOAT, 0, 0, kRaw},
    {GL_DEPTH32F_STENCIL8, GL_DEPTH_STENCIL, GL_FLOAT_32_UNSIGNED_INT_24_8_REV, 0, 0, kRaw},
    {GL_COMPRESSED_RGBA_S3TC_DXT1_EXT, 0, 0, 0, 0, kRaw},
    {GL_COMPRESSED_RGBA_S3TC_DXT5_EXT, 0, 0, 0, 0, kRaw},
    {GL_COMPRESSED_RG_RGTC2, 0, 0, 0, 0, kRaw},
    {GL_COMPRESSED_RGBA_BPTC_UNORM, 0, 0, 0, 0, kRaw},
});
static_assert(kGlFormats.size() == size_t(Format::Count));

bool Query(GLenum internal, GLenum what) {
  GLint value = GL_NONE;
  glGetInternalformativ(GL_TEXTURE_2D, internal, what, 1, &value);
  return value != GL_NONE && value != GL_FALSE;
}

FormatSupport BufferSupport(Format format) {
  FormatSupport s = FormatSupport::None;
  if (kGlFormats[size_t(format)].attribSize != 0) s = s | FormatSupport::Buffer | FormatSupport::VertexBuffer;
  if (format == Format::R16_UInt || format == Format::R32_UInt)
    s = s | FormatSupport::Buffer | FormatSupport::IndexBuffer;
  return s;
}

FormatSupport TargetSupport(Format format, GLenum internal) {
  const rhi::FormatInfo& info = rhi::GetFormatInfo(format);
  FormatSupport s = FormatSupport::None;
  if (!Query(internal, GL_FRAMEBUFFER_RENDERABLE)) return s;
  if (SupportsSamples(format, 2) || SupportsSamples(format, 4)) s = s | FormatSupport::Multisample;
  if (info.depth) return s | FormatSupport::DepthStencil;
  s = s | FormatSupport::RenderTarget;
  if (info.isInteger) return s;
  if (Query(internal, GL_FRAMEBUFFER_BLEND)) s = s | FormatSupport::Blendable;
  if (s & FormatSupport::Multisample) s = s | FormatSupport::Resolve;
  return s | FormatSupport::MipAutogen;
}

bool IsImageFormat(Format format) {
  switch (format) {
    case Format::R8_UNorm:
    case Format::RG8_UNorm:
    case Format::RGBA8_UNorm:
    case Format::R16_Float:
    case Format::RG16_Float:
    case Format::RGBA16_Float:
    case Format::R32_Float:
    case Format::RG32_Float:
    case Format::RGBA32_Float:
    case Format::R16_UInt:
    case Format::R32_UInt:
    case Format::RGBA8_UInt:
    case Format::R10G10B10A2_UNorm:
    case Format::R11G11B10_Float: return true;
    default: return false;
  }
}

template <class F>
void ForEachWord(void* texels, uint64_t count, F change) {
  auto* bytes = static_cast<std::byte*>(texels);
  for (uint64_t i = 0; i < count; ++i, bytes += 4) {
    uint32_t word;
    std::memcpy(&word, bytes, 4);
    word = change(word);
    std::memcpy(bytes, &word, 4);
  }
}

}  // namespace

const GlFormat& GetGlFormat(Format format) {
  return kGlFormats[size_t(format) < kGlFormats.size() ? size_t(format) : 0];
}

bool SupportsSamples(Format format, uint32_t samples) {
  const GlFormat& gl = GetGlFormat(format);
  if (gl.internal == 0 || IsCompressed(format)) return false;
  if (samples == 1) return true;
  GLint count = 0;
  glGetInternalformativ(GL_TEXTURE_2D_MULTISAMPLE, gl.internal, GL_NUM_SAMPLE_COUNTS, 1, &count);
  std::vector<GLint> counts(size_t(std::max(count, 0)));
  if (!counts.empty())
    glGetInternalformativ(GL_TEXTURE_2D_MULTISAMPLE, gl.internal, GL_SAMPLES, GLsizei(counts.size()), counts.data());
  return std::find(counts.begin(), counts.end(), GLint(samples)) != counts.end();
}

FormatSupport QueryFormatSupport(Format format, const rhi::Caps& caps) {
  FormatSupport s = BufferSupport(format);
  const GLenum internal = GetGlFormat(format).internal;
  const bool compressed = IsCompressed(format);
  if (internal == 0 || (compressed && !caps.textureCompressionBC) || !Query(internal, GL_INTERNALFORMAT_SUPPORTED))
    return s;
  s = s | FormatSupport::Texture2D | FormatSupport::Sample;
  if (!rhi::GetFormatInfo(format).isInteger) s = s | FormatSupport::SampleLinear;
  if (compressed) return s;
  if (IsImageFormat(format)) s = s | FormatSupport::UnorderedAccess;
  return s | TargetSupport(format, internal);
}

void DepthStencilFromGl(void* texels, uint64_t count) {
  ForEachWord(texels, count, [](uint32_t w) { return std::rotr(w, 8); });
}

GLenum TargetOf(rhi::TextureDim dim) {
  switch (dim) {
    case rhi::TextureDim::Tex2D: return GL_TEXTURE_2D;
    case rhi::TextureDim::Tex2DArray: return GL_TEXTURE_2D_ARRAY;
    case rhi::TextureDim::TexCube: return GL_TEXTURE_CUBE_MAP;
    case rhi::TextureDim::Tex3D: return GL_TEXTURE_3D;
    case rhi::TextureDim::Tex2DMS: return GL_TEXTURE_2D_MULTISAMPLE;
  }
  return GL_TEXTURE_2D;
}

}  // namespace rhi_gl

// rhi::Format in GL's terms.
#pragma once

#include <epoxy/gl.h>

#include "rhi/types.h"

namespace rhi_gl {

struct GlFormat {
  GLenum internal = 0;  // sized internal format; BGRA lies in memory as RGBA and is swizzled on its way
  GLenum layout = 0;    // format and type of texels in the caller's memory
  GLenum type = 0;
  GLint attribSize = 0;  // components of a vertex element, or GL_BGRA; 0: not a vertex format
  GLenum attribType = 0;
  GLboolean normalized = GL_FALSE;
};

const GlFormat& GetGlFormat(rhi::Format);

inline bool IsCompressed(rhi::Format f) { return rhi::GetFormatInfo(f).blockSize > 1; }

// What the current context can do with a format.
rhi::FormatSupport QueryFormatSupport(rhi::Format, const rhi::Caps&);
bool SupportsSamples(rhi::Format, uint32_t samples);

// GL puts the depth of D24_UNorm_S8_UInt in the upper bits, Direct3D in the lower ones.
void DepthStencilFromGl(void* texels, uint64_t count);

GLenum TargetOf(rhi::TextureDim);  // the texture target of a dimension

}  // namespace rhi_gl

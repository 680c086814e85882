#include "caps.h"

#include <algorithm>
#include <cstdio>
#include <cstring>

#include "core.h"

namespace rhi_gl {
namespace {

uint32_t GetUint(GLenum what) {
  GLint value = 0;
  glGetIntegerv(what, &value);
  return uint32_t(std::max(value, 0));
}

const char* GetText(GLenum what) {
  const GLubyte* text = glGetString(what);
  return text ? reinterpret_cast<const char*>(text) : "unknown";
}

bool IsSoftware(const char* renderer) {
  constexpr const char* kNames[] = {"llvmpipe", "softpipe", "swrast", "Software Rasterizer", "SwiftShader"};
  return std::any_of(std::begin(kNames), std::end(kNames),
                     [&](const char* name) { return std::strstr(renderer, name) != nullptr; });
}

uint32_t MaxSamples() {
  uint32_t samples = std::min(GetUint(GL_MAX_COLOR_TEXTURE_SAMPLES), GetUint(GL_MAX_DEPTH_TEXTURE_SAMPLES));
  return std::max(1u, samples);
}

// Everything that GL 4.5 core promises is simply true.
void SetCoreCaps(Caps* caps) {
  caps->geometryShader = caps->layeredRendering = caps->alphaToCoverage = caps->independentBlend = true;
  caps->dualSourceBlend = caps->wireframe = caps->depthClipDisable = caps->instanceStepRate = true;
  caps->customBorderColor = caps->timestamp = caps->occlusionPrecise = caps->drawIndirect = caps->compute = true;
  caps->debugMarkers = caps->bresenhamLines = true;
  caps->timestampPeriodNs = 1;
}

void SetExtensionCaps(Caps* caps) {
  const auto has = [](const char* name) { return epoxy_has_gl_extension(name); };
  caps->depthBiasClamp = epoxy_gl_version() >= 46 || has("GL_ARB_polygon_offset_clamp");
  caps->pipelineStatistics = epoxy_gl_version() >= 46 || has("GL_ARB_pipeline_statistics_query");
  caps->samplerAnisotropy =
      epoxy_gl_version() >= 46 || has("GL_ARB_texture_filter_anisotropic") || has("GL_EXT_texture_filter_anisotropic");
  caps->textureCompressionBC = has("GL_EXT_texture_compression_s3tc");  // BC5 and BC7 are core
}

void SetLimits(Caps* caps) {
  caps->maxTexture2D = GetUint(GL_MAX_TEXTURE_SIZE);
  caps->maxTexture3D = GetUint(GL_MAX_3D_TEXTURE_SIZE);
  caps->maxArrayLayers = GetUint(GL_MAX_ARRAY_TEXTURE_LAYERS);
  caps->maxColorSamples = std::min(MaxSamples(), kMaxSamples);
  caps->maxGSOutputVertices = GetUint(GL_MAX_GEOMETRY_OUTPUT_VERTICES);
  caps->maxGSOutputComponents = GetUint(GL_MAX_GEOMETRY_TOTAL_OUTPUT_COMPONENTS);
  caps->constantBufferAlignment = std::max(16u, GetUint(GL_UNIFORM_BUFFER_OFFSET_ALIGNMENT));
}

}  // namespace

Caps QueryCaps() {
  Caps caps;
  caps.backend = Backend::OpenGL;
  std::snprintf(caps.adapter.data(), caps.adapter.size(), "%s", GetText(GL_RENDERER));
  std::snprintf(caps.driver.data(), caps.driver.size(), "%s, OpenGL %s", GetText(GL_VENDOR), GetText(GL_VERSION));
  caps.software = IsSoftware(caps.adapter.data());
  const int version = epoxy_gl_version();
  caps.apiMajor = uint32_t(version / 10);
  caps.apiMinor = uint32_t(version % 10);
  if (version < 45) return caps;
  SetCoreCaps(&caps);
  SetExtensionCaps(&caps);
  SetLimits(&caps);
  return caps;
}

Limits QueryLimits() {
  return {.uniformAlignment = std::max(16u, GetUint(GL_UNIFORM_BUFFER_OFFSET_ALIGNMENT)),
          .storageAlignment = std::max(4u, GetUint(GL_SHADER_STORAGE_BUFFER_OFFSET_ALIGNMENT)),
          .maxAttribOffset = GetUint(GL_MAX_VERTEX_ATTRIB_RELATIVE_OFFSET),
          .maxDebugGroups = GetUint(GL_MAX_DEBUG_GROUP_STACK_DEPTH),
          .maxDebugMessage = GetUint(GL_MAX_DEBUG_MESSAGE_LENGTH),
          .maxLabel = GetUint(GL_MAX_LABEL_LENGTH)};
}

}  // namespace rhi_gl

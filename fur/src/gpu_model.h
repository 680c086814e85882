// A model on the GPU, for one look.
#pragma once

#include <vector>

#include "fur/model.h"
#include "fur/renderer.h"
#include "rhi/rhi.h"
#include "triangle_order.h"

namespace fur {

// Mips of technique shells, in levels: a trilinear filter takes the longer side of a pixel's footprint and reads two texels
// a side; these are nearer to the box over the pixel, with no more flicker (docs/measured.md). fur_shade.hlsli has the
// volume's too.
inline constexpr float kSurfaceMipBias = -1, kVolumeMipBias = -1;

struct GpuGeometry {  // of one primitive
  rhi::Ref<rhi::IBuffer> vertices, indices, finIndices;  // finIndices: presets.h; null for technique shells
  uint32_t indexCount = 0, finIndexCount = 0;
  std::vector<Bounds> pieces;  // of what hangs together, in the primitive's axes; technique shells, of bare skin
};

struct GpuFurMesh {  // of one furred primitive, for technique shells (fur/fur_mesh.h); null elsewhere
  rhi::Ref<rhi::IBuffer> vertices, indices, edges;
  rhi::Ref<rhi::IShaderResourceView> verticesView, edgesView, indicesView;  // structured: FurVertex; uint4; uint
  uint32_t indexCount = 0, edgeCount = 0, baldTriangles = 0, baldEdges = 0;
  std::vector<uint32_t> cpuIndices;  // these two where triangles are sorted only
  TriangleOrder order;
};

struct GpuMaterial {
  // Never null. Technique shells has the length map in baseColor's alpha, 1 without one.
  rhi::Ref<rhi::IShaderResourceView> baseColor, normal, specular;
  rhi::Ref<rhi::IShaderResourceView> lengthMap;                    // technique seed, of furred materials
  rhi::Ref<rhi::IShaderResourceView> furVolume;                    // null on bald materials
  rhi::Ref<rhi::IShaderResourceView> furTint;                      // null but for `tinted`
  rhi::Ref<rhi::IShaderResourceView> shellVolume, shellTint;       // what shells read of both: min(N, N0) slices
  rhi::Ref<rhi::IShaderResourceView> opacityMap, finMap, spots;    // null where the preset has none (presets.h)
  rhi::Ref<rhi::ISamplerState> surfaceSampler;
  rhi::Ref<rhi::IBuffer> constants;  // MaterialConstants
  uint32_t shells = 0;               // 0: bald
  double length = 0;                 // of the fur, in the primitive's units, wet as it is
  bool betweenSlices = false;        // a shell may lie between two slices of shellVolume
  bool doubleSided = false;
  FurParams groom;                // for how it leans (fur/groom.h), with the settings' comb and wind_length resolved
  bool groomed = false;           // shaded by the variants GROOM
  bool tinted = false;            // shaded by the variants TINT
  bool sways = false;             // placed by the variants SWAY
  bool wet = false;               // the skin too
};

struct GpuPart {
  uint32_t primitive = 0, material = 0;
  glm::dmat4 transform{1};
  bool mirrored = false;  // the transform turns the winding around
  // Dynamic, of an entry for each triangle in the order of drawing (shell_sorted.hlsl), or three indices; null where
  // triangles are not sorted.
  rhi::Ref<rhi::IBuffer> order, sortedIndices;
  rhi::Ref<rhi::IShaderResourceView> orderView;
};

struct GpuModel {
  std::vector<GpuGeometry> geometry;
  std::vector<GpuFurMesh> furMeshes;  // one for each primitive; empty for technique seed
  Bounds bounds;                      // without fur
  std::vector<GpuMaterial> materials;
  std::vector<GpuPart> parts;
  int32_t firstFur = -1;  // first furred material, or -1
};

Result<GpuModel> UploadModel(rhi::IDevice&, const Model&, const RenderSettings&);

}  // namespace fur

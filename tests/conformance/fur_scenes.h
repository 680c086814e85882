// What the cases of fur draw: models, cameras, and pictures of both backends side by side.
#pragma once

#include <string>
#include <vector>

#include "conformance.h"
#include "fur/renderer.h"

namespace conformance {

// Small, but thousands of a picture's pixels are fur.
inline constexpr uint32_t kFurWidth = 160, kFurHeight = 120;

struct FurShot {
  fur::RenderSettings settings{.width = kFurWidth, .height = kFurHeight};
  fur::Camera camera;
  std::vector<glm::dmat4> placements;
  std::vector<glm::dvec3> offsets;  // of inertia, one for each placement, or none
  fur::Motion Motion() const { return {.offsets = offsets}; }
};

const fur::Model& Animal();  // the built-in one
// One animal that fills the picture.
FurShot CloseShot(const fur::Model&, const fur::RenderSettings& = {.width = kFurWidth, .height = kFurHeight});

// A model of AssetsFolder() by its file, read once; null where it is not there. A file that cannot be read fails the
// case.
const fur::Model* AssetModel(const std::string& file);
// "a-b c" -> "a_b_c": names of cases have letters, digits and _.
std::string CaseWord(std::string);

Image PictureOf(const fur::Image&);
Image PictureOf(const fur::FloatImage&);

// The frame as 8 bits, and told to the recorder, so that GL's is compared with Vulkan's.
fur::Image Draw(rhi_test::Gpu&, const fur::Model&, const FurShot&);
fur::FloatImage DrawFloats(rhi_test::Gpu&, const fur::Model&, const FurShot&);

// Whether fins or shells come out of a geometry shader. Cases of one backend: skip where there is none.
bool NeedsGeometryShader(const fur::RenderSettings&);

// Fails unless Vulkan and GL draw the same picture, of more than 100 colours; skips the case, naming the cap, where a
// driver lacks what the settings need. `picture`: Vulkan's.
void ExpectAlike(rhi_test::Gpu& vulkan, rhi_test::Gpu& gl, const fur::Model&, const FurShot&,
                 fur::Image* picture = nullptr);
// And, where the drivers' pictures have to be equal, from as many fragments. Costs a frame more on each.
void ExpectAlikeAndCounted(rhi_test::Gpu& vulkan, rhi_test::Gpu& gl, const fur::Model&, const FurShot&);

}  // namespace conformance

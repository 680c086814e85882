#include "frames.h"

#include <algorithm>
#include <cmath>

namespace fur::test {

Frame Render(rhi::IDevice& device, const Model& model, const RenderSettings& settings, const Camera& camera,
             const std::vector<glm::dmat4>& placements) {
  Frame frame;
  frame.image = {"empty", settings.width, settings.height, {}};
  frame.image.pixels.resize(size_t{4} * settings.width * settings.height);
  Result<std::unique_ptr<Renderer>> renderer = MakeRenderer(device, model, settings);
  if (!renderer) {
    ADD_FAILURE() << renderer.error().message;
    return frame;
  }
  (*renderer)->Draw(camera, placements);
  if (Result<Done> done = (*renderer)->Finish(); !done) ADD_FAILURE() << done.error().message;
  if (Result<Image> image = (*renderer)->ReadImage())
    frame.image = std::move(*image);
  else
    ADD_FAILURE() << image.error().message;
  if (Result<FrameCounts> counts = (*renderer)->Count(camera, placements))
    frame.counts = *counts;
  else
    ADD_FAILURE() << counts.error().message;
  return frame;
}

Image Draw(rhi::IDevice& device, const Model& model, const RenderSettings& settings, const Camera& camera,
           const std::vector<glm::dmat4>& placements, const Motion& motion) {
  Result<std::unique_ptr<Renderer>> renderer = MakeRenderer(device, model, settings);
  if (!renderer) {
    ADD_FAILURE() << renderer.error().message;
    return {};
  }
  (*renderer)->Draw(camera, placements, motion);
  Result<Image> image = (*renderer)->ReadImage();
  if (!image) ADD_FAILURE() << image.error().message;
  return image ? std::move(*image) : Image{};
}

FloatImage Pixels(rhi::IDevice& device, const Model& model, const RenderSettings& settings, const Camera& camera,
                  const std::vector<glm::dmat4>& placements) {
  Result<std::unique_ptr<Renderer>> renderer = MakeRenderer(device, model, settings);
  if (!renderer) {
    ADD_FAILURE() << renderer.error().message;
    return {};
  }
  (*renderer)->Draw(camera, placements);
  Result<FloatImage> image = (*renderer)->ReadPixels();
  if (!image) ADD_FAILURE() << image.error().message;
  return image ? std::move(*image) : FloatImage{};
}

Rgb PixelAt(const Image& image, uint32_t x, uint32_t y) {
  const uint8_t* p = &image.pixels[(size_t{y} * image.width + x) * 4];
  return {p[0], p[1], p[2]};
}

Rgb Center(const Image& image) { return PixelAt(image, image.width / 2, image.height / 2); }

uint64_t DifferingPixels(const Image& a, const Image& b) {
  EXPECT_EQ(a.pixels.size(), b.pixels.size());
  if (a.pixels.size() != b.pixels.size()) return a.pixels.size();
  uint64_t differing = 0;
  for (size_t i = 0; i < a.pixels.size(); i += 4)
    differing += !std::equal(&a.pixels[i], &a.pixels[i] + 4, &b.pixels[i]);
  return differing;
}

size_t Colors(const Image& image) {
  std::vector<Rgb> colors;
  for (uint32_t y = 0; y < image.height; ++y)
    for (uint32_t x = 0; x < image.width; ++x) colors.push_back(PixelAt(image, x, y));
  std::sort(colors.begin(), colors.end());
  return size_t(std::unique(colors.begin(), colors.end()) - colors.begin());
}

void ExpectColor(const Rgb& got, const glm::dvec3& expected, double tolerance, const std::string& what) {
  for (size_t c = 0; c < 3; ++c) EXPECT_NEAR(got[c], 255 * expected[int(c)], tolerance) << what << ", channel " << c;
}

bool AllFinite(const FloatImage& image) {
  for (const glm::vec4& p : image.pixels)
    if (!std::isfinite(p.r + p.g + p.b + p.a)) return false;
  return !image.pixels.empty();
}

}  // namespace fur::test

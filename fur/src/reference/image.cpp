// The reference picture: rays spread evenly over each pixel, tiles on several threads.
#include <algorithm>
#include <atomic>
#include <cmath>
#include <mutex>
#include <thread>

#include "integrate.h"
#include "pixel_samples.h"

namespace fur {
namespace {

using reference::Culler;
using reference::FurScene;
using reference::Integrator;
using reference::PixelSamples;
using reference::Radiance;
using reference::Ray;

constexpr uint32_t kTile = 16;

// Rays of a picture's points; x and y in pixels from the top left corner.
class Lens {
 public:
  Lens(const Camera& c, uint32_t width, uint32_t height)
      : camera_(c), width_(width), height_(height), pixel_(2 * std::tan(glm::radians(c.fovY) / 2) / height) {
    forward_ = glm::normalize(c.target - c.eye);
    right_ = glm::normalize(glm::cross(forward_, c.up));
    up_ = glm::cross(right_, forward_);
  }
  Ray Through(double x, double y) const {
    Ray ray;
    ray.origin = camera_.eye;
    const glm::dvec3 way =
        forward_ + right_ * ((x - width_ * 0.5) * pixel_) + up_ * ((height_ * 0.5 - y) * pixel_);
    const double stretch = glm::length(way);
    ray.SetDirection(way / stretch);
    ray.tMin = camera_.zNear * stretch;  // the planes are at distances along the view
    ray.tMax = camera_.zFar * stretch;
    return ray;
  }

 private:
  Camera camera_;
  uint32_t width_, height_;
  double pixel_;
  glm::dvec3 forward_, right_, up_;
};

struct Crop {
  uint32_t x, y, width, height;
};

Result<Crop> CropOf(const ReferenceSettings& s) {
  Crop c{s.cropX, s.cropY, s.cropWidth, s.cropHeight};
  if (s.width == 0 || s.height == 0 || s.samplesPerPixel == 0)
    return Error{ErrorCode::Usage, "a reference needs a size and samples"};
  const Error outside{ErrorCode::Usage, "the crop is not within the picture"};
  if (c.x >= s.width || c.y >= s.height) return outside;
  if (c.width == 0) c.width = s.width - c.x;
  if (c.height == 0) c.height = s.height - c.y;
  if (c.width > s.width - c.x || c.height > s.height - c.y) return outside;
  return c;
}

class Picture {
 public:
  Picture(const FurScene& scene, const Culler& culler, const Camera& camera, const ReferenceSettings& s, Crop crop)
      : scene_(scene), culler_(culler), settings_(s), crop_(crop), lens_(camera, s.width, s.height) {
    const size_t pixels = size_t(crop.width) * crop.height;
    image_.color = {crop.width, crop.height, std::vector<glm::vec4>(pixels)};
    image_.furOpacity.resize(pixels);
    image_.skin.resize(pixels);
    tilesX_ = (crop.width + kTile - 1) / kTile;
    tiles_ = tilesX_ * ((crop.height + kTile - 1) / kTile);
  }

  ReferenceImage Render() {
    const uint32_t cores = std::max(1u, std::thread::hardware_concurrency());
    const uint32_t count = std::min(settings_.threads ? settings_.threads : cores, tiles_);
    std::vector<std::thread> threads;
    for (uint32_t i = 1; i < count; ++i) threads.emplace_back([this] { Work(); });
    Work();
    for (std::thread& t : threads) t.join();
    return std::move(image_);
  }

 private:
  // Of one thread.
  struct Worker {
    Integrator integrator;
    PixelSamples samples;
  };

  void Work() {
    Worker worker{Integrator(scene_, culler_, settings_.tolerance), PixelSamples(settings_.samplesPerPixel)};
    for (uint32_t tile = next_++; tile < tiles_; tile = next_++) {
      RenderTile(&worker, tile % tilesX_ * kTile, tile / tilesX_ * kTile);
      if (!settings_.progress) continue;
      const std::lock_guard<std::mutex> lock(mutex_);
      settings_.progress(double(++done_) / tiles_);
    }
  }

  void RenderTile(Worker* worker, uint32_t left, uint32_t top) {
    for (uint32_t y = top; y < std::min(top + kTile, crop_.height); ++y)
      for (uint32_t x = left; x < std::min(left + kTile, crop_.width); ++x) RenderPixel(worker, x, y);
  }

  void RenderPixel(Worker* worker, uint32_t x, uint32_t y) {
    const uint32_t px = crop_.x + x, py = crop_.y + y;
    const size_t index = size_t(y) * crop_.width + x;
    glm::dvec4 sum(0);
    double fur = 0;
    for (const glm::dvec2& at : worker->samples.Of(settings_.seed, px, py)) {
      const Radiance r = worker->integrator.Trace(lens_.Through(px + at.x, py + at.y), settings_.background);
      sum += glm::dvec4(r.color, r.skin ? 1 : r.furOpacity);
      fur += r.furOpacity;
    }
    const double samples = worker->samples.Count();
    image_.color.pixels[index] = glm::vec4(sum / samples);
    image_.furOpacity[index] = float(fur / samples);
    reference::Candidates center;
    culler_.Gather(lens_.Through(px + 0.5, py + 0.5), &center);
    image_.skin[index] = center.skin.Found();
  }

  const FurScene& scene_;
  const Culler& culler_;
  const ReferenceSettings& settings_;
  Crop crop_;
  Lens lens_;
  uint32_t tilesX_ = 1, tiles_ = 1;
  ReferenceImage image_;
  std::atomic<uint32_t> next_ = 0;
  std::mutex mutex_;
  uint32_t done_ = 0;  // guarded by mutex_
};

}  // namespace

Plane MaskOf(const ReferenceImage& image) { return {image.color.width, image.color.height, image.furOpacity}; }

Plane BandOf(const ReferenceImage& image) {
  Plane band = MaskOf(image);
  for (size_t i = 0; i < band.values.size(); ++i)
    if (image.skin[i]) band.values[i] = 0;
  return band;
}

Result<ReferenceImage> RenderReference(const Model& model, const Camera& camera, std::span<const glm::dmat4> placements,
                                       const ReferenceSettings& settings) {
  if (Result<Done> ok = CheckModel(model); !ok) return ok.error();
  const Result<Crop> crop = CropOf(settings);
  if (!crop) return crop.error();
  const FurScene scene(model, placements, settings);
  const Result<std::unique_ptr<Culler>> culler = reference::MakeEmbreeCuller(scene);
  if (!culler) return culler.error();
  return Picture(scene, **culler, camera, settings, *crop).Render();
}

}  // namespace fur

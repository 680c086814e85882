#include "bench_reference.h"

#include <algorithm>
#include <cmath>

#include "scene_flags.h"

namespace app {
namespace {

using fur::Error;
using fur::ErrorCode;
using fur::Result;

constexpr uint32_t kShownWidth = 320;

fur::FloatImage Cropped(const fur::FloatImage& whole, const BenchCrop& c) {
  fur::FloatImage part{c.width, c.height, {}};
  part.pixels.reserve(size_t(c.width) * c.height);
  for (uint32_t y = 0; y < c.height; ++y) {
    const auto row = whole.pixels.begin() + std::ptrdiff_t(size_t(c.y + y) * whole.width + c.x);
    part.pixels.insert(part.pixels.end(), row, row + c.width);
  }
  return part;
}

fur::FloatImage FromBytes(const fur::Image& image) {
  fur::FloatImage floats{image.width, image.height, std::vector<glm::vec4>(size_t(image.width) * image.height)};
  for (size_t i = 0; i < image.pixels.size(); ++i) floats.pixels[i / 4][int(i % 4)] = float(image.pixels[i]) / 255.0f;
  return floats;
}

void ClampColor(fur::FloatImage* image) {
  for (glm::vec4& p : image->pixels)
    for (int c = 0; c < 3; ++c)
      if (std::isfinite(p[c])) p[c] = std::clamp(p[c], 0.0f, 1.0f);  // what is not finite stays an error
}

// Look seed has raw values that are shown as they are.
fur::Picture AsPicture(fur::FloatImage image, fur::Look look, bool hasAlpha) {
  if (look == fur::Look::Seed) ClampColor(&image);
  return {std::move(image), look == fur::Look::Seed, hasAlpha};
}

// As it is stored in 8 bits.
fur::Picture Rounded(const fur::Picture& picture) {
  fur::FloatImage image = picture.image;
  if (!picture.encoded) fur::EncodeSrgb(&image);
  const std::vector<uint8_t> bytes = fur::ToBytes(image);
  for (size_t i = 0; i < image.pixels.size(); ++i)
    for (size_t c = 0; c < 3; ++c) image.pixels[i][int(c)] = float(bytes[i * 4 + c]) / 255.0f;
  return {std::move(image), true, picture.hasAlpha};
}

fur::ReferenceImage Mean(const fur::ReferenceImage& a, const fur::ReferenceImage& b) {
  fur::ReferenceImage mean = a;
  for (size_t i = 0; i < mean.furOpacity.size(); ++i) {
    mean.color.pixels[i] = (a.color.pixels[i] + b.color.pixels[i]) * 0.5f;
    mean.furOpacity[i] = (a.furOpacity[i] + b.furOpacity[i]) * 0.5f;
  }
  return mean;
}

}  // namespace

BenchCrop CropOf(const fur::BenchScene& scene, const BenchOptions& o) {
  const auto part = [](double share, uint32_t side) { return uint32_t(std::lround(share * side)); };
  BenchCrop c{part(scene.crop[0], o.width), part(scene.crop[1], o.height), part(scene.crop[2], o.width),
              part(scene.crop[3], o.height)};
  c.width = std::clamp(c.width, 1u, o.width - c.x);
  c.height = std::clamp(c.height, 1u, o.height - c.y);
  return c;
}

Result<BenchFrame> ReadFrame(fur::Renderer& renderer, const fur::RenderSettings& settings, const BenchCrop& crop) {
  Result<fur::FloatImage> floats = renderer.ReadPixels();
  if (floats) {
    const bool hasAlpha = settings.technique == fur::Technique::Shells;
    return BenchFrame{AsPicture(Cropped(*floats, crop), settings.look, hasAlpha), false};
  }
  if (floats.error().code != ErrorCode::Usage) return floats.error();
  const Result<fur::Image> bytes = renderer.ReadImage();
  if (!bytes) return bytes.error();
  return BenchFrame{{Cropped(FromBytes(*bytes), crop), true, false}, true};
}

bool BenchTruth::IsFor(const fur::RenderSettings& s) const {
  return s.look == report_.look && s.semantics == report_.semantics;
}

Result<BenchTruth> BenchTruth::Make(const fur::Model& model, const std::vector<SceneView>& views,
                                    const fur::RenderSettings& render, const BenchCrop& crop, const BenchOptions& o,
                                    const std::function<void(double)>& progress) {
  BenchTruth truth;
  truth.report_.look = render.look;
  truth.report_.semantics = render.semantics;
  fur::ReferenceSettings s = ReferenceOf(render);
  s.cropX = crop.x, s.cropY = crop.y, s.cropWidth = crop.width, s.cropHeight = crop.height;
  s.samplesPerPixel = std::max(1u, o.samples / 2);
  double done = 0;
  const double parts = 2 * double(views.size());
  for (const SceneView& view : views) {
    std::array<fur::ReferenceImage, 2> halves;
    for (s.seed = 0; s.seed < 2; ++s.seed) {
      s.progress = [&](double share) { progress((done + share) / parts); };
      Result<CachedReference> half = ObtainReference(o.cache, model, view, s);
      if (!half) return half.error();
      truth.report_.seconds += half->seconds;
      halves[s.seed] = std::move(half->image);
      done += 1;
    }
    const fur::ReferenceImage mean = Mean(halves[0], halves[1]);
    Angle angle;
    angle.floats = AsPicture(mean.color, render.look, true);
    angle.bytes = Rounded(angle.floats);
    angle.regions.mask = fur::MaskOf(mean);
    angle.regions.band = fur::BandOf(mean);
    const Result<fur::Comparison> c = fur::ComparePictures(
        AsPicture(halves[0].color, render.look, true), AsPicture(halves[1].color, render.look, true), angle.regions);
    if (!c) return c.error();
    truth.report_.halvesFlip += c->flip.maskMean.value_or(0) / double(views.size());
    truth.report_.halvesRmse += c->maskRmse.value_or(0) / double(views.size());
    if (truth.angles_.empty()) truth.report_.maskPixels = c->maskPixels;
    truth.angles_.push_back(std::move(angle));
  }
  if (o.pictures) truth.report_.picture = Thumbnail(ShownBytes(truth.angles_[0].floats), {}, crop.width, crop.height);
  return truth;
}

Result<fur::Comparison> BenchTruth::Compare(size_t angle, const BenchFrame& frame) const {
  const Angle& a = angles_[angle];
  return fur::ComparePictures(frame.isBytes ? a.bytes : a.floats, frame.picture, a.regions);
}

std::vector<uint8_t> ShownBytes(fur::Picture picture) {
  if (!picture.encoded) fur::EncodeSrgb(&picture.image);
  return fur::ToBytes(picture.image);
}

// Whole pixels are averaged: a wide picture becomes a whole fraction of itself.
BenchPicture Thumbnail(const std::vector<uint8_t>& frame, const std::vector<uint8_t>& heat, uint32_t width,
                       uint32_t height) {
  const uint32_t by = (width + kShownWidth - 1) / kShownWidth;
  BenchPicture small{std::max(1u, width / by), std::max(1u, height / by), {}, {}};
  const auto shrink = [&](const std::vector<uint8_t>& from, std::vector<uint8_t>* to) {
    if (from.empty()) return;
    const uint32_t rows = std::min(by, height), columns = std::min(by, width);
    for (uint32_t y = 0; y < small.height; ++y)
      for (uint32_t x = 0; x < small.width; ++x)
        for (uint32_t c = 0; c < 4; ++c) {
          uint32_t sum = 0;
          for (uint32_t j = 0; j < rows; ++j)
            for (uint32_t i = 0; i < columns; ++i) sum += from[((size_t(y) * by + j) * width + x * by + i) * 4 + c];
          to->push_back(uint8_t(sum / (rows * columns)));
        }
  };
  shrink(frame, &small.frame);
  shrink(heat, &small.heat);
  return small;
}

}  // namespace app

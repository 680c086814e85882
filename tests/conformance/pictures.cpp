#include "pictures.h"

#include <algorithm>

#include "../../app/src/html_text.h"
#include "fur/compare.h"
#include "fur/image_io.h"

namespace conformance {
namespace {

constexpr int kDifferenceGain = 16;
constexpr uint32_t kMostPixels = 1u << 20;  // larger pictures are left out of the page

uint32_t SizeOf(Component c) {
  if (c == Component::U16 || c == Component::F16) return 2;
  return c == Component::U32 || c == Component::F32 ? 4 : 1;
}

float HalfToFloat(uint16_t h) {
  const int exponent = h >> 10 & 31, mantissa = h & 1023;
  const float value = exponent ? std::ldexp(float(1024 + mantissa), exponent - 25) : std::ldexp(float(mantissa), -24);
  return h & 0x8000 ? -value : value;
}

uint8_t ToByte(float v) { return uint8_t(std::min(std::max(v, 0.f), 1.f) * 255 + 0.5f); }

uint8_t ByteAt(const uint8_t* texel, Component component) {
  if (component == Component::F32) {
    float v;
    std::memcpy(&v, texel, sizeof v);
    return ToByte(v);
  }
  if (component != Component::F16) return *texel;
  uint16_t h;
  std::memcpy(&h, texel, sizeof h);
  return ToByte(HalfToFloat(h));
}

std::string DataUri(const Image& image, const std::vector<uint8_t>& rgba) {
  const fur::Result<std::vector<uint8_t>> png = fur::EncodePng(image.width, image.height, rgba);
  return png ? "data:image/png;base64," + app::Base64(*png) : "";
}

std::vector<uint8_t> Amplified(const std::vector<uint8_t>& a, const std::vector<uint8_t>& b) {
  std::vector<uint8_t> difference(a.size(), 255);
  for (size_t i = 0; i < a.size(); i += 4) {
    const int alpha = std::abs(a[i + 3] - b[i + 3]);  // shown as grey
    for (size_t c = 0; c < 3; ++c)
      difference[i + c] = uint8_t(std::min(255, kDifferenceGain * std::max(alpha, std::abs(a[i + c] - b[i + c]))));
  }
  return difference;
}

fur::Picture ToPicture(const Image& image, const std::vector<uint8_t>& rgba) {
  fur::Picture p{.image = {image.width, image.height, {}}, .encoded = true};
  for (size_t i = 0; i < rgba.size(); i += 4)
    p.image.pixels.push_back({rgba[i] / 255.f, rgba[i + 1] / 255.f, rgba[i + 2] / 255.f, 1.f});
  return p;
}

}  // namespace

std::vector<uint8_t> Shown(const Image& image) {
  const uint32_t size = SizeOf(image.component);
  const uint32_t components = std::min(4u, std::max(1u, image.texelBytes / size));
  std::vector<uint8_t> rgba(size_t(image.width) * image.height * 4, 255);
  for (size_t i = 0; i < rgba.size() / 4; ++i) {
    const uint8_t* texel = &image.bytes[i * image.texelBytes];
    for (uint32_t c = 0; c < components; ++c) rgba[i * 4 + c] = ByteAt(texel + c * size, image.component);
    if (components == 1) rgba[i * 4 + 1] = rgba[i * 4 + 2] = rgba[i * 4];
    if (components == 2) rgba[i * 4 + 2] = 0;
  }
  return rgba;
}

Pictures MakePictures(const Compared& c) {
  Pictures p{.width = c.result.width, .height = c.result.height, .numbers = c};
  p.numbers.result = p.numbers.reference = {};
  if (uint64_t(p.width) * p.height > kMostPixels || p.width == 0 || p.height == 0) return p;
  const std::vector<uint8_t> reference = Shown(c.reference), result = Shown(c.result);
  p.reference = DataUri(c.reference, reference);
  p.result = DataUri(c.result, result);
  p.difference = DataUri(c.result, Amplified(reference, result));
  const auto flip = fur::ComparePictures(ToPicture(c.reference, reference), ToPicture(c.result, result), {});
  if (!flip) return p;
  p.flipMean = flip->flip.mean;
  p.flip = DataUri(c.result, fur::HeatMap(flip->flipMap, 1));
  return p;
}

}  // namespace conformance

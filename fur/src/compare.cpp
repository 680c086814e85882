#include "fur/compare.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <limits>

#include "compare_internal.h"
#include "file_bytes.h"
#include "fur/exr_io.h"
#include "fur/image_io.h"
#include "mips.h"

namespace fur {
namespace {

constexpr uint64_t kMaxPictureFile = uint64_t{1} << 30;
constexpr uint32_t kMaskGrowth = 4;    // pixels
constexpr double kRelMseFloor = 0.01;  // in the denominator of relMse: black must not divide by 0

bool IsFinite(const glm::vec4& p) { return std::isfinite(p.r) && std::isfinite(p.g) && std::isfinite(p.b); }

// Eight bits have few values: those are looked up.
float Decode(float encoded) {
  static const std::array<float, 256> table = [] {
    std::array<float, 256> t{};
    for (size_t i = 0; i < t.size(); ++i) t[i] = float(SrgbToLinear(double(float(i) / 255.0f)));
    return t;
  }();
  const float v = std::clamp(encoded, 0.0f, 1.0f);
  const auto i = size_t(v * 255 + 0.5f);
  return v == float(i) / 255.0f ? table[i] : float(SrgbToLinear(double(v)));
}

// A picture in both spaces that measures are made in.
struct Prepared {
  Rgb linear;   // as it is
  Rgb clamped;  // linear, 0..1
  Rgb display;  // sRGB-encoded, 0..1
};

Prepared Prepare(const Picture& picture, const std::vector<uint8_t>& broken) {
  const FloatImage& image = picture.image;
  Prepared p;
  for (Rgb* rgb : {&p.linear, &p.clamped, &p.display})
    *rgb = {image.width, image.height, std::vector<glm::vec3>(image.pixels.size(), glm::vec3(0))};
  for (size_t i = 0; i < image.pixels.size(); ++i) {
    if (broken[i]) continue;  // black in both pictures; its error is set afterwards
    for (int c = 0; c < 3; ++c) {
      const float v = image.pixels[i][c], inRange = std::clamp(v, 0.0f, 1.0f);
      p.linear.pixels[i][c] = picture.encoded ? Decode(v) : v;
      p.clamped.pixels[i][c] = picture.encoded ? p.linear.pixels[i][c] : inRange;
      p.display.pixels[i][c] = picture.encoded ? v : float(LinearToSrgb(double(inRange)));
    }
  }
  return p;
}

// ITU-R BT.601.
Plane Luma(const Rgb& in) {
  Plane out{in.width, in.height, std::vector<float>(in.pixels.size())};
  for (size_t i = 0; i < in.pixels.size(); ++i)
    out.values[i] = 0.299f * in.pixels[i].r + 0.587f * in.pixels[i].g + 0.114f * in.pixels[i].b;
  return out;
}

Plane Alpha(const FloatImage& image) {
  Plane out{image.width, image.height, std::vector<float>(image.pixels.size())};
  for (size_t i = 0; i < image.pixels.size(); ++i) out.values[i] = image.pixels[i].a;
  return out;
}

// Sums of squares over the pixels of a region.
class Squares {
 public:
  void Add(double square) {
    sum_ += square;
    ++count_;
  }
  std::optional<double> Mean() const { return count_ ? std::optional(sum_ / double(count_)) : std::nullopt; }
  std::optional<double> Root() const { return count_ ? std::optional(std::sqrt(sum_ / double(count_))) : std::nullopt; }

 private:
  double sum_ = 0;
  uint64_t count_ = 0;
};

struct Measurement {
  const Picture& a;
  const Picture& b;
  std::vector<uint8_t> broken, mask, band;
  Prepared pa, pb;
};

void MeasureColors(const Measurement& m, Comparison* out) {
  Squares all, mask, relative, display;
  for (size_t i = 0; i < m.broken.size(); ++i)
    for (int c = 0; c < 3; ++c) {
      const double r = double(m.pa.linear.pixels[i][c]), d = double(m.pb.linear.pixels[i][c]) - r;
      const double shown = std::abs(double(m.pb.display.pixels[i][c]) - double(m.pa.display.pixels[i][c]));
      const double square = m.broken[i] ? 1 : d * d, difference = m.broken[i] ? 1 : shown;
      all.Add(square);
      display.Add(difference * difference);
      out->largest = std::max(out->largest, difference);
      if (!m.mask[i]) continue;
      mask.Add(square);
      relative.Add(m.broken[i] ? 1 : square / (r * r + kRelMseFloor));
    }
  out->rmse = *all.Root();
  out->maskRmse = mask.Root();
  out->maskRelMse = relative.Mean();
  const double mse = *display.Mean();
  out->psnr = mse > 0 ? -10 * std::log10(mse) : std::numeric_limits<double>::infinity();
}

void MeasureEqual(const Measurement& m, Comparison* out) {
  const bool alike = m.a.encoded == m.b.encoded;
  const size_t bytes = sizeof(float) * (m.a.hasAlpha && m.b.hasAlpha ? 4 : 3);
  uint64_t equal = 0;
  for (size_t i = 0; i < m.broken.size(); ++i) {
    if (m.broken[i]) continue;
    equal += alike ? std::memcmp(&m.a.image.pixels[i], &m.b.image.pixels[i], bytes) == 0
                   : m.pa.display.pixels[i] == m.pb.display.pixels[i];
  }
  out->equalShare = double(equal) / double(out->pixels);
}

void MeasureOpacity(const Measurement& m, Comparison* out) {
  if (!m.a.hasAlpha || !m.b.hasAlpha) return;
  Squares band;
  for (size_t i = 0; i < m.band.size(); ++i) {
    if (!m.band[i]) continue;
    const double d = double(m.b.image.pixels[i].a) - double(m.a.image.pixels[i].a);
    band.Add(std::isfinite(d) ? d * d : 1);
  }
  out->bandOpacityRmse = band.Root();
}

void MeasureFlip(const Measurement& m, double pixelsPerDegree, Comparison* out) {
  out->flipMap = FlipMap(m.pa.clamped, m.pb.clamped, pixelsPerDegree);
  std::vector<float>& map = out->flipMap.values;
  double sum = 0, maskSum = 0;
  for (size_t i = 0; i < map.size(); ++i) {
    if (m.broken[i]) map[i] = 1;
    sum += double(map[i]);
    if (m.mask[i]) maskSum += double(map[i]);
  }
  Comparison::Flip& f = out->flip;
  f.mean = sum / double(map.size());
  if (out->maskPixels) f.maskMean = maskSum / double(out->maskPixels);
  std::vector<float> sorted = map;
  std::sort(sorted.begin(), sorted.end());
  f.q1 = WeightedPercentile(sorted, 0.25);
  f.weightedMedian = WeightedPercentile(sorted, 0.5);
  f.q3 = WeightedPercentile(sorted, 0.75);
  f.p99 = Percentile(sorted, 0.99);
  f.min = double(sorted.front());
  f.max = double(sorted.back());
}

void MeasureStructure(const Measurement& m, Comparison* out) {
  Plane map = SsimMap(Luma(m.pa.display), Luma(m.pb.display));
  for (size_t i = 0; i < map.values.size(); ++i)
    if (m.broken[i]) map.values[i] = 0;
  out->ssim = SsimMean(map);
}

uint64_t Count(const std::vector<uint8_t>& inside) { return uint64_t(std::count(inside.begin(), inside.end(), 1)); }

void FindRegions(const CompareSettings& s, Measurement* m, Comparison* out) {
  const FloatImage& a = m->a.image;
  const Plane alpha = m->a.hasAlpha ? Alpha(a) : Plane{};
  out->maskSource = s.mask ? RegionSource::Given : m->a.hasAlpha ? RegionSource::Alpha : RegionSource::Whole;
  out->bandSource = s.band ? RegionSource::Given : m->a.hasAlpha ? RegionSource::Alpha : RegionSource::None;
  if (out->maskSource == RegionSource::Whole)
    m->mask.assign(a.pixels.size(), 1);
  else
    m->mask = Dilate(FurPixels(s.mask ? *s.mask : alpha), a.width, a.height, kMaskGrowth);
  if (out->bandSource == RegionSource::None)
    m->band.assign(a.pixels.size(), 0);
  else
    m->band = s.band ? FurPixels(*s.band) : TranslucentPixels(alpha);
  out->maskPixels = Count(m->mask);
  out->bandPixels = Count(m->band);
}

std::string SizeText(uint32_t width, uint32_t height) {
  return std::to_string(width) + " x " + std::to_string(height) + " pixels";
}

Result<Done> CheckSize(const FloatImage& reference, uint32_t width, uint32_t height, const std::string& what) {
  if (reference.width == width && reference.height == height) return Done{};
  return Error{ErrorCode::Usage, what + " has " + SizeText(width, height) + ", the reference " +
                                     SizeText(reference.width, reference.height) +
                                     "; only pictures of one size can be compared"};
}

Result<Done> CheckSizes(const Picture& reference, const Picture& test, const CompareSettings& s) {
  const FloatImage& a = reference.image;
  if (Result<Done> ok = CheckSize(a, test.image.width, test.image.height, "the test picture"); !ok) return ok;
  if (s.mask)
    if (Result<Done> ok = CheckSize(a, s.mask->width, s.mask->height, "the mask"); !ok) return ok;
  if (s.band)
    if (Result<Done> ok = CheckSize(a, s.band->width, s.band->height, "the band"); !ok) return ok;
  if (a.pixels.empty()) return Error{ErrorCode::Usage, "the reference has no pixels; there is nothing to compare"};
  return Done{};
}

Picture FromBytes(const Image& image) {
  Picture picture{{image.width, image.height, std::vector<glm::vec4>(size_t(image.width) * image.height)}, true, false};
  for (size_t i = 0; i < image.pixels.size(); ++i)
    picture.image.pixels[i / 4][int(i % 4)] = float(image.pixels[i]) / 255.0f;
  return picture;
}

}  // namespace

Result<Picture> ReadPicture(const std::filesystem::path& file) {
  Result<std::vector<uint8_t>> bytes = ReadFileBytes(file, kMaxPictureFile);
  if (!bytes) return bytes.error();
  if (IsExr(*bytes)) {
    Result<ExrImage> exr = ReadExrFromMemory(*bytes, file.string());
    if (!exr) return exr.error();
    return Picture{std::move(exr->image), false, exr->hasAlpha};
  }
  Result<Image> image = ReadImageFromMemory(*bytes, file.filename().string(), file.string());
  if (!image) return image.error();
  return FromBytes(*image);
}

Result<Plane> ReadOpacity(const std::filesystem::path& file) {
  Result<Picture> picture = ReadPicture(file);
  if (!picture) return picture.error();
  const std::vector<glm::vec4>& pixels = picture->image.pixels;
  const auto translucent = [](const glm::vec4& p) { return p.a != 1; };
  const bool useAlpha = picture->encoded ? std::any_of(pixels.begin(), pixels.end(), translucent) : picture->hasAlpha;
  Plane out = Alpha(picture->image);
  if (!useAlpha)
    for (size_t i = 0; i < pixels.size(); ++i) out.values[i] = pixels[i].r;
  return out;
}

Result<Comparison> ComparePictures(const Picture& reference, const Picture& test, const CompareSettings& settings) {
  if (Result<Done> ok = CheckSizes(reference, test, settings); !ok) return ok.error();
  Comparison out;
  Measurement m{reference, test, {}, {}, {}, {}, {}};
  const std::vector<glm::vec4>&a = reference.image.pixels, &b = test.image.pixels;
  for (size_t i = 0; i < a.size(); ++i) m.broken.push_back(!IsFinite(a[i]) || !IsFinite(b[i]));
  out.pixels = a.size();
  out.nonFinite = Count(m.broken);
  m.pa = Prepare(reference, m.broken);
  m.pb = Prepare(test, m.broken);
  FindRegions(settings, &m, &out);
  MeasureColors(m, &out);
  MeasureEqual(m, &out);
  MeasureOpacity(m, &out);
  MeasureFlip(m, settings.pixelsPerDegree, &out);
  MeasureStructure(m, &out);
  return out;
}

}  // namespace fur

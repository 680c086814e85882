// How far a picture is from a reference: docs/accuracy.md, "The error".
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <vector>

#include "fur/float_image.h"
#include "fur/result.h"

namespace fur {

struct Picture {
  FloatImage image;
  bool encoded = false;   // rgb: sRGB-encoded, 0..1 (PNG, JPEG); else linear light, of any value (EXR)
  bool hasAlpha = false;  // alpha is the opacity of what was drawn over the background (EXR with a channel A)
};

// EXR by its first bytes, else whatever ReadImage (image_io.h) reads. The same errors.
Result<Picture> ReadPicture(const std::filesystem::path& file);

// A picture that says where fur is, 0..1: an EXR's alpha, a PNG's alpha where it is not opaque throughout; else red.
Result<Plane> ReadOpacity(const std::filesystem::path& file);

enum class RegionSource {
  None,   // no such region
  Given,  // by the caller
  Alpha,  // the reference's alpha
  Whole   // every pixel
};

struct CompareSettings {
  double pixelsPerDegree = 67;      // of FLIP: 0.7 m from a 4k display 0.7 m wide; > 0
  std::optional<Plane> mask, band;  // fur opacity of the reference, instead of its alpha
};

// A non-finite pixel, of either picture, counts as error 1 everywhere.
struct Comparison {
  struct Flip {
    double mean = 0;
    std::optional<double> maskMean;             // none: the mask is empty
    double weightedMedian = 0, q1 = 0, q3 = 0;  // each value weighs as much as itself: WeightedPercentile
    double p99 = 0, min = 0, max = 0;           // p99: Percentile
  } flip;
  // Linear light: all channels of the mask's pixels. relMse: mean of (b - a)^2 / (a^2 + 0.01) (Rousselle, Knaus,
  // Zwicker, "Adaptive Sampling and Reconstruction using Greedy Error Minimization", TOG 30(6), 2011).
  std::optional<double> maskRmse, maskRelMse;
  std::optional<double> bandOpacityRmse;  // none: a picture without alpha, no band, or an empty one
  double rmse = 0;                        // linear light, all channels and pixels
  double psnr = 0;                        // of sRGB values, peak 255 (1 here); infinite for equal pictures
  double ssim = 1;                        // of the luma of sRGB values
  double largest = 0;                     // difference of a channel of sRGB values, 0..1
  double equalShare = 1;  // share of pixels that are bit-equal as stored, alpha included where both have one
  uint64_t pixels = 0, maskPixels = 0, bandPixels = 0, nonFinite = 0;
  RegionSource maskSource = RegionSource::Whole, bandSource = RegionSource::None;
  Plane flipMap;  // 0..1
};

// Usage for sizes that differ, in words.
Result<Comparison> ComparePictures(const Picture& reference, const Picture& test, const CompareSettings& settings);

// RGBA8 of a map in the colours of magma, black at 0; values times `scale` beyond 1 are as 1.
std::vector<uint8_t> HeatMap(const Plane& map, double scale);

}  // namespace fur

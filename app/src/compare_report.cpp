#include "compare_report.h"

#include <fmt/format.h>

#include <cmath>

namespace app {
namespace {

nlohmann::ordered_json OrNull(const std::optional<double>& value) {
  return value && std::isfinite(*value) ? nlohmann::ordered_json(*value) : nlohmann::ordered_json(nullptr);
}

const char* MaskName(fur::RegionSource source) {
  switch (source) {
    case fur::RegionSource::Given: return "file";
    case fur::RegionSource::Alpha: return "reference_alpha";
    case fur::RegionSource::Whole: return "whole_picture";
    default: return "none";
  }
}

std::string Number(const std::optional<double>& value) { return value ? fmt::format("{:.6f}", *value) : "-"; }

std::string Region(const char* name, fur::RegionSource source, uint64_t pixels) {
  return fmt::format("{}: {} pixels ({})", name, pixels, MaskName(source));
}

}  // namespace

nlohmann::ordered_json ComparisonJson(const fur::Comparison& c, const ComparedFiles& files) {
  const fur::Comparison::Flip& f = c.flip;
  nlohmann::ordered_json j;
  j["reference"] = files.reference;
  j["test"] = files.test;
  j["width"] = c.flipMap.width;
  j["height"] = c.flipMap.height;
  j["clamped_and_encoded"] = {{"reference", !files.referenceEncoded}, {"test", !files.testEncoded}};
  j["pixels_per_degree"] = files.pixelsPerDegree;
  j["flip"] = {{"mean", f.mean},
               {"mask_mean", OrNull(f.maskMean)},
               {"weighted_median", f.weightedMedian},
               {"q1", f.q1},
               {"q3", f.q3},
               {"p99", f.p99},
               {"min", f.min},
               {"max", f.max}};
  j["mask"] = {{"rmse", OrNull(c.maskRmse)}, {"relmse", OrNull(c.maskRelMse)}, {"pixels", c.maskPixels}};
  j["mask_source"] = MaskName(c.maskSource);
  j["band"] = {{"opacity_rmse", OrNull(c.bandOpacityRmse)}, {"pixels", c.bandPixels}};
  j["band_source"] = MaskName(c.bandSource);
  j["rmse"] = c.rmse;
  j["psnr"] = OrNull(c.psnr);
  j["ssim"] = c.ssim;
  j["max"] = c.largest;
  j["equal_share"] = c.equalShare;
  j["non_finite"] = c.nonFinite;
  return j;
}

std::string ComparisonText(const fur::Comparison& c, const ComparedFiles& files) {
  const fur::Comparison::Flip& f = c.flip;
  std::string text = fmt::format("{} against {}\n", files.test, files.reference);
  text += fmt::format("  FLIP  mean {:.6f}, in the mask {}, 99 % {:.6f}, min {:.6f}, max {:.6f} ({} pixels a degree)\n",
                      f.mean, Number(f.maskMean), f.p99, f.min, f.max, files.pixelsPerDegree);
  text += fmt::format("        weighted median {:.6f}, quartiles {:.6f} and {:.6f}\n", f.weightedMedian, f.q1, f.q3);
  text += fmt::format("  RMSE  {:.6f}; in the mask {}, relMSE {} (linear light)\n", c.rmse, Number(c.maskRmse),
                      Number(c.maskRelMse));
  text += fmt::format("  PSNR  {:.3f} dB, SSIM {:.6f}, largest difference {:.6f} ({:.2f}/255)\n", c.psnr, c.ssim,
                      c.largest, 255 * c.largest);
  text += fmt::format("  equal {:.4f} % of {} pixels, {} not finite\n", 100 * c.equalShare, c.pixels, c.nonFinite);
  text += fmt::format("  {}; {}, opacity RMSE {}\n", Region("mask", c.maskSource, c.maskPixels),
                      Region("band", c.bandSource, c.bandPixels), Number(c.bandOpacityRmse));
  if (!files.referenceEncoded || !files.testEncoded) {
    const char* which = files.referenceEncoded ? "the test picture is"
                        : files.testEncoded    ? "the reference is"
                                               : "both are";
    text += std::string("  ") + which +
            " linear: clamped to 0..1 and sRGB-encoded for FLIP, PSNR, SSIM and the largest" + " difference\n";
  }
  return text;
}

}  // namespace app

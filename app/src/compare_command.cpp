// fur compare: how far a picture is from a reference, as text, JSON and a heat map, and whether that is too far.
#include <fmt/format.h>

#include <cmath>
#include <memory>

#include "commands.h"
#include "compare_report.h"
#include "flag_checks.h"
#include "fur/file.h"
#include "fur/image_io.h"

namespace app {
namespace {

using fur::Done;
using fur::Error;
using fur::ErrorCode;
using fur::Result;

struct CompareFlags {
  std::string reference, test, heat, mask, band, maxDifference;
  bool json = false;
  double ppd = 67, heatScale = 1;
  std::optional<double> maxFlip, maxMaskFlip, maxRmse, maxMaskRmse, maxBandRmse, minSsim, minPsnr, maxDifferingShare;
};

// What a flag allows of a measure. Without a value the limit is not met: a gate that looks at nothing must not pass.
struct Limit {
  const char *flag, *what;
  std::optional<double> value;
  double limit = 0;
  bool isLeast = false;  // else the most
};

std::string Excess(const Limit& l) {
  if (!l.value) return fmt::format("{} has no value, {} is {}", l.what, l.flag, l.limit);
  const bool met = l.isLeast ? *l.value >= l.limit : *l.value <= l.limit;  // false for NaN
  if (met) return "";
  return fmt::format("{} {} is {} {} {}", l.what, *l.value, l.isLeast ? "below" : "above", l.flag, l.limit);
}

// "0.01" or "3/255".
Result<double> ParseDifference(const std::string& text) {
  double value = 0, divisor = 1;
  char rest = 0;
  const bool fraction = std::sscanf(text.c_str(), "%lf/%lf%c", &value, &divisor, &rest) == 2;
  const bool number = !fraction && std::sscanf(text.c_str(), "%lf%c", &value, &rest) == 1;
  if ((fraction || number) && divisor > 0 && std::isfinite(value / divisor) && value >= 0) return value / divisor;
  return Error{ErrorCode::Usage, "--max-difference takes a number as 0.01 or N/255, not '" + text + "'"};
}

// One line that names each limit that is not met; empty: all are.
Result<std::string> ExceededLimits(const CompareFlags& f, const fur::Comparison& c) {
  std::vector<Limit> limits;
  const auto add = [&](const std::optional<double>& limit, const char* flag, const char* what,
                       const std::optional<double>& value, bool isLeast = false) {
    if (limit) limits.push_back({flag, what, value, *limit, isLeast});
  };
  add(f.maxFlip, "--max-flip", "mean FLIP", c.flip.mean);
  add(f.maxMaskFlip, "--max-mask-flip", "mean FLIP of the mask", c.flip.maskMean);
  add(f.maxRmse, "--max-rmse", "RMSE", c.rmse);
  add(f.maxMaskRmse, "--max-mask-rmse", "RMSE of the mask", c.maskRmse);
  add(f.maxBandRmse, "--max-band-rmse", "opacity RMSE of the band", c.bandOpacityRmse);
  add(f.minSsim, "--min-ssim", "SSIM", c.ssim, true);
  add(f.minPsnr, "--min-psnr", "PSNR", c.psnr, true);
  add(f.maxDifferingShare, "--max-differing-share", "share of differing pixels", 1 - c.equalShare);
  if (!f.maxDifference.empty()) {
    Result<double> difference = ParseDifference(f.maxDifference);
    if (!difference) return difference.error();
    // Pictures hold floats: a step of 1/255 is not always below 1.0/255.
    add(*difference + 1e-6, "--max-difference", "largest difference", c.largest);
  }
  std::string line;
  for (const Limit& l : limits)
    if (const std::string excess = Excess(l); !excess.empty()) line += (line.empty() ? "" : "; ") + excess;
  return line;
}

Result<fur::CompareSettings> ReadSettings(const CompareFlags& f) {
  fur::CompareSettings settings{.pixelsPerDegree = f.ppd, .mask = {}, .band = {}};
  for (const auto& [file, plane] : {std::pair{&f.mask, &settings.mask}, std::pair{&f.band, &settings.band}}) {
    if (file->empty()) continue;
    Result<fur::Plane> opacity = fur::ReadOpacity(*file);
    if (!opacity) return opacity.error();
    *plane = std::move(*opacity);
  }
  return settings;
}

Result<Done> CheckOutput(const CompareFlags& f) {
  if (f.heat.empty()) return Done{};
  for (const std::string* input : {&f.reference, &f.test, &f.mask, &f.band}) {
    std::error_code missing;
    if (std::filesystem::equivalent(f.heat, *input, missing))
      return Error{ErrorCode::Usage, "--heat would overwrite an input: " + f.heat};
  }
  return fur::CheckWritable(f.heat);
}

Result<Done> Compare(const CompareFlags& f) {
  if (Result<Done> ok = CheckOutput(f); !ok) return ok.error();
  if (Result<std::string> ok = ExceededLimits(f, fur::Comparison{}); !ok) return ok.error();  // before long work
  Result<fur::Picture> reference = fur::ReadPicture(f.reference);
  if (!reference) return reference.error();
  Result<fur::Picture> test = fur::ReadPicture(f.test);
  if (!test) return test.error();
  Result<fur::CompareSettings> settings = ReadSettings(f);
  if (!settings) return settings.error();
  Result<fur::Comparison> c = fur::ComparePictures(*reference, *test, *settings);
  if (!c) return c.error();
  if (!f.heat.empty()) {
    const std::vector<uint8_t> heat = fur::HeatMap(c->flipMap, f.heatScale);
    if (Result<Done> ok = fur::WritePng(f.heat, c->flipMap.width, c->flipMap.height, heat); !ok) return ok.error();
  }
  const ComparedFiles files{f.reference, f.test, reference->encoded, test->encoded, f.ppd};
  fmt::print("{}", f.json ? ComparisonJson(*c, files).dump(2) + "\n" : ComparisonText(*c, files));
  Result<std::string> exceeded = ExceededLimits(f, *c);
  if (!exceeded) return exceeded.error();
  if (!exceeded->empty()) return Error{ErrorCode::ComparisonFailed, *exceeded};
  return Done{};
}

void AddLimits(CLI::App* c, CompareFlags* f) {
  const auto add = [c](const char* flag, std::optional<double>* value, const char* what) {
    c->add_option(flag, *value, what)->check(kFinite);
  };
  add("--max-flip", &f->maxFlip, "Fail above this mean FLIP");
  add("--max-mask-flip", &f->maxMaskFlip, "Fail above this mean FLIP of the mask");
  add("--max-rmse", &f->maxRmse, "Fail above this RMSE of the picture, in linear light");
  add("--max-mask-rmse", &f->maxMaskRmse, "Fail above this RMSE of the mask, in linear light");
  add("--max-band-rmse", &f->maxBandRmse, "Fail above this RMSE of the band's opacity");
  add("--min-ssim", &f->minSsim, "Fail below this SSIM");
  add("--min-psnr", &f->minPsnr, "Fail below this PSNR in dB");
  add("--max-differing-share", &f->maxDifferingShare, "Fail above this share of pixels that are not bit-equal, 0..1");
  c->add_option("--max-difference", f->maxDifference, "Fail above this difference of a channel, 0..1 or N/255");
}

void AddFlags(CLI::App* c, CompareFlags* f) {
  c->add_option("A", f->reference, "The reference: PNG, JPEG or EXR")->required();
  c->add_option("B", f->test, "The picture that is measured, of the same size")->required();
  c->add_flag("--json", f->json, "Print JSON instead of text");
  c->add_option("--heat", f->heat, "PNG for the FLIP error of each pixel, black to light yellow");
  c->add_option("--heat-scale", f->heatScale, "Multiplies the errors of --heat")
      ->check(kFinite)->check(CLI::PositiveNumber)->capture_default_str();
  c->add_option("--mask", f->mask,
                "Picture of the reference's fur opacity (alpha, else red); default: A's alpha, or all");
  c->add_option("--band", f->band,
                "Picture that is above 1/255 where fur has no skin behind it; default: by A's alpha");
  c->add_option("--ppd", f->ppd, "Pixels per degree of the visual field, for FLIP")
      ->check(kFinite)->check(CLI::Range(1.0, 1000.0))->capture_default_str();
  AddLimits(c, f);
}

}  // namespace

void AddCompareCommand(CLI::App& app, Command* run) {
  auto flags = std::make_shared<CompareFlags>();
  CLI::App* c = app.add_subcommand("compare", "Measure how far picture B is from the reference A");
  AddFlags(c, flags.get());
  c->callback([flags, run] { *run = Running(flags, Compare); });
}

}  // namespace app

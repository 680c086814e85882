#include "recorder.h"

#include "drivers.h"

namespace conformance {

constexpr size_t kKeptFailures = 4;

Recorder& TheRecorder() {
  static Recorder recorder;
  return recorder;
}

void Recorder::Begin(const CaseName& name, const std::string& driver) {
  case_ = {.name = name};
  driver_ = driver;
  active_ = true;
}

CaseRecord Recorder::End(bool skipped) {
  active_ = false;
  const bool pair = before_ && !skipped && before_->name.Base() == case_.name.Base() && before_->name.backend == "vulkan" &&
                    case_.name.backend == "gl";
  if (pair) case_.parity = CompareReadBacks(*before_, case_, OddDriver());
  before_.reset();
  if (!skipped) before_ = CaseRecord{.name = case_.name, .readBacks = case_.readBacks};
  driver_.clear();
  return std::move(case_);
}

void Recorder::ReadBack(const Image& image) {
  if (active_) case_.readBacks.push_back(image);
}

void Recorder::Add(Compared compared) {
  if (!active_) return;
  ++case_.comparisons;
  case_.worst = std::max(case_.worst, compared.outcome.worst);
  std::vector<Compared>& kept = case_.kept;
  const bool onlyGood = kept.empty() || (kept.size() == 1 && kept[0].ok);
  if (!compared.ok) {
    if (onlyGood) kept.clear();
    if (kept.size() < kKeptFailures) kept.push_back(std::move(compared));
    return;
  }
  if (!onlyGood) return;
  if (!kept.empty() && compared.outcome.worst <= kept[0].outcome.worst) return;
  kept.assign(1, std::move(compared));
}

void Recorder::Measured(const Tolerance& tolerance, double distance) {
  if (!active_ || tolerance.name == std::string(kExact.name)) return;
  MeasuredTolerance& m = measured_[{tolerance.name, driver_}];
  m.worst = std::max(m.worst, distance);
  ++m.comparisons;
}

Parity CompareReadBacks(const CaseRecord& vulkan, const CaseRecord& gl, const std::string& driver) {
  Parity parity{.limit = &ParityLimitOf(gl.name.Base(), driver)};
  if (vulkan.readBacks.size() != gl.readBacks.size()) {
    parity.problem = "Vulkan read " + std::to_string(vulkan.readBacks.size()) + " pictures and buffers back, GL " +
                     std::to_string(gl.readBacks.size());
    return std::isinf(parity.limit->limit) ? Parity{.limit = parity.limit} : parity;
  }
  for (size_t i = 0; i < gl.readBacks.size(); ++i) {
    const Image &a = gl.readBacks[i], &b = vulkan.readBacks[i];
    const Difference d = Compare(a, b);
    ++parity.pictures;
    parity.pixels += uint64_t(a.width) * a.height;
    parity.differing += d.pixels;
    parity.worst = d.sameShape ? std::max(parity.worst, d.worst) : INFINITY;
    if ((d.pixels == 0 && d.sameShape) || parity.shown || !d.sameShape) continue;
    parity.shown = Compared{.outcome = {uint64_t(a.width) * a.height, d.pixels, d.pixels, d.worst},
                            .tolerance = "Vulkan against GL",
                            .limit = parity.limit->limit,
                            .ok = false,
                            .result = a,
                            .reference = b};
  }
  const double share = parity.pixels ? double(parity.differing) / double(parity.pixels) : 0;
  if (parity.worst <= parity.limit->limit && share <= parity.limit->share) return parity;
  std::ostringstream text;
  text << "GL reads other bytes back than Vulkan: " << parity.differing << " of " << parity.pixels << " pixels in "
       << parity.pictures << " pictures, by up to " << parity.worst << " (allowed: " << parity.limit->limit << ", on "
       << parity.limit->share * 100 << " % of the pixels)";
  parity.problem = text.str();
  return parity;
}

}  // namespace conformance

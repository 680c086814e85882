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
  const bool pair = before_ && !skipped && before_->name.Base() == case_.name.Base() &&
                    before_->name.backend == "vulkan" && case_.name.backend == "gl";
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

void Recorder::Measured(const Tolerance& tolerance, double distance, double differing) {
  if (!active_ || tolerance.name == std::string(kExact.name)) return;
  MeasuredTolerance& m = measured_[{tolerance.name, driver_}];
  m.worst = std::max(m.worst, distance);
  m.differing = std::max(m.differing, differing);
  ++m.comparisons;
}

namespace {

void AddTo(Parity* parity, const Image& gl, const Image& vulkan) {
  const Outcome o = Measure(gl, vulkan, parity->limit->steps);
  ++parity->pictures;
  parity->pixels += o.pixels;
  parity->differing += o.differing;
  parity->beyond += o.beyond;
  parity->worst = o.sameShape ? std::max(parity->worst, o.worst) : INFINITY;
  if (o.differing == 0 || parity->shown) return;
  parity->shown = Compared{.outcome = o,
                           .tolerance = "Vulkan against GL",
                           .limit = parity->limit->steps,
                           .ok = false,
                           .result = gl,
                           .reference = vulkan};
}

// What is wrong with so many pixels, or "".
std::string ProblemOf(const Parity& p) {
  const ParityLimit& limit = *p.limit;
  const double pixels = double(p.pixels);
  const bool shapes = std::isinf(p.worst) && p.differing == 0;
  if (!limit.Compared()) return "";
  if (!shapes && double(p.differing) <= limit.differing * pixels && double(p.beyond) <= limit.beyond * pixels)
    return "";
  std::ostringstream text;
  text << "GL reads other bytes back than Vulkan: " << (shapes ? "pictures of other shapes, " : "") << p.differing
       << " of " << p.pixels << " pixels in " << p.pictures << " pictures differ (allowed: " << limit.differing * 100
       << " %), " << p.beyond << " by more than " << limit.steps << " (allowed: " << limit.beyond * 100
       << " %), by up to " << p.worst;
  return text.str();
}

}  // namespace

testing::AssertionResult Recorder::Backends(const Image& gl, const Image& vulkan) {
  Parity now{.limit = &ParityLimitOf(case_.name.Base(), driver_)};
  AddTo(&now, gl, vulkan);
  const std::string problem = ProblemOf(now);
  Add({Measure(gl, vulkan, now.limit->steps), "Vulkan against GL", Unit::Lsb, now.limit->steps, 0, problem.empty(), gl,
       vulkan});
  if (!case_.parity) case_.parity = Parity{.limit = now.limit};
  Parity& all = *case_.parity;
  all.pictures += now.pictures;
  all.pixels += now.pixels;
  all.differing += now.differing;
  all.beyond += now.beyond;
  all.worst = std::max(all.worst, now.worst);
  if (problem.empty()) return testing::AssertionSuccess();
  return testing::AssertionFailure() << problem;
}

Parity CompareReadBacks(const CaseRecord& vulkan, const CaseRecord& gl, const std::string& driver) {
  Parity parity{.limit = &ParityLimitOf(gl.name.Base(), driver)};
  if (!parity.limit->Compared()) return parity;
  if (vulkan.readBacks.size() != gl.readBacks.size()) {
    parity.problem = "Vulkan read " + std::to_string(vulkan.readBacks.size()) + " pictures and buffers back, GL " +
                     std::to_string(gl.readBacks.size());
    return parity;
  }
  for (size_t i = 0; i < gl.readBacks.size(); ++i) AddTo(&parity, gl.readBacks[i], vulkan.readBacks[i]);
  parity.problem = ProblemOf(parity);
  return parity;
}

}  // namespace conformance

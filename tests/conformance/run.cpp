#include "run.h"

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <ctime>
#include <set>
#include <sstream>

#include "../rhi/gpu.h"
#include "pictures.h"
#include "skips.h"

namespace conformance {
namespace {

using testing::TestPartResult;

std::array<char, 256> runningCase{};  // not a std::string: a signal handler reads it

// Follows GoogleTest's cases: begins and ends their records, and holds them to the rules of skips and of parity.
class Listener final : public testing::EmptyTestEventListener {
 public:
  Listener(Run* run, const Options& o) : run_(run), pictures_(!o.html.empty()), readBacks_(!o.readBacks.empty()) {}

  void OnTestStart(const testing::TestInfo& info) override {
    current_ = {.name = NameOf(info)};
    std::snprintf(runningCase.data(), runningCase.size(), "%s", current_.name.Full().c_str());
    current_.driver = DriverLabelOf(current_.name.backend);
    TheRecorder().Begin(current_.name, DriverKeyOf(current_.name.backend));
  }
  void OnTestPartResult(const TestPartResult& part) override {
    std::string text = part.message() ? part.message() : "";
    if (part.skipped()) {
      current_.skip = text;
      return;
    }
    if (!part.failed()) return;
    if (text.starts_with("Failed\n")) text.erase(0, 7);
    if (part.file_name() && !std::string(part.file_name()).ends_with("conformance/run.cpp"))
      text = std::string(part.file_name()) + ":" + std::to_string(part.line_number()) + ": " + text;
    current_.failures.push_back(text);
  }
  void OnTestEnd(const testing::TestInfo& info) override {
    const bool skipped = info.result()->Skipped();
    CaseRecord record = TheRecorder().End(skipped);
    if (skipped)
      if (const std::string problem =
              SkipProblem(current_.name.Base(), DriverKeyOf(current_.name.backend), current_.skip);
          !problem.empty())
        ADD_FAILURE() << problem;
    if (record.parity && !record.parity->problem.empty()) ADD_FAILURE() << record.parity->problem;
    const bool failed = info.result()->Failed();
    current_.result = failed ? Result::Failed : skipped ? Result::Skipped : Result::Passed;
    current_.seconds = double(info.result()->elapsed_time()) / 1000;
    current_.comparisons = record.comparisons;
    current_.worst = record.worst;
    if (record.parity) Take(*record.parity);
    if (readBacks_)
      for (const Image& i : record.readBacks)
        run_->readBacks.insert(run_->readBacks.end(), i.bytes.begin(), i.bytes.end());
    if (pictures_)
      for (const Compared& c : record.kept) current_.pictures.push_back(MakePictures(c));
    Print();
    run_->cases.push_back(std::move(current_));
  }

 private:
  void Take(Parity& parity) {
    if (parity.shown && pictures_) current_.pictures.push_back(MakePictures(*parity.shown));
    parity.shown.reset();
    current_.hasParity = true;
    current_.parity = std::move(parity);
  }
  void Print() const {
    if (current_.result == Result::Passed) return;
    std::printf("%-7s %s\n", ToString(current_.result), current_.name.Full().c_str());
    if (current_.result == Result::Skipped) std::printf("        %s\n", current_.skip.c_str());
    for (const std::string& failure : current_.failures) std::printf("        %s\n", failure.c_str());
    std::fflush(stdout);
  }
  Run* run_;
  bool pictures_, readBacks_;
  CaseResult current_;
};

// What GoogleTest says outside of cases: a device that complains when it is closed.
class LateMessages final : public testing::EmptyTestEventListener {
 public:
  explicit LateMessages(Run* run) : run_(run) {}
  void OnTestStart(const testing::TestInfo&) override { inCase_ = true; }
  void OnTestEnd(const testing::TestInfo&) override { inCase_ = false; }
  void OnTestPartResult(const TestPartResult& part) override {
    if (!inCase_ && part.failed()) run_->problems.push_back(part.message());
  }

 private:
  Run* run_;
  bool inCase_ = false;
};

std::string Now() {
  const std::time_t now = std::time(nullptr);
  char text[32];
  std::strftime(text, sizeof text, "%Y-%m-%dT%H:%M:%SZ", std::gmtime(&now));
  return text;
}

std::string GTestFilter(const std::vector<CaseName>& cases) {
  std::string filter;
  for (const CaseName& c : cases) filter += (filter.empty() ? "" : ":") + c.gtest;
  return filter;
}

bool CanRun(const CaseName& name, const std::array<DriverInfo, 2>& drivers) {
  if (name.backend == "cpu") return true;
  if (name.backend == "both") return drivers[0].present && drivers[1].present;
  return drivers[name.backend == "vulkan" ? 0 : 1].present;
}

// A driver that is there, and that the selection has cases for, has to have run some.
void CheckThatSomeRan(const std::vector<CaseName>& selected, Run* run) {
  for (const DriverInfo& driver : run->drivers) {
    if (!driver.present) continue;
    const bool wanted =
        std::any_of(selected.begin(), selected.end(), [&](const CaseName& c) { return c.backend == driver.backend; });
    const bool ran = std::any_of(run->cases.begin(), run->cases.end(), [&](const CaseResult& c) {
      return c.name.backend == driver.backend && c.result != Result::Skipped;
    });
    if (wanted && !ran) run->problems.push_back("no case ran on " + driver.key + ", which is there");
  }
}

// Whether the run had all cases that use a tolerance: only then what it measured says how wide the limit has to be.
bool SawAllOf(const Tolerance& t, const std::vector<CaseName>& all, const Run& run) {
  return std::all_of(all.begin(), all.end(), [&](const CaseName& c) {
    if (!MatchesGlob(t.cases, c.Base()) || !MatchesGlob(t.drivers, DriverKeyOf(c.backend))) return true;
    return std::any_of(run.cases.begin(), run.cases.end(),
                       [&](const CaseResult& r) { return r.name.gtest == c.gtest && r.result == Result::Passed; });
  });
}

void CheckTolerances(Run* run) {
  const std::vector<CaseName> all = RegisteredCases();
  for (const Tolerance& t : Tolerances()) {
    double measured = 0, differing = 0;
    bool seen = false;
    for (const auto& [key, m] : run->measured) {
      if (key.first != t.name || !MatchesGlob(t.drivers, key.second)) continue;
      seen = true;
      measured = std::max(measured, m.worst);
      differing = std::max(differing, m.differing);
    }
    const std::string problem = seen && SawAllOf(t, all, *run) ? Slack(t, measured, t.differing < 1 ? differing : 1) : "";
    if (!problem.empty()) run->problems.push_back(problem);
  }
}

bool IsRequired(const DriverInfo& d) { return d.key == "vulkan:lavapipe" || d.key == "gl:llvmpipe"; }

DriverInfo Probe(rhi::Backend backend) {
  try {
    return Describe(rhi_test::SharedGpu(backend).device->GetCaps());
  } catch (const std::exception& e) {
    return {.backend = BackendName(backend), .problem = e.what()};
  }
}

// "a*,b*,-c*": what fits one of the first and none of those with a dash. With dashes only: all but those.
bool FitsFilter(const std::string& filter, const CaseName& c) {
  std::istringstream patterns(filter);
  bool wanted = filter.starts_with('-');
  for (std::string pattern; std::getline(patterns, pattern, ',');) {
    const bool without = pattern.starts_with('-');
    if (without) pattern.erase(0, 1);
    if (MatchesGlob(pattern, c.Full()) || MatchesGlob(pattern, c.gtest)) wanted = !without;
  }
  return wanted;
}

}  // namespace

const char* ToString(Result r) { return r == Result::Passed ? "passed" : r == Result::Failed ? "FAILED" : "skipped"; }

const char* RunningCase() { return runningCase.data(); }

uint64_t Run::Count(Result r) const {
  return uint64_t(std::count_if(cases.begin(), cases.end(), [r](const CaseResult& c) { return c.result == r; }));
}

std::vector<CaseName> Selected(const std::vector<CaseName>& all, const Options& o) {
  std::vector<CaseName> selected;
  std::map<std::string, size_t> order;  // of the names without backend
  for (const CaseName& c : all) {
    if (!FitsFilter(o.filter, c)) continue;
    const size_t index = order.try_emplace(c.Base(), order.size()).first->second;
    if (index % o.shards == o.shard - 1) selected.push_back(c);
  }
  return selected;
}

std::string Duplicates(const std::vector<CaseName>& all) {
  std::set<std::string> seen;
  for (const CaseName& c : all)
    if (!seen.insert(c.Full()).second) return c.Full() + " (" + c.gtest + ")";
  return "";
}

std::array<DriverInfo, 2> ProbeDrivers(const Options& o) {
  for (const std::string& a : o.adapters) {
    const bool vulkan = a.starts_with("vulkan:"), gl = a.starts_with("gl:");
    const std::string name = vulkan || gl ? a.substr(a.find(':') + 1) : a;
    if (!gl) rhi_test::UseAdapter(rhi::Backend::Vulkan, name);
    if (!vulkan) rhi_test::UseAdapter(rhi::Backend::OpenGL, name);
  }
  const std::array<DriverInfo, 2> drivers{Probe(rhi::Backend::Vulkan), Probe(rhi::Backend::OpenGL)};
  SetDrivers(drivers[0], drivers[1]);
  return drivers;
}

std::string MissingDrivers(const std::array<DriverInfo, 2>& drivers, const Options& o) {
  for (const std::string& r : o.required) {
    const std::string backend = r.substr(0, r.find(':')), name = r.substr(r.find(':') + 1);
    const DriverInfo& d = drivers[backend == "vulkan" ? 0 : 1];
    if (!d.present) return "--require " + r + ": no " + backend + " driver can be used: " + d.problem;
    if (d.adapter.find(name) == std::string::npos && d.key != r)
      return "--require " + r + ": the " + backend + " driver is " + d.key + " (" + d.adapter + ")";
  }
  return "";
}

Run RunCases(const std::vector<CaseName>& selected, const std::array<DriverInfo, 2>& drivers, const Options& o) {
  Run run{.drivers = drivers, .command = o.command, .date = Now()};
  std::vector<CaseName> able;
  std::copy_if(selected.begin(), selected.end(), std::back_inserter(able),
               [&](const CaseName& c) { return CanRun(c, drivers); });
  run.notRun = selected.size() - able.size();
  if (able.empty()) {
    run.problems.push_back("no case can run on the drivers that are there");
    return run;
  }
  testing::GTEST_FLAG(filter) = GTestFilter(able);
  testing::TestEventListeners& listeners = testing::UnitTest::GetInstance()->listeners();
  delete listeners.Release(listeners.default_result_printer());
  listeners.Append(new LateMessages(&run));
  listeners.Append(new Listener(&run, o));  // GoogleTest owns it
  const auto start = std::chrono::steady_clock::now();
  [[maybe_unused]] const int result = RUN_ALL_TESTS();  // the listeners know more
  run.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  run.measured = TheRecorder().AllMeasured();
  CheckThatSomeRan(selected, &run);
  if (IsRequired(drivers[0]) && IsRequired(drivers[1])) CheckTolerances(&run);
  return run;
}

}  // namespace conformance

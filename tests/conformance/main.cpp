// fur_conformance: proof that the backends agree, on any driver. docs/conformance.md.
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <csignal>

#include "driver_table.h"
#include "fur/file.h"
#include "planted.h"
#include "report.h"
#include "run.h"
#include "settings.h"

namespace conformance {
namespace {

enum ExitCode {
  kPassed = 0,
  kInternal = 1,
  kUsage = 2,
  kInputMissing = 3,
  kOutput = 5,
  kNoDriver = 6,
  kCaseFailed = 8
};

int Fail(ExitCode code, std::string message) {
  while (!message.empty() && message.back() == '\n') message.pop_back();
  std::replace(message.begin(), message.end(), '\n', ' ');
  fmt::print(stderr, "fur_conformance: error: {}\n", message);
  return code;
}

struct Flags : Options {
  bool list = false, tolerances = false, plant = false;
  std::string shardText = "1/1", assets;
  std::vector<std::string> driverTable;
};

void AddFlags(CLI::App& app, Flags* f) {
  app.add_flag("--list", f->list, "Print the names of the cases, one a line, and run none");
  app.add_flag("--tolerances", f->tolerances, "Print what may differ, by how much and why");
  app.add_flag("--plant", f->plant, "Add cases that must fail (planted.*), to see that failures show");
  app.add_option("--filter", f->filter,
                 "Run the cases whose name fits: globs (* ?) with commas between, a dash in front leaves out")
      ->capture_default_str();
  app.add_option("--shard", f->shardText, "Run part I of N, as I/N; twins on the two backends stay together");
  app.add_option("--require", f->required,
                 "Fail without this driver: BACKEND:NAME with commas between, as vulkan:llvmpipe,gl:llvmpipe")
      ->delimiter(',');
  app.add_option("--adapter", f->adapters,
                 "Use this adapter: part of its name, with vulkan: or gl: in front for one backend; default: software")
      ->delimiter(',');
  app.add_option("--junit", f->junit, "Write JUnit XML");
  app.add_option("--json", f->json, "Write everything but the pictures as JSON");
  app.add_option("--html", f->html, "Write a page with the pictures");
  app.add_option("--read-backs", f->readBacks, "Write the bytes that the cases read back, one after the other");
  app.add_option("--driver-table", f->driverTable,
                 "Print the table of docs/drivers.md from JSON reports, and run no case");
  app.add_option("--assets", f->assets, "Folder of the models of fur.* cases")->capture_default_str();
}

bool ParseShard(const std::string& text, Options* o) {
  char rest = 0;
  if (std::sscanf(text.c_str(), "%u/%u%c", &o->shard, &o->shards, &rest) != 2) return false;
  return o->shard >= 1 && o->shard <= o->shards && o->shards <= 1000;
}

// "" or what is wrong with the flags.
std::string BadFlags(Flags* f) {
  if (!ParseShard(f->shardText, f)) return "--shard " + f->shardText + ": must be I/N with 1 <= I <= N";
  for (const std::string& r : f->required)
    if (!(r.starts_with("vulkan:") || r.starts_with("gl:")) || r.back() == ':')
      return "--require " + r + ": must be vulkan:NAME or gl:NAME";
  std::vector<std::string> files{f->junit, f->json, f->html, f->readBacks};
  std::erase(files, "");
  std::sort(files.begin(), files.end());
  if (std::adjacent_find(files.begin(), files.end()) != files.end()) return "two reports go to the same file";
  return "";
}

int PrintList(const std::vector<CaseName>& cases) {
  for (const CaseName& c : cases) fmt::print("{}\n", c.Full());
  return kPassed;
}

int PrintTolerances() {
  for (const Tolerance& t : Tolerances())
    fmt::print("{}: {} {} ({} pixels beyond), measured {}; {} on {}\n    {}\n", t.name, t.limit, ToString(t.unit),
               t.pixels, t.measured, t.cases, t.drivers, t.cause);
  for (const ParityLimit& p : ParityLimits())
    if (p.Compared())
      fmt::print(
          "Vulkan against GL: {} on {}: up to {} steps on {} % of the pixels, more on {} % (measured {}, {} %, {} %)\n"
          "    {}\n",
          p.cases, p.drivers, p.steps, p.differing * 100, p.beyond * 100, p.measuredSteps, p.measuredDiffering * 100,
          p.measuredBeyond * 100, p.cause);
    else
      fmt::print("Vulkan against GL: {} on {}: not compared\n    {}\n", p.cases, p.drivers, p.cause);
  return kPassed;
}

int PrintDriverTable(const std::vector<std::string>& reports) {
  try {
    fmt::print("{}", DriverTable(reports));
  } catch (const std::runtime_error& e) {
    return Fail(kInputMissing, e.what());
  }
  return kPassed;
}

int WriteReports(const Run& run, const Options& o) {
  const std::pair<std::string, std::string (*)(const Run&)> reports[] = {
      {o.junit, JUnitXml}, {o.json, Json}, {o.html, Html}};
  for (const auto& [file, make] : reports) {
    if (file.empty()) continue;
    if (const auto done = fur::WriteFile(file, std::string_view(make(run))); !done)
      return Fail(kOutput, done.error().message);
  }
  if (o.readBacks.empty()) return kPassed;
  const std::string_view bytes(reinterpret_cast<const char*>(run.readBacks.data()), run.readBacks.size());
  if (const auto done = fur::WriteFile(o.readBacks, bytes); !done) return Fail(kOutput, done.error().message);
  return kPassed;
}

void PrintDrivers(const std::array<DriverInfo, 2>& drivers) {
  for (const DriverInfo& d : drivers)
    if (d.present)
      fmt::print("{}: {}, {}\n", d.key, d.adapter, d.driver);
    else
      fmt::print("{}: not there: {}\n", d.backend, d.problem);
  std::fflush(stdout);
}

void PrintSummary(const Run& run) {
  for (const std::string& p : run.problems) fmt::print("FAILED  {}\n", p);
  if (run.notRun) fmt::print("{} cases did not run: their backend is not there\n", run.notRun);
  fmt::print("{} cases: {} passed, {} failed, {} skipped in {:.1f} s\n", run.cases.size(), run.Count(Result::Passed),
             run.Count(Result::Failed), run.Count(Result::Skipped), run.seconds);
}

// A driver that crashes takes the report with it; this says at least where.
void OnCrash(int signal) {
  const char* name = RunningCase();
  for (const char* text : {"fur_conformance: error: crashed in ", name, "\n"})
    if (write(2, text, std::char_traits<char>::length(text)) < 0) break;
  std::signal(signal, SIG_DFL);
  std::raise(signal);
}

int RunAndReport(const std::vector<CaseName>& cases, const Options& o) {
  for (const std::string& file : {o.junit, o.json, o.html, o.readBacks}) {
    if (file.empty()) continue;
    if (const auto can = fur::CheckWritable(file); !can) return Fail(kOutput, can.error().message);
  }
  const std::array<DriverInfo, 2> drivers = ProbeDrivers(o);
  if (const std::string missing = MissingDrivers(drivers, o); !missing.empty()) return Fail(kNoDriver, missing);
  if (!drivers[0].present && !drivers[1].present)
    return Fail(kNoDriver, "no driver can be used: " + drivers[0].problem + "; " + drivers[1].problem);
  PrintDrivers(drivers);
  for (const int s : {SIGSEGV, SIGABRT, SIGFPE, SIGBUS, SIGILL}) std::signal(s, OnCrash);
  const Run run = RunCases(cases, drivers, o);
  PrintSummary(run);
  if (const int failed = WriteReports(run, o)) return failed;
  return run.Ok() ? kPassed : kCaseFailed;
}

int Main(int argc, char** argv) {
  CLI::App app{"Conformance of the RHI and of fur on the Vulkan and OpenGL drivers of this machine"};
  app.name("fur_conformance");
  app.footer(
      "Exit codes: 0 all passed, 1 internal error, 2 wrong flags, 3 missing input, 5 output cannot be written,\n"
      "6 no usable or no required driver, 8 a case failed.");
  Flags flags;
  flags.assets = AssetsFolder();
  AddFlags(app, &flags);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& e) {
    if (e.get_exit_code() == 0) return app.exit(e);
    return Fail(kUsage, fmt::format("{}; see fur_conformance --help", e.what()));
  }
  if (const std::string bad = BadFlags(&flags); !bad.empty()) return Fail(kUsage, bad);
  if (!SetAssetsFolder(flags.assets) && app.count("--assets"))
    return Fail(kInputMissing, "--assets " + flags.assets + ": no such folder");
  if (!flags.driverTable.empty()) return PrintDriverTable(flags.driverTable);
  for (int i = 0; i < argc; ++i) flags.command += (i ? " " : "") + std::string(argv[i]);
  int one = 1;
  testing::InitGoogleTest(&one, argv);
  if (flags.plant) RegisterPlanted();
  const std::vector<CaseName> all = RegisteredCases();
  if (const std::string twice = Duplicates(all); !twice.empty())
    return Fail(kInternal, "two cases have the name " + twice);
  if (flags.tolerances) return PrintTolerances();
  const std::vector<CaseName> selected = Selected(all, flags);
  if (flags.list) return PrintList(selected);
  if (selected.empty())
    return Fail(kUsage, "--filter " + flags.filter + " --shard " + flags.shardText + ": no case fits");
  return RunAndReport(selected, flags);
}

}  // namespace
}  // namespace conformance

int main(int argc, char** argv) {
  try {
    return conformance::Main(argc, argv);
  } catch (const std::exception& e) {
    return conformance::Fail(conformance::kInternal, e.what());
  }
}
